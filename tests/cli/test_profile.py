"""`swayless profile optimal`: files and options in, a proved command out."""

from __future__ import annotations

import json
import re
import shlex
from pathlib import Path

import numpy as np
import pytest
import typer

from swayless.cli.app import app
from swayless.design.optimal import LinearPlant, output_at_ticks
from swayless.design.optimal.command import Command
from swayless.machine import example_text
from swayless.machine.profile_file import load_profile

ROOT = Path(__file__).parents[2]
EXAMPLE = ROOT / "examples" / "time-optimal-oscillator.toml"
PAGE = (ROOT / "docs" / "profile.md").read_text(encoding="utf-8")
OSCILLATOR = (
    "--numerator",
    "1",
    "--denominator",
    "0.01 0 1",
    "--limit",
    "5",
    "--tick",
    "5 ms",
    "--target",
    "1",
)


def found(done):
    assert (done.code, done.err) == (0, "")
    return json.loads(done.out)


def played(document):
    """The command of a document, as a controller would play it."""
    values, final = np.array(document["command"]), document["final_value"]
    return Command(document["tick_s"], values, final, initial_value=document["initial_value"])


def test_the_example_is_the_robust_move_of_the_paper(run):
    document = found(run("profile", "optimal", EXAMPLE, "--json"))
    assert (document["tick_s"], document["ticks"], document["final_value"]) == (0.005, 58, 1.0)
    assert len(document["command"]) == 58
    assert np.abs(document["command"]).max() <= 5.0
    assert document["fewer_utilisation_ratio"] > 1.0
    plant = LinearPlant.from_transfer_function([1.0], [0.01, 0.0, 1.0])
    output = output_at_ticks(plant, played(document), ticks=200)
    assert output[58:] == pytest.approx(1.0, abs=1e-9)
    assert output[:59] == pytest.approx(document["reference"], abs=1e-12)
    (left,) = document["left"]
    curve = dict(zip(left["at_ratio"], left["amplitude"], strict=True))
    assert (curve[1.0] < 1e-9, len(curve)) == (True, 61)
    # What swings where the plant is 10 % off: the largest of 240 ticks is within 1e-3 of the amplitude.
    faster = LinearPlant.from_transfer_function([1.0], [0.01 / 1.21, 0.0, 1.0])
    off = output_at_ticks(faster, played(document), ticks=300)
    assert np.abs(off[58:] - 1.0).max() == pytest.approx(curve[1.1], rel=1e-3)


def test_options_do_what_the_file_does_and_replace_it(run):
    file = found(run("profile", "optimal", EXAMPLE, "--json"))
    options = found(run("profile", "optimal", *OSCILLATOR, "--robust", "1", "--json"))
    assert options["command"] == file["command"]
    assert found(run("profile", "optimal", EXAMPLE, "--robust", "0", "--json"))["ticks"] == 18
    assert found(run("profile", "optimal", EXAMPLE, "--limit", "-1 5", "--json"))["limit"] == [-1.0, 5.0]


def test_a_state_space_is_the_same_plant(run, tmp_path):
    text = EXAMPLE.read_text().replace(
        "numerator = [1.0]", "a = [[0.0, 1.0], [-100.0, 0.0]]\nb = [0.0, 100.0]"
    )
    (tmp_path / "move.toml").write_text(text.replace("denominator = [0.01, 0.0, 1.0]", "c = [1.0, 0.0]"))
    document = found(run("profile", "optimal", "move.toml", "--json"))
    assert document["command"] == pytest.approx(
        found(run("profile", "optimal", EXAMPLE, "--json"))["command"]
    )


def test_relaxed_time_takes_less_of_the_limits(run):
    document = found(run("profile", "optimal", EXAMPLE, "--relax", "1.5", "--json"))
    assert document["ticks"] == 87
    assert document["fewer_utilisation_ratio"] is None
    # Less than a third of the limit in half as much time again.
    assert document["utilisation_ratio"] < 1.0 / 3.0


def test_a_trajectory_is_read_followed_and_written(run, tmp_path):
    k = np.arange(1, 121) / 120
    wanted = 3.0 * k**2 - 2.0 * k**3
    rows = "".join(f"{0.01 * tick:.2f};{value!r}\n" for tick, value in enumerate(wanted.tolist(), 1))
    (tmp_path / "wanted.csv").write_text(f"time;output\n{rows}")
    options = ("--tick", "10 ms", "--track", "wanted.csv", "--tolerance", "0.02", "-o", "move.csv")
    document = found(run("profile", "optimal", *OSCILLATOR, *options, "--json"))
    assert np.abs(np.array(document["reference"][1:]) - wanted).max() <= 0.02 * (1.0 + 1e-9)
    lines = (tmp_path / "move.csv").read_text().splitlines()
    assert lines[0] == "tick,time_s,command,reference"
    table = np.array([line.split(",") for line in lines[1:]], dtype=float)
    assert table[:, 0].tolist() == list(range(121))
    assert table[:-1, 2].tolist() == document["command"]
    assert table[-1, 2] == document["final_value"]
    assert table[:, 3].tolist() == document["reference"]


def test_a_crane_moves_within_its_speed_and_acceleration(run, tmp_path):
    (tmp_path / "crane.toml").write_text(example_text("workshop-crane"))
    options = ("--rope-length", "5 m", "--target", "1", "--tick", "50 ms", "--json")
    document = found(run("profile", "optimal", "crane.toml", *options))
    assert document["final_value"] == pytest.approx(0.0, abs=1e-12)
    steps = np.diff([0.0, *document["command"], document["final_value"]])
    assert np.abs(steps).max() <= 0.3 * 0.05 * (1.0 + 1e-9)
    assert document["reference"][-1] == pytest.approx(1.0, abs=1e-9)
    # The way of the trolley is that of the load.
    assert 0.05 * sum(document["command"]) == pytest.approx(1.0, abs=1e-9)


def test_an_axis_of_a_crane_is_chosen_by_its_name(run, tmp_path):
    (tmp_path / "axes.toml").write_text(example_text("two-axis-crane"))
    options = ("--axis", "trolley", "--rope-length", "6", "--target", "0.2", "--tick", "0.1", "--json")
    assert found(run("profile", "optimal", "axes.toml", *options))["name"] == "two_axis_crane_trolley"


CONTACTOR = """
name = "pendant"
[crane]
rope_length = [2, 5]
max_speed = 0.5
[drive]
contactor = true
[controller]
tick = "20 ms"
[[row]]
name = "one"
family = "um-zv"
rope_length = 3
"""

CASES = {
    "--target 1 --tick 1": [
        "numerator and denominator, or a, b and c: exactly one is needed",
        "--limit: missing",
    ],
    "--numerator x --denominator 1": ['--numerator = "x": must be numbers'],
    "move.toml --limit 0": ["move.toml: --limit = 0: must be one number > 0"],
    "move.toml --target 9": ["move.toml: target = 9: needs an input of 9 to stay there"],
    "move.toml --robust 7": ["move.toml: --robust = 7: must be an integer from 0 to 6"],
    "move.toml --ei '5 %'": ["poles are either repeated or split"],
    "move.toml --track no.csv": ["a trajectory and its tolerance belong together"],
    "move.toml --track no.csv --tolerance 1": ["no.csv: cannot be read: there is no such file"],
    "move.toml --track move.toml --tolerance 1": ["move.toml: line "],
    "move.toml --rope-length 5": ["--rope-length: unknown key"],
    "crane.toml --target 1": ["crane.toml: --rope-length or frequency: exactly one is needed"],
    "hook.toml --target 1 --rope-length 5": [
        "hook.toml: a load below a hook, or a drive that feels the load"
    ],
    "crane.toml --target 1 --rope-length 11": ["--rope-length = 11.0: must be 2 to 10 m, the machine's rope"],
    "crane.toml --target 1 --frequency 1": ["--frequency = 1.0: must be 0.157"],
    "arm.toml --target 1 --rope-length 5": ["--rope-length = 5.0: this machine has no rope lengths"],
    "axes.toml --target 1 --rope-length 5": ["axes.toml: "],
    "contactor.toml --target 1 --rope-length 3": [
        "contactor drive cannot follow a command with values between"
    ],
    "broken.toml": ["broken.toml: line 1, column 1: '= 1': not valid TOML"],
    "odd.toml": ["odd.toml: [plant] numerato: unknown key", "odd.toml: [plant] numerator: missing"],
    "none.toml": ["none.toml: cannot be read"],
}


SIMULATE_CASES = {
    "move.toml --off 0": "--off[0] = 0: must be",
    "move.toml --off x": '--off[0] = "x": is not a ratio',
    "move.toml --feedback 1": '--feedback = "1": must be two numbers, P and D, not both 0',
    "move.toml --feedback '0 0'": '--feedback = "0 0": must be two numbers',
    "move.toml --feedback '50 0'": "frequencies at 90 %: feedback",
    "move.toml -o move.jpg": "move.jpg: suffix '.jpg': must be .csv for a table, or a figure's: ",
    "move.toml -o no/move.csv": "no/move.csv: cannot be written: there is no folder no",
    "mass.toml --off 0.9": "--off: nothing rings in this plant",
    "none.toml": "none.toml: cannot be read",
}


@pytest.mark.parametrize("line", SIMULATE_CASES)
def test_what_cannot_be_simulated_is_said(run, tmp_path, line):
    (tmp_path / "move.toml").write_text(EXAMPLE.read_text())
    mass = EXAMPLE.read_text().replace("[0.01, 0.0, 1.0]", "[1.0, 0.0, 0.0]").replace("robust = 1", "")
    (tmp_path / "mass.toml").write_text(mass.replace("5 ms", "50 ms"))
    done = run("profile", "simulate", *shlex.split(line))
    assert (done.code, done.out) == (2, "")
    assert SIMULATE_CASES[line] in done.err


@pytest.mark.parametrize("line", CASES)
def test_what_is_wrong_is_said_with_its_place(run, tmp_path, line):
    (tmp_path / "move.toml").write_text(EXAMPLE.read_text())
    (tmp_path / "crane.toml").write_text(example_text("workshop-crane"))
    (tmp_path / "hook.toml").write_text(example_text("double-pendulum"))
    (tmp_path / "arm.toml").write_text(example_text("flexible-arm"))
    (tmp_path / "axes.toml").write_text(example_text("two-axis-crane"))
    (tmp_path / "contactor.toml").write_text(CONTACTOR)
    (tmp_path / "broken.toml").write_text("= 1")
    (tmp_path / "odd.toml").write_text(EXAMPLE.read_text().replace("numerator", "numerato"))
    done = run("profile", "optimal", *shlex.split(line))
    assert (done.code, done.out) == (2, "")
    for message in CASES[line]:
        assert message in done.err


def test_the_page_shows_what_the_program_prints(run, tmp_path):
    (tmp_path / "time-optimal-oscillator.toml").write_text(EXAMPLE.read_text())
    (tmp_path / "crane.toml").write_text(example_text("workshop-crane"))
    shown = re.findall(r"```sh\n(.*?)```\n(?:\n```text\n(.*?)```)?", PAGE, re.DOTALL)
    assert len(shown) >= 3
    for lines, output in shown:
        for line in lines.splitlines():
            done = run(*shlex.split(line)[1:])
            assert (done.code, done.err) == (0, ""), line
        if output:
            # What is missed by rounding depends on the machine.
            assert [text for text in done.out.splitlines() if "misses rest" not in text] == [
                text for text in output.splitlines() if "misses rest" not in text
            ]


def test_the_file_on_the_page_is_read_with_all_of_its_keys(tmp_path):
    (text,) = re.findall(r"```toml\n(.*?)```", PAGE, re.DOTALL)
    (tmp_path / "move.toml").write_text(text)
    request = load_profile(tmp_path / "move.toml", {})
    assert (request.relax_ratio, request.task.rate_limit_per_s, request.task.robustness.order) == (
        1.5,
        2000.0,
        1,
    )


@pytest.mark.parametrize("name", ["optimal", "simulate"])
def test_every_option_is_on_the_page_and_no_other(name):
    command = typer.main.get_command(app).commands["profile"].commands[name]
    options = {name for parameter in command.params for name in parameter.opts if name.startswith("-")}
    first, _, second = PAGE.partition("## Options")[2].partition("`profile simulate` takes")
    documented = set(re.findall(r"`(--?[a-z-]+)`", first if name == "optimal" else second))
    assert documented == options - {"--help", "-h"}


def closed_loop_by_hand(ratio, document, gains, ticks):
    """Output and input of the oscillator under feedforward and feedback, stepped one tick after the other."""
    w, tick_s = 10.0 * ratio, document["tick_s"]
    turn = np.array([[np.cos(w * tick_s), np.sin(w * tick_s)], [-np.sin(w * tick_s), np.cos(w * tick_s)]])
    state, before, outputs, inputs = np.zeros(2), 0.0, [], []
    reference, command = (
        [*values, *[values[-1]] * ticks]
        for values in (document["reference"], [*document["command"], document["final_value"]])
    )
    for tick in range(ticks + 1):
        off = reference[tick] - state[0]
        inputs.append(command[tick] + gains[0] * off + gains[1] * (off - before) / tick_s)
        outputs.append(state[0])
        # The oscillator turns about where the input holds it.
        middle = np.array([inputs[-1], 0.0])
        state, before = middle + turn @ (state - middle), off
    return np.array(outputs), np.array(inputs)


def test_a_move_is_simulated_on_plants_that_are_off_alone_and_with_a_feedback(run):
    options = ("--feedback", "2 0.15", "--off", "0.9", "--off", "1.2", "--json")
    document = found(run("profile", "simulate", EXAMPLE, *options))
    assert document["reference"][-1] == pytest.approx(1.0, abs=1e-9)
    runs = {(each["frequency_ratio"], each["proportional"]): each for each in document["runs"]}
    assert list(runs) == [(ratio, gain) for ratio in (0.9, 1.0, 1.2) for gain in (0.0, 2.0)]
    for (ratio, gain), each in runs.items():
        gains = (gain, each["derivative_s"])
        output, asked = closed_loop_by_hand(ratio, document, gains, len(each["output"]) - 1)
        # Two ways of stepping some hundred ticks: exact but for rounding, which the feedback does not grow.
        assert each["output"] == pytest.approx(output, abs=1e-9)
        assert each["input"] == pytest.approx(asked, abs=1e-6)
        assert each["highest_input"] == pytest.approx(asked.max(), abs=1e-6)
        assert each["left"] == pytest.approx(np.abs(output[58:] - 1.0).max(), abs=1e-9)
        way = np.abs(output[:59] - document["reference"]).max()
        assert each["farthest_on_the_way"] == pytest.approx(way, abs=1e-9)
    assert runs[0.9, 2.0]["left_later"] < 0.05 * runs[0.9, 0.0]["left_later"]
    assert runs[0.9, 2.0]["limit_share_ratio"] > 1.1


def test_what_was_simulated_is_written_and_drawn(run, tmp_path):
    written = ("-o", "loop.csv", "-o", "loop.svg", "-o", "loop.png")
    done = run("profile", "simulate", EXAMPLE, "--off", "95 %", *written)
    assert (done.code, done.err) == (0, "")
    assert done.out.endswith("loop.csv: written\nloop.svg: written\nloop.png: written\n")
    head, *lines = (tmp_path / "loop.csv").read_text().splitlines()
    columns = "command,reference,input_0.95_feedforward,output_0.95_feedforward,input_1_feedforward"
    assert head == f"tick,time_s,{columns},output_1_feedforward"
    table = np.array([line.split(",") for line in lines], dtype=float)
    # On the plant as designed the command makes its trajectory.
    assert table[:, 7] == pytest.approx(table[:, 3], abs=1e-9)
    assert (tmp_path / "loop.svg").read_text().startswith("<?xml")
    assert (tmp_path / "loop.png").read_bytes().startswith(b"\x89PNG")


def test_the_page_of_the_paper_says_how_to_play_figure_12(run, tmp_path):
    page = (ROOT / "docs" / "papers" / "xu-meckl-2005.md").read_text(encoding="utf-8")
    (line,) = re.findall(r"`swayless (profile simulate [^`]+)`", page)
    done = run(*shlex.split(line.replace("examples/", f"{ROOT}/examples/")))
    assert (done.code, done.err) == (0, "")
    head, *_ = (tmp_path / "loop.csv").read_text().splitlines()
    assert head.startswith("tick,time_s,command,reference,input_0.9_feedforward,output_0.9_feedforward,")


@pytest.mark.parametrize("command", ["optimal", "simulate"])
def test_the_trajectory_to_follow_is_never_written_over(run, tmp_path, command):
    plant = "[plant]\nnumerator = [1]\ndenominator = [1, 0, 0]\n[move]\ntick = 0.1\nlimit = 9\ntarget = 1\n"
    (tmp_path / "move.toml").write_text(f'{plant}track = "wanted.csv"\ntolerance = 0.5\n')
    (tmp_path / "wanted.csv").write_text("0.3\n0.6\n0.9\n1\n1\n")
    done = run("profile", command, "move.toml", "-o", "wanted.csv")
    assert (done.code, done.out) == (2, "")
    assert "wanted.csv: would be written over, and it is read: choose another output" in done.err
    assert (tmp_path / "wanted.csv").read_text() == "0.3\n0.6\n0.9\n1\n1\n"


def test_a_target_where_the_move_starts_is_named_by_its_option(run):
    done = run("profile", "optimal", EXAMPLE, "--target", "0")
    assert (done.code, done.out) == (2, "")
    assert "--target: 0: must differ from the start" in done.err


def test_a_move_is_written_and_drawn_at_once(run, tmp_path):
    done = run("profile", "optimal", EXAMPLE, "-o", "move.csv", "-o", "move.pdf", "-o", "move.html")
    assert done.out.endswith("move.csv: written\nmove.pdf: written\nmove.html: written\n")
    assert (tmp_path / "move.pdf").read_bytes().startswith(b"%PDF")
    page = (tmp_path / "move.html").read_text(encoding="ascii")
    for said in (
        "<td>58 ticks of 0.005 s, 0.29 s</td>",
        "<td>0.0389</td>",
        "<p>proved: 57 ticks would",
        "<svg ",
    ):
        assert said in page
    assert "<script" not in page


def test_a_crane_is_simulated_on_other_ropes(run, tmp_path):
    (tmp_path / "crane.toml").write_text(example_text("workshop-crane").replace('"0.2 %"', "0.0"))
    options = ("--rope-length", "5 m", "--target", "1", "--tick", "50 ms", "--json")
    document = found(run("profile", "simulate", "crane.toml", *options))
    assert [each["frequency_ratio"] for each in document["runs"]] == [0.9, 1.0, 1.1]
    # A rope longer by 1 / 0.9^2 has 0.9 of the frequency.
    w2 = 0.81 * 9.80665 / 5.0
    longer = LinearPlant.from_transfer_function([w2], [1.0, 0.0, w2, 0.0])
    output = output_at_ticks(longer, played(document), ticks=len(document["runs"][0]["output"]) - 1)
    assert document["runs"][0]["output"] == pytest.approx(output.tolist(), abs=1e-9)


def test_an_inverted_move_is_simulated_too(run):
    servo = EXAMPLE.with_name("inverted-servo.toml")
    document = found(run("profile", "simulate", servo, "--off", "0.9", "--json"))
    off, nominal = document["runs"]
    assert nominal["left"] < 1e-9
    assert off["left"] > 0.05
    assert nominal["output"][: len(document["reference"])] == pytest.approx(document["reference"], abs=1e-12)
    done = run("profile", "simulate", servo, "--limit", "5", "--axis", "x")
    assert (done.code, done.out, len(done.err.splitlines())) == (2, "", 2)
    assert "--limit: belongs to the fastest move" in done.err


def test_modes_that_are_one_move_together_and_none_is_said_to_be_off(run, tmp_path):
    options = (
        "--numerator",
        "1",
        "--denominator",
        "1 0 2 0 1",
        "--limit",
        "5",
        "--tick",
        "50 ms",
        "--target",
        "1",
    )
    done = run("profile", "optimal", *options, "-o", "both.svg")
    assert (done.code, done.err) == (0, "")
    assert "note: two modes at 1j rad/s are one: none can be off on its own\n" in done.out
    assert found(run("profile", "optimal", *options, "--json"))["left"] == []
