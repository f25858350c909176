"""One shaper for several modes: a single program over all bands against a convolution of one shaper per mode.

Not for: the program itself (`robust`), nor for machines and what their modes are (`swayless.plant`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from swayless.design.robust import Amplitudes, RobustDesign, specified_insensitivity
from swayless.design.robust.demand import TOLERANCES
from swayless.design.robustness import partial_sums, worst_residual_promised
from swayless.design.shaper import FloatArray
from swayless.errors import DesignError
from swayless.plant import Band

_COINCIDENT = 1e-9  # of the duration: impulses nearer than this act at once, their times differ by rounding
_ACCURACY = 1e-6  # relative, of what the relaxed convolution leaves
_ROUNDS = 60  # a round usually halves the error; every thirtieth pair of bands keeps jumping about


@dataclass(frozen=True, eq=False)
class Convolution:
    """Single-mode shapers, convolved.

    Parameters
    ----------
    designs : tuple of RobustDesign
        One for each band, by rising frequency.
    times_s, amplitudes : ndarray, shape (n,)
        All impulses of the convolution, in rising order; some may act at one time.
    worst_residual_ratios : tuple of float
        What the convolution leaves at worst in each band. With positive amplitudes at most what the
        band's own shaper leaves; shapers with negative ones may leave more than without a shaper at the
        frequency of another mode, and spoil what its shaper does.
    """

    designs: tuple[RobustDesign, ...]
    times_s: FloatArray
    amplitudes: FloatArray
    worst_residual_ratios: tuple[float, ...]

    @property
    def duration_s(self) -> float:
        """Sum of the durations, in seconds."""
        return float(self.times_s[-1])

    @property
    def reference_range(self) -> tuple[float, float]:
        """Lowest and highest level of the reference after a unit step, 0 before it included.

        Shapers whose partial sums stay in 0 .. 1 do not keep them there together: negative amplitudes
        may ask for more than full speed, and for less than none.
        """
        apart = np.diff(self.times_s, append=np.inf) > _COINCIDENT * self.duration_s
        levels = partial_sums(self)[apart]
        return min(0.0, float(levels.min())), float(levels.max())


@dataclass(frozen=True)
class SingleModes:
    """Single-mode shapers for several bands that share all else.

    Parameters
    ----------
    bands : tuple of Band
        One for each shaper, rising.
    tolerance : float
        What their convolution should leave, as a ratio.
    damping_ratio, amplitudes
        As for `specified_insensitivity`.
    """

    bands: tuple[Band, ...]
    tolerance: float
    damping_ratio: float | tuple[float, float]
    amplitudes: Amplitudes

    def convolution(self, tolerances: Sequence[float]) -> Convolution:
        """Design a shaper for each band at its own tolerance, and convolve them."""
        designs = tuple(
            specified_insensitivity(
                band, tolerance=tolerance, damping_ratio=self.damping_ratio, amplitudes=self.amplitudes
            )
            for band, tolerance in zip(self.bands, tolerances, strict=True)
        )
        times_s, amplitudes = np.zeros(1), np.ones(1)
        for design in designs:
            times_s = np.add.outer(times_s, design.shaper.times_s).ravel()
            amplitudes = np.multiply.outer(amplitudes, design.shaper.amplitudes).ravel()
        rising = np.argsort(times_s, kind="stable")
        together = Convolution(designs, times_s[rising], amplitudes[rising], ())
        worst = tuple(worst_residual_promised(together, design.shaper.guarantee) for design in designs)
        return Convolution(designs, together.times_s, together.amplitudes, worst)

    def relaxed(self, convolved: Convolution) -> Convolution | None:
        """Change the single tolerances until the convolution just holds the tolerance in each band.

        What is left in a band is its own shaper's residual times what the others let through there, so each
        tolerance is divided by what it is off by: by the root of it, since where the structure of impulses
        changes, several times as much may be let through.
        """
        shortest: Convolution | None = None
        for _ in range(_ROUNDS):
            own = np.array([design.shaper.guarantee.tolerance for design in convolved.designs])
            excess = np.array(convolved.worst_residual_ratios) / self.tolerance
            holds = bool(np.all(excess <= 1.0 + _ACCURACY))
            if holds and (shortest is None or convolved.duration_s < shortest.duration_s):
                shortest = convolved
            wanted = np.clip(own / np.sqrt(excess), *TOLERANCES)
            if np.all(np.abs(wanted / own - 1.0) <= 0.5 * _ACCURACY):
                return shortest
            convolved = self.convolution(wanted.tolist())
        return shortest


@dataclass(frozen=True, eq=False)
class SeveralModes:
    """One program over several bands, beside what single-mode shapers make of them.

    Parameters
    ----------
    one : RobustDesign
        The shortest shaper for all bands, with its proof.
    convolved : Convolution
        The shortest single-mode shapers at the same tolerance: usually more than was asked for.
    program : SingleModes
        How they are designed.
    """

    one: RobustDesign
    convolved: Convolution
    program: SingleModes

    @property
    def separate(self) -> tuple[RobustDesign, ...]:
        """Single-mode designs at the tolerance."""
        return self.convolved.designs

    @property
    def convolved_duration_s(self) -> float:
        """Duration of their convolution, in seconds."""
        return self.convolved.duration_s

    @property
    def convolved_worst_ratio(self) -> float:
        """What their convolution leaves at worst over all bands, as a ratio."""
        return max(self.convolved.worst_residual_ratios)

    @property
    def saving_ratio(self) -> float:
        """By how much one program is shorter than the convolution, relative to it."""
        return 1.0 - self.one.shaper.duration_s / self.convolved.duration_s

    @cached_property
    def relaxed(self) -> Convolution | None:
        """The fair comparison, some twenty times the work: single-mode tolerances changed until they just do.

        Between 1 and 20 %, they are such that the convolution leaves the tolerance in each band, to a
        millionth of it. Where another structure of impulses jumps in at a small change of them, it is the
        shortest convolution met that holds. None where none did: with negative amplitudes only. Where several
        single-mode shapers are equally short, its duration depends on them in the fourth digit.
        """
        return self.program.relaxed(self.convolved)

    @property
    def relaxed_saving_ratio(self) -> float | None:
        """By how much one program is shorter than the relaxed convolution, if there is one."""
        return None if self.relaxed is None else 1.0 - self.one.shaper.duration_s / self.relaxed.duration_s


def compare_with_convolution(
    bands: Sequence[Band],
    *,
    tolerance: float = 0.05,
    damping_ratio: float | tuple[float, float] = 0.0,
    amplitudes: Amplitudes = "positive",
) -> SeveralModes:
    """Design one shaper for several modes, and compare it with a convolution of single-mode shapers.

    With positive amplitudes the convolution is one of the shapers that the program chooses from, so the
    program is never longer. Convolved unity-magnitude shapers are none of unity magnitude.

    Parameters
    ----------
    bands : sequence of Band
        At least two, apart; as for `specified_insensitivity`.
    tolerance : float
        Residual vibration as a ratio, 0.01 to 0.2.
    damping_ratio : float or (float, float)
        One value, or the lowest and highest: 0 to 0.2, over all bands.
    amplitudes : {"positive", "bounded", "unity-magnitude"}
        Sign rule.

    Returns
    -------
    SeveralModes

    Raises
    ------
    DesignError
        If a value is out of range, or fewer than two bands are left when those that meet are joined.

    References
    ----------
    Hyde and Seering (1991), using input command pre-shaping to suppress multiple mode vibration: constraints
    of all modes at once are shorter than a convolution.

    Examples
    --------
    Hook and load of one crane:

    >>> modes = compare_with_convolution([Band(0.2, 0.25), Band(0.8, 1.0)])
    >>> round(modes.one.shaper.duration_s, 3), round(modes.convolved_duration_s, 3)
    (4.454, 5.002)
    >>> round(modes.saving_ratio, 3), round(modes.relaxed_saving_ratio, 2)
    (0.109, 0.1)
    """
    one = specified_insensitivity(
        bands, tolerance=tolerance, damping_ratio=damping_ratio, amplitudes=amplitudes
    )
    apart = one.shaper.guarantee.bands
    if len(apart) < 2:
        raise DesignError(f"bands = {list(bands)!r}: must be at least two that do not meet")
    program = SingleModes(apart, tolerance, damping_ratio, amplitudes)
    return SeveralModes(one, program.convolution([tolerance] * len(apart)), program)
