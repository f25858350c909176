"""Parameters of a drive put into the text of its file; comments, order and everything else stay.

Not for: finding them (`swayless.design.inversion`).
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from swayless.errors import FileError
from swayless.machine.identified_text import entries, replaced
from swayless.machine.inversion_file import InversionRequest
from swayless.machine.source import read_source
from swayless.machine.toml_source import MAX_BYTES
from swayless.plant.elastic_drive import TUNED, ElasticDrive

_DIGITS = 9


def rounded(drive: ElasticDrive) -> ElasticDrive:
    """Give the drive that a file will hold: nine digits of each parameter."""
    values = {name: float(f"{getattr(drive, name):.{_DIGITS}g}") for name in TUNED}
    return replace(drive, **values)


def with_drive(request: InversionRequest, drive: ElasticDrive) -> InversionRequest:
    """Give the same request for another drive."""
    top, bottom = drive.transfer_function
    return replace(request, drive=drive, numerator=top, denominator=bottom)


def text_with_drive(path: Path, drive: ElasticDrive) -> str:
    r"""Give the text of a file with other parameters.

    Parameters
    ----------
    path : Path
        A file with its ``[drive]`` in a section of its own.
    drive : ElasticDrive
        As `rounded` gives it.

    Raises
    ------
    FileError
        If the section is not written with a head of its own.

    Examples
    --------
    >>> import tempfile
    >>> drive = ElasticDrive(0.1, 2.0, 5.0, 1.0, 3.0, 0.5, 40.0)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder, "a.toml")
    ...     keys = "".join(f"{name} = 1 # one\n" for name in TUNED)
    ...     _ = path.write_text(f"[drive]\n{keys}")
    ...     print(text_with_drive(path, drive).splitlines()[-1])
    stiffness = 40.0 # one
    """
    text = read_source(path, max_bytes=MAX_BYTES).replace("\r\n", "\n")
    there = {entry.key for entry in entries(text, "drive")}
    missing = [name for name in TUNED if name not in there]
    if missing:
        raise FileError([f"{path}: [drive] {missing[0]}: must stand on a line of its own below [drive]"])
    values = {name: getattr(drive, name) for name in TUNED}
    return replaced(text, "drive", {name: repr(value) for name, value in values.items()})
