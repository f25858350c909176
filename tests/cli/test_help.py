"""What a user reads before anything else."""

from __future__ import annotations

import inspect
import tomllib
from pathlib import Path

import pytest
import typer

import swayless
from swayless.cli.app import app

COMMANDS = ["init", "design", "plot", "generate", "verify", "build"]
ROOT = Path(__file__).parents[2]


def examples(command: str) -> list[str]:
    """Example lines of the command's docstring."""
    (found,) = [info.callback for info in app.registered_commands if info.callback.__name__ == command]
    return inspect.getdoc(found).partition("Examples\n--------\n")[2].splitlines()


def test_no_argument_prints_the_help_and_is_no_error(run):
    alone, asked = run(), run("--help")
    assert alone == asked
    assert (alone.code, alone.err) == (0, "")
    for command in COMMANDS:
        assert f"\n  {command} " in alone.out


def test_the_list_of_commands_cuts_no_sentence(run):
    assert "..." not in run().out.partition("Commands:")[2]


@pytest.mark.parametrize("columns", [80, 110])
@pytest.mark.parametrize("command", COMMANDS)
def test_help_fits_the_terminal_and_keeps_example_lines_whole(run, monkeypatch, command, columns):
    monkeypatch.setenv("COLUMNS", str(columns))
    done = run(command, "--help")
    assert (done.code, done.err) == (0, "")
    lines = done.out.splitlines()
    assert max(map(len, lines)) <= columns
    assert examples(command)
    for example in examples(command):
        assert example in [line.strip() for line in lines]


@pytest.mark.parametrize("command", COMMANDS)
def test_every_option_has_a_help_text(command):
    parameters = typer.main.get_command(app).commands[command].params
    assert all(parameter.help for parameter in parameters if parameter.name != "help")


def test_the_version_is_that_of_the_package(run):
    stated = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["version"]
    assert run("--version").out == f"swayless {swayless.__version__}\n" == f"swayless {stated}\n"
