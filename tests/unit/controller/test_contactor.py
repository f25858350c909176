"""Two-speed and on-off pendants: the reference is 0, slow or fast, ever."""

import numpy as np
import pytest

from swayless.controller import CommandShaper, Status
from tests.properties.strategies import NUMBERS
from tests.unit.controller.blocks import UM_ZV, block, command_of, run
from tests.unit.controller.operator_blocks import hands_off, metres, operated, travelled_m

UM_LONG = ((0, 1.0), (5, -1.0), (9, 1.0))
UNRAMPED = {"acceleration_m_s2": None, "deceleration_m_s2": None, "quick_stop_m_s2": None}

every_number = pytest.mark.parametrize("number", NUMBERS)
every_pendant = pytest.mark.parametrize("speeds", [(0.5,), (0.1, 0.5)])


def contactor_block(number, speeds, **options):
    """Two rows of a drive behind contactors."""
    return operated(block(UM_ZV, UM_LONG, number=number, **UNRAMPED), contactor_speeds_m_s=speeds, **options)


@every_number
@every_pendant
def test_the_reference_is_one_that_the_drive_knows_whatever_is_done(number, speeds):
    settings = contactor_block(
        number, speeds, stop_switches=True, slow_speed_m_s=speeds[0], limit_margin_m=0.0
    )
    random, shaper = np.random.default_rng(6), CommandShaper(settings)
    known = {0.0} | {sign * float(c) for c in settings.operator.contactor_commands for sign in (1, -1)}
    seen = set()
    for _ in range(400):
        now = hands_off(
            settings,
            command=command_of(settings, random.choice([0.0, 0.1, 0.2, 0.3, 1.0, -1.0, -0.25, 1.4])),
            selector=int(random.integers(0, 3)),
            distance_forward=metres(settings, random.choice([0.0, 0.3, 2.0, 20.0])),
            **{name: bool(random.random() < 0.05) for name in ("stop_forward", "slow_forward", "quick_stop")},
        )
        seen |= {float(out.reference) for out in run(shaper, [now] * int(random.integers(1, 25)))}
    assert seen == known


@every_number
def test_a_command_counts_as_the_largest_speed_that_is_not_above_it(number):
    settings = contactor_block(number, (0.1, 0.5))
    slow, fast = settings.operator.contactor_commands
    for ratio, expected in ((0.19, 0), (0.2, slow), (0.99, slow), (1.0, fast), (-0.5, -slow), (-1.0, -fast)):
        out = run(CommandShaper(settings), [hands_off(settings, command=command_of(settings, ratio))] * 30)[
            -1
        ]
        assert out.reference == expected
        assert bool(out.status & Status.BELOW_MINIMUM) == (expected == 0)


@every_number
@every_pendant
def test_a_speed_below_the_slowest_is_a_0_that_releases_stops(number, speeds):
    settings = contactor_block(number, speeds)
    shaper = CommandShaper(settings)
    run(shaper, [hands_off(settings, emergency_stop=True)])
    out = shaper.step(hands_off(settings, command=command_of(settings, 0.1)))
    assert not out.status & Status.EMERGENCY_STOP


@every_number
def test_before_an_end_the_slow_speed_goes_on_where_the_fast_one_may_not(number):
    settings = contactor_block(number, (0.1, 0.5), limit_margin_m=0.0)
    shaper, place_m, seen = CommandShaper(settings), 0.0, []
    for _ in range(900):
        left = metres(settings, max(0.2 - place_m, 0.0))
        out = shaper.step(hands_off(settings, command=settings.limits.max_command, distance_forward=left))
        place_m += travelled_m(settings, [out])
        seen.append(float(out.reference))
    slow = float(settings.operator.contactor_commands[0])
    assert set(seen) == {0.0, slow}
    assert 0.2 - place_m >= -2e-3
    # What is left is less than the shortest slow move: on for the settling time, and one tick.
    assert 0.2 - place_m <= 0.1 * settings.tick_s * (settings.longest_delay_ticks + 2)
