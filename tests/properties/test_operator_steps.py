"""Step Mode (Kriikku, Singer and Singhose 1997, section V): what is pressed is what is travelled."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from swayless.controller import CommandShaper, Status
from swayless.plant import STANDARD_GRAVITY_M_S2
from tests.properties.strategies import NUMBERS, examples
from tests.unit.controller.blocks import fork, run
from tests.unit.controller.operator_blocks import (
    KINDS,
    ROPE_LENGTH_M,
    STEP_SIZES_M,
    hands_off,
    operator_block,
    to_rest,
    travelled_m,
)

REFUSED = Status.STEP_REFUSED | Status.STEP_SIZE_INVALID
WAITING = ("um-zv", "um-split")

RELATIVE = {"double": 1e-12, "float": 2e-5, "int32": 0.0}
"""Of all that was pressed. Each tick rounds what is left and the reference, by 2**-53 or 2**-24 of what was
pressed; half a thousand ticks of either sign add up to no more than this."""

DISTANCE_M = {"double": 1e-9, "float": 2e-4, "int32": 1.1e-3}
"""Of a foretold way of up to 16 m: the same rounding; in int32 the output is in whole mm."""


def step_block(kind, number, **limits):
    """A block that makes steps."""
    return operator_block(kind, number, limits, step_sizes_m=STEP_SIZES_M)


def presses(random, settings, ticks):
    """Random presses for so many ticks: buttons held for a while, three sizes, now and then a wrong one."""
    inputs = []
    while len(inputs) < ticks:
        forward, size = random.random() < 0.6, int(random.choice([1, 1, 2, 2, 3, 0, 4]))
        button = {"step_forward": forward, "step_reverse": not forward, "step_size": size}
        inputs += [hands_off(settings, **button)] * int(random.integers(1, 4))
        inputs += [hands_off(settings)] * int(random.choice([1, 2, 5, 20]))
    return inputs


def accepted(settings, inputs, outs):
    """Signed sum, and sum of sizes, of the presses that were not refused: exact."""
    held, net, gross = True, Fraction(0), Fraction(0)
    for now, out in zip(inputs, outs, strict=True):
        pressed = now.step_forward or now.step_reverse
        if pressed and not held and not out.status & REFUSED:
            size = Fraction(float(settings.operator.steps.sizes[now.step_size - 1]))
            net += size if now.step_forward else -size
            gross += size
        held = pressed
    return net, gross


def test_a_thousand_random_press_sequences_arrive_where_they_were_pressed():
    random = np.random.default_rng(5)
    blocks = {(kind, number): step_block(kind, number) for kind in KINDS for number in NUMBERS}
    for sequence in range(1000):
        kind, number = KINDS[sequence % len(KINDS)], NUMBERS[(sequence // len(KINDS)) % len(NUMBERS)]
        settings = blocks[kind, number]
        shaper = CommandShaper(settings)
        inputs = [hands_off(settings), *presses(random, settings, int(random.integers(5, 60)))]
        outs = run(shaper, inputs)
        net, gross = accepted(settings, inputs, outs)
        outs += to_rest(shaper, hands_off(settings))
        total = sum(Fraction(float(out.reference)) for out in outs)
        assert abs(total - net) <= RELATIVE[number] * gross, (kind, number, sequence)
        assert outs[-1].settled
        assert not outs[-1].status & Status.STEPPING


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("kind", KINDS)
def test_the_way_of_each_size_is_that_of_the_machine_file(kind, number):
    settings = step_block(kind, number)
    shaper = CommandShaper(settings)
    for size, asked_m in enumerate(STEP_SIZES_M, start=1):
        for sign, button in ((1, "step_forward"), (-1, "step_reverse")):
            outs = run(
                shaper, [hands_off(settings), hands_off(settings, **{button: True, "step_size": size})]
            )
            outs += to_rest(shaper, hands_off(settings))
            # A size is a whole number of counts times ticks: at most half of 8 counts of 1/20 mm times 50 ms.
            slack_m = 1e-5 if settings.number.is_integer else RELATIVE[number] * asked_m
            assert abs(travelled_m(settings, outs) - sign * asked_m) <= slack_m
            assert all(sign * out.reference >= 0 for out in outs)


@examples(25)
@given(st.data())
def test_stop_distance_is_the_sum_of_the_references_that_follow_at_every_tick_of_steps(data):
    kind, number = data.draw(st.sampled_from(KINDS)), data.draw(st.sampled_from(NUMBERS))
    settings = step_block(kind, number)
    random = np.random.default_rng(data.draw(st.integers(0, 1000)))
    shaper = CommandShaper(settings)
    run(shaper, [hands_off(settings)])
    for tick, now in enumerate(presses(random, settings, 40)):
        out = shaper.step(now)
        if tick % 3 == 0:
            follow_m = travelled_m(settings, to_rest(fork(shaper), hands_off(settings)))
            foretold_m = out.stop_distance / (1000 if settings.number.is_integer else 1)
            assert abs(follow_m - foretold_m) <= DISTANCE_M[number]


@examples(40)
@given(st.data())
def test_the_references_of_steps_keep_the_limits_of_speed_and_ramp(data):
    kind, number = data.draw(st.sampled_from(KINDS)), data.draw(st.sampled_from(NUMBERS))
    ramps = {
        "acceleration_m_s2": data.draw(st.sampled_from([None, 0.3, 1.0])),
        "deceleration_m_s2": data.draw(st.sampled_from([None, 0.25, 2.0])),
    }
    if kind == "phase":  # built with ramps only
        ramps = {name: value or 30.0 for name, value in ramps.items()}
    settings = step_block(kind, number, **ramps)
    limits = settings.limits
    random = np.random.default_rng(data.draw(st.integers(0, 1000)))
    shaper = CommandShaper(settings)
    outs = run(shaper, [hands_off(settings), *presses(random, settings, 60)])
    outs += to_rest(shaper, hands_off(settings))
    commands = [0.0] + [float(out.reference) for out in outs]
    assert max(map(abs, commands)) <= limits.max_command
    if kind not in WAITING:  # positive amplitudes: the reference changes no faster than the command
        fastest = max(float(limits.acceleration_step), float(limits.deceleration_step))
        slack = 1 if number == "int32" else fastest * 1e-5
        assert max(abs(b - a) for a, b in pairwise(commands)) <= fastest + slack


@pytest.mark.parametrize("number", NUMBERS)
def test_three_quick_presses_are_one_move_that_does_not_stop(number):
    settings = step_block("zvd", number)
    shaper = CommandShaper(settings)
    press, release = hands_off(settings, step_forward=True, step_size=2), hands_off(settings)
    outs = run(shaper, [release, *[press, release, release] * 3]) + to_rest(shaper, release)
    moving = [out.reference > 0 for out in outs]
    first, last = moving.index(True), len(moving) - moving[::-1].index(True)
    assert all(moving[first:last])
    assert travelled_m(settings, outs) == pytest.approx(3 * STEP_SIZES_M[1], rel=RELATIVE[number] + 1e-12)
    speeds = [out.reference for out in outs]
    peak = speeds.index(max(speeds))
    assert speeds[first:peak] == sorted(speeds[first:peak]), "it slowed down on the way"


@pytest.mark.parametrize("number", NUMBERS)
def test_a_press_against_the_motion_that_is_too_late_overshoots_and_returns(number):
    settings = step_block("zvd", number)
    shaper = CommandShaper(settings)
    release = hands_off(settings)
    ahead = hands_off(settings, step_forward=True, step_size=3)
    back = hands_off(settings, step_reverse=True, step_size=3)
    outs = run(shaper, [release, ahead] + [release] * 20 + [back]) + to_rest(shaper, release)
    assert min(out.reference for out in outs) < 0
    assert abs(travelled_m(settings, outs)) <= RELATIVE[number] * 2 * STEP_SIZES_M[2]


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("kind", WAITING)
def test_rows_that_wait_never_reverse_within_a_step_and_make_later_presses_one_by_one(kind, number):
    settings = step_block(kind, number)
    shaper = CommandShaper(settings)
    press, release = hands_off(settings, step_forward=True, step_size=2), hands_off(settings)
    outs = run(shaper, [release, press, release, press, release, release, press, release])
    outs += to_rest(shaper, release)
    speeds = [out.reference for out in outs]
    assert min(speeds) == 0
    assert travelled_m(settings, outs) == pytest.approx(3 * STEP_SIZES_M[1], abs=1e-4)
    rests = [k for k in range(3, len(speeds)) if speeds[k] > 0 and speeds[k - 1] == 0]
    assert len(rests) >= 1, "the presses on the way wait for the next move"


@pytest.mark.parametrize("number", NUMBERS)
def test_the_row_is_locked_while_steps_run_even_where_the_command_is_constant(number):
    settings = step_block("zvd", number)
    shaper = CommandShaper(settings)
    run(shaper, [hands_off(settings), hands_off(settings, step_forward=True, step_size=3)])
    outs = to_rest(shaper, hands_off(settings, selector=0))
    assert any(out.settled and out.reference > 0 for out in outs)
    assert all(out.row == 1 and out.status & Status.ROW_WAITS for out in outs[:-1])
    assert shaper.step(hands_off(settings, selector=0)).row == 0


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("kind", KINDS)
def test_a_command_while_steps_run_does_nothing_until_it_has_been_0(kind, number):
    settings = step_block(kind, number)
    limit = settings.limits.max_command
    quiet, pushed = CommandShaper(settings), CommandShaper(settings)
    start = [hands_off(settings), hands_off(settings, step_forward=True, step_size=2)]
    run(quiet, start)
    run(pushed, start)
    expected = to_rest(quiet, hands_off(settings))
    outs = run(pushed, [hands_off(settings, command=limit)] * len(expected))
    assert [out.reference for out in outs] == [out.reference for out in expected]
    assert all(out.status & Status.COMMAND_LOCKED for out in outs)
    assert pushed.step(hands_off(settings, command=limit)).reference == 0
    run(pushed, [hands_off(settings)])
    moved = run(pushed, [hands_off(settings, command=limit)] * 250)
    assert not moved[0].status & Status.COMMAND_LOCKED
    assert moved[-1].reference == limit


@pytest.mark.parametrize("number", NUMBERS)
def test_a_press_is_refused_while_a_command_moves_or_what_it_left_is_pending(number):
    settings = step_block("zvd", number)
    shaper = CommandShaper(settings)
    press = {"step_forward": True, "step_size": 1}
    run(shaper, [hands_off(settings, command=settings.limits.max_command)] * 5)
    moving = shaper.step(hands_off(settings, command=settings.limits.max_command, **press))
    assert moving.status & Status.STEP_REFUSED
    run(shaper, [hands_off(settings)] * 8)
    pending = shaper.step(hands_off(settings, **press))
    assert pending.status & Status.STEP_REFUSED
    assert not pending.status & Status.STEPPING
    shaper.step(hands_off(settings))
    to_rest(shaper, hands_off(settings))
    run(shaper, [hands_off(settings)] * 9)
    assert shaper.step(hands_off(settings, **press)).status & Status.STEPPING


@pytest.mark.parametrize("number", NUMBERS)
def test_a_full_buffer_refuses_the_next_press_and_keeps_what_it_has(number):
    settings = step_block("zvd", number)
    shaper = CommandShaper(settings)
    press, release = hands_off(settings, step_forward=True, step_size=3), hands_off(settings)
    outs = run(shaper, [release] + [press, release] * 20)
    refused = [bool(out.status & Status.STEP_REFUSED) for out in outs[1::2]]
    assert refused.index(True) == 16
    way_m = travelled_m(settings, outs + to_rest(shaper, release))
    count = refused.count(False)
    assert way_m == pytest.approx(count * STEP_SIZES_M[2], rel=2e-5 if number == "float" else 1e-12)


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("stop", ["quick_stop", "emergency_stop"])
@pytest.mark.parametrize("kind", KINDS)
def test_a_stop_cancels_the_steps_and_what_waits(kind, stop, number):
    settings = step_block(kind, number)
    shaper = CommandShaper(settings)
    press, release = hands_off(settings, step_forward=True, step_size=3), hands_off(settings)
    run(shaper, [release, press, release, press, release])
    stopped = run(shaper, [hands_off(settings, **{stop: True})] * 25)
    assert stopped[-1].reference == 0
    assert not stopped[0].status & Status.STEPPING
    assert shaper.step(hands_off(settings, step_forward=True, **{stop: True})).status & Status.STEP_REFUSED
    after = run(shaper, [release] * 60)
    assert all(out.reference == 0 and out.stop_distance == 0 for out in after)


@pytest.mark.parametrize("number", NUMBERS)
def test_minimum_resolution_and_inching_do_not_apply_to_steps(number):
    small = {"minimum_speed_m_s": 0.2, "command_resolution_m_s": 0.1, "inching_speed_m_s": 0.3}
    shaped = step_block("zvd", number)
    asked = step_block("zvd", number, **small)
    start = [hands_off(shaped), hands_off(shaped, step_forward=True, step_size=1)]
    expected, outs = CommandShaper(shaped), CommandShaper(asked)
    ticks = [*start, *[hands_off(shaped)] * 60]
    assert [o.reference for o in run(expected, ticks)] == [o.reference for o in run(outs, ticks)]


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("size", [1, 2, 3])
def test_steps_swing_no_more_than_the_guarantee_of_their_row_allows(number, size):
    settings = step_block("phase", number)
    swing = []
    for enable in (False, True):  # without the row the same commands, unshaped
        shaper = CommandShaper(settings)
        press = hands_off(settings, step_forward=True, step_size=size, enable=enable)
        outs = run(shaper, [hands_off(settings), press]) + to_rest(shaper, hands_off(settings, enable=enable))
        speeds = np.array([0.0] + [float(out.reference) for out in outs])
        turn = np.sqrt(STANDARD_GRAVITY_M_S2 / ROPE_LENGTH_M) * settings.tick_s
        swing.append(abs(np.sum(np.diff(speeds) * np.exp(1j * turn * np.arange(speeds.size - 1)))))
    # In int32 each reference is rounded to a count, which swings by as much.
    slack = 2.0 * len(speeds) ** 0.5 if number == "int32" else 0.0
    assert swing[1] <= settings.bank.rows[0].taps.guarantee.tolerance * swing[0] + slack


def test_what_rounding_leaves_after_a_long_ramp_is_not_travelled_back():
    # In float the sum of this ramp of 157 ticks to rest is rounded up, and the step ends an ulp too far.
    ramps = {"acceleration_m_s2": 0.09739560485559633, "deceleration_m_s2": 0.06388784397520522}
    settings = operator_block("zvd", "float", ramps, step_sizes_m=(7.798082319246751,) * 3)
    shaper = CommandShaper(settings)
    outs = run(shaper, [hands_off(settings), hands_off(settings, step_forward=True)])
    outs += to_rest(shaper, hands_off(settings))
    assert all(out.reference >= 0 for out in outs)
