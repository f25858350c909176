"""What `build` says of a motion profile: to people, in JSON, at the head of the code. Not for: making it."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from swayless.cli.console import counted, per_cent

if TYPE_CHECKING:
    from swayless.codegen.profile_model import ProfileOrigin
    from swayless.controller.profile import Pieces
    from swayless.machine.profile_design import ProfileDesign


def profile_origin(design: ProfileDesign, text: str) -> ProfileOrigin:
    """Say where generated code comes from, and what was proved of it.

    Parameters
    ----------
    design : ProfileDesign
    text : str
        Its stored file.
    """
    from swayless.codegen.profile_model import ProfileOrigin

    move, promise = design.move, design.guarantee
    robust = f", robust of order {move.robustness.order}" if move.robustness.order else ""
    off = _where_off(design)
    facts = (
        f"Design: {move.start:.6g} to {move.target:.6g}{robust}, {move.command.hold} hold; SHA-256:",
        hashlib.sha256(text.encode("ascii")).hexdigest(),
        f"Proved with these numbers: a move leaves at most {promise.final_error_ratio:g} of each state's"
        " largest,",
        f"an abort at any tick {_after_aborts(design):g}{off}.",
        f"Limits are kept. {_where_stops_rest(design)}",
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
    settings, promise = design.settings, design.guarantee
    return {
        "design": origin,
        "number": settings.number.name,
        "tick_s": settings.tick_s,
        "ticks": settings.pieces.ticks,
        "stop_ticks": settings.rest_ticks,
        "stop_rests_at": list(settings.extremes.rest),
        "limit": list(settings.limits),
        "hold_ratio": settings.hold_ratio,
        "max_travel": settings.max_travel,
        "robust_order": design.move.robustness.order,
        "split_ratio": design.move.robustness.split_ratio,
        "guarantee": {
            "final_error_ratio": promise.final_error_ratio,
            "stop_error_ratio": promise.stop_error_ratio,
        },
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
    at_rest = f"at rest at most {counted(settings.rest_ticks, 'tick')} after an abort"
    yield f"{design.name}: {lasts}; {at_rest}"
    yield _table_line("table", settings.pieces, design.table_bytes)
    if settings.stop is None:
        yield "stop: none, the end of the move is always sooner"
    else:
        yield _table_line("stop", settings.stop.pieces, design.stop_bytes)
    share = per_cent(_largest_input_ratio(design))
    yield (
        f"proved: a move leaves at most {promise.final_error_ratio:g} of each state's largest, an abort at"
        f" any tick {_after_aborts(design):g}{_where_off(design)}; both take up to {share} of the limits"
    )
    if settings.stop is not None:
        yield _where_stops_rest(design)[:-1]
    if origin != "new":
        yield f"design: {origin}"


def _where_off(design: ProfileDesign) -> str:
    """Say for which plant the promise is, where poles were split: the nominal one swings a little."""
    split = design.move.robustness.split_ratio
    return "" if split is None else f", where a frequency is {per_cent(split)} off"


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
