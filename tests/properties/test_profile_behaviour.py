"""Each sentence of what the motion profile does, under any history of its inputs."""

import math
from dataclasses import replace
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from swayless.controller.profile import ProfileInput, ProfileOutput, ProfileStatus

from .profile_blocks import run, settings_of

KINDS = [("oscillator", "double"), ("oscillator", "float"), ("mass", "double"), ("mass", "float")]
NEVER = 10**6

positions = st.sampled_from([-0.5, 0.0, 0.25, 1.0, 1.25, 3.0, math.nan, math.inf, -math.inf, 1e30, 1e16])
starts = st.one_of(st.none(), st.none(), st.none(), positions)
stretches = st.tuples(st.booleans(), st.booleans(), starts, positions, st.integers(1, 18))
histories = st.lists(stretches, min_size=1, max_size=12).map(
    lambda parts: [part[:4] for part in parts for _ in range(part[4])]
)

every_kind = pytest.mark.parametrize("kind", KINDS, ids="-".join)
any_history = given(history=histories)
quick = settings(derandomize=True, deadline=None, max_examples=25)


def rises(before, pins):
    return pins.execute and not before[0].execute


def steps(trace):
    """Each tick with the one before; before the first, execute is false and nothing plays."""
    none = (ProfileInput(False, False, 0.0, 0.0), ProfileOutput(0.0, 0.0, False, False, False, 0))
    return pairwise([none, *trace])


def refused(output):
    """The reasons why nothing started: all bits but those that are no refusals."""
    return output.status & ~(ProfileStatus.STOPPING | ProfileStatus.START_INVALID)


def moved(block, *, ticks, abort_at=NEVER, start=0.0, target=1.0):
    """One move, aborted for a tick, with execute for the first tick only."""
    return run(block, [(tick == 0, tick == abort_at, start, target) for tick in range(ticks)])


@every_kind
@quick
@any_history
def test_nothing_leaves_the_limits_and_every_output_is_finite(kind, history):
    block = settings_of(*kind)
    low, high = block.limits
    for _, output in run(block, history):
        assert low <= output.reference <= high
        assert math.isfinite(output.position)


@every_kind
@quick
@any_history
def test_a_rising_edge_starts_in_this_very_tick_or_says_why_not(kind, history):
    block = settings_of(*kind)
    first = block.number.scalar(block.pieces.values(block.number)[0])
    hold = block.number.scalar(block.hold_ratio)
    for before, (pins, output) in steps(run(block, history)):
        if rises(before, pins) and not before[1].busy:
            assert output.busy == (refused(output) == 0)
            if output.busy:
                assert output.reference == (hold * pins.start) + ((pins.target - pins.start) * first)
                assert not output.done
                assert not output.aborted


@every_kind
@quick
@any_history
def test_without_a_rising_edge_nothing_starts(kind, history):
    for before, (pins, output) in steps(run(settings_of(*kind), history)):
        if output.busy and not before[1].busy:
            assert rises(before, pins)


@every_kind
@quick
@any_history
def test_while_busy_a_rising_edge_is_ignored_and_says_so(kind, history):
    for before, (pins, output) in steps(run(settings_of(*kind), history)):
        if rises(before, pins) and before[1].busy:
            assert refused(output) == ProfileStatus.EXECUTE_IGNORED


@every_kind
@quick
@any_history
def test_reasons_stay_until_execute_is_false(kind, history):
    for before, (pins, output) in steps(run(settings_of(*kind), history)):
        if not pins.execute:
            assert refused(output) == 0
        elif not rises(before, pins):
            assert refused(output) == refused(before[1])


@every_kind
@quick
@any_history
def test_done_and_aborted_stay_while_execute_is_true_and_for_a_tick_at_least(kind, history):
    for before, (pins, output) in steps(run(settings_of(*kind), history)):
        for flag in ("done", "aborted"):
            rose = before[1].busy and not output.busy
            if getattr(output, flag):
                assert rose or (getattr(before[1], flag) and pins.execute)
            elif getattr(before[1], flag):
                assert not pins.execute or output.busy
        assert not (output.done and output.aborted)


@every_kind
@quick
@any_history
def test_at_rest_the_reference_holds_the_position_exactly(kind, history):
    block = settings_of(*kind)
    hold = block.number.scalar(block.hold_ratio)
    for _, (_, output) in steps(run(block, history)):
        if not output.busy:
            assert output.reference == hold * output.position


@every_kind
@quick
@any_history
def test_once_moved_a_resting_block_stays_whatever_start_says(kind, history):
    has_moved = False
    for before, (_, output) in steps(run(settings_of(*kind), history)):
        if has_moved and not output.busy and not before[1].busy:
            assert output.position == before[1].position
        has_moved = has_moved or output.busy


@every_kind
@quick
@any_history
def test_before_the_first_move_the_block_holds_at_start_or_at_the_last_good_one(kind, history):
    block = settings_of(*kind)
    last = block.first_position
    for _, (pins, output) in steps(run(block, history)):
        if output.busy:
            return
        good = abs(pins.start) <= 2.0**50
        good = good and block.limits[0] <= block.hold_ratio * float(pins.start) <= block.limits[1]
        last = pins.start if good else last
        assert output.position == last
        assert bool(output.status & ProfileStatus.START_INVALID) == (not good)


@every_kind
@quick
@any_history
def test_the_rate_keeps_its_limit_between_accepted_ticks(kind, history):
    block = settings_of(*kind)
    most = 40.0 * block.limits[1] * block.tick_s
    has_moved = False
    for before, (_, output) in steps(run(block, history)):
        if has_moved and before[1].busy:
            assert abs(float(output.reference) - float(before[1].reference)) <= most
        has_moved = has_moved or output.busy


@every_kind
def test_a_move_is_busy_for_its_ticks_then_done_at_the_target_exactly(kind):
    block = settings_of(*kind)
    n = block.pieces.ticks
    outputs = [output for _, output in moved(block, ticks=n + 5, target=0.75)]
    assert [output.busy for output in outputs] == [True] * n + [False] * 5
    assert [output.done for output in outputs] == [False] * n + [True] + [False] * 4
    assert {output.reference for output in outputs[n:]} == {block.hold_ratio * 0.75}
    assert {output.position for output in outputs[n:]} == {0.75}


@every_kind
def test_an_abort_waits_for_a_tick_that_allows_a_stop_or_rests_at_the_end_of_the_move(kind):
    block = settings_of(*kind)
    n, m = block.pieces.ticks, block.stop.ticks
    whole = [output for _, output in moved(block, ticks=n)]
    begins = {tick for first, last in block.stop.ranges.tolist() for tick in range(first, last + 1)}
    assert begins
    for abort_at in range(1, n):
        begin = min((tick for tick in begins if tick >= abort_at), default=n)
        lasts = min(begin + m, n) - abort_at
        assert lasts <= block.rest_ticks
        trace = moved(block, ticks=abort_at + lasts + 1, abort_at=abort_at)
        *played, rests = [output for _, output in trace]
        stopping = [bool(output.status & ProfileStatus.STOPPING) for output in played]
        assert stopping == [False] * abort_at + [True] * lasts
        assert (rests.aborted, rests.done, rests.busy) == (True, False, False)
        same = [output.reference for output in played] == [
            output.reference for output in whole[: len(played)]
        ]
        assert same == (rests.position == 1.0) == (begin == n)
        assert [output.reference for output in played[:begin]] == [
            output.reference for output in whole[:begin]
        ]


@every_kind
def test_where_it_rests_after_an_abort_the_next_move_starts(kind):
    block = settings_of(*kind)
    n, m = block.pieces.ticks, block.stop.ticks
    first, last = block.stop.ranges[-1].tolist()
    for abort_at in (first, last, last + 1, n - 1):
        ticks = abort_at + m if abort_at <= last else n
        history = [(tick == 0, tick == abort_at, 0.0, 1.0) for tick in range(ticks + 1)]
        (_, rests), (_, starts) = run(block, [*history, (True, False, None, 0.5)])[-2:]
        assert rests.reference == block.number.scalar(block.hold_ratio) * rests.position
        assert starts.busy
        assert refused(starts) == 0


@every_kind
def test_without_a_stop_every_abort_goes_on_to_the_end(kind):
    with_stop = settings_of(*kind)
    block = replace(with_stop, stop=None)
    n = block.pieces.ticks
    *played, rests = [output for _, output in moved(block, ticks=n + 1, abort_at=1)]
    assert [output.reference for output in played] == [
        output.reference for _, output in moved(block, ticks=n)
    ]
    assert (rests.aborted, rests.done, rests.position) == (True, False, 1.0)
    assert block.rest_ticks == n - 1
    assert with_stop.rest_ticks < n - 1


@every_kind
def test_abort_in_rest_or_in_a_stop_changes_nothing(kind):
    block = settings_of(*kind)
    ticks = block.pieces.ticks + block.stop.ticks
    once = [output for _, output in moved(block, ticks=ticks, abort_at=5)]
    held = run(block, [(tick == 0, tick >= 5, 0.0, 1.0) for tick in range(ticks)])
    assert [output for _, output in held] == once
    resting = run(block, [(False, tick > 3, 0.0, 1.0) for tick in range(9)])
    assert len({(output.reference, output.position, output.status) for _, output in resting}) == 1


@every_kind
def test_when_the_table_is_over_abort_comes_too_late(kind):
    block = settings_of(*kind)
    n = block.pieces.ticks
    last = moved(block, ticks=n + 1, abort_at=n)[-1][1]
    assert last.done
    assert last.position == 1.0


@every_kind
def test_all_reasons_of_a_refusal_are_said_at_once(kind):
    block = settings_of(*kind)
    _, output = run(block, [(False, False, 0.0, 0.0), (True, True, math.nan, 0.0)])[-1]
    assert refused(output) == ProfileStatus.ABORT_HELD | ProfileStatus.INPUT_NOT_FINITE
    _, output = run(block, [(False, False, 0.0, 0.0), (True, True, 0.0, 1e6)])[-1]
    expected = ProfileStatus.ABORT_HELD | ProfileStatus.LIMIT_EXCEEDED | ProfileStatus.TRAVEL_TOO_LONG
    assert refused(output) == expected


def test_a_plant_that_must_be_held_refuses_a_start_elsewhere_and_one_that_stays_by_itself_does_not():
    done = [(True, False, 0.0, 1.0)] + [(False, False, 0.0, 1.0)] * 15
    for kind, expected in (("oscillator", ProfileStatus.START_ELSEWHERE), ("mass", ProfileStatus(0))):
        _, output = run(settings_of(kind, "double"), [*done, (True, False, 0.5, 0.75)])[-1]
        assert refused(output) == expected


@every_kind
def test_start_and_target_are_read_when_a_move_starts_and_not_later(kind):
    block = settings_of(*kind)
    ticks = block.pieces.ticks + 2
    steady = run(block, [(True, False, 0.0, 1.0)] * ticks)
    shaken = run(block, [(True, False, 0.0, 1.0)] + [(True, False, math.nan, 7.0)] * (ticks - 1))
    assert [output for _, output in steady] == [output for _, output in shaken]


@every_kind
@quick
@given(travel=st.floats(-1.0, 1.0))
def test_a_move_is_its_shape_times_the_travel_in_the_order_that_is_written(kind, travel):
    block = settings_of(*kind)
    scalar = block.number.scalar
    trace = moved(block, ticks=block.pieces.ticks, target=travel)
    shape = block.pieces.values(block.number)
    expected = [(scalar(0) * scalar(0)) + (scalar(travel) * scalar(value)) for value in shape]
    assert [output.reference for _, output in trace] == expected
