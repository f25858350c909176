"""Writing files so that nothing is ever half written. Not for: deciding what to write."""

from __future__ import annotations

import errno
import os
import secrets
import shutil
from pathlib import Path

from swayless.errors import FileError


def write_text_atomically(path: Path | str, text: str) -> None:
    r"""Write a text file in UTF-8, with the line ends that the text has, in one step.

    The text goes to a new file in the same folder, which then takes the name: whoever reads the name sees the
    old file or the whole new one. A file that is there keeps its rights; a link to one stays a link.

    Parameters
    ----------
    path : Path or str
        The file; its folder must exist.
    text : str
        The whole content.

    Raises
    ------
    FileError
        If the folder is missing or the file cannot be written. The old file, if any, is then as it was.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_text_atomically(Path(folder, "a.txt"), "one\n")
    ...     Path(folder, "a.txt").read_bytes()
    b'one\n'
    """
    path = Path(path)
    try:
        # The name that holds the text, not that of a link to it.
        _exchange(Path(os.path.realpath(path)), text)
    except (OSError, ValueError) as error:
        raise FileError([f"{path}: cannot be written: {_why(path, error)}"]) from error


def _exchange(place: Path, text: str) -> None:
    """Put a new file with a text in the place of another one, or of none."""
    if place.is_dir():
        raise IsADirectoryError(errno.EISDIR, "it is a directory")
    if place.exists() and not place.is_file():
        raise ValueError("it is a device")
    # Not tempfile: it makes files that only their owner may read, and the new file must have ordinary rights.
    temporary = place.parent / f".{place.name[:100]}.{secrets.token_hex(6)}.tmp"
    try:
        with temporary.open("xb") as stream:
            stream.write(text.encode("utf-8"))
        if place.exists():
            shutil.copymode(place, temporary)
        temporary.replace(place)
    finally:
        _remove(temporary)


def _remove(temporary: Path) -> None:
    """Remove what a failure left behind; after success there is nothing."""
    try:
        temporary.unlink(missing_ok=True)
    except (OSError, ValueError):
        return  # The write itself has already failed in this folder, and that error is the one to tell.


def _why(path: Path, error: OSError | ValueError) -> str:
    if isinstance(error, FileNotFoundError) and not path.parent.exists():
        return f"there is no folder {path.parent}"
    return (error.strerror if isinstance(error, OSError) else None) or str(error)
