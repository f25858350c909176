"""Figures as files: the same bytes each time, and never half a file. Not for: drawing."""

from __future__ import annotations

import contextlib
import io
import os
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Literal

from matplotlib.figure import Figure

from swayless.errors import FileError
from swayless.report.style import figure_style

FigureFormat = Literal["svg", "png", "pdf"]

_FORMATS: Mapping[str, FigureFormat] = MappingProxyType({".svg": "svg", ".png": "png", ".pdf": "pdf"})

# No dates and no versions: what is None, matplotlib leaves out.
_METADATA: Mapping[FigureFormat, Mapping[str, str | None]] = MappingProxyType(
    {
        "svg": {"Creator": "swayless", "Date": None},
        "png": {"Software": None},
        "pdf": {"Creator": "swayless", "Producer": None, "CreationDate": None},
    }
)


def figure_bytes(figure: Figure, file_format: FigureFormat) -> bytes:
    """Draw a figure: the same bytes for the same figure and version of matplotlib.

    Parameters
    ----------
    figure : Figure
        One of this room's.
    file_format : {"svg", "png", "pdf"}
        SVG holds its text as outlines, so that it looks the same everywhere.

    Examples
    --------
    >>> from swayless.report.style import new_figure
    >>> figure, _ = new_figure("Nothing", [1.0])
    >>> figure_bytes(figure, "svg")[:13]
    b'<?xml version'
    """
    title = {"Title": figure.get_suptitle().replace("\n", " ")}
    stream = io.BytesIO()
    with figure_style():
        figure.savefig(stream, format=file_format, metadata={**_METADATA[file_format], **title})
    return stream.getvalue()


def check_place(path: Path) -> None:
    """Refuse a place in which no figure can be written, before it is drawn.

    Raises
    ------
    FileError
        If the suffix is no figure's, or the folder is missing.
    """
    if path.suffix.lower() not in _FORMATS:
        allowed = ", ".join(_FORMATS)
        raise FileError([f"{path}: suffix {path.suffix!r} is no figure format: must be one of {allowed}"])
    if not path.parent.exists():
        raise FileError([f"{path}: cannot be written: there is no folder {path.parent}"])


def save_figure(figure: Figure, path: str | Path) -> None:
    """Write a figure; the suffix of the path chooses the format. The file appears whole or not at all.

    Parameters
    ----------
    figure : Figure
        One of this room's.
    path : str or Path
        Ends in .svg, .png or .pdf. A file that is there is replaced.

    Raises
    ------
    FileError
        If the suffix is another one, or the file cannot be written.
    """
    path = Path(path)
    check_place(path)
    content = figure_bytes(figure, _FORMATS[path.suffix.lower()])
    partial = path.with_name(f".{path.name}.{os.getpid()}.part")  # beside it, so that the rename is one step
    try:
        partial.write_bytes(content)
        partial.replace(path)
    except OSError as error:
        with contextlib.suppress(OSError):
            partial.unlink()
        raise FileError([f"{path}: cannot be written: {error.strerror or error}"]) from error
