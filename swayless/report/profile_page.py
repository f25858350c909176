"""A page on a move computed ahead: its facts in tables and its figure, in one HTML file that needs no other.

Not for: drawing the figure, or finding out the facts.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

from matplotlib.figure import Figure

from swayless.report.save import figure_bytes
from swayless.report.style import ALARM, FIGURE_WIDTH_IN, GRID, INK

_STYLE = f"""
body {{ margin: 2em auto; max-width: {FIGURE_WIDTH_IN:g}in; color: {INK} }}
body {{ font: 10pt/1.5 "DejaVu Sans", Verdana, sans-serif }}
h1 {{ font-size: 14pt; border-bottom: 2px solid {ALARM} }}
table {{ border-collapse: collapse; margin: 1em 0 }}
caption {{ text-align: left; font-weight: bold }}
th, td {{ border-bottom: 1px solid {GRID}; padding: 0.2em 1.5em 0.2em 0 }}
th, td {{ text-align: left; font-weight: normal }}
svg {{ width: 100%; height: auto }}
"""


@dataclass(frozen=True)
class PageTable:
    """A table of a page.

    Parameters
    ----------
    title : str
        Above it.
    heads : sequence of str
        Of its columns.
    rows : sequence of sequences of str
    """

    title: str
    heads: Sequence[str]
    rows: Sequence[Sequence[str]]


def page_text(title: str, tables: Sequence[PageTable], remarks: Sequence[str], figure: Figure) -> str:
    """Write a page: the same text for the same facts and version of matplotlib, in ASCII.

    Parameters
    ----------
    title : str
    tables : sequence of PageTable
        Above the figure; one without rows is left out.
    remarks : sequence of str
        Sentences below the tables.
    figure : Figure
        Drawn into the page.

    Examples
    --------
    >>> from swayless.report.style import new_figure
    >>> figure, _ = new_figure("Nothing", [1.0])
    >>> text = page_text("1 < 2", [PageTable("facts", ("", "value"), [("way", "2 m")])], [], figure)
    >>> "<h1>1 &lt; 2</h1>" in text, "<td>2 m</td>" in text, text.count("<svg"), text.isascii()
    (True, True, 1, True)
    """
    drawing = figure_bytes(figure, "svg").decode("utf-8")
    parts = [
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">',
        f"<title>{escape(title)}</title>\n<style>{_STYLE}</style>\n</head>\n<body>\n<h1>{escape(title)}</h1>",
        *(_table(table) for table in tables if table.rows),
        *(f"<p>{escape(remark)}</p>" for remark in remarks),
        drawing[drawing.index("<svg") :].rstrip(),
        "</body>\n</html>\n",
    ]
    return "\n".join(parts).encode("ascii", "xmlcharrefreplace").decode("ascii")


def _table(table: PageTable) -> str:
    heads = _row("th", table.heads)
    rows = "\n".join(_row("td", row) for row in table.rows)
    return f"<table>\n<caption>{escape(table.title)}</caption>\n{heads}\n{rows}\n</table>"


def _row(kind: str, cells: Sequence[str]) -> str:
    return "<tr>" + "".join(f"<{kind}>{escape(cell)}</{kind}>" for cell in cells) + "</tr>"
