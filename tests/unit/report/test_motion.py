"""Commands and references over time."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from swayless.design.shaper import Guarantee, Shaper
from swayless.errors import DesignError
from swayless.plant import Band, Mode
from swayless.report import PlottedCommand, PlottedShaper
from swayless.report.motion import accepted_hold_s, command_profile, shaped_profile


def test_a_step_jumps_once(zv: PlottedShaper) -> None:
    times_s, velocity_m_s = command_profile(PlottedCommand(0.5), zv).vertices()
    assert times_s.tolist() == [0.0, 0.0]
    assert velocity_m_s.tolist() == [0.0, 0.5]


def test_a_press_ramps_up_and_down_at_its_own_rates(zv: PlottedShaper) -> None:
    command = PlottedCommand(0.5, 4.0, acceleration_m_s2=0.25, deceleration_m_s2=0.5)
    times_s, velocity_m_s = command_profile(command, zv).vertices()
    assert times_s[::2].tolist() == [0.0, 2.0, 4.0, 5.0]
    assert velocity_m_s[::2].tolist() == [0.0, 0.5, 0.5, 0.0]


def test_a_ramp_in_ticks_gains_one_step_a_tick_and_the_rest_in_the_last(zv: PlottedShaper) -> None:
    ticked = dataclasses.replace(zv, tick_s=0.25)
    profile = command_profile(PlottedCommand(0.55, acceleration_m_s2=1.0), ticked)
    assert profile.times_s.tolist() == [0.0, 0.25, 0.5]
    np.testing.assert_allclose(profile.jumps_m_s, [0.25, 0.25, 0.05], rtol=1e-14)  # roundings
    assert not profile.acceleration_steps_m_s2.any()


def test_a_press_in_ticks_lasts_a_whole_number_of_them(zv: PlottedShaper) -> None:
    ticked = dataclasses.replace(zv, tick_s=0.25)
    assert command_profile(PlottedCommand(hold_s=0.6), ticked).times_s.tolist() == [0.0, 0.75]
    assert command_profile(PlottedCommand(hold_s=0.75), ticked).times_s.tolist() == [0.0, 0.75]


def test_a_short_press_on_positive_amplitudes_counts_as_long_as_it_is(zv: PlottedShaper) -> None:
    assert accepted_hold_s(PlottedCommand(hold_s=0.1), zv) == 0.1


def test_a_short_press_on_negative_amplitudes_is_held_until_settled(um_zv: PlottedShaper) -> None:
    command = PlottedCommand(0.5, 0.1, acceleration_m_s2=0.25)
    assert accepted_hold_s(command, um_zv) == 2.0 + um_zv.duration_s
    assert accepted_hold_s(PlottedCommand(0.5, 60.0), um_zv) == 60.0


@settings(derandomize=True, deadline=None)
@given(
    hold_s=st.floats(0.01, 10.0),
    acceleration_m_s2=st.just(math.inf) | st.floats(0.1, 5.0),
    deceleration_m_s2=st.just(math.inf) | st.floats(0.1, 5.0),
    tick_s=st.none() | st.just(0.05),
    negative=st.booleans(),
)
def test_a_press_ends_at_rest_and_the_reference_stays_in_range(
    hold_s: float, acceleration_m_s2: float, deceleration_m_s2: float, tick_s: float | None, negative: bool
) -> None:
    amplitudes = [1.0, -1.0, 1.0] if negative else [0.25, 0.5, 0.25]
    shaper = _design([0.0, 0.7, 1.4], amplitudes, tick_s)
    command = PlottedCommand(0.5, hold_s, acceleration_m_s2, deceleration_m_s2)
    reference = shaped_profile(command_profile(command, shaper), shaper.impulses)
    _, velocity_m_s = reference.vertices()
    # Hundreds of roundings of numbers up to 0.5 and slopes up to 5.
    assert velocity_m_s[-1] == pytest.approx(0.0, abs=1e-12)
    assert velocity_m_s.min() >= -1e-12
    assert velocity_m_s.max() <= 0.5 + 1e-12


def test_a_ramp_of_too_many_ticks_is_refused(zv: PlottedShaper) -> None:
    ticked = dataclasses.replace(zv, tick_s=1e-6)
    with pytest.raises(DesignError, match=r"a ramp of 1e\+06 ticks: a figure shows at most 200000"):
        command_profile(PlottedCommand(1.0, acceleration_m_s2=1.0), ticked)


def _design(times_s: list[float], amplitudes: list[float], tick_s: float | None) -> PlottedShaper:
    guarantee = Guarantee(0.05, Mode(0.3), Band(0.3, 0.3), 0.05)
    shaper = Shaper(np.array(times_s), np.array(amplitudes), "test", guarantee, "test")
    return PlottedShaper("test", shaper, guarantee, tick_s)
