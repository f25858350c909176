"""Compile generated C once and run it over stimuli. Not for: judging what comes out."""

from __future__ import annotations

import subprocess
import tempfile
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import Self

import numpy as np
from numpy.typing import NDArray

from swayless.codegen.render import GeneratedFile
from swayless.controller.settings import ShaperSettings
from swayless.errors import VerificationError
from swayless.verify.records import output_dtype
from swayless.verify.toolchain import Compiler

RUN_TIMEOUT_S = 300.0
"""A million ticks take a fraction of a second."""


class CompiledProgram:
    """A block in C, compiled; a context manager that owns a temporary folder.

    Parameters
    ----------
    files : sequence of GeneratedFile
        Header, source and example; every source is compiled with strict warnings.
    harness : GeneratedFile
        The program that feeds the block.
    compiler : Compiler
        What compiles them.
    outputs : dtype
        Layout of the records of its outputs.
    """

    def __init__(
        self,
        files: Sequence[GeneratedFile],
        harness: GeneratedFile,
        compiler: Compiler,
        outputs: np.dtype[np.void],
    ) -> None:
        self._files, self._harness, self._compiler, self._outputs = files, harness, compiler, outputs
        self._folder = tempfile.TemporaryDirectory(prefix="swayless-", ignore_cleanup_errors=True)
        self._program = Path(self._folder.name) / "block.exe"

    def __enter__(self) -> Self:
        """Write the files and compile them."""
        folder = Path(self._folder.name)
        try:
            for file in (*self._files, self._harness):
                (folder / file.path).write_text(file.text, encoding="ascii", newline="\n")
            sources = [folder / file.path for file in self._files if file.path.endswith(".c")]
            blocks = [source for source in sources if not source.stem.endswith("_example")]
            self._compiler.build([folder / self._harness.path], blocks, self._program)
            for example in (source for source in sources if source not in blocks):
                self._compiler.build([], [example, *blocks], folder / "example.exe")
        except BaseException:
            self._folder.cleanup()
            raise
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Remove the folder."""
        self._folder.cleanup()

    def run(self, inputs: NDArray[np.void]) -> NDArray[np.void]:
        """Run the block from power-on over a stimulus.

        Parameters
        ----------
        inputs : structured ndarray, shape (ticks,)
            Laid out as the input structure.

        Returns
        -------
        structured ndarray, shape (ticks,)
            Laid out as the output structure.

        Raises
        ------
        VerificationError
            If the program fails.
        """
        try:
            done = subprocess.run(  # noqa: S603 - the program compiled above
                [str(self._program)],
                input=inputs.tobytes(),
                capture_output=True,
                check=False,
                timeout=RUN_TIMEOUT_S,
            )
        except subprocess.TimeoutExpired as error:
            raise VerificationError(f"the compiled block did not end within {RUN_TIMEOUT_S:.0f} s") from error
        if done.returncode != 0:
            raise VerificationError(f"the compiled block ended with code {done.returncode}")
        return np.frombuffer(done.stdout, dtype=self._outputs)


class CompiledBlock(CompiledProgram):
    """A command shaper in C, compiled.

    Parameters
    ----------
    files, harness, compiler
        As for `CompiledProgram`.
    settings : ShaperSettings
        The block, for the layout of its records.
    """

    def __init__(
        self,
        files: Sequence[GeneratedFile],
        harness: GeneratedFile,
        compiler: Compiler,
        settings: ShaperSettings,
    ) -> None:
        super().__init__(files, harness, compiler, output_dtype(settings))
