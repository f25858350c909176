"""What a user reads before anything else."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import pytest
import typer

import swayless
from swayless.cli.app import app
from swayless.cli.design_options import COMMANDS as DESIGN_COMMANDS

COMMANDS = ["init", "design", "plot", "simulate", "identify", "profile", "generate", "verify", "build"]
OF_DESIGN = ["FAMILY", *DESIGN_COMMANDS]
OF_PROFILE = ["optimal", "simulate", "invert", "tune"]
ALL = [*COMMANDS, *(f"design {name}" for name in OF_DESIGN), *(f"profile {name}" for name in OF_PROFILE)]
ROOT = Path(__file__).parents[2]


def found(line: str) -> Any:
    """Give the command that a command line names."""
    command = typer.main.get_command(app)
    for name in line.split():
        command = command.commands[name]
    return command


def examples(help_text: str) -> list[str]:
    """Example lines of a command's help."""
    return [line.strip() for line in help_text.partition("Examples:\n")[2].splitlines()]


def test_no_argument_prints_the_help_and_is_no_error(run):
    alone, asked = run(), run("--help")
    assert alone == asked
    assert (alone.code, alone.err) == (0, "")
    for command in COMMANDS:
        assert f"\n  {command} " in alone.out


def test_design_lists_its_commands_and_is_an_error_alone(run):
    asked = run("design", "--help")
    assert (asked.code, asked.err) == (0, "")
    assert [line.split()[0] for line in asked.out.partition("Commands:\n")[2].splitlines()] == OF_DESIGN
    alone = run("design")
    assert (alone.code, alone.out) == (2, "")
    assert "swayless design FAMILY|COMMAND [OPTIONS]\n" in alone.err


@pytest.mark.parametrize("group", [(), ("design",), ("profile",)])
def test_the_list_of_commands_cuts_no_sentence(run, group):
    assert "..." not in run(*group, "--help").out.partition("Commands:")[2]


@pytest.mark.parametrize("line", ["FAMILY --help", "zv --help", "zv --frequency 1 -h"])
def test_the_help_of_the_families_is_that_of_one_command(run, line):
    out = run("design", *line.split()).out
    assert "swayless design FAMILY [OPTIONS]\n" in out.partition("\n\n")[0] + "\n"
    assert "--rope-length M " in out


@pytest.mark.parametrize("columns", [80, 110])
@pytest.mark.parametrize("command", ALL)
def test_help_fits_the_terminal_and_keeps_example_lines_whole(run, monkeypatch, command, columns):
    monkeypatch.setenv("COLUMNS", str(columns))
    done = run(*command.split(), "--help")
    assert (done.code, done.err) == (0, "")
    lines = done.out.splitlines()
    wanted = examples(found(command).help)
    assert wanted
    for example in wanted:
        assert example in [line.strip() for line in lines]
    # An example is to be copied: it is one line even where the terminal has to fold it.
    assert max(len(line) for line in lines if line.strip() not in wanted) <= columns
    assert max(map(len, wanted)) <= 90


@pytest.mark.parametrize("command", ALL)
def test_every_option_has_a_help_text(command):
    assert all(parameter.help for parameter in found(command).params if parameter.name != "help")


def test_the_version_is_that_of_the_package(run):
    stated = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["version"]
    assert run("--version").out == f"swayless {swayless.__version__}\n" == f"swayless {stated}\n"
