"""What the evaluator raises. Not for: a missing parser, which is `swayless.errors.ToolMissingError`."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeAlias

from swayless.errors import VerificationError

Problem: TypeAlias = tuple[int, str]
"""A line number, from 1, and what is wrong there."""


class StructuredTextError(VerificationError):
    """Base of everything that is wrong with a Structured Text file or with how it was run."""


class SubsetError(StructuredTextError):
    """The source is outside the portable subset. Holds every problem found, not only the first.

    Parameters
    ----------
    problems : iterable of (int, str)
        Line number, from 1, and message of each problem, at least one.

    Examples
    --------
    >>> print(SubsetError([(7, "EXIT is not portable"), (3, "X is declared twice")]))
    line 3: X is declared twice
    line 7: EXIT is not portable
    """

    def __init__(self, problems: Iterable[Problem]) -> None:
        self.problems = tuple(sorted(set(problems)))
        super().__init__("\n".join(f"line {line}: {message}" for line, message in self.problems))

    @property
    def line(self) -> int:
        """Line of the first problem."""
        return self.problems[0][0]


class ExecutionError(StructuredTextError):
    """A step did what a controller would do wrong without a word: overflow, bad index, zero divisor.

    Parameters
    ----------
    line : int
        Line of the source, from 1.
    message : str
        What happened there, with the values.
    """

    def __init__(self, line: int, message: str) -> None:
        self.line = line
        super().__init__(f"line {line}: {message}")


class InputError(StructuredTextError):
    """A value given to a block's input has the wrong name, type or range."""


class Problems:
    """Collects the problems of one stage, so that a user sees all of them at once.

    Examples
    --------
    >>> problems = Problems()
    >>> with problems:
    ...     raise SubsetError([(2, "first")])
    >>> problems.add(5, "second")
    >>> problems.raise_if_any()
    Traceback (most recent call last):
    swayless.verify.structured_text.faults.SubsetError: line 2: first
    line 5: second
    """

    def __init__(self) -> None:
        self._found: list[Problem] = []

    def add(self, line: int, message: str) -> None:
        """Note one problem."""
        self._found.append((line, message))

    def raise_if_any(self) -> None:
        """End the stage.

        Raises
        ------
        SubsetError
            If a problem was noted.
        """
        if self._found:
            raise SubsetError(self._found)

    def __enter__(self) -> Problems:
        return self

    def __exit__(self, kind: object, error: BaseException | None, traceback: object) -> bool:
        if isinstance(error, SubsetError):
            self._found += error.problems
            return True
        return False
