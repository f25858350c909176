"""Figures as files: stable bytes, whole files, clear refusals."""

from __future__ import annotations

import hashlib
import os
import re
import subprocess
import sys
from pathlib import Path

import matplotlib as mpl
import pytest

from swayless.errors import FileError
from swayless.report import (
    FigureFormat,
    PlottedShaper,
    bank_figure,
    figure_bytes,
    save_figure,
    sensitivity_figure,
)

FORMATS: tuple[FigureFormat, ...] = ("svg", "png", "pdf")

# Run in processes of its own: draws a figure of each kind in each format and prints the digest.
PROGRAM = """
import hashlib
import numpy as np
from swayless.design.shaper import Guarantee, Shaper
from swayless.plant import Band, Mode
from swayless.report import *
guarantee = Guarantee(0.05, Mode(0.25), Band(0.2, 0.3), 0.05)
shaper = Shaper(np.array([0.0, 2.0, 4.0]), np.array([0.2625, 0.475, 0.2625]), "ei", guarantee, "closed form")
rows = [PlottedShaper("EI", shaper, guarantee)]
figures = [
    sensitivity_figure(rows, over="rope_length"),
    response_figure(rows[0]),
    bank_figure(rows, frequency_hz=(0.1, 0.3)),
]
digest = hashlib.sha256()
for figure in figures:
    for file_format in ("svg", "png", "pdf"):
        digest.update(figure_bytes(figure, file_format))
print(digest.hexdigest())
"""


def _digest(hash_seed: str, time_zone: str) -> str:
    environment = {**os.environ, "PYTHONHASHSEED": hash_seed, "TZ": time_zone}
    run = subprocess.run(
        [sys.executable, "-W", "error", "-c", PROGRAM],
        env=environment,
        capture_output=True,
        text=True,
        check=True,
    )
    return run.stdout.strip()


def test_bytes_do_not_depend_on_the_process() -> None:
    assert _digest("0", "UTC") == _digest("4711", "Asia/Tokyo")


@pytest.mark.parametrize("file_format", FORMATS)
def test_drawing_a_figure_again_gives_the_same_bytes(ei: PlottedShaper, file_format: FigureFormat) -> None:
    figure = sensitivity_figure([ei])
    first = figure_bytes(figure, file_format)
    figure_bytes(figure, "png")
    assert figure_bytes(figure, file_format) == first
    assert figure_bytes(sensitivity_figure([ei]), file_format) == first


@pytest.mark.parametrize("file_format", FORMATS)
def test_files_hold_no_date_and_no_version(ei: PlottedShaper, file_format: FigureFormat) -> None:
    content = figure_bytes(sensitivity_figure([ei]), file_format)
    assert mpl.__version__.encode() not in content
    assert not re.search(rb"dc:date|CreationDate|ModDate|tIME|\b20\d\d-\d\d-\d\d", content)


@pytest.mark.parametrize(("file_format", "start"), [("svg", b"<?xml"), ("png", b"\x89PNG"), ("pdf", b"%PDF")])
def test_the_suffix_chooses_the_format(
    ei: PlottedShaper, tmp_path: Path, file_format: FigureFormat, start: bytes
) -> None:
    figure = sensitivity_figure([ei])
    for suffix in (file_format, file_format.upper()):
        path = tmp_path / f"figure.{suffix}"
        save_figure(figure, path)
        assert path.read_bytes().startswith(start)
        assert path.read_bytes() == figure_bytes(figure, file_format)


def test_svg_holds_the_title_and_text_as_outlines(ei: PlottedShaper) -> None:
    text = figure_bytes(bank_figure([ei], frequency_hz=(0.1, 0.3)), "svg").decode("ascii")
    assert "<dc:title>What the bank leaves over frequency</dc:title>" in text
    assert "<text" not in text
    assert 'id="gap-1"' in text
    assert "\r" not in text


@pytest.mark.parametrize("name", ["figure.jpg", "figure", "figure.svg.gz"])
def test_other_suffixes_are_refused_with_those_that_are_allowed(
    ei: PlottedShaper, tmp_path: Path, name: str
) -> None:
    with pytest.raises(FileError, match=rf"{name}: suffix '.*' is no .*: must be one of \.svg, \.png, \.pdf"):
        save_figure(sensitivity_figure([ei]), tmp_path / name)
    assert list(tmp_path.iterdir()) == []


def test_a_missing_directory_is_a_file_error(ei: PlottedShaper, tmp_path: Path) -> None:
    with pytest.raises(
        FileError, match=r"nowhere.figure\.svg: cannot be written: there is no folder .*nowhere"
    ):
        save_figure(sensitivity_figure([ei]), tmp_path / "nowhere" / "figure.svg")


def test_a_file_in_place_of_the_directory_is_a_file_error(ei: PlottedShaper, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("kept")
    with pytest.raises(FileError, match="cannot be written"):
        save_figure(sensitivity_figure([ei]), tmp_path / "file" / "figure.svg")
    assert (tmp_path / "file").read_text() == "kept"


def test_an_unwritable_directory_is_a_file_error_and_the_old_file_stays(
    ei: PlottedShaper, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "figure.svg"
    path.write_text("old")

    def refuse(self: Path, content: bytes) -> int:
        raise PermissionError(13, "Permission denied")  # what the system says; root may write everywhere

    monkeypatch.setattr(Path, "write_bytes", refuse)
    with pytest.raises(FileError, match=r"figure\.svg: cannot be written: Permission denied"):
        save_figure(sensitivity_figure([ei]), path)
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_nothing_half_written_is_left_when_the_file_cannot_be_replaced(
    ei: PlottedShaper, tmp_path: Path
) -> None:
    (tmp_path / "figure.svg").mkdir()
    with pytest.raises(FileError, match="cannot be written"):
        save_figure(sensitivity_figure([ei]), tmp_path / "figure.svg")
    assert [path.name for path in tmp_path.iterdir()] == ["figure.svg"]


def test_the_users_settings_neither_matter_nor_change(ei: PlottedShaper) -> None:
    plain = hashlib.sha256(figure_bytes(sensitivity_figure([ei]), "svg"))
    with mpl.rc_context(
        {"lines.linewidth": 7.0, "svg.hashsalt": "other", "font.size": 20.0, "savefig.bbox": "tight"}
    ):
        before = dict(mpl.rcParams)
        styled = hashlib.sha256(figure_bytes(sensitivity_figure([ei]), "svg"))
        assert dict(mpl.rcParams) == before
    assert styled.hexdigest() == plain.hexdigest()
