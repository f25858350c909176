"""The plant from tick to tick, and stops: against their definitions, solved another way."""

import numpy as np
import pytest
from scipy.linalg import expm

from swayless.design.optimal import Command, LinearPlant, Robustness, transform_derivatives
from swayless.design.optimal.robustification import rest_conditions
from swayless.design.playing import (
    ShapeLimits,
    error_ratio,
    fewer_ranges,
    missed_by_move,
    quickest_stop,
    ranges_of,
    shape_model,
    ticks_of,
    ticks_to_rest,
)
from swayless.errors import DesignError

OSCILLATOR = LinearPlant.from_transfer_function([1.0], [0.01, 0.004, 1.0])
ON_A_BODY = LinearPlant.from_transfer_function([1.0], [0.01, 0.002, 1.0, 0.0, 0.0])
MASS = LinearPlant([[0.0, 1.0], [0.0, 0.0]], [0.0, 1.0], [1.0, 0.0])
TICK_S = 0.02

MODELS = [
    (OSCILLATOR, Robustness()),
    (OSCILLATOR, Robustness(order=2)),
    (OSCILLATOR, Robustness(split_ratio=0.1)),
    (ON_A_BODY, Robustness(order=1)),
    (ON_A_BODY, Robustness(split_ratio=0.2)),
    (MASS, Robustness()),
]


def smallest_shape(model, ticks):
    """The move by 1 whose sum of squares is least."""
    return np.linalg.lstsq(model.kept @ model.system.reach(ticks), model.final, rcond=None)[0]


@pytest.mark.parametrize(("plant", "robustness"), MODELS)
def test_a_shape_that_rests_in_this_model_rests_by_the_conditions_of_the_design(plant, robustness):
    model = shape_model(plant, TICK_S, robustness=robustness)
    shape = smallest_shape(model, 90)
    rest = rest_conditions(plant, TICK_S, 1.0, robustness)
    # The shape itself solves to some 1e-13; chains of three links lose two digits.
    assert rest.rows(90) @ shape == pytest.approx(rest.final, abs=1e-10 * np.abs(rest.final).max())
    assert model.final.size == rest.final.size


def test_the_model_has_each_state_once():
    sizes = [shape_model(plant, TICK_S, robustness=asked).order for plant, asked in MODELS]
    assert sizes == [2, 6, 6, 6, 8, 2]


@pytest.mark.parametrize(("plant", "robustness"), MODELS)
def test_under_a_first_order_hold_states_are_those_of_straight_lines(plant, robustness):
    model = shape_model(plant, TICK_S, "first-order", robustness)
    shape = np.array([0.3, -0.2, 0.5, 0.1])
    states = model.states(shape)
    # By the exponential of state, input and slope; the drive comes from 0 in the tick before.
    order = plant.order
    block = np.zeros((order + 2, order + 2))
    block[:order, :order], block[:order, order], block[order, order + 1] = plant.a, plant.b, 1.0
    exact, state, before, positions = expm(block * TICK_S), np.zeros(order), 0.0, []
    for value in shape:
        state = (exact @ np.array([*state, before, (value - before) / TICK_S]))[:order]
        before = value
        positions.append(plant.c @ state + plant.d * value)
    ours = states[:-1] @ model.output + model.feedthrough * shape
    assert ours == pytest.approx(positions, abs=1e-14)


@pytest.mark.parametrize("hold", ["zero-order", "first-order"])
@pytest.mark.parametrize(("plant", "robustness"), MODELS)
def test_under_its_own_input_a_plant_at_rest_stays(plant, robustness, hold):
    model = shape_model(plant, TICK_S, hold, robustness)
    shape = np.append(smallest_shape(model, 90), np.full(200, model.hold_ratio))
    # 200 ticks later nothing has moved: of the states, which are of order 1 to 10, rounding is left.
    assert error_ratio(model, missed_by_move(model, shape), model.sizes(shape)) < 1e-11
    states = model.states(shape) @ model.kept.T
    assert states[90] == pytest.approx(states[-1], abs=1e-9)


def by_definition(model, limits, ticks, known):
    """The stop of a length from dense equations of prices, and its rest from three points of its cost."""
    held, order = model.hold_ratio, model.order
    width, change = limits.high - limits.low, limits.change
    through = model.kept @ model.system.reach(ticks)
    moved = model.kept @ np.linalg.matrix_power(model.system.a, ticks) @ known[:order]
    steps = np.eye(ticks + 1, ticks) - np.eye(ticks + 1, ticks, k=-1)
    cost = np.eye(ticks) / width**2 + steps.T @ steps / change**2
    # How the input returns by itself does not depend on the state; what is added does, and on the rest.
    itself = np.linalg.solve(cost, np.eye(ticks)[0] / change**2)

    def added(rest):
        inputs = held * rest + (known[-1] - held * rest) * itself
        missing = model.final * rest - moved - through @ inputs
        prices = np.linalg.solve(through @ np.linalg.solve(cost, through.T), missing)
        more = np.linalg.solve(cost, through.T @ prices)
        return inputs + more, float(more @ cost @ more)

    # The cost is a parabola in the position of rest: three points give its vertex.
    low, middle, high = (added(rest)[1] for rest in (-1.0, 0.0, 1.0))
    rest = 0.5 * (low - high) / (low - 2.0 * middle + high)
    return added(rest)[0], rest


@pytest.mark.parametrize("change", [np.inf, 0.3])
@pytest.mark.parametrize(("plant", "robustness"), MODELS)
def test_a_stop_is_the_least_of_its_length_by_definition(plant, robustness, change):
    model = shape_model(plant, TICK_S, robustness=robustness)
    shape = smallest_shape(model, 60)
    most = 3.0 * max(model.hold_ratio, np.abs(shape).max())
    limits = ShapeLimits(-most, most, change * most)
    stop = quickest_stop(model, shape, limits)
    for tick in (1, 20, 59):
        known = np.append(model.states(shape)[tick], shape[tick - 1])
        inputs, rest = by_definition(model, limits, len(stop.gains), known)
        # Dense equations in chains of three links are good to some eight digits.
        assert stop.gains @ known == pytest.approx(inputs, abs=1e-7 * most)
        assert stop.rest @ known == pytest.approx(rest, abs=1e-7)


@pytest.mark.parametrize(
    ("plant", "robustness"), [(OSCILLATOR, Robustness(order=2)), (ON_A_BODY, Robustness(1))]
)
def test_a_move_and_its_stop_are_together_as_robust_as_the_move(plant, robustness):
    model = shape_model(plant, TICK_S, robustness=robustness)
    shape = smallest_shape(model, 60)
    most = 3.0 * np.abs(shape).max()
    stop = quickest_stop(model, shape, ShapeLimits(-most, most))
    pole = complex(plant.ringing_poles_rad_s[0])
    for tick in (1, 25, 59):
        known = np.append(model.states(shape)[tick], shape[tick - 1])
        inputs = np.append(shape[:tick], stop.gains @ known)
        whole = Command(TICK_S, inputs, model.hold_ratio * float(stop.rest @ known))
        derivatives = transform_derivatives(whole, pole, robustness.order)
        # Of inputs of this size, weighted by (|p| t)^order.
        scale = most * (abs(pole) * whole.duration_s) ** np.arange(robustness.order + 1)
        assert (np.abs(derivatives) < 1e-10 * scale).all()


def shares(inputs, known, limits):
    """What stops of a mass take of the limits, the steps at both ends included."""
    changes = np.abs(np.diff(np.vstack([known[-1], inputs, 0.0 * known[-1]]), axis=0))
    return max(np.abs(inputs).max() / limits.high, changes.max() / limits.change)


@pytest.mark.parametrize("change", [np.inf, 0.2])
def test_stops_of_moves_that_last_longer_keep_the_limits_and_with_a_tick_less_they_would_not(change):
    model = shape_model(MASS, TICK_S)
    shape = np.convolve(np.repeat([0.9, -0.9], 20), np.ones(10) / 10.0)
    limits = ShapeLimits(-1.0, 1.0, change)
    stop = quickest_stop(model, shape, limits)
    known = np.vstack([model.states(shape)[1:-1].T, shape[:-1]])
    ticks = len(stop.gains)
    longer = known[:, : shape.size - 1 - ticks]
    assert shares(stop.of(longer), longer, limits) <= 1.0
    longer = known[:, : shape.size - ticks]
    shorter = [by_definition(model, limits, ticks - 1, column)[0] for column in longer.T]
    assert shares(np.array(shorter).T, longer, limits) > 1.0


def test_a_mass_is_braked_evenly():
    model = shape_model(MASS, TICK_S)
    shape = np.repeat([1.0, -1.0], 40)
    stop = quickest_stop(model, shape, ShapeLimits(-1.0, 1.0))
    inputs = stop.gains @ np.append(model.states(shape)[30], 1.0)
    assert np.ptp(inputs) < 1e-12  # constant deceleration has the least sum of squares
    assert len(inputs) in {39, 40}  # from tick 39 on the move is over in 40; limits may be hit by rounding


@pytest.mark.parametrize("change", [np.inf, 0.5])
def test_a_plant_of_one_state_is_stopped_in_a_tick_where_limits_allow_it(change):
    lag = shape_model(LinearPlant.from_transfer_function([3.0], [0.2, 1.0]), TICK_S)
    stop = quickest_stop(lag, smallest_shape(lag, 40), ShapeLimits(-0.1, 1.0, change))
    assert len(stop.gains) == 1
    if change == np.inf:  # it rests where it is, under the input that holds it there
        assert stop.gains[0] == pytest.approx(lag.hold_ratio * stop.rest)


def test_of_all_lengths_the_one_whose_worst_abort_waits_and_stops_soonest_is_taken():
    model = shape_model(MASS, TICK_S)
    shape = np.repeat([1.0, 0.0, -1.0], [20, 30, 20])
    speed, n = np.abs(model.states(shape)[1:-1] @ [0.0, 1.0]) / TICK_S, shape.size
    aborts, worst = np.arange(1, n), {}
    # A mass is braked evenly, from a speed of v ticks of full force in v ticks.
    for length in range(2, n - 1):
        begins = aborts[(speed <= 1.05 * length) & (aborts + length < n)]
        waits = begins - aborts[:, np.newaxis]
        stops = np.where(waits < 0, n, waits).min(axis=1, initial=n) + length
        rests = np.minimum(stops, n - aborts)
        worst[length] = rests.max(), rests.mean()
    stop = quickest_stop(model, shape, ShapeLimits(-1.05, 1.05))
    rests = stop.rests(n)
    assert (rests.max(), rests.mean()) == min(worst.values())
    assert stop.ticks == min(worst, key=worst.get)
    assert stop.ranges.tolist() == [[1, n - stop.ticks - 1]]


@pytest.mark.parametrize("ticks", [[], [4], [1, 2, 3], [2, 5, 6, 9]])
def test_ranges_have_exactly_the_ticks_that_they_were_made_of(ticks):
    ranges = ranges_of(ticks)
    assert ticks_of(ranges).tolist() == ticks
    assert (ranges[1:, 0] > ranges[:-1, 1] + 1).all()


def test_an_abort_rests_after_the_next_tick_that_allows_a_stop_or_at_the_end():
    ticks, stop, move = [3, 4, 9], 5, 20
    for abort, found in enumerate(ticks_to_rest(ranges_of(ticks), stop, move).tolist(), start=1):
        waits = [tick - abort + stop for tick in ticks if tick >= abort]
        assert found == min([move - abort, *waits])


@pytest.mark.parametrize("seed", range(5))
def test_without_the_ranges_that_are_left_out_no_abort_takes_much_longer(seed):
    kept = np.flatnonzero(np.random.default_rng(seed).random(320) < 0.6) + 1
    every = ranges_of(kept)
    few = fewer_ranges(every, 60, 400)
    before, after = (ticks_to_rest(ranges, 60, 400) for ranges in (every, few))
    assert len(few) < len(every)
    assert set(ticks_of(few)) < set(kept)
    assert after.max() == before.max()
    assert (after - before).max() <= 4  # a hundredth of the move


def test_a_move_that_is_over_as_soon_needs_no_stop():
    model = shape_model(MASS, TICK_S)
    assert quickest_stop(model, np.array([1.0, -1.0]), ShapeLimits(-1.1, 1.1)) is None
    swing = shape_model(LinearPlant.from_transfer_function([1.0], [0.01, 0.0, 1.0]), TICK_S)
    # Limits that leave no stop the room to end sooner than any move of 12 ticks.
    assert quickest_stop(swing, smallest_shape(swing, 12), ShapeLimits(-0.01, 0.01)) is None


def test_what_robustness_cannot_be_against_is_refused():
    with pytest.raises(DesignError, match="nothing rings in this plant"):
        shape_model(MASS, TICK_S, robustness=Robustness(order=1))
