"""Candidates for a machine from the best to the worst, each with the reason why in one sentence.

Not for: designing or measuring them (`candidates`).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from swayless.design.tradeoff.candidates import Candidate, Refusal, candidates
from swayless.design.tradeoff.need import Need
from swayless.design.tradeoff.reasons import reason

_ON_LIMIT = 1e-9  # relative: an overtravel this little beyond the longest is as long, by rounding


@dataclass(frozen=True, eq=False)
class Recommendation:
    """A candidate in its place.

    Parameters
    ----------
    candidate : Candidate
        What is recommended, or not.
    shortfall_ratio : float
        0 where it does all that is needed; see `shortfall`.
    reason : str
        Why it stands where it does, in one sentence.
    """

    candidate: Candidate
    shortfall_ratio: float
    reason: str


def recommend(
    need: Need, *, on_candidate: Callable[[str], None] = lambda _: None
) -> tuple[list[Recommendation], list[Refusal]]:
    """Rank everything that could serve a machine, and say why.

    First comes what holds the whole range within the longest overtravel: the shortest overtravel first, and
    of those that print the same the simplest, positive before negative and fewer rows before more. Then
    comes what falls least short.

    Parameters
    ----------
    need : Need
        The machine.
    on_candidate : callable
        Called with the name of each candidate before it is designed.

    Returns
    -------
    ranked : list of Recommendation
        From the best to the worst.
    refused : list of Refusal
        What does not exist at this tolerance, damping or range.

    Raises
    ------
    DesignError
        If a value of the machine is out of range.

    Examples
    --------
    >>> from swayless.plant import Band
    >>> ranked, _ = recommend(Need(Band(1.0, 1.0), ramp_up_s=7.0, ramp_down_s=7.0))
    >>> ranked[0].candidate.name
    'own ramp'
    """
    found, refused = candidates(need, on_candidate=on_candidate)
    ranked = sorted(found, key=lambda candidate: place(candidate, need))
    recommendations = [
        Recommendation(candidate, shortfall(candidate, need), reason(candidate, need, ranked[0]))
        for candidate in ranked
    ]
    return recommendations, refused


def shortfall(candidate: Candidate, need: Need) -> float:
    """Tell how far a candidate falls short of what is needed.

    Returns
    -------
    float
        The larger of two ratios: the part of the range that it does not hold, and the part by which its
        overtravel is too long. 0 where it does all that is needed.
    """
    missing = 0.0 if candidate.whole else 1.0 - candidate.share
    if need.longest_overtravel_m is None:
        return missing
    excess = candidate.overtravel_m / need.longest_overtravel_m - 1.0
    return max(missing, excess if excess > _ON_LIMIT else 0.0)


def place(candidate: Candidate, need: Need) -> tuple[float, float, bool, int]:
    """Give the key to sort by: what falls short, then the overtravel as printed, then what is simpler."""
    printed_m = float(f"{candidate.overtravel_m:.3g}")
    return shortfall(candidate, need), printed_m, candidate.negative, len(candidate.rows)
