"""What figures are given is checked."""

from __future__ import annotations

import dataclasses
import math

import pytest

from swayless.errors import DesignError, PlantError
from swayless.report import PlottedCommand, PlottedShaper


def test_an_empty_label_is_refused(zv: PlottedShaper) -> None:
    with pytest.raises(DesignError, match="label = ' ': must not be empty"):
        dataclasses.replace(zv, label=" ")


@pytest.mark.parametrize("tick_s", [0.0, -0.01, math.inf, math.nan])
def test_a_tick_out_of_range_is_refused(zv: PlottedShaper, tick_s: float) -> None:
    with pytest.raises(DesignError, match=r"ZV: tick_s = .*: must be finite and > 0, or None"):
        dataclasses.replace(zv, tick_s=tick_s)


@pytest.mark.parametrize("name", ["speed_m_s", "hold_s", "acceleration_m_s2", "deceleration_m_s2"])
@pytest.mark.parametrize("value", [0.0, -1.0, math.nan])
def test_commands_must_be_positive(name: str, value: float) -> None:
    with pytest.raises(PlantError, match=f"{name} = .*: must be > 0"):
        PlottedCommand(**{name: value})


def test_the_speed_of_a_command_is_finite() -> None:
    with pytest.raises(PlantError, match="speed_m_s = inf: must be finite"):
        PlottedCommand(math.inf)


def test_a_command_that_is_held_for_ever_is_a_step() -> None:
    assert PlottedCommand(0.5).title == "step to 0.5 m/s"
