"""Every table that a block runs on, in the order in which its checksum takes them. Not for: the sums.

Scalars, such as limits and units, and the constants of formulas are no tables. C and Structured Text sum the
same numbers.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import accumulate, chain
from typing import Any

from swayless.controller.checksum import Checksum, Table, checksum, real_table, whole_table
from swayless.controller.diagnostics import DesignFacts
from swayless.controller.hoist import stretches
from swayless.controller.hoist_answers import answers
from swayless.controller.hoist_int32 import IntegerHoist
from swayless.controller.output_units import residual_bounds
from swayless.controller.settings import ShaperSettings
from swayless.controller.spaced_taps import SpacedTaps
from swayless.errors import ControllerError


def tables_of(settings: ShaperSettings) -> tuple[Table, ...]:
    """List the tables of a block.

    Parameters
    ----------
    settings : ShaperSettings
        The block.

    Examples
    --------
    >>> import numpy as np
    >>> from swayless.controller import Bank, Row, SpeedLimits, Taps, command_limits, number_type
    >>> from swayless.design import design_shaper
    >>> from swayless.plant import Mode
    >>> double, held = number_type("double"), design_shaper("zv", Mode(0.5)).guarantee
    >>> zv = Taps(np.array([0, 20]), np.array([0.5, 0.5]), 0.05, held, double)
    >>> limits = command_limits(SpeedLimits(0.5, 0.5), tick_s=0.05, number=double)
    >>> block = ShaperSettings(Bank((Row("sling", "zv", zv),)), limits)
    >>> [(table.name, table.numbers) for table in tables_of(block)][2:5]
    [('lags', (0, 0, 20)), ('amplitudes', (1.0, 0.5, 0.5)), ('tails', (0, 20))]
    """
    return tuple(chain(_of_rows(settings), _of_ropes(settings), _of_diagnostics(settings)))


def design_facts(settings: ShaperSettings, design_id: int) -> DesignFacts:
    """Give a block its identifier and the checksum of its tables, when all else is settled.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    design_id : int
        CRC-32 of the design file.
    """
    return DesignFacts(design_id, _sum_of(settings))


def tables_match(settings: ShaperSettings) -> bool:
    """Whether the tables of a block are those that its facts were made from; without facts they are."""
    facts = settings.diagnostics.facts
    return facts is None or checksum(tables_of(settings)) == facts.checksum


def _sum_of(settings: ShaperSettings) -> Checksum:
    found = checksum(tables_of(settings))
    if found is None:
        raise ControllerError("a table of the block has numbers that no checksum takes")
    return found


def _of_rows(settings: ShaperSettings) -> Iterator[Table]:
    """Rows 0 to n: their taps, one after the other, then a number a row."""
    rows, counts = settings.row_tables, [len(row.lags) for row in settings.row_tables]
    yield whole_table("first taps", [0, *accumulate(counts[:-1])])
    yield whole_table("tap counts", counts)
    yield whole_table("lags", chain.from_iterable(row.lags for row in rows))
    yield _table("amplitudes", chain.from_iterable(row.amplitudes for row in rows), settings)
    yield whole_table("tails", [row.tail for row in rows])
    yield from _moments(settings)
    yield _table("residual bounds", residual_bounds(settings), settings)
    if any(row.waits for row in rows):
        yield whole_table("waits", [row.waits for row in rows])


def _moments(settings: ShaperSettings) -> Iterator[Table]:
    """Moments of rows 0 to n; in int32 their whole ticks, then what is left over 2**30."""
    moments = [row.moment for row in settings.row_tables]
    if not settings.number.is_integer:
        yield _table("moments", [settings.number.scalar(float(moment)) for moment in moments], settings)
        return
    split = [divmod(int(moment * (1 << 30)), 1 << 30) for moment in moments]
    yield whole_table("moments", [whole for whole, _ in split])
    yield whole_table("moments, fractions", [fraction for _, fraction in split])


def _of_ropes(settings: ShaperSettings) -> Iterator[Table]:
    """Give what depends on the rope: limits of rows, spacings, quanta."""
    ropes, taps = settings.bank.by_rope, settings.bank.rows[0].taps
    if ropes is not None:
        yield _table("row lower ends", ropes.lower, settings)
        yield _table("row upper ends", ropes.upper, settings)
    if isinstance(taps, SpacedTaps):
        yield _table("spacing starts", taps.spacing.starts, settings)
        yield whole_table("spacing ticks", taps.spacing.ticks)
    if settings.clock is not None:
        yield whole_table("tick quanta", settings.clock.nodes)
        yield from _of_hoist(settings)


def _of_hoist(settings: ShaperSettings) -> Iterator[Table]:
    """Give what the answer to a hoist takes for each tap of each row."""
    if settings.number.is_integer:
        whole = IntegerHoist(settings, max_scaled=1)
        stretched, answered = whole.stretch, whole.answers
    else:
        scalar = settings.number.scalar
        stretched = tuple(tuple(scalar(each) for each in row) for row in stretches(settings))
        answered = tuple(
            tuple((scalar(e), scalar(n)) for e, n in zip(*a, strict=True)) for a in answers(settings)
        )
    yield _table("stretches", chain.from_iterable(stretched), settings)
    for place, name in enumerate(("answers", "leans")):
        yield _table(name, (pair[place] for pair in chain.from_iterable(answered)), settings)


def _of_diagnostics(settings: ShaperSettings) -> Iterator[Table]:
    """Bounds over the rope, row by row; turns of the swing."""
    bounds, sway = settings.diagnostics.rope_bounds, settings.diagnostics.sway
    if bounds is not None:
        yield whole_table("bound counts", [len(row) for row in bounds.starts])
        yield _table("bound starts", chain.from_iterable(bounds.starts), settings)
        yield _table("rope bounds", chain.from_iterable(bounds.bounds), settings)
    if sway is not None:
        if sway.rope is None:
            for name in ("cosine", "sine", "metres"):
                yield _table(f"turn {name}", [getattr(turn, name) for turn in sway.turns], settings)
        elif settings.clock is None:
            yield whole_table("sway quanta", sway.rope.clock.nodes)


def _table(name: str, numbers: Any, settings: ShaperSettings) -> Table:
    """Make a table in the block's number type."""
    kept = tuple(numbers)
    return whole_table(name, kept) if settings.number.is_integer else real_table(name, kept, settings.number)
