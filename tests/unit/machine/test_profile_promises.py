"""What is promised of a motion profile: rates, limits, other starts and travels, plants that were split."""

import json
from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm

from swayless.controller.profile import MotionProfile, ProfileInput
from swayless.design.optimal import Command, LinearPlant, MoveTask, Robustness, time_optimal
from swayless.errors import DesignError, FileError
from swayless.machine.profile_design import make_profile_design
from swayless.machine.profile_design_file import load_profile_design, profile_design_text
from swayless.machine.profile_design_move import ProfileMove

MASS = LinearPlant([[0.0, 1.0], [0.0, 0.0]], [0.0, 1.0], [1.0, 0.0])
HELD = LinearPlant.from_transfer_function([3.0], [1.0, 0.4, 37.0])
TICK_S = 0.02
SPLIT = 0.1


def sampled(plant, tick_s):
    block = np.block([[plant.a, plant.b[:, np.newaxis]], [np.zeros((1, plant.order + 1))]])
    exact = expm(block * tick_s)
    return exact[:-1, :-1], exact[:-1, -1]


def optimal_move(robustness=None, **asked):
    task = {"start": 0.7, "rate_limit_per_s": None, "limits": (-20.0, 60.0), **asked}
    found = time_optimal(MoveTask(HELD, TICK_S, target=3.0, robustness=robustness or Robustness(), **task))
    return ProfileMove(
        HELD,
        found.command,
        task["limits"],
        task["start"],
        3.0,
        task["rate_limit_per_s"],
        robustness or Robustness(),
    )


def played(settings, start, target, abort_at=10**9):
    """References of one move, from the one that holds the plant before to the first at rest."""
    scalar = settings.number.scalar
    profile = MotionProfile(settings)
    start, target = scalar(start), scalar(target)
    before = profile.step(ProfileInput(False, False, start, target)).reference
    outputs = [
        profile.step(ProfileInput(True, tick == abort_at, start, target))
        for tick in range(settings.pieces.ticks + 1)
    ]
    assert outputs[0].busy
    busy = sum(output.busy for output in outputs)
    return np.array([float(before), *(float(output.reference) for output in outputs[: busy + 1])]), outputs[
        -1
    ]


def run_on(plant, references, start):
    """State when the last reference begins."""
    a, b = sampled(plant, TICK_S)
    state = plant.equilibrium(start)[0]
    for reference in references[1:-1]:
        state = a @ state + b * reference
    return state


def with_poles_times(factor):
    """The plant with its frequency off, its damping ratio and its hold ratio as before."""
    return LinearPlant.from_transfer_function([3.0 * factor**2], [1.0, 0.4 * factor, 37.0 * factor**2])


@pytest.fixture(scope="module")
def split_design():
    return make_profile_design("ei", "ei.toml", optimal_move(Robustness(split_ratio=SPLIT)))


def swing_after(plant, references, start, rests):
    """Largest distance of the position from where it rests, in the ten seconds after; 2.3 is the travel."""
    state = run_on(plant, references, start) - plant.equilibrium(rests)[0]
    a, _ = sampled(plant, 0.001)
    distances = []
    for _ in range(10_000):
        distances.append(abs(plant.c @ state))
        state = a @ state
    return max(distances) / 2.3


def test_split_poles_rest_where_frequencies_are_off_and_the_plant_as_given_swings_as_promised(split_design):
    settings, promise = split_design.settings, split_design.guarantee
    swings, off = [], []
    for abort_at in (10**9, *range(1, settings.pieces.ticks)):
        references, rested = played(settings, 0.7, 3.0, abort_at)
        swings.append(swing_after(HELD, references, 0.7, rested.position))
        for factor in (1.0 - SPLIT, 1.0 + SPLIT):
            if abort_at % 5 == 0:
                off.append(swing_after(with_poles_times(factor), references, 0.7, rested.position))
    # Amplitudes, rounded up to two digits, against distances of a damped swing.
    assert 0.85 * promise.final_swing_ratio < swings[0] <= promise.final_swing_ratio
    assert promise.final_swing_ratio > 0.01
    largest = max(promise.final_swing_ratio, promise.stop_swing_ratio)
    assert 0.85 * largest < max(swings) <= largest
    assert max(off) < 1e-9


def test_only_what_is_asked_for_is_promised_and_stored(split_design, tmp_path):
    promise = json.loads(profile_design_text(split_design))["guarantee"]
    assert list(promise) == [
        "final_error_ratio",
        "stop_error_ratio",
        "rounding_gain",
        "final_swing_ratio",
        "stop_swing_ratio",
    ]
    file = tmp_path / "ei.profile.json"
    for value in (0.1 * promise["final_swing_ratio"], 1.0):
        text = profile_design_text(split_design)
        file.write_text(
            text.replace(
                f'"final_swing_ratio": {promise["final_swing_ratio"]}', f'"final_swing_ratio": {value}'
            )
        )
        with pytest.raises(FileError, match=r"guarantee\.final_swing_ratio: promises"):
            load_profile_design(file)


def test_limits_are_rounded_inwards_to_float():
    move = optimal_move(limits=(-20.1, 60.7))
    low, high = make_profile_design("held", "held.toml", move, "float").settings.limits
    assert -20.1 <= low < -20.0999
    assert 60.6999 < high <= 60.7


def gentle_move():
    """A mass that is moved smoothly, at a quarter of what the rate may be: its stops change faster."""
    ticks = np.arange(40)
    pushes = np.sin(2.0 * np.pi * (ticks + 0.5) / 40.0)
    target = float(0.01 * np.sum(pushes * (39.5 - ticks)))
    rate = 40.0 * np.abs(np.diff(pushes)).max()
    return ProfileMove(MASS, Command(0.1, pushes, 0.0), (-1.5, 1.5), 0.0, target, rate_limit_per_s=rate)


@pytest.mark.parametrize("number", ["double", "float"])
def test_no_travel_that_is_accepted_breaks_the_limit_of_the_rate_by_any_stop(number):
    move = gentle_move()
    settings = make_profile_design("mass", "mass.toml", replace(move, limits=(-9.0, 9.0)), number).settings
    scalar, longest = settings.number.scalar, settings.max_travel
    beyond = np.nextafter(scalar(longest), scalar(np.inf))
    assert not MotionProfile(settings).step(ProfileInput(True, False, scalar(0), beyond)).busy
    steps = []
    for abort_at in range(1, 42):
        profile = MotionProfile(settings)
        played = [0.0]
        for tick in range(42):
            pins = ProfileInput(True, tick == abort_at, scalar(0), scalar(-longest))
            played.append(float(profile.step(pins).reference))
        steps.append(np.abs(np.diff(played)).max())
    assert max(steps) <= move.rate_limit_per_s * 0.1
    assert max(steps) == pytest.approx(move.rate_limit_per_s * 0.1, rel=1e-4)  # and the bound is sharp
    assert steps[-1] < max(steps)  # a stop, not the move, is what sets it


def at_the_limit(times):
    """A move whose largest change, so many times, is the limit of the rate; the input has room."""
    move = optimal_move()
    changes = np.diff([move.command.initial_value, *move.command.values, move.command.final_value])
    rate = times * float(np.abs(changes).max()) / TICK_S
    return replace(move, limits=(-200.0, 300.0), rate_limit_per_s=rate)


@pytest.mark.parametrize("number", ["double", "float"])
def test_wherever_it_starts_a_held_plant_keeps_the_limit_of_the_rate_strictly(number):
    move = at_the_limit(1.1)
    rate = move.rate_limit_per_s
    made = make_profile_design("held", "held.toml", move, number)
    settings = made.settings
    assert made.guarantee.rate_excess_ratio == 0.0
    for where, way in ((0.7, 1.0), (1.9, -1.0), (-3.3, 1.0), (12.34567, -1.0)):
        start = settings.number.scalar(where)
        target = settings.number.scalar(float(start) + way * settings.max_travel)
        while abs(target - start) > settings.max_travel:  # rounding of the target
            target = np.nextafter(target, start)
        for abort_at in (10**9, *range(1, settings.pieces.ticks, 2)):
            references, _ = played(settings, start, target, abort_at)
            assert np.abs(np.diff(references)).max() <= rate * TICK_S


@pytest.mark.parametrize("number", ["double", "float"])
def test_a_move_at_the_limit_of_the_rate_says_by_how_much_rounding_may_exceed_it(number):
    move = at_the_limit(1.0)
    made = make_profile_design("held", "held.toml", move, number)
    excess = made.guarantee.rate_excess_ratio
    assert made.settings.max_travel == pytest.approx(2.3, rel=1e-6)
    # In double the twelve digits of the command may have taken it below the limit.
    assert 0.0 <= excess <= 1e-9 if number == "double" else 0.0 < excess <= 1e-4
    for abort_at in (10**9, *range(1, made.settings.pieces.ticks, 3)):
        references, _ = played(made.settings, 0.7, 3.0, abort_at)
        assert np.abs(np.diff(references)).max() <= move.rate_limit_per_s * TICK_S * (1.0 + excess)


def test_a_limit_of_the_rate_that_drowns_in_rounding_is_refused():
    move = replace(at_the_limit(1.0), limits=(-1e6, 1e6))
    make_profile_design("held", "held.toml", move)
    with pytest.raises(DesignError, match=r"rate_limit = .*: in float references up to 1e\+06 are rounded"):
        make_profile_design("held", "held.toml", move, "float")


@pytest.mark.parametrize("number", ["double", "float"])
@pytest.mark.parametrize(("start", "travel"), [(0.7, 0.028), (50_000.0, 2.0), (-777.7, 1e-3), (0.0, 4000.0)])
def test_other_starts_and_travels_leave_what_is_promised_of_them(number, start, travel):
    made = make_profile_design("held", "held.toml", replace(optimal_move(), limits=(-1e6, 1e6)), number)
    settings, promise = made.settings, made.guarantee
    scalar = settings.number.scalar
    start, target = scalar(start), scalar(start) + scalar(travel)
    travel = float(target - start)
    states = made.move.model().states(settings.pieces.values(settings.number))
    sizes = np.abs(states).max(axis=0) * abs(travel)
    for abort_at in (10**9, 1, settings.pieces.ticks // 3):
        references, rested = played(settings, start, target, abort_at)
        largest = np.abs(references).max()
        # From where the plant really rests, under the reference that holds it, to where it will.
        before, after = references[0] * 3.0 / 37.0, references[-1] * 3.0 / 37.0
        state = run_on(HELD, references, before) - HELD.equilibrium(after)[0]
        promised = max(promise.final_error_ratio, promise.stop_error_ratio)
        promised += promise.rounding_gain * largest / abs(travel)
        # Sums of this test itself: some 1e-16 of states for each tick.
        here = 1e-14 * np.abs(HELD.equilibrium(largest)[0])
        assert (np.abs(state / HELD.state_units) <= promised * sizes + here / HELD.state_units).all()
        assert float(rested.position) == pytest.approx(
            after, rel=4.0 * (2.0**-52 if number == "double" else 2.0**-23)
        )


def test_a_stop_that_brings_rest_hardly_sooner_is_left_out():
    move = optimal_move(Robustness(3))
    made = make_profile_design("slow", "slow.toml", move)
    assert made.settings.stop is None
    assert made.guarantee.stop_error_ratio == 0.0
    assert made.settings.rest_ticks == made.settings.pieces.ticks - 1


def test_rounding_of_a_stored_command_takes_no_pieces():
    ticks = np.arange(1000)
    pushes = np.sin(2.0 * np.pi * (ticks + 0.5) / 1000.0)
    target = float(TICK_S**2 * np.sum(pushes * (999.5 - ticks)))
    made = make_profile_design(
        "m", "m.toml", ProfileMove(MASS, Command(TICK_S, pushes, 0.0), (-2.0, 2.0), 0.0, target)
    )
    # Nearer than the twelve digits it would take more than 50 pieces.
    assert made.settings.pieces.lengths.size <= 5
    assert made.guarantee.final_error_ratio <= 5e-11
