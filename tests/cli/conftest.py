from __future__ import annotations

import dataclasses
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from swayless.cli import block_build
from swayless.cli.app import main
from swayless.controller import ShaperSettings
from swayless.machine import example_text
from swayless.verify import verification
from swayless.verify.stimulus import Stimulus, stimuli

SHORT_TICKS = 300
Run = Callable[..., "Done"]


@dataclasses.dataclass(frozen=True)
class Done:
    """What a command did."""

    code: int
    out: str
    err: str


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path) -> Run:
    """Run the program in this process, in a folder of its own."""
    monkeypatch.chdir(tmp_path)
    # Bit equality is proven elsewhere, over many ticks; here a few show that the proof runs at all.
    monkeypatch.setattr(verification, "stimuli", short_stimuli)

    def run(*arguments: object) -> Done:
        capsys.readouterr()
        monkeypatch.setattr(sys, "argv", ["swayless", *map(str, arguments)])
        with pytest.raises(SystemExit) as exit_:
            main()
        out, err = capsys.readouterr()
        return Done(int(exit_.value.code or 0), out, err)

    return run


@pytest.fixture
def blank_figures(monkeypatch: pytest.MonkeyPatch) -> None:
    """Leave the drawing out of builds: it takes most of their time, and is tested elsewhere."""
    monkeypatch.setattr(block_build, "drawn", lambda figures: dict.fromkeys(figures, b"figure"))


def short_stimuli(settings: ShaperSettings, *, ticks: int) -> Iterator[Stimulus]:
    """Begin every stimulus, and end it soon."""
    for stimulus in stimuli(settings, ticks=min(ticks, SHORT_TICKS)):
        yield Stimulus(stimulus.name, stimulus.inputs[:SHORT_TICKS])


def snapshot(folder: Path) -> dict[str, bytes | None]:
    """Everything below a folder, hidden or not: contents of files, None for folders."""
    return {
        path.relative_to(folder).as_posix(): path.read_bytes() if path.is_file() else None
        for path in folder.rglob("*")
    }


ARM = """
name = "arm"
[arm]
frequency = [4.0, 5.0]
max_speed = 1.2
acceleration = 6
[drive]
counts_per_m_s = 10000
[controller]
tick = "20 ms"
number = "double"
[[row]]
name = "fast"
family = "zv"
frequency = 4.5
[[row]]
name = "robust"
family = "zvd"
frequency = 4.5
"""
"""A machine whose code is small and settles within a few ticks."""


@pytest.fixture
def arm(tmp_path: Path) -> Path:
    """Machine file of a small machine, in double."""
    path = tmp_path / "arm.toml"
    path.write_text(ARM)
    return path


@pytest.fixture
def gantry(tmp_path: Path) -> Path:
    """Machine file of the gantry crane."""
    path = tmp_path / "gantry.toml"
    path.write_text(example_text("srtc-gantry"))
    return path


DESIGNS = {
    "plain.json": ("zv", "--frequency", "4.5"),
    "taps.json": ("zv", "--frequency", "4.5", "--tick", "20 ms"),
    "counts.json": ("zv", "--frequency", "4.5", "--tick", "20 ms", "--counts-per-m-s", "10000"),
    "waits.json": ("um-zv", "--rope-length", "1", "--tick", "50 ms", "--max-speed", "0.5"),
}


@pytest.fixture(scope="session")
def designs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder with design files: without taps, with taps, in counts, and with negative amplitudes."""
    folder = tmp_path_factory.mktemp("designs")
    for name, arguments in DESIGNS.items():
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(sys, "argv", ["swayless", "design", *arguments, "-o", str(folder / name)])
            with pytest.raises(SystemExit) as exit_:
                main()
        assert not exit_.value.code
    return folder
