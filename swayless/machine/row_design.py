"""From what a row asks for to its shaper, and to its taps where there is a tick.

Not for: the mathematics (`swayless.design`), nor for storing what is found (`swayless.machine.designing`).
"""

from __future__ import annotations

from dataclasses import dataclass

from swayless.design import GridShaper, Guarantee, Shaper, design_shaper, solve_on_grid
from swayless.design.robust.demand import TOLERANCES
from swayless.design.robust.specified import RobustDesign, fixed_duration, specified_insensitivity
from swayless.design.robust.ticks import (
    RobustTaps,
    fixed_duration_on_ticks,
    specified_insensitivity_on_ticks,
)
from swayless.design.robust.whole_ticks import whole_tick_taps
from swayless.machine.robust_row import RobustRow
from swayless.machine.row_section import Row, RowSection


@dataclass(frozen=True, eq=False)
class RowDesign:
    """A designed row.

    Parameters
    ----------
    shaper : Shaper
        In continuous time.
    taps : GridShaper or None
        On the ticks of the controller, where there is one.
    lower_bound_s : float or None
        Duration proved too short for any shaper that holds as much; None where nothing is proved.
    """

    shaper: Shaper
    taps: GridShaper | None
    lower_bound_s: float | None

    @property
    def promise(self) -> Guarantee:
        """What runs holds this."""
        return (self.shaper if self.taps is None else self.taps).guarantee


def design_of(row: Row, *, tick_s: float | None, contactor: bool) -> RowDesign:
    """Design a row.

    Parameters
    ----------
    row : RowSection or RobustRow
        What is asked for.
    tick_s : float or None
        Length of a tick; None leaves the design in continuous time.
    contactor : bool
        Whether the drive knows only 0 and full speed: then taps are +1 and -1 on whole ticks.

    Raises
    ------
    DesignError
        If there is no such shaper, or the tick is too coarse.
    """
    if isinstance(row, RowSection):
        return _named(row, tick_s, contactor=contactor)
    if tick_s is None or (row.amplitudes == "unity-magnitude" and not contactor):
        return robust_design(_ideal(row), tick_s)
    return robust_design(_on_ticks(row, tick_s), tick_s)


def robust_design(made: RobustDesign | RobustTaps, tick_s: float | None) -> RowDesign:
    """Complete a robust design: on ticks, where it is not there yet.

    Unity-magnitude impulses lie between ticks. A drive that can make levels between 0 and full speed follows
    them by levels that last a tick: by bounded taps that hold the same, or the smallest tolerance.
    """
    if isinstance(made, RobustTaps):
        return RowDesign(made.ideal.shaper, made.taps, made.ideal.lower_bound_s)
    taps, held = None, made.shaper.guarantee
    if tick_s is not None:
        taps = specified_insensitivity_on_ticks(
            held.bands,
            tick_s,
            tolerance=max(held.tolerance, TOLERANCES[0]),
            damping_ratio=held.damping_ratios,
            amplitudes="bounded",
        ).taps
    return RowDesign(made.shaper, taps, made.lower_bound_s)


def _named(row: RowSection, tick_s: float | None, *, contactor: bool) -> RowDesign:
    shaper = design_shaper(
        row.family, row.mode, tolerance=row.tolerance, order=row.order, delay_s=row.delay_s
    )
    if tick_s is None:
        return RowDesign(shaper, None, None)
    solve = whole_tick_taps if contactor else solve_on_grid
    return RowDesign(shaper, solve(shaper, tick_s), None)


def _ideal(row: RobustRow) -> RobustDesign:
    if row.duration_s is None:
        return specified_insensitivity(
            row.bands,
            tolerance=row.tolerance,
            damping_ratio=row.damping_ratios,
            amplitudes=row.amplitudes,
            impulses=row.impulses,
        )
    return fixed_duration(
        row.duration_s,
        row.bands[0].low_hz,
        tolerance=row.tolerance,
        damping_ratio=row.damping_ratios[0],
        amplitudes=row.amplitudes,
        impulses=row.impulses,
    )


def _on_ticks(row: RobustRow, tick_s: float) -> RobustTaps:
    if row.duration_s is None:
        return specified_insensitivity_on_ticks(
            row.bands,
            tick_s,
            tolerance=row.tolerance,
            damping_ratio=row.damping_ratios,
            amplitudes=row.amplitudes,
            impulses=row.impulses,
        )
    return fixed_duration_on_ticks(
        row.duration_s,
        row.bands[0].low_hz,
        tick_s,
        tolerance=row.tolerance,
        damping_ratio=row.damping_ratios[0],
        amplitudes=row.amplitudes,
        impulses=row.impulses,
    )
