"""Amplitudes on whole ticks that hold what an ideal shaper holds, or as much of it as they can.

Not for: how many ticks a design takes, or what is ideal (`ticks`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from swayless.design.damping_range import worst_on_arc
from swayless.design.grid import LARGEST_DURATION_TICKS
from swayless.design.grid_shaper import GridShaper, decimal_amplitudes
from swayless.design.minimax import HeldLine, minimax_amplitudes
from swayless.design.minimax.response import IndexArray
from swayless.design.residual import NEGLIGIBLE_AMPLITUDE
from swayless.design.robust.crossing import crossing
from swayless.design.robust.demand import RULES, Amplitudes
from swayless.design.robustness import TOUCH_SLACK, worst_residual_promised
from swayless.design.shaper import FloatArray, Guarantee, Shaper
from swayless.errors import DesignError
from swayless.plant import Band

_SLACK = 1e-10  # of the residual: more than a dozen amplitudes put on the decimal lattice can add
_LEAST_LAST = 2.0 * NEGLIGIBLE_AMPLITUDE  # so that the last tap counts
_DAMPING_ROUNDS = 12  # of further damping ratios at the ends of the bands
_EDGE_ACCURACY = 1e-8  # of the logarithms of the residual and of the edge
_STEEPNESS = 5.0  # a usual d log(residual) / d log(edge), of the first step


@dataclass(frozen=True, eq=False)
class TickProgram:
    """Taps on the ticks 0 .. last, near an ideal shaper.

    Parameters
    ----------
    tick_s : float
        Tick of the controller, > 0.
    amplitudes : {"positive", "bounded"}
        Sign rule.
    ideal : Shaper
        Ticks near its impulses are tried first; the optimum over all ticks does not depend on it.
    """

    tick_s: float
    amplitudes: Amplitudes
    ideal: Shaper

    def holding(self, promise: Guarantee, last: int) -> GridShaper | None:
        """Find taps that keep a promise; None if there are none."""
        taps = self._best(promise, last, promise.tolerance - _SLACK)
        return taps if taps.guarantee.worst_residual_ratio <= promise.tolerance else None

    def least(self, promise: Guarantee, last: int) -> GridShaper:
        """Find the taps that leave least over the bands of a promise, and make what they leave theirs."""
        taps = self._best(promise, last, 0.0)
        worst = taps.guarantee.worst_residual_ratio
        return replace(taps, guarantee=replace(taps.guarantee, tolerance=worst))

    def widest(self, last: int) -> GridShaper:
        """Find the taps that hold the ideal's tolerance from its lowest frequency as far up as any.

        The least worst residual rises with the upper edge, from the ideal's edge down (which no taps pass)
        until it is at the tolerance.
        """
        promise, found = self.ideal.guarantee, dict[float, GridShaper]()
        low_hz, tolerance = promise.band.low_hz, promise.tolerance

        def excess(shortfall: float) -> float:
            band = Band(low_hz, max(low_hz, promise.band.high_hz * math.exp(-shortfall)))
            found[shortfall] = self._best(replace(promise, band=band), last, 0.0)
            return math.log(max(found[shortfall].guarantee.worst_residual_ratio, _SLACK) / tolerance)

        most = math.log(promise.band.high_hz / low_hz)
        shortfall = crossing(
            excess, 0.0, most, steepness=_STEEPNESS, near=_EDGE_ACCURACY, apart=_EDGE_ACCURACY / 10.0
        )
        if shortfall is not None:
            return found[shortfall]
        least = found[most].guarantee.worst_residual_ratio
        raise DesignError(
            f"tick_s = {self.tick_s!r}: taps on {last} ticks leave {100 * least:.6g} % at {low_hz:g} Hz "
            f"alone, where {100 * tolerance:g} % is asked for; a finer tick does"
        )

    def _best(self, promise: Guarantee, last: int, target: float) -> GridShaper:
        """Find the taps that leave least, at every damping ratio of the promise, or at most the target.

        A residual within a range of damping ratios is largest on its border: on the bands at the lowest and
        the highest ratio, or at an end of a band in between, which is added where it turns out so.
        """
        lines = [
            HeldLine(band, damping)
            for damping in dict.fromkeys(promise.damping_ratios)
            for band in promise.bands
        ]
        for _ in range(_DAMPING_ROUNDS):
            taps, worst = self._solved(promise, last, lines, target)
            beyond = _beyond(taps, max(worst, target))
            if not beyond:
                break
            lines += beyond
        return taps

    def _solved(
        self, promise: Guarantee, last: int, lines: list[HeldLine], target: float
    ) -> tuple[GridShaper, float]:
        """Solve for given lines: the taps, and what they leave on these lines."""
        if last > LARGEST_DURATION_TICKS:
            raise DesignError(
                f"tick_s = {self.tick_s:.12g}: {last} ticks are too many; must be at least "
                f"{last * self.tick_s / LARGEST_DURATION_TICKS:g} for at most {LARGEST_DURATION_TICKS}"
            )
        best = minimax_amplitudes(
            np.arange(last + 1, dtype=np.float64) * self.tick_s,
            lines,
            rule=RULES[self.amplitudes],
            start=self._near(last),
            target_ratio=target,
            least_last=_LEAST_LAST,
        )
        delays = (best.taps - best.taps[0]).astype(np.int64)
        taps = GridShaper(delays, decimal_amplitudes(best.amplitudes), self.tick_s, promise)
        worst = worst_residual_promised(taps, promise)
        return replace(
            taps, guarantee=replace(promise, worst_residual_ratio=worst)
        ), best.worst_residual_ratio

    def _near(self, last: int) -> IndexArray:
        """Ticks beside the ideal impulses, stretched to the last tick."""
        near: FloatArray = self.ideal.times_s * (last / self.ideal.duration_s)
        ticks = np.union1d(np.floor(near), np.ceil(near)).astype(np.intp)
        return np.union1d(ticks[ticks <= last], last)


def _beyond(taps: GridShaper, ceiling: float) -> list[HeldLine]:
    """Find ends of bands, at damping ratios inside a range, where taps leave more than the ceiling."""
    promise = taps.guarantee
    lowest, highest = promise.damping_ratios
    if lowest == highest or promise.worst_residual_ratio <= ceiling * (1.0 + TOUCH_SLACK):
        return []
    ends_hz = [end_hz for band in promise.bands for end_hz in (band.low_hz, band.high_hz)]
    peaks = [(end_hz, worst_on_arc(taps, end_hz, (lowest, highest))) for end_hz in ends_hz]
    return [
        HeldLine(Band(end_hz, end_hz), peak.damping_ratio)
        for end_hz, peak in peaks
        if lowest < peak.damping_ratio < highest and peak.ratio > ceiling
    ]
