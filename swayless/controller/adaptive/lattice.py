"""The lattice on which coefficients lie: their sum is exactly 1, in any order. Not for: finding them."""

from __future__ import annotations

import math
from typing import Any

from swayless.controller.adaptive.information import Coefficients
from swayless.controller.adaptive.settings import AdaptiveSettings


class Lattice:
    """Rounds coefficients to the finest lattice on which their sums are exact, whatever is accepted.

    Of amplitudes that sum to 1 the negative ones sum to (peak factor - 1) / 2 where the absolute ones sum to
    the peak factor, so that no sum of some of them exceeds (peak factor + 1) / 2. Below the power of two
    above that all sums are exact whose steps are its 2**-24 in float, its 2**-53 in double.

    Parameters
    ----------
    settings : AdaptiveSettings
        Peak factor and number type.

    Examples
    --------
    >>> lattice = Lattice(AdaptiveSettings(25, 0.001, 1.0, 2.0, 4000, max_reference=8.0))
    >>> lattice.anchor, lattice.most_negative
    (4.0, 3.5)
    """

    def __init__(self, settings: AdaptiveSettings) -> None:
        scalar, peak_factor = settings.number.scalar, settings.peak_factor
        self.most_negative: Any = scalar(0.5 * (peak_factor - 1.0))
        self.anchor: Any = scalar(2.0 ** math.floor(math.log2(1.0 + float(self.most_negative))))
        self._zero = scalar(0)

    def rounded(self, c0: Any, c2: Any) -> Coefficients:
        """Round the outer coefficients, and give the middle one the rest to 1, exactly if it is allowed.

        Examples
        --------
        >>> c0, c1, c2 = Lattice(AdaptiveSettings(25, 0.001, 1.0, 2.0, 4000)).rounded(0.1, 0.2)
        >>> (c0 + c1) + c2 == (c2 + c0) + c1 == 1.0
        True
        """
        c0, c2 = self._round(c0), self._round(c2)
        return c0, 1.0 - (c0 + c2), c2

    def allows(self, coefficients: Coefficients) -> bool:
        """Whether the absolute sum of rounded coefficients is at most the peak factor.

        Examples
        --------
        >>> lattice = Lattice(AdaptiveSettings(25, 0.001, 1.0, 2.0, 4000))
        >>> lattice.allows(lattice.rounded(0.5, 0.5)), lattice.allows(lattice.rounded(0.6, 0.5))
        (True, False)
        """
        below = [-c if c < 0.0 else self._zero for c in coefficients]
        return bool((below[0] + below[1]) + below[2] <= self.most_negative)

    def _round(self, value: Any) -> Any:
        """Round a value below the anchor to a multiple of the step there; others are such multiples."""
        size = abs(value)
        if size < self.anchor:
            size = (size + self.anchor) - self.anchor
        return -size if value < 0.0 else size
