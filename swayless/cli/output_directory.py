"""Write a set of generated files, or compare it with what is there. The directory belongs to the generator.

Not for: making the files.
"""

from __future__ import annotations

import difflib
import shutil
import tempfile
from collections.abc import Mapping
from pathlib import Path

from swayless.errors import FileError

DIFF_LINES = 40
"""Lines of a diff that are shown of each file."""


def unknown_files(directory: Path, files: Mapping[str, bytes]) -> list[str]:
    """Paths below a directory that the generator does not make, sorted.

    Parameters
    ----------
    directory : Path
        May be absent.
    files : mapping
        Contents by relative path.
    """
    if not directory.is_dir():
        return []
    found = (path.relative_to(directory).as_posix() for path in directory.rglob("*") if not path.is_dir())
    return sorted(path for path in found if path not in files)


def write_files(directory: Path, files: Mapping[str, bytes]) -> None:
    """Write files so that none is ever half written, and none of somebody else's is touched.

    Parameters
    ----------
    directory : Path
        Made if absent.
    files : mapping
        Contents by relative path.

    Raises
    ------
    FileError
        If the directory holds files that the generator does not make, or cannot be written.
    """
    unknown = unknown_files(directory, files)
    if unknown:
        raise FileError(
            [
                f"{directory / path}: is not a file that swayless makes here; "
                "move it away or choose another output directory"
                for path in unknown
            ]
        )
    try:
        directory.mkdir(parents=True, exist_ok=True)
        staging = Path(tempfile.mkdtemp(prefix=".swayless-", dir=directory))
        try:
            for path, content in files.items():
                (staging / path).parent.mkdir(parents=True, exist_ok=True)
                (staging / path).write_bytes(content)
            for path in files:
                (directory / path).parent.mkdir(parents=True, exist_ok=True)
                (staging / path).replace(directory / path)
        finally:
            shutil.rmtree(staging, ignore_errors=True)
    except OSError as error:
        raise FileError([f"{directory}: cannot be written: {error.strerror or error}"]) from error


def differences(directory: Path, files: Mapping[str, bytes]) -> list[str]:
    """Say what writing would change: one text for each file that changes, appears or is too much.

    Parameters
    ----------
    directory : Path
        What is there.
    files : mapping
        What should be there.

    Returns
    -------
    list of str
        A unified diff for text files, one line for others; empty if nothing would change.
    """
    found = []
    for path, content in files.items():
        old = _read(directory / path)
        if old is None:
            found.append(f"{path}: missing")
        elif old != content:
            found.append(_diff(path, old, content))
    return found + [f"{path}: too much, the generator does not make it" for path in unknown_files(directory, files)]


def _read(path: Path) -> bytes | None:
    try:
        return path.read_bytes()
    except OSError:
        return None


def _diff(path: str, old: bytes, new: bytes) -> str:
    old_lines, new_lines = (text.decode("utf-8", "replace").splitlines() for text in (old, new))
    lines = list(difflib.unified_diff(old_lines, new_lines, f"{path} (there)", f"{path} (generated)", lineterm=""))
    if not lines:
        return f"{path}: differs in line ends or bytes that are not text"
    rest = len(lines) - DIFF_LINES
    return "\n".join(lines[:DIFF_LINES] + ([f"... {rest} more lines"] if rest > 0 else []))
