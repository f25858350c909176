"""Faults at the operator's side of the block: each by itself, on every law and in every number type.

What holds in all of them: speed and acceleration keep their limits, nothing starts by itself, nothing jumps
but where an emergency stop does, and what can arrive arrives.
"""

import math
from itertools import pairwise

import numpy as np
import pytest

from swayless.controller import CommandShaper, Status
from tests.properties.strategies import NUMBERS
from tests.unit.controller.blocks import ZVD, block, command_of, run
from tests.unit.controller.operator_blocks import (
    KINDS,
    STEP_SIZES_M,
    block_of,
    hands_off,
    metres,
    operated,
    operator_block,
    to_rest,
    travelled_m,
)

POSITIVE = ("zvd", "phase", "modified", "original")
ROPED = ("phase", "modified", "original")
EVERYTHING = {"step_sizes_m": STEP_SIZES_M, "stop_switches": True, "drive_feedback": True}

every_block = pytest.mark.parametrize("number", NUMBERS)
every_kind = pytest.mark.parametrize("kind", KINDS)


def largest_change(settings, ramp=None):
    """Largest change of the reference in a tick: a step of the ramp, and what rounding to a count adds."""
    limits = settings.limits
    step = (
        max(float(limits.acceleration_step), float(limits.deceleration_step)) if ramp is None else float(ramp)
    )
    return step + (1.0 if settings.number.is_integer else 1e-5 * step)


def assert_limits(settings, outs, before=0.0, ramp=None):
    """No reference beyond the maximum, and no change faster than the ramp."""
    references = [float(before)] + [float(out.reference) for out in outs]
    assert max(map(abs, references)) <= settings.limits.max_command
    assert max(abs(b - a) for a, b in pairwise(references)) <= largest_change(settings, ramp)


def moving(settings, shaper, ticks=60):
    """Full speed forward for so many ticks; returns the last reference."""
    return run(shaper, [hands_off(settings, command=settings.limits.max_command)] * ticks)[-1].reference


@every_block
@every_kind
def test_emergency_stop_in_the_middle_of_a_move_drops_everything_and_restarts_nothing(kind, number):
    settings = operator_block(kind, number, **EVERYTHING)
    for start in ({"command": settings.limits.max_command}, {"step_forward": True, "step_size": 3}):
        shaper = CommandShaper(settings)
        run(shaper, [hands_off(settings)])
        run(shaper, [hands_off(settings, **start)] * 25)
        stopped = shaper.step(hands_off(settings, emergency_stop=True, **start))
        assert (stopped.reference, stopped.stop_distance, stopped.stop_time_ticks) == (0, 0, 0)
        held = run(shaper, [hands_off(settings, **start)] * 100)
        assert all(out.reference == 0 for out in held), "it restarts under a held button"
        released = run(shaper, [hands_off(settings)] * 100)
        assert all(out.reference == 0 for out in released)
        assert not released[-1].status & (Status.EMERGENCY_STOP | Status.STEPPING)


@every_block
@pytest.mark.parametrize("kind", ROPED)
def test_an_encoder_that_dies_holds_its_last_length_and_the_crane_stops_as_shaped(kind, number):
    settings = operator_block(kind, number, **EVERYTHING)
    dead = {"rope_length_valid": False, "rope_length": settings.number.scalar(0)}
    healthy, faulty = CommandShaper(settings), CommandShaper(settings)
    moving(settings, healthy, 30)
    moving(settings, faulty, 30)
    expected = run(healthy, [hands_off(settings)] * 250)
    outs = run(faulty, [hands_off(settings, **dead)] * 250)
    assert [out.reference for out in outs] == [out.reference for out in expected]
    assert all(out.error and out.status & Status.ROPE_INVALID for out in outs)


@every_block
def test_a_knob_that_turns_every_tick_changes_no_row_before_rest_and_breaks_no_limit(number):
    settings = operated(block(ZVD, ((0, 0.5), (5, 0.5)), number=number), step_sizes_m=STEP_SIZES_M)
    shaper, full = CommandShaper(settings), settings.limits.max_command
    commands = [full] * 40 + [0] * 40 + [-full] * 40 + [0] * 60
    scalar = settings.number.scalar
    inputs = [hands_off(settings, command=scalar(c), selector=k % 4) for k, c in enumerate(commands)]
    outs = run(shaper, inputs)
    assert_limits(settings, outs)
    for before, out in pairwise(outs):
        assert out.row == before.row or before.settled
    assert outs[-1].reference == 0


@every_block
@every_kind
def test_a_limit_that_is_hit_while_motion_is_pending_is_not_passed(kind, number):
    settings = operator_block(kind, number, {"quick_stop_m_s2": 5.0}, stop_switches=True)
    quick = settings.limits.quick_stop_step
    for ticks in range(1, 30, 2):
        shaper = CommandShaper(settings)
        moving(settings, shaper, ticks)
        released = run(shaper, [hands_off(settings)] * 6)
        before = released[-1].reference
        outs = run(shaper, [hands_off(settings, stop_forward=True)] * 150)
        expected = [max(before - k * quick, 0) for k in range(1, 151)]
        assert [out.reference for out in outs] == expected
        after = run(shaper, [hands_off(settings)] * 150)
        assert all(out.reference == 0 for out in after), "pending motion survived the switch"


@every_block
@every_kind
def test_a_drive_that_trips_and_comes_back_at_speed_is_brought_to_rest_without_a_jump(kind, number):
    settings = operator_block(kind, number, **EVERYTHING)
    shaper, full = CommandShaper(settings), settings.limits.max_command
    held = hands_off(settings, command=full)
    run(shaper, [hands_off(settings)])
    moving(settings, shaper)
    tripped = run(shaper, [held._replace(drive_ready=False)] * 20)
    assert all(out.reference == 0 and out.stop_distance == 0 for out in tripped)
    assert all(out.status & Status.DRIVE_NOT_READY and not out.active for out in tripped)
    speed = command_of(settings, 0.6)
    back = [shaper.step(held._replace(actual_speed=speed)), *run(shaper, [held] * 100)]
    assert_limits(settings, back, before=speed, ramp=settings.limits.quick_stop_step)
    assert back[0].reference > 0
    assert back[-1].reference == 0
    assert back[-1].status & Status.QUICK_STOP, "commands count after a 0 only"
    run(shaper, [hands_off(settings)] * 2)
    again = run(shaper, [held] * 250)
    assert again[-1].reference == full


@every_block
@pytest.mark.parametrize("speed", [math.nan, math.inf, 1e30])
def test_a_speed_that_the_drive_cannot_have_is_clamped_or_counts_as_0(number, speed):
    settings = operator_block("zvd", number, drive_feedback=True)
    largest = 2**31 - 1 if number == "int32" else settings.number.scalar(speed)
    out = CommandShaper(settings).step(hands_off(settings, actual_speed=largest))
    limits = settings.limits
    starts = number == "int32" or speed == 1e30
    assert out.reference == (limits.max_command - limits.quick_stop_step if starts else 0)


@every_block
@every_kind
def test_a_warm_restart_with_stale_state_is_a_cold_start_after_init(kind, number):
    settings = operator_block(kind, number, start_from_zero=True, **EVERYTHING)
    stale, new = CommandShaper(settings), CommandShaper(settings)
    run(stale, [hands_off(settings)])
    run(stale, [hands_off(settings, step_forward=True, step_size=3)] * 20)
    stale.init()
    history = [
        *[hands_off(settings, command=settings.limits.max_command)] * 30,
        *[hands_off(settings)] * 5,
        *[hands_off(settings, step_reverse=True, step_size=2)] * 60,
        *[hands_off(settings, command=command_of(settings, -0.5))] * 30,
    ]
    assert run(stale, history) == run(new, history)


@every_block
@every_kind
def test_missed_calls_stretch_a_move_and_lose_nothing_of_it(kind, number):
    settings = operator_block(kind, number, step_sizes_m=STEP_SIZES_M)
    shaper, random = CommandShaper(settings), np.random.default_rng(2)
    run(shaper, [hands_off(settings)])
    outs, stretched_m = [shaper.step(hands_off(settings, step_forward=True, step_size=2))], 0.0
    while outs[-1].stop_time_ticks:
        missed = int(random.integers(0, 3))  # the drive holds the last reference for as long
        stretched_m += travelled_m(settings, outs[-1:] * missed)
        outs.append(shaper.step(hands_off(settings)))
    asked_m = float(settings.operator.steps.sizes[1]) * settings.tick_s / settings.limits.units_per_m_s
    assert travelled_m(settings, outs) == pytest.approx(asked_m, rel=2e-5)
    assert 0.0 < stretched_m < 2.0 * asked_m
    assert outs[-1].settled


@every_block
@every_kind
def test_noise_and_flutter_of_the_command_keep_every_limit_and_end_at_rest(kind, number):
    settings = operated(
        block_of(kind, number, command_resolution_m_s=0.02), stop_switches=True, start_from_zero=True
    )
    random, shaper, scalar = np.random.default_rng(4), CommandShaper(settings), settings.number.scalar
    full = float(settings.limits.max_command)
    noise = np.clip(0.5 + random.normal(0.0, 0.01, 200), -1.0, 1.0)
    flutter = np.where(random.random(200) < 0.5, 1.0, 0.0)
    signs = np.where(random.random(200) < 0.5, 1.0, -1.0)
    whole = round if settings.number.is_integer else float
    commands = [scalar(whole(c * full)) for c in np.concatenate([[0.0], noise, flutter, signs])]
    outs = run(shaper, [hands_off(settings, command=command) for command in commands])
    if kind in POSITIVE:
        assert_limits(settings, outs)
    assert max(abs(out.reference) for out in outs) <= full
    last = run(shaper, [hands_off(settings)] * 400)[-1]
    assert (last.reference, last.stop_distance, last.stop_time_ticks) == (0, 0, 0)
    assert last.settled


@every_block
@every_kind
def test_both_step_buttons_at_once_count_as_none(kind, number):
    settings = operator_block(kind, number, step_sizes_m=STEP_SIZES_M)
    shaper = CommandShaper(settings)
    run(shaper, [hands_off(settings)])
    both = run(shaper, [hands_off(settings, step_forward=True, step_reverse=True)] * 30)
    assert all(out.reference == 0 and out.status & Status.STEP_REFUSED for out in both)
    assert not run(shaper, [hands_off(settings)])[-1].status & Status.STEP_REFUSED
    outs = run(shaper, [hands_off(settings, step_forward=True)] * 2)
    outs += run(shaper, [hands_off(settings, step_forward=True, step_reverse=True)])
    assert outs[-1].status & Status.STEPPING, "the second button takes its own step away, and no more"
    outs += to_rest(shaper, hands_off(settings))
    assert abs(travelled_m(settings, outs)) <= 2e-5


@every_block
@every_kind
@pytest.mark.parametrize("held", ["command", "step_forward", "step_reverse", "both"])
def test_power_on_with_a_button_held_moves_nothing_until_it_was_released(kind, held, number):
    settings = operator_block(kind, number, start_from_zero=True, **EVERYTHING)
    full = settings.limits.max_command
    fields = {"command": full} if held == "command" else {held: True}
    if held == "both":
        fields = {"command": full, "step_forward": True}
    shaper = CommandShaper(settings)
    assert all(out.reference == 0 for out in run(shaper, [hands_off(settings, **fields)] * 50))
    run(shaper, [hands_off(settings)])
    pressed = run(shaper, [hands_off(settings, **{**fields, "step_forward": held == "step_forward"})] * 40)
    assert any(out.reference != 0 for out in pressed)


@every_block
def test_an_end_that_is_lost_on_the_way_is_kept_by_dead_reckoning(number):
    settings = operator_block("zvd", number, limit_margin_m=0.0)
    shaper, place_m, end_m = CommandShaper(settings), 0.0, 3.0
    for tick in range(400):
        left = metres(settings, end_m - place_m) if tick < 10 else settings.number.scalar(0)
        ways = {"distance_forward": left, "distance_valid": tick < 10}
        out = shaper.step(hands_off(settings, command=settings.limits.max_command, **ways))
        place_m += travelled_m(settings, [out])
    assert place_m == pytest.approx(end_m, abs=2e-3)
    assert to_rest(shaper, hands_off(settings))[-1].reference == 0
