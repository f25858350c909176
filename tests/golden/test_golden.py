"""The command line makes the golden files of every example, no byte, no file more and none less."""

import contextlib
import json

import pytest
from typer.testing import CliRunner

from swayless.cli import block_build
from swayless.cli.app import app
from tests.golden.update import EXAMPLES, GOLDEN, NAMES, built, files_below


def test_every_example_has_golden_files_and_none_is_left_over():
    assert (
        sorted(path.name for path in GOLDEN.iterdir() if path.is_dir() and path.name != "__pycache__")
        == NAMES
    )


@pytest.mark.parametrize("name", NAMES)
def test_an_example_gives_its_golden_files(name, tmp_path, monkeypatch):
    # Golden files leave figures out, and drawing them takes longer than everything else.
    monkeypatch.setattr(block_build, "drawn", lambda figures: dict.fromkeys(figures, b"figure"))
    golden = files_below(GOLDEN / name)
    made = built(name, tmp_path / name, stored=GOLDEN / name, build=build_here)
    assert sorted(made) == sorted(golden)
    for path, content in golden.items():
        assert made[path] == content, path


@pytest.mark.parametrize("name", ["srtc-gantry-bank", "elbow-arm"])
def test_building_twice_gives_the_same_bytes_figures_included(name, tmp_path):
    first, second = tmp_path / "first", tmp_path / "second"
    built(name, first)
    built(name, second)
    contents = [
        {
            path.relative_to(folder).as_posix(): path.read_bytes()
            for path in folder.rglob("*")
            if path.is_file()
        }
        for folder in (first, second)
    ]
    assert contents[0] == contents[1]
    assert any(path.startswith("figures/") for path in contents[0])


def build_here(*arguments):
    """Run the command in this process."""
    with contextlib.chdir(EXAMPLES):
        done = CliRunner().invoke(app, arguments)
    assert done.exit_code == 0, done.output


def run_check(name, folder):
    with contextlib.chdir(EXAMPLES):
        done = CliRunner().invoke(app, ["build", f"{name}.toml", "-o", str(folder), "--check", "--json"])
    return done.exit_code, json.loads(done.stdout)["differences"]


def test_check_sees_one_changed_character_a_missing_and_an_extra_file(tmp_path):
    folder = tmp_path / "build"
    files = built("srtc-gantry", folder)
    assert run_check("srtc-gantry", folder) == (0, [])
    for path, content in files.items():
        place = len(content) // 2
        changed = content[:place] + bytes([content[place] ^ 1]) + content[place + 1 :]
        (folder / path).write_bytes(changed)
        code, differences = run_check("srtc-gantry", folder)
        assert code == 1
        assert any(path in text for text in differences), path
        (folder / path).write_bytes(content)
    (folder / "c" / "stray.c").write_text("int stray;\n")
    code, differences = run_check("srtc-gantry", folder)
    assert (code, differences) == (1, ["c/stray.c: too much, the generator does not make it"])
    (folder / "c" / "stray.c").unlink()
    (folder / "figures" / "bank.svg").unlink()
    assert run_check("srtc-gantry", folder) == (1, ["figures/bank.svg: missing"])
