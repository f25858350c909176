"""Magee and Book, position dependent parameters: the impulses of figs 10 to 14, one by one.

An impulse is {a, b}: tap b = 1 to N of the input sample at tick a. The spacing changes at tick 0.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from swayless.controller.spacing_laws import spaced_filter
from tests.properties.strategies import examples
from tests.unit.controller.spaced_blocks import position_of, spaced_block

BEFORE, AFTER = 30, 30
"""Ticks before and after the change; the longest delay is 15."""

FOUR = (1 / 16, 2 / 16, 4 / 16, 9 / 16)
"""Amplitudes of four taps: every sum of some of them is another."""

EXTRA = {4: {(0, 2)}, 8: {(0, 3)}, 9: {(1, 3)}, 12: {(0, 4)}, 13: {(1, 4)}, 14: {(2, 4)}}
"""Darkened in fig 13, without tails in fig 14: added when the spacing grows, left out when it shrinks."""


def references(law, amplitudes, spacings, commands):
    """References of a filter that runs from rest at 0, ticks from -BEFORE on."""
    settings = spaced_block("double", law, amplitudes=amplitudes, ticks=sorted(set(spacings)))
    shape = spaced_filter(settings)
    out = []
    for spacing, command in zip(spacings, commands, strict=True):
        shape.turn(position_of(settings, spacing), 0.0)
        out.append(shape.run(float(command), 1))
    return np.array(out)


def impulses(law, spacings, amplitudes=FOUR):
    """The {a, b} of each tick: samples are sent one at a time, and taps known by their amplitudes."""
    found = {n: set() for n in range(AFTER)}
    # The largest command, 0.5, keeps every sum below the maximum.
    for a in range(-BEFORE, AFTER):
        commands = np.zeros(BEFORE + AFTER)
        commands[a + BEFORE] = 0.5
        parts = references(law, amplitudes, spacings, commands)[BEFORE:] / 0.5
        for n, part in enumerate(parts):
            whole = round(16 * part)
            assert whole == 16 * part
            for tap in (4, 3, 2, 1):
                if whole >= 16 * amplitudes[tap - 1]:
                    whole -= round(16 * amplitudes[tap - 1])
                    found[n].add((a, tap))
            assert whole == 0
    return found


def changing(old, new):
    return [old] * BEFORE + [new] * AFTER


def by_spacing(spacing):
    """Impulses of a spacing that never changes."""
    return {n: {(n - (b - 1) * spacing, b) for b in (1, 2, 3, 4)} for n in range(AFTER)}


def scattered(old, new):
    """Impulses of samples before tick 0 by the old spacing, from there on by the new one."""
    found = {n: set() for n in range(AFTER)}
    for a in range(-BEFORE, AFTER):
        for b in (1, 2, 3, 4):
            n = a + (b - 1) * (old if a < 0 else new)
            if 0 <= n < AFTER:
                found[n].add((a, b))
    return found


@pytest.mark.parametrize("law", ["original", "modified"])
def test_fig_10_four_impulses_every_tick_at_a_constant_period_of_four(law):
    assert impulses(law, changing(4, 4)) == by_spacing(4)
    assert by_spacing(4)[0] == {(0, 1), (-4, 2), (-8, 3), (-12, 4)}


def test_fig_11_six_gaps_when_the_period_grows_from_four_to_five():
    found = impulses("original", changing(4, 5))
    assert found == scattered(4, 5)
    assert found[4] == {(4, 1), (-4, 3), (-8, 4)}
    assert {n: len(each) for n, each in found.items() if len(each) != 4} == dict.fromkeys(EXTRA, 3)


def test_fig_12_six_surplus_impulses_when_the_period_shrinks_from_five_to_four():
    found = impulses("original", changing(5, 4))
    assert found == scattered(5, 4)
    assert found[4] == {(4, 1), (-1, 2), (0, 2), (-6, 3), (-11, 4)}
    assert {n: len(each) for n, each in found.items() if len(each) != 4} == dict.fromkeys(EXTRA, 5)


def test_fig_13_the_gaps_are_filled_by_the_old_period_of_the_samples_after_the_change():
    expected = scattered(4, 5)
    for n, extra in EXTRA.items():
        expected[n] |= extra
    assert impulses("modified", changing(4, 5)) == expected
    assert all(len(each) == 4 for each in expected.values())


def test_fig_14_the_same_impulses_are_left_out_when_the_period_shrinks():
    expected = scattered(5, 4)
    for n, left_out in EXTRA.items():
        assert left_out < expected[n]
        expected[n] -= left_out
    assert impulses("modified", changing(5, 4)) == expected


@pytest.mark.parametrize(("old", "new"), [(4, 7), (7, 3)])
def test_a_change_by_several_ticks_leaves_no_gap_and_no_surplus_either(old, new):
    found = impulses("modified", changing(old, new))
    assert all(sorted(b for _, b in each) == [1, 2, 3, 4] for each in found.values())
    assert {n: found[n] for n in range(3 * max(old, new), AFTER)} == {
        n: each for n, each in by_spacing(new).items() if n >= 3 * max(old, new)
    }


@pytest.mark.parametrize(("old", "new"), [(4, 5), (5, 4)])
@pytest.mark.parametrize("ticks", [1, 2, 3])
def test_a_period_that_changes_back_is_followed_by_the_taps_for_which_it_lasts(old, new, ticks):
    found = impulses("modified", [old] * BEFORE + [new] * ticks + [old] * (AFTER - ticks))
    assert all(sorted(b for _, b in each) == [1, 2, 3, 4] for each in found.values())
    steady = by_spacing(old)
    for b in (1, 2, 3, 4):
        follows = any((n, each) for n in found for each in found[n] ^ steady[n] if each[1] == b)
        # Tap b needs a change that lasts longer than the b - 1 ticks by which it moves.
        assert follows == (1 <= b - 1 < ticks)


def as_written_in_the_paper(old, new, amplitudes, samples):
    """Shape samples as the text says: N - (n + 1) more by the old period, or n + 1 only by the new one."""
    count = len(amplitudes)
    output = np.zeros(samples.size + (count - 1) * max(old, new))
    for index, sample in enumerate(samples):
        n = index - BEFORE
        changes = 0 <= n <= count - 2
        kept = n + 1 if changes and new < old else count
        for b in range(kept):
            output[index + b * (old if n < 0 else new)] += amplitudes[b] * sample
        for b in range(n + 1, count) if changes and new > old else ():
            output[index + b * old] += amplitudes[b] * sample
    return output[: samples.size]


@examples(40)
@given(st.data())
def test_the_text_of_the_method_and_the_law_agree_on_any_samples(data):
    weights = data.draw(st.lists(st.integers(1, 9), min_size=2, max_size=6))
    amplitudes = np.round(np.array(weights) / sum(weights) * 2**20) / 2**20
    amplitudes[0] += 1.0 - amplitudes.sum()
    old = data.draw(st.integers(2, 5))
    new = old + data.draw(st.sampled_from([-1, 1]))
    samples = np.random.default_rng(data.draw(st.integers(0, 99))).uniform(-0.5, 0.5, BEFORE + AFTER)
    expected = as_written_in_the_paper(old, new, amplitudes, samples)
    # Six products below 0.5, summed in another order.
    assert np.abs(references("modified", amplitudes, changing(old, new), samples) - expected).max() <= 1e-15
