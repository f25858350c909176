"""Every function at once, every input flapping: what must hold whatever an operator and a fault do."""

import math

import numpy as np
from hypothesis import example, given
from hypothesis import strategies as st

from swayless.controller import CommandShaper, Status
from tests.properties.strategies import NUMBERS, examples
from tests.unit.controller.blocks import fork
from tests.unit.controller.operator_blocks import (
    KINDS,
    ROPE_LENGTH_M,
    STEP_SIZES_M,
    block_of,
    hands_off,
    metres,
    operated,
    to_rest,
    travelled_m,
)

EVERYTHING = {
    "step_sizes_m": STEP_SIZES_M,
    "step_speed_m_s": 0.4,
    "stop_switches": True,
    "slow_speed_m_s": 0.15,
    "limit_margin_m": 0.1,
    "drive_feedback": True,
    "speed_limit": True,
    "start_from_zero": True,
}

DISTANCE_M = {"double": 1e-9, "float": 2e-4, "int32": 1.1e-3}
"""Of ways of up to 16 m, as in `test_operator_steps`."""


def everything(kind, number, **limits):
    """A block with every function that its law can have."""
    offset = {"rope_offset_m": (-0.5, 0.5)} if kind in {"phase", "modified", "original"} else {}
    return operated(block_of(kind, number, **limits), **(EVERYTHING | offset))


def flapping(random, settings, ticks):
    """Inputs that all change at random, some of them to what they must not be."""
    scalar, full = settings.number.scalar, float(settings.limits.max_command)
    odd = [] if settings.number.is_integer else [math.nan, math.inf, -math.inf, -0.0]
    whole = round if settings.number.is_integer else float
    fields = {
        "command": [0, 0, 0, full, -full, 0.3 * full, 1.5 * full, *odd],
        "selector": [1, 1, 1, 0, 7],
        "step_size": [1, 2, 3, 0, 9],
        "actual_speed": [0, full, -0.4 * full, 3 * full, *odd],
        "speed_limit": [full, full, full, 0.5 * full, 0, -1, *odd],
    }
    flags = {"step_forward": 0.2, "step_reverse": 0.2, "quick_stop": 0.02, "emergency_stop": 0.02}
    flags |= {"stop_forward": 0.03, "stop_reverse": 0.03, "slow_forward": 0.2, "slow_reverse": 0.2}
    flags |= {"drive_ready": 0.97, "distance_valid": 0.9, "enable": 0.9}
    now, inputs = hands_off(settings), []
    for _ in range(ticks):
        change = {
            name: values[int(random.integers(len(values)))]
            for name, values in fields.items()
            if random.random() < 0.06
        }
        change = {
            name: value
            if name in {"selector", "step_size"}
            else scalar(whole(value) if math.isfinite(value) else value)
            for name, value in change.items()
        }
        change |= {
            name: bool(random.random() < odds) for name, odds in flags.items() if random.random() < 0.1
        }
        if random.random() < 0.05:
            change["distance_forward"] = metres(settings, random.uniform(0.0, 3.0))
            change["distance_reverse"] = metres(settings, random.uniform(0.0, 3.0))
            change["rope_offset"] = metres(settings, random.uniform(-0.7, 0.7))
            change["rope_length"] = metres(settings, ROPE_LENGTH_M)
        now = now._replace(**change)
        inputs.append(now)
    return inputs


def let_go(now, settings):
    """Nothing is pressed any more; what is around the crane stays as it is."""
    return now._replace(
        command=settings.number.scalar(0),
        step_forward=False,
        step_reverse=False,
        quick_stop=False,
        emergency_stop=False,
    )


@examples(40)
@given(st.data())
def test_whatever_happens_the_reference_is_finite_limited_and_honest(data):
    kind, number = data.draw(st.sampled_from(KINDS)), data.draw(st.sampled_from(NUMBERS))
    small = {"inching_speed_m_s": data.draw(st.sampled_from([0.0, 0.06]))}
    settings = everything(kind, number, **small)
    random = np.random.default_rng(data.draw(st.integers(0, 10_000)))
    shaper, possible = CommandShaper(settings), sum(settings.status_bits)
    for now in flapping(random, settings, 120):
        out = shaper.step(now)
        for value in (out.reference, out.stop_distance, out.stop_time_s):
            assert math.isfinite(value)
            assert value != 0 or math.copysign(1.0, value) > 0
        assert abs(out.reference) <= settings.limits.max_command
        assert not out.status & ~possible
        for made, sign in ((now.stop_forward, 1), (now.stop_reverse, -1)):
            assert not made or out.reference * sign <= 0 or out.status & Status.QUICK_STOP
        if not now.drive_ready:
            assert out.reference == out.stop_distance == 0
    rested = [shaper.step(let_go(now, settings)) for _ in range(900)][-1]
    assert (rested.reference, rested.stop_distance) == (0, 0)
    assert not rested.status & Status.STEPPING


@examples(40)
@given(st.sampled_from(KINDS), st.sampled_from(NUMBERS), st.integers(0, 10_000))
@example("um-zv", "double", 0)  # a stop waits, and with it a row
def test_the_stop_distance_comes_true_whatever_happened_before(kind, number, seed):
    settings = everything(kind, number)
    random = np.random.default_rng(seed)
    shaper = CommandShaper(settings)
    for tick, now in enumerate(flapping(random, settings, 80)):
        free = now._replace(stop_forward=False, stop_reverse=False, drive_ready=True, distance_valid=True)
        far = free._replace(
            **{name: metres(settings, 900.0) for name in ("distance_forward", "distance_reverse")}
        )
        far = far._replace(speed_limit=settings.limits.max_command, rope_offset=settings.number.scalar(0))
        out = shaper.step(far)
        if tick % 5 == 0:
            follow_m = travelled_m(settings, to_rest(fork(shaper), let_go(far, settings)))
            foretold_m = float(out.stop_distance) / (1000 if settings.number.is_integer else 1)
            assert abs(follow_m - foretold_m) <= DISTANCE_M[number], (kind, tick)
