"""Where the plant ends: references as they are played, put into the plant by a simulation of its own."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from swayless.controller.profile import ProfileStatus
from swayless.design.optimal import LinearPlant
from swayless.machine.profile_design import make_profile_design
from swayless.machine.profile_design_move import ProfileMove

from .profile_blocks import run, sampled_by_hand, smallest_command

EPS = {"double": 2.0**-52, "float": 2.0**-23}


def oscillator(rad_s, damping_ratio):
    return [rad_s**2], [1.0, 2.0 * damping_ratio * rad_s, rad_s**2]


@st.composite
def plants(draw):
    """A mass, an oscillator, one on a rigid body, two modes, a load below a trolley; damped or not."""
    kind = draw(st.sampled_from(["mass", "one mode", "on a rigid body", "two modes", "below a trolley"]))
    rad_s, damping = draw(st.floats(1.0, 8.0)), draw(st.sampled_from([0.0, 0.02, 0.3]))
    top, bottom = oscillator(rad_s, damping)
    if kind == "mass":
        return LinearPlant.from_transfer_function([draw(st.floats(0.2, 5.0))], [1.0, 0.0, 0.0])
    if kind == "on a rigid body":
        bottom = np.polymul(bottom, [1.0, 0.0, 0.0])
    if kind == "below a trolley":
        bottom = np.polymul(bottom, [1.0, 0.0])
    if kind == "two modes":
        over, under = oscillator(2.7 * rad_s, 0.05)
        top, bottom = np.polymul(top, over), np.polymul(bottom, under)
    return LinearPlant.from_transfer_function(top, bottom)


@st.composite
def moves(draw):
    """A smooth move of 10 to 60 ticks about as long as the plant is slow, its limits a little wider."""
    plant, ticks = draw(plants()), draw(st.integers(10, 60))
    tick_s = draw(st.floats(0.6, 2.0)) / ticks
    start, target = draw(st.sampled_from([(0.0, 1.0), (2.0, 0.5), (-0.3, 0.1)]))
    command = smallest_command(plant, tick_s, ticks, start, target)
    inputs = np.array([command.initial_value, *command.values, command.final_value])
    room = 0.4 * (inputs.max() - inputs.min())
    rate = None
    if draw(st.booleans()):
        rate = 1.5 * float(np.abs(np.diff(inputs)).max()) / tick_s
    return ProfileMove(plant, command, (inputs.min() - room, inputs.max() + room), start, target, rate)


def reached(plant, tick_s, references, start):
    """State after references that begin where they hold the plant."""
    a, b = sampled_by_hand(plant, tick_s)
    state = plant.equilibrium(start)[0]
    for reference in references:
        state = a @ state + b * reference
    return state


@settings(derandomize=True, deadline=None, max_examples=80)
@given(
    move=moves(),
    number=st.sampled_from(["double", "float"]),
    where=st.floats(0.0, 1.0),
    factor=st.floats(-1.0, 1.0),
    aborted=st.booleans(),
)
def test_moves_and_stops_of_random_plants_rest_as_promised_within_all_limits(
    move, number, where, factor, aborted
):
    design = make_profile_design("random", "test.toml", move, number)
    block, promise = design.settings, design.guarantee
    start = float(block.number.scalar(move.start))
    target = float(block.number.scalar(start + factor * (move.target - move.start)))
    abort_at = 1 + int(where * (block.pieces.ticks - 2)) if aborted else 10**6
    ticks = block.pieces.ticks + 1
    trace = run(block, [(tick == 0, tick == abort_at, start, target) for tick in range(ticks)])
    outputs = [output for _, output in trace]
    if not outputs[0].busy:
        assert ProfileStatus(outputs[0].status) == ProfileStatus.LIMIT_EXCEEDED  # further than the move
        return
    references = np.array([float(output.reference) for output in outputs])
    low, high = block.limits
    assert low <= references.min()
    assert references.max() <= high
    if move.rate_limit_per_s is not None:
        held = float(block.number.scalar(block.hold_ratio) * block.number.scalar(start))
        assert promise.rate_excess_ratio == 0.0
        assert np.abs(np.diff([held, *references])).max() <= move.rate_limit_per_s * block.tick_s

    state = reached(move.plant, block.tick_s, references, start)
    rest = move.plant.equilibrium(float(outputs[-1].position))[0]
    model = design.numbered.model
    sizes = np.abs(model.states(block.pieces.values(block.number))[:, : move.plant.order]).max(axis=0)
    sizes = sizes * unit_of(design) * abs(target - start)
    # After an abort either a stop has ended, or the move.
    ratio = max(promise.final_error_ratio, promise.stop_error_ratio)
    if target != start:
        ratio += promise.rounding_gain * np.abs(references).max() / abs(target - start)
    # What holds the plant is rounded at both ends; and each sum here.
    here = 8.0 * ticks * EPS["double"] * np.abs([state, rest]).max()
    allowed = ratio * sizes + 4.0 * EPS[number] * np.abs(rest) + here
    assert (np.abs(state - rest) <= allowed).all()
    assert any(output.aborted for output in outputs) == aborted


@settings(derandomize=True, deadline=None, max_examples=12)
@given(move=moves(), number=st.sampled_from(["double", "float"]))
def test_an_abort_at_any_tick_rests_after_the_next_stop_that_is_allowed_or_with_the_move(move, number):
    block = make_profile_design("random", "test.toml", move, number).settings
    n = block.pieces.ticks
    ranges = [] if block.stop is None else block.stop.ranges.tolist()
    start, target = float(block.number.scalar(move.start)), float(block.number.scalar(move.target))
    found = []
    for abort_at in range(1, n):
        trace = run(block, [(tick == 0, tick == abort_at, start, target) for tick in range(n + 1)])
        found.append([output.aborted for _, output in trace].index(True) - abort_at)
        waits = [max(first - abort_at, 0) for first, last in ranges if last >= abort_at]
        stops = [wait + block.stop.ticks for wait in waits]
        assert found[-1] == min([n - abort_at, *stops])
    assert max(found) == block.rest_ticks  # the promise is kept, and no longer than it need be


def unit_of(design):
    """Of the states of the design's model, in those of the plant."""
    move = design.move
    largest = np.abs(move.model().states(move.shape)).max(axis=0)[: move.plant.order]
    units = 2.0 ** np.round(np.log2(np.where(largest > 0.0, largest, 1.0)))
    return units * move.plant.state_units
