"""What docs/identify.md shows is what the program does."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import numpy as np
import pytest
import typer

from swayless.cli.app import app
from swayless.machine import load_machine
from swayless.plant.identification import identify_periods

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "identify.md").read_text(encoding="utf-8")


def test_every_command_line_of_the_page_prints_what_is_shown(run, tmp_path):
    for name, text in re.findall(r"^`(\S+\.csv)`:\n\n```csv\n(.*?)```", PAGE, re.DOTALL | re.MULTILINE):
        (tmp_path / name).write_text(text)
    shown = re.findall(r"```sh\n(.*?)```\n(?:\n```text\n(.*?)```)?", PAGE, re.DOTALL)
    assert len(shown) >= 6
    for lines, output in shown:
        *before, last = [line for line in lines.splitlines() if line.startswith("swayless ")]
        for line in before:
            assert run(*shlex.split(line)[1:]).code == 0, line
        done = run(*shlex.split(last)[1:])
        assert done.code == (2 if done.err else 0)
        if output:
            assert (done.out + done.err).splitlines() == output.splitlines(), last
    assert load_machine(tmp_path / "measured.toml").rows[0].family == "si"


@pytest.mark.parametrize(("angle_deg", "shown"), [(10.0, "0.19 % at 10 degrees"), (30.0, "1.7 % at 30")])
def test_the_slowness_of_large_swings_is_that_of_the_pendulum(angle_deg, shown):
    small = identify_periods(np.array([6.0]), amplitude_rad=np.radians(angle_deg))
    assert f"{100.0 * (6.0 * small.frequency_hz - 1.0):.2g} % at {angle_deg:g}" in shown
    assert shown.split(" degrees")[0] in PAGE


@pytest.mark.parametrize("columns", [80, 110])
def test_the_help_fits_the_terminal(run, monkeypatch, columns):
    monkeypatch.setenv("COLUMNS", str(columns))
    lines = run("identify", "--help").out.splitlines()
    examples = [line for line in lines if line.startswith("    swayless identify ")]
    assert len(examples) == 4
    assert max(len(line) for line in lines if line not in examples) <= columns
    assert max(map(len, examples)) <= 94


def test_every_option_is_in_the_table_of_the_command_and_no_other():
    section = (ROOT / "docs" / "commands.md").read_text(encoding="utf-8").partition("\n## identify\n")[2]
    rows = re.findall(r"^\| `(\S+)` \|", section.partition("\n## ")[0], re.MULTILINE)
    parameters = typer.main.get_command(app).commands["identify"].params
    names = [
        parameter.metavar if parameter.param_type_name == "argument" else parameter.opts[0]
        for parameter in parameters
        if parameter.name != "help"
    ]
    assert rows == names
