"""What is promised of a motion profile, from what was proved of it. Not for: proving it."""

from __future__ import annotations

import math
from dataclasses import astuple, dataclass, fields

from swayless.design.playing import noise_gain
from swayless.machine.profile_design_numbers import NumberedMove
from swayless.machine.profile_design_proof import ProfileProof
from swayless.machine.profile_design_rate import longest_travel, rate_excess_ratio

_STEPS = (1.0, 2.0, 5.0, 10.0)
_LEAST_PROMISE = 1e-12
_MORE = 100.0  # times: what another mathematical library may find of errors that are rounding
_INPUT_ROUNDINGS, _REST_ROUNDINGS = 3.0, 8.0


@dataclass(frozen=True)
class ProfileGuarantee:
    """What is promised of a block; proved for the numbers that run.

    Parameters
    ----------
    final_error_ratio : float
        How far the states may be from rest at the end of the move of the design, each of its largest in it.
    stop_error_ratio : float
        The same, after a stop from any tick; 0 where there are no stops.
    rounding_gain : float
        What rounding of references adds in other moves: at most so many times R / T, R the largest reference
        in size, T the travel, in the units of the design.
    rate_excess_ratio : float or None
        By how much the limit of the rate may be exceeded, as a share of it: 0 where it is kept strictly, else
        rounding of a move that is at the limit. None where the rate has no limit.
    final_swing_ratio, stop_swing_ratio : float or None
        Where poles are split, the states rest where frequencies are off by the split. The position of the
        plant as it is given swings by so much of the travel after the move, and after the worst stop.
    """

    final_error_ratio: float
    stop_error_ratio: float
    rounding_gain: float
    rate_excess_ratio: float | None = None
    final_swing_ratio: float | None = None
    stop_swing_ratio: float | None = None


def guaranteed(numbered: NumberedMove, proof: ProfileProof, has_stop: bool) -> ProfileGuarantee:
    """Give the promise that a proof allows.

    Parameters
    ----------
    numbered : NumberedMove
    proof : ProfileProof
    has_stop : bool
        Whether there are stops to promise anything of.
    """
    found = _found(numbered, proof)
    excess, swing, stop_swing = found.rate_excess_ratio, found.final_swing_ratio, found.stop_swing_ratio
    return ProfileGuarantee(
        promised(found.final_error_ratio),
        promised(found.stop_error_ratio) if has_stop else 0.0,
        outward(found.rounding_gain),
        excess and promised(excess),
        swing and outward(swing),
        stop_swing and outward(stop_swing),
    )


def broken_promises(
    promise: ProfileGuarantee, numbered: NumberedMove, proof: ProfileProof, has_stop: bool
) -> list[tuple[str, str]]:
    """Give the key and the reason of every promise that is not kept, or that is not what was proved."""
    found, fresh = _found(numbered, proof), guaranteed(numbered, proof, has_stop)
    problems = []
    for field, is_, proved, best in zip(
        fields(promise), astuple(promise), astuple(found), astuple(fresh), strict=True
    ):
        more = _MORE if field.name.endswith("error_ratio") else 1.2  # else two digits, rounded up
        if (is_ is None) != (best is None):
            problems.append((field.name, f"= {is_!r}: must be {best!r}, as proved"))
        elif is_ is not None and not proved <= is_ <= more * best:
            problems.append((field.name, f"promises {is_:g}, what is stored leaves {proved:.3g}"))
    return problems


def _found(numbered: NumberedMove, proof: ProfileProof) -> ProfileGuarantee:
    """Give what was measured."""
    unit = 2.0**-numbered.number.significand_bits
    noise = noise_gain(numbered.model, numbered.shape, _INPUT_ROUNDINGS * unit, _REST_ROUNDINGS * unit)
    limited = numbered.largest_change is not None
    split = numbered.move.robustness.split_ratio is not None
    excess = rate_excess_ratio(numbered, proof, longest_travel(numbered, proof))
    return ProfileGuarantee(
        proof.final_error_ratio,
        proof.stop_error_ratio,
        noise,
        excess if limited else None,
        proof.final_swing_ratio if split else None,
        proof.stop_swing_ratio if split else None,
    )


def promised(measured: float) -> float:
    """Promise an error: the next 1, 2 or 5 of a power of ten above twice what was measured.

    Another mathematical library may measure a little more.

    Examples
    --------
    >>> promised(3.1e-10), promised(1e-16)
    (1e-09, 1e-12)
    """
    least = max(2.0 * measured, _LEAST_PROMISE)
    power = 10.0 ** math.floor(math.log10(least))
    text = next(f"{step * power:.0e}" for step in _STEPS if step * power >= least * (1.0 - 1e-9))
    return float(text)


def outward(measured: float) -> float:
    """Round up to two digits, where nothing is rounding.

    Examples
    --------
    >>> outward(0.03121), outward(0.0), outward(9.99e-9)
    (0.032, 0.0, 1e-08)
    """
    if measured == 0.0:
        return 0.0
    power = 10.0 ** (math.floor(math.log10(measured)) - 1)
    return float(f"{math.ceil(measured / power * (1.0 + 1e-6)) * power:.1e}")
