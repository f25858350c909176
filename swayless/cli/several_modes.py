"""What one shaper for several modes saves against one for each of them, convolved.

Not for: the comparison itself (`swayless.design.several_modes`).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, get_args

from swayless.cli.console import per_cent

if TYPE_CHECKING:
    from swayless.design.several_modes import SeveralModes
    from swayless.machine import DesignFile


_LEVEL_DIGITS = 6
"""Decimals of full speed: fewer than rounding spoils."""


def savings(design: DesignFile) -> list[str]:
    """Compare a design of several modes with convolutions; nothing to say of one mode.

    Parameters
    ----------
    design : DesignFile
        As `swayless design si` makes it.
    """
    from swayless.design.robust import Amplitudes
    from swayless.design.several_modes import compare_with_convolution
    from swayless.errors import DesignError
    from swayless.plant import Band

    (shaper,) = design.shapers
    held = shaper.guarantee
    if not held.further_frequency_hz or shaper.impulses is not None:
        return []
    bands = [Band(*band) for band in (held.frequency_hz, *held.further_frequency_hz)]
    (rule,) = (known for known in get_args(Amplitudes) if known == shaper.amplitude_rule)
    try:
        modes = compare_with_convolution(
            bands, tolerance=held.tolerance, damping_ratio=held.damping_ratio, amplitudes=rule
        )
    except DesignError as error:
        return [f"several modes: not compared with one shaper for each: {error}"]
    return list(_lines(modes))


def _lines(modes: SeveralModes) -> Iterator[str]:
    low, high = (round(level, _LEVEL_DIGITS) + 0.0 for level in modes.convolved.reference_range)
    beyond = "" if (low, high) == (0.0, 1.0) else f", and ask for {low:.3g} to {high:.3g} of full speed"
    yield (
        f"several modes: one shaper for each of the {len(modes.separate)}, convolved, would last "
        f"{modes.convolved_duration_s:.4g} s{beyond}; one for all saves {per_cent(modes.saving_ratio, 3)}"
    )
    if modes.relaxed is not None and modes.relaxed_saving_ratio is not None:
        yield (
            "with single tolerances as large as what is left allows the convolution would last "
            f"{modes.relaxed.duration_s:.4g} s; against that one for all saves "
            f"{per_cent(modes.relaxed_saving_ratio, 3)}"
        )
