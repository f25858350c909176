"""Ends of the travel: stop switches, slow-down switches and distances, on every law, in every number type."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from swayless.controller import CommandShaper, Status
from tests.properties.strategies import NUMBERS, examples
from tests.unit.controller.blocks import ZVD, block, command_of, fork, run
from tests.unit.controller.operator_blocks import (
    KINDS,
    STEP_SIZES_M,
    hands_off,
    metres,
    operated,
    operator_block,
    to_rest,
    travelled_m,
)

POSITIVE = ("zvd", "phase", "modified", "original")
MARGIN_M = 0.2
WAYS = {"limit_margin_m": MARGIN_M}

ROUNDING_M = {"double": 1e-9, "float": 2e-4, "int32": 2e-3}
"""Of ways of up to 20 m: a thousand sums rounded by 2**-53 or 2**-24 of them; in int32 ways are whole mm."""


class Track:
    """A crane that follows its reference exactly, and the distances that it measures."""

    def __init__(self, settings, forward_m, reverse_m):
        self.settings, self.shaper = settings, CommandShaper(settings)
        self.forward_m, self.reverse_m, self.place_m = forward_m, reverse_m, 0.0

    def tick(self, inputs, noise_m=0.0):
        """Run one tick at the present distances."""
        settings = self.settings
        ways = (self.forward_m - self.place_m + noise_m, self.reverse_m + self.place_m + noise_m)
        forward, reverse = (metres(settings, max(way, 0.0)) for way in ways)
        out = self.shaper.step(inputs._replace(distance_forward=forward, distance_reverse=reverse))
        self.place_m += float(out.reference) * settings.tick_s / settings.limits.units_per_m_s
        return out

    def run(self, inputs, ticks):
        """Outputs of so many ticks."""
        return [self.tick(inputs) for _ in range(ticks)]


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("sign", [1, -1])
def test_full_speed_towards_an_end_comes_to_rest_before_the_margin(kind, number, sign):
    settings = operator_block(kind, number, **WAYS)
    track = Track(settings, 4.0, 4.0)
    outs = track.run(hands_off(settings, command=command_of(settings, 1.0 * sign)), 700)
    assert outs[-1].reference == 0
    assert any(out.status & Status.WAY_LIMITS for out in outs)
    assert not any(out.status & Status.WAY_TOO_SHORT for out in outs)
    left_m = 4.0 - MARGIN_M - sign * track.place_m
    assert left_m >= -ROUNDING_M[number]
    if kind in POSITIVE:  # arrives: what deceleration leaves over is travelled too
        assert left_m <= ROUNDING_M[number] + (0.002 if number == "int32" else 0.0)


@examples(30)
@given(st.data())
def test_no_command_passes_an_end_and_the_way_back_is_open(data):
    kind, number = data.draw(st.sampled_from(KINDS)), data.draw(st.sampled_from(NUMBERS))
    ramps = {
        "acceleration_m_s2": data.draw(st.sampled_from([0.3, 1.0, 8.0])),
        "deceleration_m_s2": data.draw(st.sampled_from([0.25, 2.0])),
    }
    settings = operator_block(kind, number, ramps, **WAYS)
    track = Track(settings, data.draw(st.floats(0.1, 3.0)), data.draw(st.floats(0.1, 3.0)))
    far_m = (
        track.forward_m - min(MARGIN_M, track.forward_m),
        track.reverse_m - min(MARGIN_M, track.reverse_m),
    )
    for _ in range(data.draw(st.integers(2, 6))):
        command = command_of(settings, data.draw(st.sampled_from([1.0, -1.0, 0.3, -0.6, 0.0])))
        for out in track.run(hands_off(settings, command=command), data.draw(st.integers(1, 150))):
            assert not out.status & Status.WAY_TOO_SHORT
        assert -far_m[1] - ROUNDING_M[number] <= track.place_m <= far_m[0] + ROUNDING_M[number]
    before_m = track.place_m
    ahead_m, behind_m = far_m[0] - before_m, far_m[1] + before_m
    track.run(hands_off(settings), 300)
    track.run(hands_off(settings, command=command_of(settings, 1.0 if ahead_m > behind_m else -1.0)), 600)
    if max(ahead_m, behind_m) > 0.2:
        assert abs(track.place_m - before_m) > 0.5 * max(ahead_m, behind_m)


@examples(15)
@given(st.data())
def test_stop_distance_holds_while_the_way_limits(data):
    kind, number = data.draw(st.sampled_from(KINDS)), data.draw(st.sampled_from(NUMBERS))
    settings = operator_block(kind, number, **WAYS)
    track = Track(settings, data.draw(st.floats(0.5, 4.0)), 2.0)
    pushed = hands_off(settings, command=command_of(settings, data.draw(st.sampled_from([1.0, 0.5]))))
    for tick in range(150):
        out = track.tick(pushed)
        if tick % 10 == 0:
            far = hands_off(settings)
            follow_m = travelled_m(settings, to_rest(fork(track.shaper), far))
            foretold_m = out.stop_distance / (1000 if settings.number.is_integer else 1)
            assert abs(follow_m - foretold_m) <= ROUNDING_M[number]


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("kind", KINDS)
def test_steps_beyond_an_end_are_cut_off_there(kind, number):
    settings = operator_block(kind, number, step_sizes_m=STEP_SIZES_M, **WAYS)
    track = Track(settings, 1.7, 1.0)
    press = hands_off(settings, step_forward=True, step_size=3)
    outs = [track.tick(now) for now in [hands_off(settings), *[press, hands_off(settings)] * 4]]
    outs += track.run(hands_off(settings), 900)
    assert not outs[-1].status & Status.STEPPING
    assert outs[-1].stop_distance == 0
    assert track.place_m == pytest.approx(1.7 - MARGIN_M, abs=0.003)
    assert any(out.status & Status.WAY_LIMITS for out in outs)


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("kind", POSITIVE)
def test_without_valid_distances_the_last_ones_less_the_way_since_hold(kind, number):
    settings = operator_block(kind, number, **WAYS)
    track = Track(settings, 3.0, 3.0)
    pushed = hands_off(settings, command=command_of(settings, 1.0))
    track.run(pushed, 20)
    bad = settings.number.is_integer
    for _ in range(700):
        lost = {"distance_valid": False} if bad else {"distance_forward": settings.number.scalar(math.nan)}
        out = track.shaper.step(pushed._replace(**lost, distance_reverse=metres(settings, 3.0)))
        track.place_m += float(out.reference) * settings.tick_s / settings.limits.units_per_m_s
        assert out.status & Status.DISTANCE_INVALID
        assert out.error
    assert out.reference == 0
    assert track.place_m == pytest.approx(3.0 - MARGIN_M, abs=ROUNDING_M[number] + 1e-3)


@pytest.mark.parametrize("number", NUMBERS)
def test_before_the_first_valid_distance_nothing_moves(number):
    settings = operator_block("zvd", number, **WAYS)
    pushed = hands_off(settings, command=command_of(settings, 1.0), distance_valid=False)
    assert all(out.reference == 0 for out in run(CommandShaper(settings), [pushed] * 30))


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("kind", KINDS)
def test_a_way_that_jumps_too_short_is_said_and_the_ramp_does_what_it_can(kind, number):
    settings = operator_block(kind, number, **WAYS)
    track = Track(settings, 100.0, 100.0)
    pushed = hands_off(settings, command=command_of(settings, 1.0))
    track.run(pushed, 200)
    released = fork(track.shaper)
    track.forward_m = track.place_m + 0.3
    outs = track.run(pushed, 250)
    assert outs[0].status & Status.WAY_TOO_SHORT
    assert outs[0].error
    expected = run(released, [hands_off(settings)] * 250)
    assert [out.reference for out in outs] == [out.reference for out in expected]


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("kind", POSITIVE)
def test_a_noisy_distance_changes_no_ramp_and_costs_no_more_than_its_noise(kind, number):
    settings = operator_block(kind, number, **WAYS)
    random, track = np.random.default_rng(3), Track(settings, 4.0, 4.0)
    pushed = hands_off(settings, command=command_of(settings, 1.0))
    references = [track.tick(pushed, random.uniform(-0.01, 0.01)).reference for _ in range(700)]
    largest = max(float(settings.limits.acceleration_step), float(settings.limits.deceleration_step))
    slack = 1 if number == "int32" else 1e-5 * largest
    assert max(abs(np.diff(np.array(references, dtype=float)))) <= largest + slack
    assert track.place_m == pytest.approx(4.0 - MARGIN_M, abs=0.013)


@examples(40)
@given(st.data())
def test_nothing_moves_towards_a_made_stop_switch_but_a_quick_stop(data):
    kind, number = data.draw(st.sampled_from(KINDS)), data.draw(st.sampled_from(NUMBERS))
    settings = operator_block(kind, number, stop_switches=True)
    shaper, before = CommandShaper(settings), settings.number.scalar(0)
    for _ in range(data.draw(st.integers(3, 12))):
        made = data.draw(st.sampled_from([{}, {}, {"stop_forward": True}, {"stop_reverse": True}]))
        command = command_of(settings, data.draw(st.sampled_from([1.0, -1.0, 0.4, 0.0, 0.0])))
        for _ in range(data.draw(st.integers(1, 60))):
            out = shaper.step(hands_off(settings, command=command, **made))
            for button, sign in (("stop_forward", 1), ("stop_reverse", -1)):
                if button in made and out.reference * sign > 0:
                    assert out.status & Status.QUICK_STOP
                    # Exact: quick-stop ramps lose no bit.
                    assert out.reference * sign == before * sign - settings.limits.quick_stop_step
            assert bool(out.status & Status.STOP_SWITCH) == bool(made)
            before = out.reference


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("kind", KINDS)
def test_the_way_back_from_a_made_stop_switch_is_open_and_shaped(kind, number):
    settings = operator_block(kind, number, stop_switches=True)
    shaper = CommandShaper(settings)
    full = command_of(settings, 1.0)
    run(shaper, [hands_off(settings, command=full)] * 100)
    held = run(shaper, [hands_off(settings, command=full, stop_forward=True)] * 50)
    assert held[-1].reference == 0
    assert held[-1].status & Status.QUICK_STOP, "latched until the command has been 0"
    run(shaper, [hands_off(settings, stop_forward=True)] * 2)
    back = run(shaper, [hands_off(settings, command=command_of(settings, -1.0), stop_forward=True)] * 250)
    assert back[-1].reference == -full
    assert back[10].active


@pytest.mark.parametrize("number", NUMBERS)
def test_a_switch_that_opens_under_a_held_button_starts_nothing(number):
    settings = operator_block("zvd", number, stop_switches=True)
    shaper = CommandShaper(settings)
    held = hands_off(settings, command=command_of(settings, 1.0))
    outs = run(shaper, [held._replace(stop_forward=True)] * 5 + [held] * 30)
    assert all(out.reference == 0 for out in outs)
    assert outs[-1].status & Status.COMMAND_LOCKED
    run(shaper, [hands_off(settings)])
    assert run(shaper, [held] * 30)[-1].reference == command_of(settings, 1.0)


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("kind", KINDS)
def test_a_slow_switch_limits_the_command_towards_it_by_the_ramp_and_no_other(kind, number):
    settings = operator_block(kind, number, slow_speed_m_s=0.1, step_sizes_m=STEP_SIZES_M)
    shaper = CommandShaper(settings)
    slow = settings.operator.slow_command
    full = hands_off(settings, command=command_of(settings, 1.0))
    assert run(shaper, [full] * 200)[-1].reference == settings.limits.max_command
    slowed = run(shaper, [full._replace(slow_forward=True)] * 250)
    assert slowed[-1].reference == slow
    assert slowed[-1].status & Status.SLOW_SWITCH
    assert min(out.reference for out in slowed) == slow
    other = run(shaper, [full._replace(slow_reverse=True)] * 250)
    assert other[-1].reference == settings.limits.max_command
    assert not other[-1].status & Status.SLOW_SWITCH
    run(shaper, [hands_off(settings)] * 300)
    press = hands_off(settings, step_forward=True, step_size=3, slow_forward=True)
    steps = [shaper.step(press), *to_rest(shaper, hands_off(settings, slow_forward=True))]
    assert max(out.reference for out in steps) <= slow


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("kind", POSITIVE)
def test_a_reversal_that_is_pending_does_not_turn_towards_a_switch_made_meanwhile(kind, number):
    settings = operator_block(kind, number, {"acceleration_m_s2": 5.0}, stop_switches=True)
    ahead, back = (hands_off(settings, command=command_of(settings, sign)) for sign in (1.0, -1.0))
    made = ahead._replace(stop_forward=True)
    turned = 0
    for ticks in (*range(1, 9), *range(9, 100, 9)):
        shaper = CommandShaper(settings)
        run(shaper, [back] * 150)
        last = run(shaper, [ahead] * ticks)[-1].reference
        if last >= 0:
            break
        outs = run(shaper, [made] * 250)
        references = [last] + [out.reference for out in outs]
        assert max(references) == 0
        assert references[-1] == 0
        steps = np.diff(np.array(references, dtype=float))
        largest = max(float(settings.limits.acceleration_step), float(settings.limits.deceleration_step))
        assert max(abs(steps)) <= largest + (1 if number == "int32" else 1e-5 * largest)
        turned += any(out.status & Status.QUICK_STOP for out in outs)
        assert all(out.reference == 0 for out in run(shaper, [hands_off(settings)] * 100))
    assert turned, "nothing was pending towards the switch"


@pytest.mark.parametrize("number", NUMBERS)
def test_what_is_pending_at_a_reference_of_0_is_dropped_at_once_and_not_foretold(number):
    unramped = {"acceleration_m_s2": None, "deceleration_m_s2": None, "quick_stop_m_s2": None}
    settings = operated(block(((0, 0.5), (8, 0.5)), number=number, **unramped), stop_switches=True)
    shaper = CommandShaper(settings)
    outs = run(shaper, [hands_off(settings, command=settings.limits.max_command), hands_off(settings)])
    assert outs[1].reference == 0
    assert outs[1].stop_distance > 0
    made = shaper.step(hands_off(settings, stop_forward=True))
    assert made.status & Status.QUICK_STOP
    assert made.stop_distance == 0


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("kind", KINDS)
def test_steps_whose_way_jumps_too_short_end_where_the_ramp_does_and_do_not_return(kind, number):
    settings = operator_block(kind, number, step_sizes_m=(1.0, 2.0, 10.0), **WAYS)
    track = Track(settings, 100.0, 100.0)
    track.run(hands_off(settings), 1)
    track.run(hands_off(settings, step_forward=True, step_size=3), 120)
    track.forward_m = track.place_m + 0.3
    outs = track.run(hands_off(settings), 600)
    assert any(out.status & Status.WAY_TOO_SHORT for out in outs)
    assert all(out.reference >= 0 for out in outs)
    assert not outs[-1].status & Status.STEPPING
    assert outs[-1].stop_distance == 0


LONG = ((0, 0.25), (8, 0.5), (16, 0.25))
"""The last tick in which full speed fits comes 8 ticks before that of row 0, and 4 before that of row 1."""


def two_rows(number, **options):
    """A block with a short row and one whose stop takes longer."""
    return operated(block(ZVD, LONG, number=number, acceleration_m_s2=0.4), **options)


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("before", ["row 0", "row 1", "disabled"])
def test_a_row_whose_stop_is_longer_takes_over_only_where_it_keeps_within_the_way(number, before):
    settings = two_rows(number, **WAYS)
    full = hands_off(settings, command=command_of(settings, 1.0), selector=2)
    first = {
        "row 0": full._replace(selector=0),
        "row 1": full._replace(selector=1),
        "disabled": full._replace(enable=False),
    }[before]
    waited = passed = 0
    for turn in range(130, 156, 2):
        track = Track(settings, 4.0, 4.0)
        outs = track.run(first, turn) + track.run(full, 120)
        assert abs(float(outs[-1].reference)) <= 1e-12  # the last bits of the way that this track measures
        assert track.place_m <= 4.0 - MARGIN_M + ROUNDING_M[number]
        assert not any(out.status & Status.WAY_TOO_SHORT for out in outs)
        moving = [out for out in outs[turn:] if out.settled and out.reference != 0]
        waited += any(out.status & Status.ROW_WAITS for out in moving[1:])
        passed += any(out.row == 2 for out in moving)
    assert waited
    assert passed


@pytest.mark.parametrize("number", NUMBERS)
def test_the_stop_distance_holds_while_a_row_waits_for_room(number):
    settings = two_rows(number, **WAYS)
    full = hands_off(settings, command=command_of(settings, 1.0), selector=2)
    for turn in range(132, 156, 3):
        track = Track(settings, 4.0, 4.0)
        track.run(full._replace(selector=0), turn)
        for _ in range(4):
            out = track.tick(full)
            twin = Track(settings, track.forward_m, track.reverse_m)
            twin.shaper, twin.place_m = fork(track.shaper), track.place_m
            rest = twin.run(full._replace(command=settings.number.scalar(0)), 120)
            foretold_m = float(out.stop_distance) / (1000 if settings.number.is_integer else 1)
            assert foretold_m == pytest.approx(travelled_m(settings, rest), abs=ROUNDING_M[number])
