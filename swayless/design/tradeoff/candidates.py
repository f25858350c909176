"""Everything that could serve a machine: families, robust shapers, banks and ramps, by the same measures.

Not for: choosing between them (`recommending`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial
from itertools import pairwise

from swayless.design.families import FAMILIES
from swayless.design.robust import Amplitudes, RobustDesign, specified_insensitivity
from swayless.design.robustness import overtravel_s, peak_factor, worst_residual
from swayless.design.shaper import Shaper
from swayless.design.tradeoff.banks import range_steps, shortest_split
from swayless.design.tradeoff.frontier import Frontier, frontier
from swayless.design.tradeoff.need import WHOLE, Need
from swayless.design.tradeoff.placing import placed_shaper
from swayless.design.tradeoff.ramp import held_by_ramp, jog_residual, shortest_ramp_s, worst_ramp_residual
from swayless.errors import DesignError
from swayless.plant import Band

KINDS: tuple[Amplitudes, ...] = ("positive", "bounded")
BANK_ROWS = (2, 3, 4)

PLACED_FAMILIES = tuple(
    name for name, family in FAMILIES.items() if family.parameters <= frozenset({"tolerance"})
)
"""Families that a mode and a tolerance define."""


OWN_RAMP, SLOWER_RAMP = "own ramp", "slower ramp"


@dataclass(frozen=True, eq=False)
class Candidate:
    """Something that could serve a machine, and what it is worth there.

    Parameters
    ----------
    name : str
        What it is, in words.
    rows : tuple of Shaper
        One for each position of the knob; none for a plain ramp.
    held : tuple of Band
        Parts of the machine's range in which at most the tolerance is left.
    share : float
        The same as a part of the range, 0 to 1, in the measure of the machine.
    worst_residual_ratio : float
        Largest residual vibration that is left anywhere in the range.
    duration_s : float
        Of the longest row, or of the ramp.
    overtravel_s : float
        Way per unit of speed once the command is released, in m per m/s: of the shaper, or of the plain ramp.
    overtravel_m : float
        Way from full speed to rest, the machine's own ramp included, in m.
    lower_bound_s : float or None
        Duration in which no shaper with the same sign rule holds the range: proved. None where nothing is.
    jog_residual_ratio : float
        Largest swing that a press of any length leaves anywhere in the range, as a ratio of what an unshaped
        full-speed step leaves.
    """

    name: str
    rows: tuple[Shaper, ...]
    held: tuple[Band, ...]
    share: float
    worst_residual_ratio: float
    duration_s: float
    overtravel_s: float
    overtravel_m: float
    lower_bound_s: float | None
    jog_residual_ratio: float

    @property
    def whole(self) -> bool:
        """Whether the whole range is held at the tolerance."""
        return self.share >= WHOLE

    @property
    def peak_factor(self) -> float:
        """How far arbitrary commands of size 1 could drive the reference, at least 1."""
        return max(map(peak_factor, self.rows), default=1.0)

    @property
    def negative(self) -> bool:
        """Whether an amplitude is negative."""
        return any(float(row.amplitudes.min()) < 0.0 for row in self.rows)


@dataclass(frozen=True)
class Refusal:
    """What could not be designed for a machine, and why."""

    name: str
    reason: str


def candidates(
    need: Need, *, on_candidate: Callable[[str], None] = lambda _: None
) -> tuple[list[Candidate], list[Refusal]]:
    """Design everything that could serve a machine.

    Parameters
    ----------
    need : Need
        The machine.
    on_candidate : callable
        Called with the name of each candidate before it is designed.

    Returns
    -------
    found : list of Candidate
        Named families, each on the mode for which it covers most; the best shaper for the whole range with
        positive and with bounded amplitudes; banks of 2 to 4 rows; plain ramps.
    refused : list of Refusal
        What does not exist at this tolerance, damping or range.

    Examples
    --------
    >>> found, refused = candidates(Need(Band(1.0, 1.0)))
    >>> [candidate.name for candidate in found if candidate.whole][:3]
    ['zv', 'zvd', 'zvdd']
    """
    found: list[Candidate] = []
    refused: list[Refusal] = []
    for name, design in _recipes(need):
        on_candidate(name)
        try:
            found.append(design())
        except DesignError as error:
            refused.append(Refusal(name, str(error)))
    return found, refused


def _recipes(need: Need) -> Iterator[tuple[str, Callable[[], Candidate]]]:
    """Names, and how to design them."""
    for family in PLACED_FAMILIES:
        yield family, partial(family_candidate, family, need)
    for kind in KINDS:
        yield f"{kind} si", partial(robust_candidate, kind, need)
        if need.ratio > 1.0:
            front = cache(partial(need_frontier, need, kind))
            for number in BANK_ROWS:
                yield f"{number} {kind} rows", partial(bank_candidate, number, need, front)
    own_s = max(need.ramp_up_s, need.ramp_down_s)
    if own_s > 0.0:
        yield OWN_RAMP, partial(ramp_candidate, OWN_RAMP, need, need.ramp_up_s, need.ramp_down_s)
    ramp_s = shortest_ramp_s(
        need.band, tolerance=need.tolerance, damping_ratio=need.damping_ratio, at_least_s=own_s
    )
    if ramp_s > own_s:
        yield SLOWER_RAMP, partial(ramp_candidate, SLOWER_RAMP, need, ramp_s, ramp_s)


def family_candidate(family: str, need: Need) -> Candidate:
    """Put a named family on the mode for which it covers most of the range, and measure it."""
    shaper = placed_shaper(family, need)
    held = need.within([shaper.guarantee.band])
    worst = worst_residual(shaper, need.band, damping_ratio=need.damping_ratio)
    return _shaped(family, need, (shaper,), held, worst, None)


def robust_candidate(amplitudes: Amplitudes, need: Need) -> Candidate:
    """Design the shortest shaper for the whole range, and measure it."""
    return _robust(f"{amplitudes} si", need, [_shortest(need.band, need, amplitudes)])


def bank_candidate(number: int, need: Need, front: Callable[[], Frontier]) -> Candidate:
    """Split the range among rows, each the shortest for its part, and measure them."""
    ends_hz = need.band.low_hz * shortest_split(number, range_steps(need.ratio), front())
    ends_hz[-1] = need.band.high_hz  # to the last bit
    kind = front().amplitudes
    rows = [_shortest(Band(low, high), need, kind) for low, high in pairwise(ends_hz.tolist())]
    return _robust(f"{number} {kind} rows", need, rows)


def need_frontier(need: Need, amplitudes: Amplitudes) -> Frontier:
    """Design the shortest shapers for all parts of the range from its lowest frequency up."""
    return frontier(
        need.band.low_hz,
        range_steps(need.ratio)[1:],
        tolerance=need.tolerance,
        damping_ratio=need.damping_ratio,
        amplitudes=amplitudes,
    )


def _shortest(band: Band, need: Need, amplitudes: Amplitudes) -> RobustDesign:
    return specified_insensitivity(
        band, tolerance=need.tolerance, damping_ratio=need.damping_ratio, amplitudes=amplitudes
    )


def ramp_candidate(name: str, need: Need, up_s: float, down_s: float) -> Candidate:
    """Measure plain ramps, without a shaper."""
    up, down = (
        need.within(held_by_ramp(ramp_s, tolerance=need.tolerance, damping_ratio=need.damping_ratio))
        for ramp_s in (up_s, down_s)
    )
    held = tuple(both for band in up for both in replace(need, band=band).within(down))
    return Candidate(
        name=name,
        rows=(),
        held=held,
        share=need.share(held),
        worst_residual_ratio=max(
            worst_ramp_residual(ramp_s, need.band, damping_ratio=need.damping_ratio)
            for ramp_s in (up_s, down_s)
        ),
        duration_s=max(up_s, down_s),
        overtravel_s=down_s / 2.0,
        overtravel_m=need.speed_m_s * down_s / 2.0,
        lower_bound_s=None,
        jog_residual_ratio=jog_residual(need.band, up_s, down_s),
    )


def _robust(name: str, need: Need, designs: Sequence[RobustDesign]) -> Candidate:
    """Measure designs that hold the range between them, each its own part."""
    shapers = tuple(design.shaper for design in designs)
    held = need.within([shaper.guarantee.band for shaper in shapers])
    worst = max(shaper.guarantee.worst_residual_ratio for shaper in shapers)
    bound_s = designs[0].lower_bound_s if len(designs) == 1 else None
    return _shaped(name, need, shapers, held, worst, bound_s)


def _shaped(
    name: str,
    need: Need,
    rows: tuple[Shaper, ...],
    held: tuple[Band, ...],
    worst: float,
    lower_bound_s: float | None,
) -> Candidate:
    """Measure shapers whose parts of the range are known."""
    slowest_s = max(map(overtravel_s, rows))
    return Candidate(
        name=name,
        rows=rows,
        held=held,
        share=need.share(held),
        worst_residual_ratio=worst,
        duration_s=max(row.duration_s for row in rows),
        overtravel_s=slowest_s,
        overtravel_m=need.overtravel_m(slowest_s),
        lower_bound_s=lower_bound_s,
        jog_residual_ratio=2.0 * worst,  # a start and a stop
    )
