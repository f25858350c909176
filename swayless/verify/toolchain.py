"""C compilers that may be on this machine, each with the warnings of a strict embedded reviewer as errors.

Not for: what is compiled.
"""

from __future__ import annotations

import importlib.util
import os
import shutil
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from swayless.errors import ToolMissingError, VerificationError

COMPILE_TIMEOUT_S = 300.0
"""The first use of zig builds its C library, which takes seconds; minutes mean that something is wrong."""

_BASE = ("-std=c99", "-O2", "-ffp-contract=off", "-Werror", "-Wall", "-Wextra", "-Wpedantic")
_COMMON = (
    *("-Wconversion", "-Wsign-conversion", "-Wdouble-promotion", "-Wfloat-equal", "-Wshadow", "-Wundef"),
    *("-Wcast-qual", "-Wcast-align", "-Wswitch-default", "-Wstrict-prototypes", "-Wmissing-prototypes"),
    *("-Wvla", "-Wnull-dereference"),
)
_GCC = (*_BASE, *_COMMON, "-Wlogical-op", "-Wduplicated-cond", "-Wjump-misses-init")
_CLANG = (*_BASE, "-Weverything", "-Wno-padded", "-Wno-unknown-warning-option", "-Wno-unsafe-buffer-usage")


@dataclass(frozen=True)
class Compiler:
    """One C compiler.

    Parameters
    ----------
    name : str
        As on the command line.
    command : tuple of str
        How to start it.
    strict : tuple of str
        Flags for generated code.
    """

    name: str
    command: tuple[str, ...]
    strict: tuple[str, ...]

    def is_installed(self) -> bool:
        """Whether the compiler is on this machine."""
        if self.name == "zig":
            return importlib.util.find_spec("ziglang") is not None
        return shutil.which(self.command[0]) is not None

    def build(self, sources: Sequence[Path], strict_sources: Sequence[Path], program: Path) -> None:
        """Compile a program; the strict sources with every warning an error.

        Parameters
        ----------
        sources : sequence of Path
            Files compiled without warnings, such as a test harness.
        strict_sources : sequence of Path
            Generated files.
        program : Path
            What to make; its folder takes the objects.

        Raises
        ------
        VerificationError
            If a file does not compile; the message is the compiler's.
        """
        objects = []
        for source, flags in [
            *((s, self.strict) for s in strict_sources),
            *((s, _BASE[:3]) for s in sources),
        ]:
            objects.append(program.parent / f"{source.stem}.o")
            self._run([*flags, "-c", str(source), "-o", str(objects[-1])], source.name, program.parent)
        self._run([*map(str, objects), "-o", str(program)], program.name, program.parent)

    def _run(self, arguments: list[str], what: str, folder: Path) -> None:
        # Temporary files of a compiler that is interrupted go with the folder.
        # Fixed programs, no shell; paths are swayless's own temporary files.
        try:
            done = subprocess.run(  # noqa: S603
                [*self.command, *arguments],
                capture_output=True,
                text=True,
                check=False,
                timeout=COMPILE_TIMEOUT_S,
                env={**os.environ, "LC_ALL": "C", "TMPDIR": str(folder)},
            )
        except subprocess.TimeoutExpired as error:
            raise VerificationError(
                f"{self.name} took more than {COMPILE_TIMEOUT_S:.0f} s on {what}"
            ) from error
        if done.returncode != 0:
            raise VerificationError(f"{self.name} does not accept {what}:\n{done.stderr.strip()}")


COMPILERS = (
    Compiler("gcc", ("gcc",), _GCC),
    Compiler("clang", ("clang",), _CLANG),
    Compiler("zig", (sys.executable, "-m", "ziglang", "cc"), _CLANG),
)
"""Every adapter, in the order in which they are tried."""


def find_compiler(name: str | None = None) -> Compiler:
    """Find a compiler: the one named, or the first that is installed.

    Raises
    ------
    ToolMissingError
        If it is not installed, or none is; the message says what would help.
    """
    known = {compiler.name: compiler for compiler in COMPILERS}
    if name is not None and name not in known:
        raise ToolMissingError(f"compiler {name!r} is not known: choose {', '.join(known)}")
    for compiler in COMPILERS:
        if name in (None, compiler.name) and compiler.is_installed():
            return compiler
    wanted = name or "C compiler"
    raise ToolMissingError(
        f"no {wanted} on this machine: install gcc or clang, or run pip install 'swayless[verify]'"
    )
