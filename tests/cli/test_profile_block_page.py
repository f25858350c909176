"""The data sheet of the motion profile says what the block does."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from swayless.codegen.profile_pins import INPUTS, OUTPUTS
from swayless.controller.profile import (
    Extremes,
    MotionProfile,
    Pieces,
    ProfileInput,
    ProfileModel,
    ProfileSettings,
    ProfileStatus,
    StopLaw,
    explain_profile,
)
from swayless.design.optimal import time_optimal
from swayless.design.playing import ShapeLimits, quickest_stop, shape_model
from swayless.machine.profile_file import load_profile
from swayless.machine.profile_plant import load_below_trolley
from swayless.plant import Mode, pendulum_frequency_hz

PAGE = (Path(__file__).parents[2] / "docs" / "profile-block.md").read_text(encoding="utf-8")
MASS = ProfileModel([[0.0, 1.0], [0.0, 0.0]], [0.5, 1.0], [1.0, 0.0], 0.0)
STOP = StopLaw(Pieces([2], [[[0.0, -0.5, 0.0]]]), [1.0, 1.0, 0.0], [[1, 1]])
SHAPE = Pieces([2, 2], [[0.25], [-0.25]])
SETTINGS = ProfileSettings(1.0, SHAPE, MASS, STOP, Extremes((-0.25, 0.25), (0.0, 1.0)), (-2.0, 2.0))
"""The mass of 1 kg of the timing diagrams."""

DIAGRAMS = re.findall(r"```text\n(tick .*?)```", PAGE, re.DOTALL)


def cells(first_head):
    (table,) = re.findall(rf"^\| {first_head} \|.*\n\|[-|]+\n((?:\|.*\n)+)", PAGE, re.MULTILINE)
    return [[cell.strip().strip("`") for cell in line.split("|")[1:-1]] for line in table.splitlines()]


def rows_of(diagram):
    """Numbers of each line of a timing diagram, by its name."""
    lines = (line.split() for line in diagram.splitlines())
    return {name: [float(value) for value in values] for name, *values in lines}


@pytest.mark.parametrize("diagram", DIAGRAMS, ids=range(len(DIAGRAMS)))
def test_a_timing_diagram_is_what_the_reference_does(diagram):
    rows = rows_of(diagram)
    block = MotionProfile(SETTINGS)
    columns = zip(rows["execute"], rows["abort"], rows["start"], rows["target"], strict=True)
    outputs = [
        block.step(ProfileInput(bool(execute), bool(abort), *move)) for execute, abort, *move in columns
    ]
    for pin in OUTPUTS:
        assert rows[pin.field] == [float(getattr(out, pin.field)) for out in outputs], pin.field
    assert list(rows) == ["tick", *(pin.field for pin in (*INPUTS, *OUTPUTS))]


def test_the_timing_diagrams_show_every_output_true():
    for pin in OUTPUTS:
        assert any(any(rows_of(diagram)[pin.field]) for diagram in DIAGRAMS), pin.field


def test_the_pin_table_is_that_of_the_generators():
    found = [[row[0], row[1], row[4]] for row in cells("C")]
    assert found == [[pin.c_name, pin.st_name, pin.doc] for pin in (*INPUTS, *OUTPUTS)]


def test_the_status_table_is_that_of_the_controller():
    assert cells("value") == [[str(bit.value), bit.name, explain_profile(bit)] for bit in ProfileStatus]


def test_the_crane_of_the_page_rests_after_an_abort_as_the_page_says(tmp_path):
    (text,) = re.findall(r"```toml\n(.*?)```", PAGE, re.DOTALL)
    (tmp_path / "crane.toml").write_text(text)
    task = load_profile(tmp_path / "crane.toml", {}).task
    shape = time_optimal(task).command.values / 12.0
    limits = ShapeLimits(-0.8 / 12.0, 0.8 / 12.0, 0.4 * 0.02 / 12.0)
    within = ShapeLimits(*(limit * (1.0 - 1e-9) for limit in (limits.low, limits.high, limits.change)))
    model = shape_model(task.plant, 0.02, robustness=task.robustness)
    stop = quickest_stop(model, shape, within)
    rests = stop.rests(shape.size)
    # Another library may shift a range, or the length, by a tick or two.
    numbers = re.findall(r"takes (\d+) ticks.*?at most (\d+) ticks.*?within (\d+) ticks", PAGE, re.DOTALL)
    waits = np.where(rests < shape.size - np.arange(1, shape.size), rests - stop.ticks, 0)
    assert [stop.ticks, waits.max(), rests.max()] == pytest.approx([int(n) for n in numbers[-1]], abs=3)
    begins = 300 + rests[299] - stop.ticks
    known = np.append(model.states(shape)[begins], shape[begins - 1])
    rest, at = 12.0 * float(stop.rest @ known), 12.0 * float(model.output @ model.states(shape)[300])
    assert [12.0 - at, rest - at] == pytest.approx([8.47, 3.44], abs=0.02)
    assert 0.02 * rests[299] == pytest.approx(9.16, abs=0.06)  # an abort after 6 s


def test_the_crane_of_the_page_is_the_load_below_a_trolley_and_moves(tmp_path):
    (text,) = re.findall(r"```toml\n(.*?)```", PAGE, re.DOTALL)
    (tmp_path / "crane.toml").write_text(text)
    task = load_profile(tmp_path / "crane.toml", {}).task
    load = load_below_trolley(Mode(pendulum_frequency_hz(6.0)))
    # To the 13 digits that the page shows.
    np.testing.assert_allclose(np.poly(task.plant.a), np.poly(load.a), rtol=1e-12, atol=1e-12)
    assert task.plant.equilibrium(12.0)[1] == 0.0
