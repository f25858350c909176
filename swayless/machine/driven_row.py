"""Rows of a crane whose speed loop feels the load: designed for the true mode, proved on every rope.

The damping ratio changes with the rope. ``si`` holds a range of them; other families are designed for one,
and for a tolerance smaller by what the damping of other ropes adds, until the ropes promised leave no more
than was asked. Not for: the modes (`swayless.plant.ropes`) or banks (`swayless.machine.driven_bank`).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from swayless.design import GridShaper, Shaper
from swayless.design.along_ropes import HeldRopes, held_ropes, highest_hump, residual_on_ropes, worst_on_ropes
from swayless.errors import DesignError
from swayless.machine.design_document import ShaperRecord
from swayless.machine.robust_row import RobustRow
from swayless.machine.row_design import RowDesign, design_of
from swayless.machine.row_section import Row
from swayless.machine.shaper_record import shaper_record
from swayless.machine.true_row import true_row
from swayless.plant import DrivenRopes

MARGIN = 1e-5
"""Of the tolerance: kept free on the ropes promised, for amplitudes in narrower number types."""

ROUNDS = 8
"""Of tolerances to design for, until what was asked is left at the most."""

OVER = 1e-4
"""Relative: a tolerance to design for is lowered by this more than what was too much."""


@dataclass(frozen=True, eq=False)
class DrivenDesign:
    """A row for a driven trolley.

    Parameters
    ----------
    row : RowSection or RobustRow
        What was asked for, at the true modes.
    design : RowDesign
        Its shaper and taps, for a tolerance that may be smaller than the row's.
    held : tuple of HeldRopes
        Ropes on which shaper and taps leave no more than the row's tolerance, each rope at its own mode.
    """

    row: Row
    design: RowDesign
    held: tuple[HeldRopes, ...]


def design_driven_row(row: Row, ropes: DrivenRopes, *, tick_s: float | None, contactor: bool) -> DrivenDesign:
    """Design a row for the true modes of its ropes.

    Parameters
    ----------
    row : RowSection or RobustRow
        As the file describes it.
    ropes : DrivenRopes
        Of the machine.
    tick_s : float or None
        Length of a tick; None leaves the design in continuous time.
    contactor : bool
        Whether the drive knows only 0 and full speed.

    Raises
    ------
    DesignError
        If there is no such shaper, or the tick is too coarse.
    """
    own, true = replace(ropes, damping_ratio=row.damping_ratios[0]), true_row(row, ropes)
    assert row.rope_range_m is not None  # noqa: S101 - checked when the file was read
    if isinstance(true, RobustRow) and true.family == "si":
        return _held_as_asked(true, own, design_of(true, tick_s=tick_s, contactor=contactor))
    if isinstance(true, RobustRow):
        undamped = replace(true, damping_ratios=(0.0, 0.0))  # about as wide, and soon found
        true = _at_its_middle(true, own, design_of(undamped, tick_s=None, contactor=contactor).shaper)
    rope_m, allowed, aim = row.rope_range_m[1], true.tolerance * (1.0 - MARGIN), true.tolerance
    for _ in range(ROUNDS):
        design = design_of(replace(true, tolerance=aim), tick_s=tick_s, contactor=contactor)
        over = max(_worst_near(impulses, own, rope_m) for impulses in impulses_of(design)) / allowed
        if over <= 1.0:
            held = [held_ropes(made, own, rope_m, tolerance=allowed) for made in impulses_of(design)]
            return DrivenDesign(true, design, tuple(held))
        aim /= over * (1.0 + OVER)
    raise DesignError(
        f"no tolerance to design for leaves {100 * true.tolerance:g} % on every rope near {rope_m:.4g} m:"
        " their damping differs too much"
    )


def driven_record(row: Row, design: DrivenDesign) -> ShaperRecord:
    """Make the record of a row for a driven trolley.

    Parameters
    ----------
    row : RowSection or RobustRow
        What was asked for.
    design : DrivenDesign
        What was found.
    """
    record = shaper_record(design.row, design.design)
    promises = [
        replace(
            promise,
            tolerance=row.tolerance,
            rope_length_m=held.range_m,
            worst_residual_ratio=max(promise.worst_residual_ratio, held.worst_residual_ratio),
        )
        for promise, held in zip(record.guarantees.values(), design.held, strict=True)
    ]
    proven = record.guarantee.tolerance == row.tolerance
    return replace(
        record,
        lower_bound_s=record.lower_bound_s if proven else None,
        guarantee=promises[0],
        taps=None if record.taps is None else replace(record.taps, guarantee=promises[-1]),
    )


def _held_as_asked(row: RobustRow, ropes: DrivenRopes, design: RowDesign) -> DrivenDesign:
    """Complete a design that holds bands at every damping ratio, and so all ropes asked for."""
    range_m = row.rope_range_m
    assert range_m is not None  # noqa: S101 - checked when the file was read
    held = [HeldRopes(range_m, worst_on_ropes(made, ropes, range_m)) for made in impulses_of(design)]
    return DrivenDesign(row, design, tuple(held))


def _at_its_middle(row: RobustRow, ropes: DrivenRopes, shaper: Shaper) -> RobustRow:
    """Give a row the damping ratio in the middle of what its shaper holds."""
    band = shaper.guarantee.band
    near = ropes.damping_near(math.sqrt(band.low_hz * band.high_hz))
    return replace(row, damping_ratios=(near, near))


def impulses_of(design: RowDesign) -> Iterator[Shaper | GridShaper]:
    """Give the shaper of a design, and its taps where there is a tick."""
    yield design.shaper
    if design.taps is not None:
        yield design.taps


def _worst_near(impulses: Shaper | GridShaper, ropes: DrivenRopes, rope_m: float) -> float:
    """Find the most that is left on the rope of a row, or at a maximum among the ropes of its band."""
    here = float(residual_on_ropes(impulses, ropes, np.array(rope_m)))
    return max(here, highest_hump(impulses, ropes, rope_m, impulses.guarantee.band))
