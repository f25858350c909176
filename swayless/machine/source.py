"""The text of a file that a person wrote or edited: read with a limit, and every failure said in words.

Not for: parsing, or files that swayless writes (`swayless.machine.writing`).
"""

from __future__ import annotations

from pathlib import Path

from swayless.errors import FileError


def read_source(path: Path, *, max_bytes: int) -> str:
    """Read a UTF-8 text file, with or without a byte order mark.

    Parameters
    ----------
    path : Path
        The file.
    max_bytes : int
        Largest size accepted: no machine needs more, and a wrong path should not fill the memory.

    Raises
    ------
    FileError
        If the file is missing, is a directory, may not be read, is too large or is not UTF-8.
    """
    try:
        with path.open("rb") as stream:
            data = stream.read(max_bytes + 1)
    except (OSError, ValueError) as error:
        raise FileError([f"{path}: cannot be read: {_why(error)}"]) from error
    if len(data) > max_bytes:
        raise FileError([f"{path}: is larger than {max_bytes} bytes, the most that is read"])
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        reason = f"is not UTF-8 text: byte 0x{data[error.start]:02x} in line {line}"
        raise FileError([f"{path}: {reason}"]) from error


def _why(error: OSError | ValueError) -> str:
    if isinstance(error, FileNotFoundError):
        return "there is no such file"
    if isinstance(error, PermissionError):
        return "permission denied"
    if isinstance(error, IsADirectoryError):
        return "it is a directory"
    return (error.strerror if isinstance(error, OSError) else None) or str(error)
