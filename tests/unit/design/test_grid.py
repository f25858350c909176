"""Shapers on the tick grid: the promise kept on whole ticks, or refused with a tick that does."""

from __future__ import annotations

import math
import re
from decimal import Decimal

import numpy as np
import pytest

from swayless.design.convolution import convolve
from swayless.design.families import FAMILIES, design_shaper
from swayless.design.grid import EXTRA_TICKS, LARGEST_DURATION_TICKS, solve_on_grid
from swayless.design.residual import residual_vibration
from swayless.design.shaper import Shaper
from swayless.errors import DesignError
from swayless.plant import Mode


def test_ei_at_eleven_ticks_a_period_needs_a_twelfth() -> None:
    taps = solve_on_grid(design_shaper("ei", Mode(1.0)), 1.0 / 11.0)
    assert taps.delays_ticks.tolist() == [0, 5, 6, 11, 12]
    assert taps.guarantee.worst_residual_ratio == 0.05  # the held band ends where the tolerance is reached
    assert taps.guarantee.band.low_hz < 0.8002746
    assert taps.guarantee.band.high_hz > 1.1997254


def test_zv_cancels_the_mode_between_ticks_where_a_rounded_one_leaves_5_8_percent() -> None:
    mode = Mode(0.963)
    shaper = design_shaper("zv", mode)
    taps = solve_on_grid(shaper, 0.05)

    class Rounded:
        times_s = np.round(shaper.times_s / 0.05) * 0.05
        amplitudes = shaper.amplitudes

    assert float(residual_vibration(Rounded(), mode.frequency_hz)) == pytest.approx(0.058, abs=1e-4)
    assert taps.delays_ticks.tolist() == [0, 10, 11]
    assert float(residual_vibration(taps, mode.frequency_hz)) < 1e-11  # three amplitudes on the 1e-12 lattice


@pytest.mark.parametrize(
    ("family", "order", "ticks_per_period", "damping_ratio"),
    [
        ("zv", None, 20, 0.0),
        ("zv", None, 20, 0.1),
        ("zvd", None, 20, 0.2),
        ("zvdd", None, 20, 0.0),
        ("zvddd", None, 20, 0.05),
        ("zvm", 6, 20, 0.0),
        ("ei", None, 20, 0.0),
        ("ei2", None, 412, 0.0),
        ("ei3", None, 12, 0.0),
        ("mzv", None, 16, 0.0),
        ("mzv", None, 16, 0.1),
        ("um-zv", None, 12, 0.0),
    ],
)
def test_ideal_times_on_ticks_keep_the_ideal_amplitudes(
    family: str, order: int | None, ticks_per_period: int, damping_ratio: float
) -> None:
    mode = Mode(0.37, damping_ratio)
    tick_s = mode.damped_period_s / ticks_per_period
    shaper = design_shaper(family, mode, order=order)
    taps = solve_on_grid(shaper, tick_s)
    np.testing.assert_allclose(taps.times_s, shaper.times_s, rtol=1e-12)
    # Fixed by equalities or by optimality: to the lattice, and to times that are within 1e-11 of a tick.
    np.testing.assert_allclose(taps.amplitudes, shaper.amplitudes, atol=1e-10)
    assert taps.guarantee.band.low_hz <= shaper.guarantee.band.low_hz
    assert taps.guarantee.band.high_hz >= shaper.guarantee.band.high_hz


@pytest.mark.parametrize("family", ["zv", "zvd", "ei2", "mzv", "um-zv"])
@pytest.mark.parametrize("damping_ratio", [0.0, 0.1])
@pytest.mark.parametrize("off_tick", [1e-5, 1e-7, 1e-8, 1e-9, 1e-10, 1e-12])
@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_ideal_times_nearly_on_ticks_cost_at_most_one_tick(
    family: str, damping_ratio: float, off_tick: float, side: float
) -> None:
    mode = Mode(1.0, damping_ratio)
    tick_s = mode.damped_period_s / (240.0 * (1.0 + side * off_tick))
    shaper = design_shaper(family, mode)
    taps = solve_on_grid(shaper, tick_s)
    assert taps.delays_ticks[-1] - math.floor(shaper.duration_s / tick_s + 1e-9) in {0, 1}
    # An equality counts as met within 1e-9, and a zero is two of them.
    assert float(residual_vibration(taps, 1.0, damping_ratio=damping_ratio)) < 2e-9
    assert taps.guarantee.worst_residual_ratio <= 0.05 + 2e-9


def test_unity_magnitude_taps_hold_levels_for_a_tick() -> None:
    taps = solve_on_grid(design_shaper("um-zv", Mode(0.25)), 0.01)
    levels = np.cumsum(taps.amplitudes)
    assert taps.delays_ticks.tolist() == [0, 66, 67, 133, 134]
    assert levels.min() >= 0.0
    assert levels.max() <= 1.0
    assert 0.0 < levels[2] < 0.02  # a short step where the ideal edge falls between two ticks


def test_delay_filter_moves_its_delay_to_the_nearest_whole_tick() -> None:
    mode = Mode(0.5, 0.05)
    taps = solve_on_grid(design_shaper("oatf", mode, delay_s=0.437), 0.02)
    moved = design_shaper("oatf", mode, delay_s=0.44)
    assert taps.delays_ticks.tolist() == [0, 22, 44]
    np.testing.assert_allclose(taps.amplitudes, moved.amplitudes, atol=1e-12)  # the lattice
    assert float(residual_vibration(taps, 0.5, damping_ratio=0.05)) < 1e-11


def test_delay_filter_waits_at_least_one_tick() -> None:
    taps = solve_on_grid(design_shaper("oatf", Mode(0.5), delay_s=0.1), 0.3)
    assert taps.delays_ticks.tolist() == [0, 1, 2]


def test_derivatives_vanish_with_the_vibration() -> None:
    mode = Mode(1.0, 0.1)
    taps = solve_on_grid(design_shaper("zvm", mode, order=4), 1.0 / 23.7)
    ratio = residual_vibration(taps, [0.96, 0.98, 1.02, 1.04], damping_ratio=0.1)
    # V grows with the fifth power of the distance, 32 for twice of it. The next power is odd and cancels
    # between the two sides; what remains is (0.04 pi)^2 and the like.
    assert (ratio[0] + ratio[3]) / (ratio[1] + ratio[2]) == pytest.approx(32.0, rel=0.02)


def test_amplitudes_are_decimals_that_sum_to_one() -> None:
    taps = solve_on_grid(design_shaper("ei3", Mode(0.31, 0.1)), 0.01)
    decimals = [Decimal(repr(float(amplitude))) for amplitude in taps.amplitudes]
    assert sum(decimals) == 1
    assert all(decimal == round(decimal, 12) for decimal in decimals)


def test_solving_twice_gives_the_same_numbers() -> None:
    shaper = design_shaper("um-ei", Mode(0.31, 0.1))
    first, second = solve_on_grid(shaper, 0.01), solve_on_grid(shaper, 0.01)
    assert first.amplitudes.tolist() == second.amplitudes.tolist()
    assert first.guarantee == second.guarantee


def test_result_does_not_depend_on_the_unit_of_time() -> None:
    slow = solve_on_grid(design_shaper("ei2", Mode(0.125, 0.05)), 0.08)
    fast = solve_on_grid(design_shaper("ei2", Mode(128.0, 0.05)), 0.000078125)  # 1024 times faster, exactly
    assert slow.delays_ticks.tolist() == fast.delays_ticks.tolist()
    np.testing.assert_allclose(slow.amplitudes, fast.amplitudes, atol=1e-11)  # the band's edges round apart


@pytest.mark.parametrize(
    ("family", "tick_s", "reason"),
    [
        ("zv", 4.0, r"no amplitudes within 3 ticks leave less than [\d.]+ %, and 5 % is promised"),
        ("zvd", 4.0, r"no amplitudes within 4 ticks cancel the mode"),
        ("ei", 4.0, r"no amplitudes within 4 ticks leave less than [\d.]+ %, and 5 % is promised"),
        ("um-zv", 2.0, r"no room for 3 impulses in a duration of 1 x 2 s"),
        ("um-ei", 3.6, r"no room for 5 impulses in a duration of 2 x 3.6 s"),
    ],
)
def test_too_coarse_a_tick_is_refused_with_one_that_does(family: str, tick_s: float, reason: str) -> None:
    shaper = design_shaper(family, Mode(0.2))
    with pytest.raises(DesignError, match=reason) as refused:
        solve_on_grid(shaper, tick_s)
    message = str(refused.value)
    assert message.startswith(f"{family} at 0.2 Hz, tick_s = {tick_s:g}: ")
    named = re.search(r"; a tick of ([\d.e-]+) s does$", message)
    assert named is not None
    assert float(named.group(1)) < tick_s
    taps = solve_on_grid(shaper, float(named.group(1)))
    assert taps.guarantee.band.low_hz <= shaper.guarantee.band.low_hz


@pytest.mark.parametrize("tick_s", [0.0, -0.01, math.inf, math.nan])
def test_tick_must_be_a_time(tick_s: float) -> None:
    with pytest.raises(DesignError, match=rf"^tick_s = {tick_s!r}: must be finite and > 0$"):
        solve_on_grid(design_shaper("zv", Mode(1.0)), tick_s)


def test_too_fine_a_tick_is_refused_with_the_finest() -> None:
    reason = r"zv lasts 0\.5 s, more than 20000 ticks; must be at least 2\.5e-05$"
    with pytest.raises(DesignError, match=reason):
        solve_on_grid(design_shaper("zv", Mode(1.0)), 1e-6)
    taps = solve_on_grid(design_shaper("zv", Mode(1.0)), 2.5e-5)
    assert taps.delays_ticks[-1] == LARGEST_DURATION_TICKS


def test_last_impulse_too_small_to_split_is_refused() -> None:
    with pytest.raises(DesignError, match=r"^zvm: its last impulse is 9\.79e-07, .* must be at least 1e-05$"):
        solve_on_grid(design_shaper("zvm", Mode(1.0, 0.2), order=12), 0.01)


def test_convolution_is_refused_because_its_promise_is_for_one_mode_only() -> None:
    both = convolve(design_shaper("zv", Mode(0.2)), design_shaper("zv", Mode(0.5)))
    with pytest.raises(DesignError, match=r"^family 'zv\*zv': .* solved one by one$"):
        solve_on_grid(both, 0.01)


def _independent_ratio(taps_times_s: np.ndarray, amplitudes: np.ndarray, shaper: Shaper) -> float:
    """Largest residual vibration in the promised band, from the definition, ten times finer than needed."""
    band, damping_ratio = shaper.guarantee.band, shaper.guarantee.mode.damping_ratio
    cycles = taps_times_s[-1] * (band.high_hz - band.low_hz)
    worst = 0.0
    for frequency_hz in np.array_split(np.linspace(band.low_hz, band.high_hz, int(640 * cycles) + 100), 50):
        w = 2.0 * math.pi * frequency_hz[:, np.newaxis]
        lag_s = taps_times_s - taps_times_s[-1]
        decay = np.exp(damping_ratio * w * lag_s)
        cosine = (amplitudes * decay * np.cos(w * math.sqrt(1.0 - damping_ratio**2) * lag_s)).sum(axis=1)
        sine = (amplitudes * decay * np.sin(w * math.sqrt(1.0 - damping_ratio**2) * lag_s)).sum(axis=1)
        worst = max(worst, float(np.hypot(cosine, sine).max()))
    return worst


@pytest.mark.parametrize("family", [name for name in FAMILIES if name != "oatf"])
@pytest.mark.parametrize("damping_ratio", [0.0, 0.05, 0.1, 0.2])
@pytest.mark.parametrize("tolerance", [0.02, 0.05, 0.1])
def test_every_family_keeps_its_promise_on_ticks(family: str, damping_ratio: float, tolerance: float) -> None:
    seed = [len(family), *map(ord, family), round(1000 * damping_ratio), round(1000 * tolerance)]
    awkward = np.exp(np.random.default_rng(seed).uniform(math.log(9.0), math.log(600.0), 2))
    shaper = design_shaper(
        family, Mode(1.0, damping_ratio), tolerance=tolerance, order=4 if family == "zvm" else None
    )
    for ticks_per_period in (*awkward, float(round(awkward[0]))):
        tick_s = float(1.0 / ticks_per_period)
        taps = solve_on_grid(shaper, tick_s)
        assert taps.delays_ticks[-1] <= math.ceil(shaper.duration_s / tick_s - 1e-6) + EXTRA_TICKS
        worst = _independent_ratio(taps.delays_ticks * tick_s, taps.amplitudes, shaper)
        assert worst <= tolerance * (1.0 + 1e-7)  # the slack of 2e-9, to the least tolerance
        levels = np.cumsum(np.rint(taps.amplitudes * 1e12))
        assert levels.min() >= 0
        assert levels.max() <= 10**12
        assert FAMILIES[family].negative or taps.amplitudes.min() > 0.0
