"""The tracking monitor: what lags within the delay passes, and what does not follow is told in time."""

import numpy as np
import pytest

from swayless.controller import SpeedLimits, command_limits, number_type
from swayless.controller.tracking import Tracking, TrackingSettings, tracking_settings
from swayless.errors import ControllerError
from tests.properties.strategies import NUMBERS
from tests.unit.controller.blocks import COUNTS_PER_M_S

TICK_S = 0.01


def limits_of(number):
    speeds = SpeedLimits(0.5, 0.5, units_per_m_s=COUNTS_PER_M_S if number == "int32" else 1.0)
    return command_limits(speeds, tick_s=TICK_S, number=number_type(number))


def settings_of(number="double", tolerance_m_s=0.05, time_s=0.1, delay_s=0.2):
    kind = number_type(number)
    return tracking_settings(
        tolerance_m_s, time_s=time_s, delay_s=delay_s, tick_s=TICK_S, limits=limits_of(number), number=kind
    )


def watched(settings, references, actuals, number="double", expected=True):
    kind = number_type(number)
    monitor = Tracking(settings, kind)
    scale = COUNTS_PER_M_S if kind.is_integer else 1.0
    return [
        monitor.watch(kind.scalar(r * scale), kind.scalar(a * scale), expected=expected)
        for r, a in zip(references, actuals, strict=True)
    ]


def moves(ticks=1500, seed=3):
    """Ramps to random speeds, some of them long, some cut short."""
    generator = np.random.default_rng(seed)
    targets = np.repeat(generator.uniform(-0.5, 0.5, ticks // 100), 100)
    references = [0.0]
    for target in targets:
        references.append(references[-1] + float(np.clip(target - references[-1], -0.005, 0.005)))
    return np.array(references[1:])


@pytest.mark.parametrize("number", NUMBERS)
def test_a_drive_that_is_late_by_the_delay_or_less_and_off_by_the_tolerance_or_less_passes(number):
    references = moves()
    for late in (0, 7, 20):
        actuals = np.concatenate([np.zeros(late), references[: references.size - late]])
        off = 0.0499 * np.sign(np.sin(np.arange(references.size)))
        # 1e-4 m/s of room: two counts in int32, far more than rounding in float
        assert not any(watched(settings_of(number), references, actuals + off, number))


def test_a_drive_of_first_order_with_the_delay_as_time_constant_passes():
    references, actual, actuals = moves(), 0.0, []
    for reference in references:
        actual += (reference - actual) * (1.0 - np.exp(-TICK_S / 0.2))
        actuals.append(actual)
    assert not any(watched(settings_of(), references, actuals))


@pytest.mark.parametrize("number", NUMBERS)
def test_a_drive_that_stands_is_told_after_the_time_and_two_windows_at_most(number):
    settings = settings_of(number)
    told = watched(settings, [0.5] * 100, [0.0] * 100, number)
    first = told.index(True)
    # The 0 from before lies in the window before the one that fills: 21 ticks at the latest, and 10 of time.
    assert settings.time_ticks <= first <= 2 * settings.window_ticks + settings.time_ticks
    assert all(told[first:])


def test_a_difference_that_ends_within_the_time_is_not_told_and_the_next_one_counts_anew():
    settings = TrackingSettings(0.05, time_ticks=4, window_ticks=1)
    actuals = [0.1] * 4 + [0.0] + [0.1] * 5 + [0.0]
    assert watched(settings, [0.0] * 11, actuals) == [False] * 9 + [True, False]


def test_nothing_is_told_while_the_drive_is_not_expected_to_follow():
    settings = settings_of()
    assert not any(watched(settings, [0.5] * 200, [0.0] * 200, expected=False))


@pytest.mark.parametrize("actual", [float("nan"), float("inf"), float("-inf")])
def test_a_speed_that_is_not_finite_follows_nothing(actual):
    settings = settings_of(time_s=0.0)
    assert all(watched(settings, [0.1] * 3, [actual] * 3))


def test_the_memory_does_not_grow_and_the_count_ends():
    monitor = Tracking(TrackingSettings(0.05, time_ticks=3, window_ticks=2), number_type("double"))
    for _ in range(1000):
        monitor.watch(0.0, 1.0, expected=True)
    assert monitor._outside == 4
    assert all(not isinstance(value, list) for value in vars(monitor).values())


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        ({"tolerance_m_s": 0.0}, r"tracking_tolerance = 0\.0 m/s: must be at most max_speed, and above 0"),
        ({"tolerance_m_s": 0.6}, "tracking_tolerance = 0.6 m/s: must be at most max_speed"),
        ({"tolerance_m_s": float("nan")}, "tracking_tolerance = nan m/s"),
        ({"time_s": -1.0}, r"tracking_time = -1\.0 s: must be 0 to 10485\.8 s"),
        ({"delay_s": 2e4}, "tracking_delay = 20000.0 s: must be 0 to"),
        ({"number": "int32", "tolerance_m_s": 1e-5}, "and at least one count"),
    ],
)
def test_what_is_out_of_range_is_refused(asked, message):
    with pytest.raises(ControllerError, match=message):
        settings_of(**asked)
