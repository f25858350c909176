"""`swayless simulate` on a crane whose drive feels the load: the linear prediction, and what it gains."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path

import numpy as np
import pytest

from swayless.cli.simulation import simulate_move
from swayless.machine import load_machine, save_text
from swayless.machine.as_pendulum import pendulum_design
from swayless.machine.designing import design_machine
from swayless.machine.move_section import MoveSection
from swayless.machine.running import shaper_settings
from swayless.plant import ServoDrive
from tests.unit.plant.linear_drive import state_matrix

PAGE = (Path(__file__).parents[2] / "docs" / "simulate.md").read_text(encoding="utf-8")
TOML = re.findall(r"```toml\n# driven\.toml\n(.*?)```", PAGE, re.DOTALL)[0]
TICK_S, SPEED_M_S = 0.01, 0.1
SLOW = ("--move", f"10 s at {SPEED_M_S} m/s", "--rope-length", "10")
"""Swings of half a degree at the most, where a pendulum is linear to 1e-5."""


@pytest.fixture
def driven(tmp_path):
    path = tmp_path / "driven.toml"
    path.write_text(TOML)
    return path


@pytest.fixture
def simulated(run):
    """Give the document of a simulation."""

    def simulated(*arguments):
        done = run("simulate", *arguments, "--json")
        assert (done.code, done.err) == (0, "")
        return json.loads(done.out)

    return simulated


def predicted_ratio(reference_m_s, rope_m, drive):
    """Residual of a reference, from the residue of the swing's transfer function at the true mode.

    a(t) = sum over changes of the reference of 2 Re(c exp(s t)), with c from the matrix's eigenvectors.
    """
    matrix = state_matrix(drive, rope_m, 0.0)
    values, right = np.linalg.eig(matrix)
    swings = np.flatnonzero(values.imag > 1e-6)
    at = swings[(-values[swings].real / abs(values[swings])).argmin()]
    gain = drive.gain_n_s_m / drive.trolley_mass_kg
    push = np.array([gain, 1.0, 0.0, -gain / rope_m])
    # A step of the reference: x' = A x + push r, whose mode grows by (left push) / s times exp(s t) - 1.
    share = (np.linalg.inv(right)[at] @ push) * right[2, at] / values[at]
    # What is left is read a tick after the last change, which has acted then.
    ends_s = TICK_S * (len(reference_m_s) + 1 - np.arange(len(reference_m_s) + 1))
    steps = np.diff(reference_m_s, prepend=0.0, append=0.0)
    swing_rad = 2.0 * abs(share * (steps @ np.exp(values[at] * ends_s)))
    return swing_rad / (SPEED_M_S / math.sqrt(9.80665 * rope_m))


def test_the_simulation_leaves_what_the_linear_model_predicts(driven):
    design = design_machine(load_machine(driven))
    settings, free = shaper_settings(design), shaper_settings(pendulum_design(design))
    move = MoveSection(duration_s=10.0, speed_m_s=SPEED_M_S, places=(10.0, 8.0))
    drive = ServoDrive.from_lag(2000.0, 6000.0, 0.1)
    cases = simulate_move(design, settings, move, free).cases
    assert len(cases) == 16
    for case in cases:
        expected = predicted_ratio(case.contender.reference_m_s, case.site.length_m, drive)
        # 1e-4: a pendulum at one degree is linear to 2e-5, of up to 1.7 that a jump leaves.
        assert case.residual_ratio == pytest.approx(expected, abs=1e-4), case.contender.name


def test_the_true_mode_gains_what_a_pendulum_leaves(driven, simulated):
    (long,) = simulated(driven, *SLOW)["moves"][0]["true_mode"]
    assert long["rope_length_m"] == [10.0, 10.0]
    assert long["mode"]["damping_ratio"] == pytest.approx(0.75 * 0.99028 * 0.1 / 2.0, rel=0.01)
    assert long["mode"]["frequency_hz"] > long["mode"]["pendulum_frequency_hz"]
    zv, ei = long["rows"]
    # The row is made for this rope: ticks and linearity are all that is left.
    assert zv["residual_ratio"] < 1e-4
    assert zv["pendulum_residual_ratio"] > 0.03
    assert (zv["moved_by"], zv["knob"], ei["knob"]) == ("1 zv", 1, 2)


def test_cases_for_a_pendulum_are_told_apart(driven, simulated):
    cases = simulated(driven, *SLOW, "--row", "2")["moves"][0]["cases"]
    marked = [case["moved_by"] for case in cases if case.get("for_pendulum")]
    assert marked == ["2 ei for a pendulum"]


def test_a_drive_without_masses_says_nothing_of_a_true_mode(driven, simulated):
    driven.write_text(re.sub(r"\[drive\].*?\[controller\]", "[controller]", TOML, flags=re.DOTALL))
    move = simulated(driven, *SLOW)["moves"][0]
    assert "true_mode" not in move
    assert not any("for_pendulum" in case for case in move["cases"])


def test_a_design_file_gives_the_same_comparison(driven, simulated, tmp_path):
    stored = tmp_path / "driven.json"
    stored.write_text(save_text(design_machine(load_machine(driven))))
    assert simulated(stored, *SLOW) == simulated(driven, *SLOW)


REFUSED = [
    (("design", "recommend"), "[drive] trolley_mass: candidates are compared at one damping ratio"),
    (("plot", "tradeoff"), "[drive] trolley_mass: candidates are compared at one damping ratio"),
]


@pytest.mark.parametrize(("command", "reason"), REFUSED, ids=[" ".join(case[0]) for case in REFUSED])
def test_what_knows_one_damping_ratio_only_refuses_a_driven_crane(driven, run, command, reason):
    done = run(*command, driven, *(["-o", "f.svg"] if command[0] == "plot" else []))
    assert done.code == 2
    assert reason in done.err


def test_figures_over_rope_lengths_which_are_those_of_pendulums_are_refused(driven, run, tmp_path):
    stored = tmp_path / "driven.json"
    stored.write_text(save_text(design_machine(load_machine(driven))))
    done = run("plot", "sensitivity", stored, "--over", "rope-length", "-o", "f.svg")
    assert done.code == 2
    assert "the design driven_crane is for a drive that feels the load" in done.err
    assert not Path("f.svg").exists()
