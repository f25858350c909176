"""The errors a user may meet. Each also subclasses the builtin that fits, so callers may catch either.

Not for: programming errors, which stay plain Python exceptions.
"""

from __future__ import annotations


class SwaylessError(Exception):
    """Base of every error that swayless raises on purpose."""


class PlantError(SwaylessError, ValueError):
    """A physical quantity is outside its range: what, its value and what is allowed."""


class DesignError(SwaylessError, ValueError):
    """A shaper does not exist for what was asked: which limit was passed, and by what."""


class ControllerError(SwaylessError, ValueError):
    """A design cannot run as asked: tick, number type, limits or rows do not fit together."""


class FileError(SwaylessError, ValueError):
    """A file cannot be read or is wrong. Holds every problem found, not only the first.

    Parameters
    ----------
    problems : sequence of str
        One line each: file, key, value and what is allowed.

    Examples
    --------
    >>> print(FileError(["crane.toml: [crane] rope_length[0] = -2.0: must be > 0"]))
    crane.toml: [crane] rope_length[0] = -2.0: must be > 0
    """

    def __init__(self, problems: list[str] | tuple[str, ...]) -> None:
        self.problems = tuple(problems)
        super().__init__("\n".join(self.problems))


class CodegenError(SwaylessError, ValueError):
    """Code cannot be generated: a name is reserved or collides, or a number does not fit the type."""


class ToolMissingError(SwaylessError, RuntimeError):
    """A check was asked for, and the tool that does it is not on this machine."""


class VerificationError(SwaylessError, AssertionError):
    """Generated code and its reference differ, or the code cannot be compiled."""
