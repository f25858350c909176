"""What a limit of the rate leaves: the longest travel, and by how much rounding may exceed the limit.

A step of the reference is that of the shape, times the travel, and rounding: two references are rounded to
the number type, and at rest the one that holds the plant. Not for: limits of the reference itself.
"""

from __future__ import annotations

from swayless.controller.profile.compression import TOLERANCE_RATIO
from swayless.controller.profile.settings import LARGEST_POSITION
from swayless.errors import DesignError
from swayless.machine.profile_design_numbers import NumberedMove
from swayless.machine.profile_design_proof import ProfileProof

LARGEST_EXCESS_RATIO = 1e-3
"""Of the limit: more is no rounding of a move at its limit."""

_ROUNDINGS = 8.0
"""In a step, of the largest reference. The step into rest after a stop has most: 3 of the stop's last
reference, a sum with a product of up to twice its size; 5 of those that hold the plant before and after.
"""


def longest_travel(numbered: NumberedMove, proof: ProfileProof) -> float:
    """Give the longest travel that keeps the limit of the rate; that of the design, if it is at the limit."""
    change = numbered.largest_change
    if change is None:
        return LARGEST_POSITION
    fixed, per_travel = _rounding(numbered, proof)
    # A little less: this is a sum and a product too.
    travel = (change - fixed) / (proof.largest_step + per_travel) * (1.0 - 2.0**-50)
    return max(numbered.rounded_down(min(travel, LARGEST_POSITION)), abs(numbered.travel))


def rate_excess_ratio(numbered: NumberedMove, proof: ProfileProof, travel: float) -> float:
    """Give by how much a travel may exceed the limit of the rate, as a share of the limit; 0 if it does not.

    Parameters
    ----------
    numbered : NumberedMove
    proof : ProfileProof
    travel : float
        > 0.
    """
    change = numbered.largest_change
    if change is None:
        return 0.0
    fixed, per_travel = _rounding(numbered, proof)
    return max(0.0, (travel * (proof.largest_step + per_travel) + fixed) / change - 1.0)


def check_rate(numbered: NumberedMove, proof: ProfileProof) -> None:
    """Refuse a limit of the rate that drowns in the rounding of references.

    Raises
    ------
    DesignError
        With what rounding takes, and what may be done.
    """
    excess = rate_excess_ratio(numbered, proof, abs(numbered.travel))
    if excess > LARGEST_EXCESS_RATIO:
        low, high = numbered.limits
        fixed, _ = _rounding(numbered, proof)
        raise DesignError(
            f"rate_limit = {numbered.move.rate_limit_per_s!r}: in {numbered.number.name} references up to"
            f" {max(-low, high):g} are rounded, which takes up to {fixed:.2g} of a change of"
            f" {numbered.largest_change:.6g} a tick: it could be exceeded by {excess:.2g} of itself, at most"
            f" {LARGEST_EXCESS_RATIO:g} is allowed; set limits nearer to what the move takes, or use double"
        )


def keeps_rate(numbered: NumberedMove, proof: ProfileProof) -> bool:
    """Whether the design's own move keeps the limit, but for rounding of its shape."""
    change = numbered.largest_change
    rounding = 8.0 * TOLERANCE_RATIO[numbered.number.name] * proof.largest_shape
    return change is None or abs(numbered.travel) * (proof.largest_step - rounding) <= change


def _rounding(numbered: NumberedMove, proof: ProfileProof) -> tuple[float, float]:
    """Give what rounding adds to a step at most: always, and per unit of travel."""
    unit = 2.0**-numbered.number.significand_bits
    if numbered.hold_ratio == 0.0:  # a reference is one product
        return 0.0, 2.0 * unit * proof.largest_shape
    return _ROUNDINGS * unit * max(abs(limit) for limit in numbered.limits), 0.0
