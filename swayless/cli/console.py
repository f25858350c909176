"""What the program prints: tables and lines on standard output, progress on standard error.

Not for: what is printed.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import typer


def print_json(document: Any) -> None:
    """Print one JSON document, keys in the order given."""
    typer.echo(json.dumps(document, indent=2, allow_nan=False))


def print_table(title: str, columns: Sequence[str], rows: Sequence[Sequence[str]], note: str = "") -> None:
    """Print a table that fits the terminal; to a pipe it is never cut.

    Parameters
    ----------
    title : str
        Above the table.
    columns : sequence of str
        Heads, with units.
    rows : sequence of sequences of str
        One for each line.
    note : str
        Below the table.
    """
    from rich import box
    from rich.console import Console
    from rich.table import Table

    console = Console(highlight=False, emoji=False, markup=False)
    if not console.is_terminal:
        console = Console(highlight=False, emoji=False, markup=False, width=160)
    table = Table(title=title, title_justify="left", box=box.SIMPLE, caption=note or None, caption_justify="left")
    for column in columns:
        table.add_column(column, overflow="fold")
    for row in rows:
        table.add_row(*row)
    console.print(table)


@contextmanager
def progress() -> Iterator[Callable[[str], None]]:
    """Show what is being done, on standard error and only on a terminal.

    Yields
    ------
    callable
        Call it with a few words for each piece of work.
    """
    from rich.console import Console

    console = Console(stderr=True, highlight=False)
    if not console.is_terminal:
        yield lambda _: None
        return
    with console.status("") as status:
        yield lambda what: status.update(f"{what} ...")
