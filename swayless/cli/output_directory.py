"""Write a set of generated files, or compare it with what is there. The directory belongs to the generator.

Not for: making the files.
"""

from __future__ import annotations

import difflib
import os
import shutil
import tempfile
from collections.abc import Collection, Iterable, Iterator, Mapping
from itertools import islice
from pathlib import Path

from swayless.errors import FileError

DIFF_LINES = 40
"""Lines of a diff that are shown of each file."""

MOST_UNKNOWN = 10
"""Unknown files that are named before the search ends: a wrong directory may hold a whole disk."""


def unknown_files(directory: Path, known: Collection[str]) -> Iterator[str]:
    """Find what lies below a directory and is not made by the generator; folders without files do not count.

    Parameters
    ----------
    directory : Path
        May be absent.
    known : collection of str
        Relative paths that the generator makes.

    Yields
    ------
    str
        Relative paths, found as they are asked for.
    """
    for folder, folders, files in os.walk(directory):
        folders.sort()
        links = [name for name in folders if Path(folder, name).is_symlink()]
        for name in sorted([*links, *files]):
            path = Path(folder, name).relative_to(directory).as_posix()
            if path not in known:
                yield path


def check_directory(directory: Path, known: Collection[str]) -> None:
    """Refuse an output directory that cannot be one, or that holds what the generator does not make.

    Parameters
    ----------
    directory : Path
        May be absent.
    known : collection of str
        Relative paths that the generator makes.

    Raises
    ------
    FileError
        Naming what is in the way.
    """
    _refuse_file(directory)
    if not os.access(_nearest(directory), os.W_OK | os.X_OK):
        raise FileError([f"{directory}: cannot be written: permission denied"])
    reason = "is not a file that swayless makes here; move it away or choose another output directory"
    unknown = islice(unknown_files(directory, known), MOST_UNKNOWN + 1)
    found = [f"{directory / path}: {reason}" for path in unknown]
    if len(found) > MOST_UNKNOWN:
        found[-1] = f"{directory}: holds more such files"
    if found:
        raise FileError(found)


def _refuse_file(directory: Path) -> None:
    nearest = _nearest(directory)
    if not nearest.is_dir():
        raise FileError([f"{nearest}: is a file, not a directory; choose another with -o"])


def _nearest(directory: Path) -> Path:
    """Give the directory, or what is there of the way to it."""
    return next(path for path in (directory, *directory.absolute().parents) if path.exists())


def write_files(directory: Path, files: Mapping[str, bytes]) -> None:
    """Write all files or none; nobody else's file is touched, and a failure leaves everything as it was.

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
    check_directory(directory, files)
    folders = _absent_folders(directory, files)
    try:
        for folder in folders:
            folder.mkdir(exist_ok=True)
        _replace_files(directory, files)
    except BaseException as error:
        _remove_empty(folders)
        if isinstance(error, OSError):
            raise FileError([f"{directory}: cannot be written: {error.strerror or error}"]) from error
        raise


def _absent_folders(directory: Path, files: Iterable[str]) -> list[Path]:
    """Folders that the files need and that are not there, outermost first."""
    needed = {parent for path in files for parent in (directory / path).parents}
    return sorted(folder for folder in needed if not folder.exists())


def _remove_empty(folders: list[Path]) -> None:
    for folder in reversed(folders):
        try:
            folder.rmdir()
        except OSError:
            continue  # never made, or no longer ours alone


def _replace_files(directory: Path, files: Mapping[str, bytes]) -> None:
    """Write everything beside the old files, then exchange them; put the old ones back if that fails."""
    staging = Path(tempfile.mkdtemp(prefix=".swayless-", dir=directory))
    fresh, old = staging / "fresh", staging / "old"
    try:
        for path, content in files.items():
            (fresh / path).parent.mkdir(parents=True, exist_ok=True)
            (fresh / path).write_bytes(content)
            if (directory / path).exists():
                (old / path).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(directory / path, old / path)
        done: list[str] = []
        try:
            for path in files:
                done.append(path)
                (fresh / path).replace(directory / path)
        except BaseException:
            for path in done:
                _put_back(old / path, directory / path)
            raise
    finally:
        shutil.rmtree(staging, ignore_errors=True)


def _put_back(old: Path, path: Path) -> None:
    if old.exists():
        old.replace(path)
    else:
        path.unlink(missing_ok=True)


def differences(directory: Path, files: Mapping[str, bytes], *, present: Collection[str] = ()) -> list[str]:
    """Say what writing would change: one text for each file that changes, appears or is too much.

    Parameters
    ----------
    directory : Path
        What is there.
    files : mapping
        What should be there.
    present : collection of str
        Files that should be there too, whatever they hold.

    Returns
    -------
    list of str
        A unified diff for text files, one line for others; empty if nothing would change.

    Raises
    ------
    FileError
        If `directory` is a file.
    """
    _refuse_file(directory)
    found = []
    for path, content in files.items():
        old = _read(directory / path)
        if old is None:
            found.append(f"{path}: missing")
        elif old != content:
            found.append(_diff(path, old, content))
    found += [f"{path}: missing" for path in present if not (directory / path).is_file()]
    unknown = islice(unknown_files(directory, {*files, *present}), MOST_UNKNOWN)
    return found + [f"{path}: too much, the generator does not make it" for path in unknown]


def _read(path: Path) -> bytes | None:
    try:
        return path.read_bytes()
    except OSError:
        return None


def _diff(path: str, old: bytes, new: bytes) -> str:
    old_lines, new_lines = (text.decode("utf-8", "replace").splitlines() for text in (old, new))
    lines = list(
        difflib.unified_diff(old_lines, new_lines, f"{path} (there)", f"{path} (generated)", lineterm="")
    )
    if not lines:
        return f"{path}: differs in line ends or bytes that are not text"
    rest = len(lines) - DIFF_LINES
    return "\n".join(lines[:DIFF_LINES] + ([f"... {rest} more lines"] if rest > 0 else []))
