"""What the program prints: tables and lines on standard output, progress on standard error.

Not for: what is printed.
"""

from __future__ import annotations

import json
import shutil
import sys
import textwrap
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from typing import Any

import typer

from swayless.errors import VerificationError

PIPE_WIDTH = 10_000
"""Columns of a table that does not go to a terminal: room for any line, so that none is folded."""

SMALLEST_PER_CENT = Decimal("0.0001")

INDENT = "  "
"""In front of each line of a table."""


def print_json(document: Any) -> None:
    """Print one JSON document, keys in the order given."""
    typer.echo(json.dumps(document, indent=2, allow_nan=False))


@contextmanager
def failure_in_json(*, wanted: bool) -> Iterator[None]:
    """Where JSON is wanted, say in JSON that code could not even be compiled or run, and exit 1."""
    try:
        yield
    except VerificationError as error:
        if not wanted:
            raise
        print_json({"verified": "failed", "reason": str(error)})
        raise typer.Exit(1) from error


def print_line(text: str) -> None:
    """Print one remark; on a terminal it breaks between words."""
    if sys.stdout is not None and sys.stdout.isatty():  # None where the caller closed it
        text = textwrap.fill(text, shutil.get_terminal_size().columns, break_long_words=False)
    typer.echo(text)


def print_table(title: str, columns: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """Print a table that fits the terminal; to a pipe it is never cut.

    Parameters
    ----------
    title : str
        Line above the table.
    columns : sequence of str
        Heads, with units.
    rows : sequence of sequences of str
        One for each line.
    """
    from rich import box
    from rich.console import Console
    from rich.table import Table

    console = Console(highlight=False, emoji=False, markup=False)
    console.width = console.width - len(INDENT) if console.is_terminal else PIPE_WIDTH
    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0), pad_edge=False, show_edge=False)
    for column in columns:
        table.add_column(column, overflow="fold")
    for row in rows:
        table.add_row(*row)
    with console.capture() as capture:
        console.print(table)
    typer.echo(f"{title}\n")
    for line in capture.get().splitlines():
        typer.echo(f"{INDENT}{line}".rstrip())
    typer.echo()


def interval(low: float, high: float, digits: int = 4) -> str:
    """Print a guaranteed range, rounded inward: what is printed is never more than what is held.

    Examples
    --------
    >>> interval(6.93084, 7.74039)
    '6.931 to 7.740'
    """
    down, up = Context(digits, ROUND_FLOOR), Context(digits, ROUND_CEILING)
    return f"{up.create_decimal(repr(low))} to {down.create_decimal(repr(high))}"


def per_cent(ratio: float, digits: int = 6) -> str:
    """Print a ratio in per cent.

    Examples
    --------
    >>> per_cent(0.05), per_cent(0.38712, 3)
    ('5 %', '38.7 %')
    """
    return f"{100 * ratio:.{digits}g} %"


def at_most(ratio: float, digits: int = 2) -> str:
    """Print a ratio in per cent, rounded up, and to no less than 0.0001 %.

    Examples
    --------
    >>> at_most(3.1e-9), at_most(0.0012345), at_most(0.0538212, 4)
    ('0.0001 %', '0.13 %', '5.383 %')
    """
    ratio_per_cent = Context(digits, ROUND_CEILING).multiply(Decimal(repr(ratio)), 100)
    return f"{max(ratio_per_cent.normalize(), SMALLEST_PER_CENT):f} %"


def rounded_down(value: float, digits: int = 6) -> str:
    """Print a lower bound: what is printed is never more than what is proved.

    Examples
    --------
    >>> rounded_down(2.71333019)
    '2.71333'
    """
    return f"{Context(digits, ROUND_FLOOR).create_decimal(repr(value)):f}"


def counted(number: int, noun: str) -> str:
    """Print a number with its noun.

    Examples
    --------
    >>> counted(1, "file"), counted(1_110_649, "tick")
    ('1 file', '1,110,649 ticks')
    """
    return f"{number:,} {noun}{'' if number == 1 else 's'}"


@contextmanager
def progress() -> Iterator[Callable[[str], None]]:
    """Show what is being done, on standard error and only on a terminal.

    Yields
    ------
    callable
        Call it with a few words for each piece of work.
    """
    from rich.console import Console

    console = Console(stderr=True, highlight=False, emoji=False, markup=False)
    if not console.is_terminal:
        yield lambda _: None
        return
    with console.status("") as status:
        yield lambda what: status.update(f"{what} ...")
