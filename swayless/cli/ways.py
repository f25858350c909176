"""How far the crane goes: ways in m, asked of the block's own reference. Not for: printing them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from swayless.controller import CommandShaper, ShaperInput, ShaperOutput, ShaperSettings

MM_PER_M = 1000.0
"""Stop distances of int32 blocks are in mm."""


class Ways(NamedTuple):
    """Ways of the crane, in m: to rest from full speed, released or by a quick stop, and of the shortest jog.

    The way of a stop counts from the tick in which the button is released or pressed; the shortest jog is a
    press of full speed for one tick.
    """

    released_m: float
    quick_m: float
    jog_m: float


def ways(settings: ShaperSettings, row: int) -> Ways:
    """Ask the block's own reference for the ways of a row: on the longest rope, where the arm is slowest.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    row : int
        Position of the selector.
    """
    from swayless.controller import CommandShaper

    shaper, full = CommandShaper(settings), held(settings, row, settings.limits.max_command)
    shaper.step(full._replace(command=settings.number.scalar(0)))
    first = shaper.step(full)
    steady = settled(shaper, settings, full)
    quick = shaper.step(full._replace(quick_stop=True))
    return Ways(
        released_m=still_to_go_m(settings, steady),
        quick_m=still_to_go_m(settings, quick) + way_of_tick_m(settings, quick),
        jog_m=still_to_go_m(settings, first) + way_of_tick_m(settings, first),
    )


def held(settings: ShaperSettings, row: int, command: Any) -> ShaperInput:
    """Give the inputs of a command that is held in a row: on a rope of the row, where the arm is slowest.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    row : int
        Row that is to shape it.
    command : float or int
        In command units.
    """
    from swayless.machine.functions import undisturbed

    selector, rope, by_rope = row, _slowest(settings), settings.bank.by_rope
    if by_rope is not None and row > 0:  # where its neighbours do not hold: their ends overlap
        selector, rope = 1, _middle(settings, by_rope.lower[row - 1], by_rope.upper[row - 1])
    return undisturbed(settings)._replace(command=command, selector=selector, rope_length=rope)


def _middle(settings: ShaperSettings, low: Any, high: Any) -> Any:
    return (low + high) // 2 if settings.number.is_integer else (low + high) / settings.number.scalar(2)


def settled(shaper: CommandShaper, settings: ShaperSettings, inputs: ShaperInput) -> ShaperOutput:
    """Hold inputs until the reference rests where they want it, and give the outputs then.

    Parameters
    ----------
    shaper : CommandShaper
        At any moment; it is stepped.
    settings : ShaperSettings
        Its constants.
    inputs : ShaperInput
        What is held.
    """
    for _ in range(_ticks_to_settle(settings)):
        output = shaper.step(inputs)
    return output


def _ticks_to_settle(settings: ShaperSettings) -> int:
    """Give the ticks after which any change has settled: one that waits, then its ramp and its taps."""
    limits = settings.limits
    ramp_ticks = int(limits.max_command / min(limits.acceleration_step, limits.deceleration_step)) + 2
    return ramp_ticks + 2 * settings.longest_delay_ticks + 2


def _slowest(settings: ShaperSettings) -> Any:
    """Rope, or position, at which the shaping takes longest; 0 where nothing is measured."""
    from swayless.controller.spaced_taps import SpacedTaps

    taps = settings.bank.rows[0].taps
    if isinstance(taps, SpacedTaps):
        spacing = taps.spacing
        return spacing.starts[spacing.ticks.index(spacing.most)]
    return 0 if settings.rope is None else settings.rope.longest


def still_to_go_m(settings: ShaperSettings, output: ShaperOutput) -> float:
    """Give the stop distance of an output in m."""
    return float(output.stop_distance) / (MM_PER_M if settings.number.is_integer else 1.0)


def way_of_tick_m(settings: ShaperSettings, output: ShaperOutput) -> float:
    """Give the way of the tick of an output in m."""
    return float(output.reference) / settings.limits.units_per_m_s * settings.tick_s


class EndWays(NamedTuple):
    """Ways that switches need, in m: the largest of any row.

    Parameters
    ----------
    to_slow_m : float or None
        From full speed to the slow one, once the slow-down switch is made; None without one.
    stop_m : float
        From the speed at which the stop switch is made to rest: the slow speed if there is one.
    """

    to_slow_m: float | None
    stop_m: float


def step_ways_m(settings: ShaperSettings) -> tuple[float, ...]:
    """Give the exact ways of the three steps, to the nearest double.

    Parameters
    ----------
    settings : ShaperSettings
        A block with steps.
    """
    from fractions import Fraction

    from swayless.controller.number import as_written

    steps = settings.operator.steps
    assert steps is not None  # noqa: S101 - asked for by the caller
    sums_per_m = as_written(settings.limits.units_per_m_s) / as_written(settings.tick_s)
    whole = settings.number.is_integer
    return tuple(float(Fraction(int(size) if whole else float(size)) / sums_per_m) for size in steps.sizes)


def end_ways(settings: ShaperSettings) -> EndWays:
    """Ask the reference how far the crane goes once a switch is made.

    Parameters
    ----------
    settings : ShaperSettings
        A block with switches.
    """
    slow = settings.operator.slow_command
    rows = range(1, len(settings.bank.rows) + 1)
    found = [_way_to_slow_m(settings, row, slow) for row in rows] if slow is not None else []
    return EndWays(max(found, default=None), _stop_way_m(settings, slow))


def _way_to_slow_m(settings: ShaperSettings, row: int, slow: Any) -> float:
    """Way from full speed until the reference is the slow speed, for good."""
    from swayless.controller import CommandShaper

    shaper, full = CommandShaper(settings), held(settings, row, settings.limits.max_command)
    shaper.step(full._replace(command=settings.number.scalar(0)))
    settled(shaper, settings, full)
    slowed = full._replace(slow_forward=True)
    outputs = [shaper.step(slowed) for _ in range(_ticks_to_settle(settings))]
    faster = [tick for tick, output in enumerate(outputs) if output.reference != slow]
    return sum(way_of_tick_m(settings, output) for output in outputs[: max(faster, default=-1) + 1])


def _stop_way_m(settings: ShaperSettings, slow: Any) -> float:
    """Way of a quick stop from the slow speed, or from full speed where there is none."""
    from swayless.controller import CommandShaper

    speed = settings.limits.max_command if slow is None else slow
    shaper, steady = CommandShaper(settings), held(settings, 1, speed)
    shaper.step(steady._replace(command=settings.number.scalar(0)))
    settled(shaper, settings, steady)
    stopping = shaper.step(steady._replace(quick_stop=True))
    return still_to_go_m(settings, stopping) + way_of_tick_m(settings, stopping)
