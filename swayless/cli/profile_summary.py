"""What `build` says of a motion profile: to people, in JSON, at the head of the code. Not for: making it."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterator
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from swayless.cli.console import counted, per_cent

if TYPE_CHECKING:
    from swayless.codegen.profile_model import ProfileOrigin
    from swayless.controller.profile import Pieces
    from swayless.machine.profile_design import ProfileDesign


NOTED_ERROR_RATIO = 1e-3
"""What is left of a state and worth a note."""


def profile_origin(design: ProfileDesign, text: str) -> ProfileOrigin:
    """Say where generated code comes from, and what was proved of it.

    Parameters
    ----------
    design : ProfileDesign
    text : str
        Its stored file.
    """
    from swayless.codegen.profile_model import ProfileOrigin

    move = design.move
    facts = (
        f"Design: {move.start:.6g} to {move.target:.6g}{_asked(design)}, {move.command.hold} hold; SHA-256:",
        hashlib.sha256(text.encode("ascii")).hexdigest(),
        f"Proved with these numbers{_where_off(design)}: the move of the design leaves at most",
        f"{design.guarantee.final_error_ratio:g} of each state's largest, an abort at any tick of it"
        f" {_after_aborts(design):g}.",
        *(f"{sentence}." for sentence in _swings(design)),
        f"{_rounding(design)}.",
        f"Limits are kept{_rate_kept(design)}. {_where_stops_rest(design)}",
    )
    return ProfileOrigin(design.name, design.generator, design.source, facts, (move.start, move.target))


def profile_facts(design: ProfileDesign, origin: str) -> dict[str, Any]:
    """Give what is known of a block, for machines.

    Parameters
    ----------
    design : ProfileDesign
    origin : str
        How it stands to the stored one.
    """
    settings = design.settings
    return {
        "design": origin,
        "number": settings.number.name,
        "tick_s": settings.tick_s,
        "ticks": settings.pieces.ticks,
        "rest_ticks": settings.rest_ticks,
        "stop_rests_at": list(settings.extremes.rest),
        "limit": list(settings.limits),
        "hold_ratio": settings.hold_ratio,
        "max_travel": settings.max_travel,
        "robust_order": design.move.robustness.order,
        "split_ratio": design.move.robustness.split_ratio,
        "rate_limit_per_s": design.move.rate_limit_per_s,
        "guarantee": asdict(design.guarantee),
        "largest_input_ratio": _largest_input_ratio(design),
        "table": _table(settings.pieces, design.table_bytes),
        "stop_table": settings.stop and _table(settings.stop.pieces, design.stop_bytes),
    }


def profile_lines(design: ProfileDesign, origin: str) -> Iterator[str]:
    """Say what is known of a block to people, line by line.

    Parameters
    ----------
    design : ProfileDesign
    origin : str
        How it stands to the stored one.
    """
    settings, promise = design.settings, design.guarantee
    ticks, tick_s = settings.pieces.ticks, settings.tick_s
    lasts = f"a move in {counted(ticks, 'tick')} of {tick_s:g} s, {ticks * tick_s:.6g} s"
    rest_s = f"{settings.rest_ticks * tick_s:.6g} s"
    at_rest = f"at rest at most {counted(settings.rest_ticks, 'tick')}, {rest_s}, after an abort"
    yield f"{design.name}: {lasts}; {at_rest}"
    yield _table_line("table", settings.pieces, design.table_bytes)
    if settings.stop is None:
        yield "stop: none would be much sooner than the end of the move"
    else:
        yield _table_line("stop", settings.stop.pieces, design.stop_bytes)
    share = per_cent(_largest_input_ratio(design))
    yield (
        f"proved{_where_off(design)}: the move of the design leaves at most {promise.final_error_ratio:g} of"
        f" each state's largest, an abort at any tick of it {_after_aborts(design):g}; both take up to"
        f" {share} of the limits{_rate_kept(design)}"
    )
    yield from _swings(design)
    yield _rounding(design)
    if _after_aborts(design) > NOTED_ERROR_RATIO:
        yield _much_is_left(design)
    if settings.stop is not None:
        yield _where_stops_rest(design)[:-1]
    if origin != "new":
        yield f"design: {origin}"


def _asked(design: ProfileDesign) -> str:
    """Say what the command was asked to keep or to be robust against."""
    order, split = design.move.robustness.order, design.move.robustness.split_ratio
    rate = design.move.rate_limit_per_s
    robust = f", robust of order {order}" if order else ""
    return (
        robust
        + ("" if split is None else f", ei {per_cent(split)}")
        + ("" if rate is None else f", rate limit {rate:.6g} a second")
    )


def _where_off(design: ProfileDesign) -> str:
    """Say for which plants the promise is, where poles were split."""
    split = design.move.robustness.split_ratio
    return "" if split is None else f" where frequencies are {per_cent(split)} off"


def _swings(design: ProfileDesign) -> Iterator[str]:
    """Say what the plant keeps that is as it was given, where poles were split."""
    move, stop = design.guarantee.final_swing_ratio, design.guarantee.stop_swing_ratio
    if move is not None and stop is not None:
        after = f"{per_cent(move)} of the travel, after an abort {per_cent(max(move, stop))}"
        yield f"The plant as given swings then by up to {after}"


def _rounding(design: ProfileDesign) -> str:
    """Say what other moves may leave."""
    return (
        f"Another start or travel T adds at most {design.guarantee.rounding_gain:g} R / |T|, R its largest"
        " reference"
    )


def _rate_kept(design: ProfileDesign) -> str:
    """Say how strictly the limit of the rate is kept, where there is one."""
    excess = design.guarantee.rate_excess_ratio
    if excess is None:
        return ""
    return ", that of the rate too" if excess == 0.0 else f", that of the rate to {excess:g} of itself"


def _much_is_left(design: ProfileDesign) -> str:
    """Say that a promise is a large one, and what to do."""
    more = "; use double" if design.settings.number.name == "float" else ""
    return f"note: {per_cent(_after_aborts(design))} of the largest is much, the plant hardly rests{more}"


def _after_aborts(design: ProfileDesign) -> float:
    """Promise of all ways to rest after an abort: a stop, or the end of the move."""
    return max(design.guarantee.final_error_ratio, design.guarantee.stop_error_ratio)


def _where_stops_rest(design: ProfileDesign) -> str:
    """Say where a stop comes to rest, rounded outward."""
    low, high = design.settings.extremes.rest
    if design.settings.stop is None:
        return "There are no stops: the end of the move is sooner."
    return (
        f"A stop rests at {math.floor(1e3 * low) / 1e3:g} to {math.ceil(1e3 * high) / 1e3:g} of the travel."
    )


def _table_line(what: str, pieces: Pieces, sizes: tuple[int, int]) -> str:
    form = "plain values" if pieces.is_raw else f"polynomials of degree {pieces.degree}"
    size = f"{counted(sizes[1], 'byte')} instead of {sizes[0]:,}"
    return f"{what}: {counted(pieces.lengths.size, 'piece')}, {form}: {size}"


def _table(pieces: Pieces, sizes: tuple[int, int]) -> dict[str, int]:
    return {
        "pieces": int(pieces.lengths.size),
        "degree": pieces.degree,
        "bytes": sizes[1],
        "plain_bytes": sizes[0],
    }


def _largest_input_ratio(design: ProfileDesign) -> float:
    """Largest share of the limits that the design's move, or a stop of it, takes: 1 at a limit."""
    import numpy as np

    low, high = design.settings.limits
    inputs = design.numbered.references(np.array(design.settings.extremes.shape))
    return float(np.abs(inputs - 0.5 * (low + high)).max() / (0.5 * (high - low)))
