"""Files are written all or none, and nobody else's file is touched."""

from __future__ import annotations

import errno
import os
import shutil
from pathlib import Path

import pytest

from swayless.cli.output_directory import MOST_UNKNOWN, check_directory, differences, write_files
from swayless.errors import FileError
from tests.cli.conftest import snapshot

OLD = {"a.json": b"old\n", "c/x.c": b"old\n", "st/y.st": b"old\n"}
NEW = {"a.json": b"new\n", "c/x.c": b"new\n", "c/x.h": b"new\n", "st/y.st": b"new\n"}


@pytest.fixture
def written(tmp_path):
    write_files(tmp_path / "out", OLD)
    return tmp_path / "out"


def failing_at(step, monkeypatch, failure):
    """Let the exchange of files fail at one of them."""
    exchange, count = Path.replace, iter(range(100))

    def replace(self, target):
        if "fresh" in self.parts and next(count) == step:
            raise failure
        return exchange(self, target)

    monkeypatch.setattr(Path, "replace", replace)


@pytest.mark.parametrize("step", range(len(NEW)))
@pytest.mark.parametrize(
    "failure", [OSError(errno.ENOSPC, "No space left on device"), KeyboardInterrupt()], ids=type
)
def test_a_failure_at_any_file_leaves_everything_as_it_was(written, monkeypatch, step, failure):
    before = snapshot(written.parent)
    failing_at(step, monkeypatch, failure)
    with pytest.raises((FileError, KeyboardInterrupt)):
        write_files(written, NEW)
    assert snapshot(written.parent) == before


@pytest.mark.parametrize("step", range(len(NEW)))
def test_a_failure_in_a_new_directory_leaves_no_directory(tmp_path, monkeypatch, step):
    failing_at(step, monkeypatch, OSError(errno.ENOSPC, "No space left on device"))
    with pytest.raises(FileError, match="deep: cannot be written: No space left on device"):
        write_files(tmp_path / "out" / "deep", NEW)
    assert snapshot(tmp_path) == {}


def test_a_full_disk_while_writing_is_said_and_leaves_everything_as_it_was(written, monkeypatch):
    before = snapshot(written.parent)

    def full(self, content):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with monkeypatch.context() as patch:
        patch.setattr(Path, "write_bytes", full)
        with pytest.raises(FileError, match="cannot be written: No space left on device"):
            write_files(written, NEW)
    assert snapshot(written.parent) == before


def test_a_directory_without_the_right_to_write_is_refused_before_any_work(tmp_path, monkeypatch):
    # Tests may run as root, who may write everywhere: the answer of the system is given here.
    monkeypatch.setattr(os, "access", lambda path, mode: Path(path) != tmp_path)
    with pytest.raises(FileError, match="new: cannot be written: permission denied"):
        check_directory(tmp_path / "new", NEW)


def test_writing_replaces_changes_and_leaves_no_other_trace(written):
    write_files(written, NEW)
    assert {path: content for path, content in snapshot(written).items() if content is not None} == NEW


@pytest.mark.parametrize("stray", ["note.txt", "c/main.c", ".hidden", "deep/er/x"])
def test_a_file_that_is_not_ours_is_refused_by_name_and_kept(written, stray):
    (written / stray).parent.mkdir(parents=True, exist_ok=True)
    (written / stray).write_bytes(b"mine")
    before = snapshot(written)
    with pytest.raises(FileError, match=rf"{stray}: is not a file that swayless makes here; move it away"):
        write_files(written, NEW)
    assert snapshot(written) == before


def test_a_linked_folder_is_not_ours_and_not_entered(written, tmp_path):
    shutil.copytree(written, tmp_path / "elsewhere")
    (written / "link").symlink_to(tmp_path / "elsewhere", target_is_directory=True)
    with pytest.raises(FileError) as refused:
        write_files(written, NEW)
    assert [problem.split(":")[0] for problem in refused.value.problems] == [str(written / "link")]


def test_a_wrong_directory_full_of_files_gives_a_short_message(tmp_path):
    for number in range(3 * MOST_UNKNOWN):
        (tmp_path / f"{number}.txt").touch()
    with pytest.raises(FileError) as refused:
        check_directory(tmp_path, NEW)
    assert len(refused.value.problems) == MOST_UNKNOWN + 1
    assert refused.value.problems[-1] == f"{tmp_path}: holds more such files"


def test_differences_name_what_changes_appears_and_is_too_much(written):
    (written / "stray").touch()
    found = differences(written, NEW, present=["figures/a.svg", "a.json"])
    assert [text.splitlines()[0] for text in found] == [
        "--- a.json (there)",
        "--- c/x.c (there)",
        "c/x.h: missing",
        "--- st/y.st (there)",
        "figures/a.svg: missing",
        "stray: too much, the generator does not make it",
    ]
    assert found[0].splitlines()[-2:] == ["-old", "+new"]


def test_no_difference_is_an_empty_list(written):
    assert differences(written, OLD) == []


def test_line_ends_are_a_difference(written):
    (written / "a.json").write_bytes(b"old\r\n")
    assert differences(written, OLD) == ["a.json: differs in line ends or bytes that are not text"]
