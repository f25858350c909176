"""What no command computed ahead can do is refused, with the cause."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest

from swayless.design.optimal import (
    Command,
    Feedback,
    LinearPlant,
    MoveTask,
    Robustness,
    detuned,
    least_energy,
    output_at_ticks,
    output_with_feedback,
    time_optimal,
    track,
)
from swayless.errors import DesignError

made = LinearPlant.from_transfer_function
OSCILLATOR = made([1.0], [0.01, 0.0, 1.0])
LAG = made([1.0], [1.0, 1.0])


def task(plant=OSCILLATOR, tick_s=0.01, limits=(-5.0, 5.0), target=1.0, **options):
    return MoveTask(plant, tick_s, limits, target, **options)


CASES = {
    "unstable": (lambda: task(made([1.0], [1.0, -1.0])), "unstable, pole at 1 rad/s"),
    "slowly unstable beside a fast lag": (
        lambda: task(made([1.0], np.polymul([1e-4, 1.0], [1.0, -1e-3]))),
        "unstable, pole at 0.001 rad/s",
    ),
    "a slow mode that grows beside a fast lag": (
        lambda: task(made([1.0], np.polymul([1e-4, 1.0], [1.0, -0.01, 1.0]))),
        "unstable, pole at 0.005",
    ),
    "not controllable": (
        lambda: task(LinearPlant([[-1.0, 0.0], [0.0, -2.0]], [1.0, 0.0], [1.0, 1.0])),
        "not controllable, the input does not move the pole at -2 rad/s",
    ),
    "input that moves nothing": (lambda: task(LinearPlant([[0.0]], [0.0], [1.0])), "not controllable"),
    "zero at 0": (lambda: task(made([1.0, 0.0], [1.0, 1.0, 1.0])), "a zero at 0: no input holds its output"),
    "no limit": (lambda: task(limits=(0.0, 0.0)), "limit = 0.0 to 0.0: must be finite and rise"),
    "limit without end": (lambda: task(limits=(-math.inf, 1.0)), "limit = -inf to 1.0: must be finite"),
    "no rate": (lambda: task(rate_limit_per_s=0.0), "rate_limit = 0.0: must be finite and > 0"),
    "no tick": (lambda: task(tick_s=0.0), "tick_s = 0.0: must be finite and > 0"),
    "no move": (lambda: task(target=0.0), "target = 0.0: must be finite, and differ from start = 0.0"),
    "target out of reach": (
        lambda: task(target=6.0),
        "needs an input of 6 to stay there, and the limit is -5 to 5",
    ),
    "start out of reach": (lambda: task(start=-7.0), "start = -7: needs an input of -7 to stay there"),
    "target only approached": (
        lambda: time_optimal(task(LAG, target=5.0)),
        "the target needs all of the limit, 5",
    ),
    "rate that never gets there": (
        lambda: task(rate_limit_per_s=1e-9),
        "rate_limit = 1e-09: the input takes 1e+09 s from 0 to 1: must take up to 20000 ticks of 0.01 s",
    ),
    "rate that does not get there in time": (
        lambda: least_energy(task(rate_limit_per_s=1e-2), 10),
        "10 ticks of 0.01 s: any command takes 24032.5 times",
    ),
    "half a period a tick": (
        lambda: time_optimal(task(tick_s=math.pi / 10.0)),
        "from tick to tick the input does not move the pole",
    ),
    "nothing rings": (
        lambda: time_optimal(task(LAG, robustness=Robustness(1))),
        "nothing rings in this plant",
    ),
    "two poles in one": (
        lambda: time_optimal(task(made([1.0], [1.0, 0.0, 2.0, 0.0, 1.0]), robustness=Robustness(1))),
        "rad/s cannot be told apart",
    ),
    "order": (lambda: Robustness(7), "robust order = 7: must be a whole number from 0 to 6"),
    "split": (lambda: Robustness(split_ratio=0.5), "split_ratio = 0.5: must be above 0 and below 0.5"),
    "both": (lambda: Robustness(1, 0.1), "either repeated or split"),
    "too few ticks": (
        lambda: least_energy(task(robustness=Robustness(1)), 20),
        "20 ticks of 0.01 s: any command takes 4.52803 times the limits",
    ),
    "fewer ticks than conditions": (
        lambda: least_energy(task(), 1),
        "ticks = 1: so few cannot bring the plant to rest, whatever the limits",
    ),
    "no ticks": (lambda: least_energy(task(), 0), "ticks = 0: must be a whole number from 1"),
    "trajectory elsewhere": (lambda: track(task(), [0.1, 0.5], 0.1), "ends at 0.5, the target is 1"),
    "trajectory without an end": (lambda: track(task(), [], 0.1), "trajectory of shape (0,)"),
    "tracking exactly": (
        lambda: track(task(), [1.0], 0.0),
        "tracking tolerance = 0.0: must be finite and > 0",
    ),
    "not minimum phase": (
        lambda: track(task(made([-1.0, 1.0], [1.0, 1.0, 1.0])), np.linspace(0.01, 1.0, 100), 0.01),
        "the plant is not minimum phase (zero at 1+0j rad/s)",
    ),
    "trajectory too fast": (lambda: track(task(), np.linspace(0.1, 1.0, 10), 0.01), "limit, are needed"),
    "input at once": (lambda: track(task(made([1.0, 2.0], [1.0, 1.0])), [0.5, 1.0], 0.5), "d is not 0"),
    "feedback at once": (
        lambda: output_with_feedback(
            made([1.0, 2.0], [1.0, 1.0]), Command(0.1, [1.0], 1.0), [0.0], Feedback(1.0, 0.0), ticks=3
        ),
        "d is not 0",
    ),
    "feedback that grows": (
        lambda: output_with_feedback(
            OSCILLATOR, Command(0.1, [1.0], 1.0), [0.0], Feedback(50.0, 0.0), ticks=3
        ),
        "feedback P = 50, D = 0 s: unstable, grows",
    ),
    "a root in common": (
        lambda: made([1.0, 1.0], [1.0, 3.0, 2.0]),
        "both have the root -1 rad/s: it is not controllable or not observable",
    ),
    "a mode in common": (lambda: made([1.0, 0.0, 4.0], [1.0, 1.0, 4.0, 4.0]), "both have the root"),
    "poles beyond numbers": (lambda: made([1.0], [1e-300, 0.0, 1.0]), "must be up to 1e+12 rad/s"),
    "states beyond numbers": (
        lambda: LinearPlant([[-1e200]], [1.0], [1.0]),
        "a = [[-1e+200]]: must be finite, up to",
    ),
    "two modes in one, off": (
        lambda: detuned(made([1.0], [1.0, 0.0, 2.0, 0.0, 1.0]), 1.1),
        "cannot be told apart",
    ),
    "a plant off by nothing": (lambda: detuned(OSCILLATOR, 0.0), "frequency_ratio = 0.0: must be finite"),
    "numerator of higher power": (lambda: made([1.0, 0.0, 0.0], [1.0, 1.0]), "no higher power of s"),
    "no denominator": (lambda: made([1.0], [2.0]), "no higher power of s"),
    "coefficient without end": (lambda: made([math.nan], [1.0, 1.0]), "must be finite"),
    "shapes": (lambda: LinearPlant([[0.0]], [1.0, 2.0], [1.0]), "plant of shapes"),
    "too many states": (lambda: made([1.0], [1.0] * 22), "plant of 21 states: must have 1 to 20"),
    "command without values": (lambda: Command(0.1, [], 1.0), "command of shape (0,)"),
    "command without end": (lambda: Command(0.1, [math.inf], 1.0), "every value must be finite"),
    "command without a tick": (lambda: Command(0.0, [1.0], 1.0), "tick_s = 0.0"),
    "other hold": (
        lambda: output_at_ticks(OSCILLATOR, Command(0.1, [1.0], 1.0, "first-order")),
        "only zero-order commands are simulated",
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_it_is_refused_with_its_cause(name):
    work, message = CASES[name]
    with pytest.raises(DesignError, match=re.escape(message)):
        work()
