"""The help of commands and groups of commands, made from their docstrings. Not for: what commands do."""

from __future__ import annotations

import inspect
from collections.abc import Callable


def help_text(command: Callable[..., None]) -> str:
    r"""Give the help of a command: its docstring, in which typer must not fill the lines of the examples.

    Examples
    --------
    >>> from swayless.cli.verify import verify
    >>> help_text(verify).splitlines()[-4:-1]
    ['\x08', 'Examples:', '  swayless verify out/srtc-gantry']
    """
    text, _, examples = (inspect.getdoc(command) or "").partition("\n\nExamples\n--------\n")
    return "\n".join([text, "", "\b", "Examples:", *(f"  {line}" for line in examples.splitlines())])
