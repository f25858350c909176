"""Magee and Book's laws by name. Not for: the laws themselves (`original_filter`, `modified_filter`)."""

from __future__ import annotations

from swayless.controller.modified_filter import ModifiedFilter
from swayless.controller.original_filter import OriginalFilter
from swayless.controller.settings import ShaperSettings
from swayless.controller.spaced_taps import SpacedTaps
from swayless.controller.spacing_filter import SpacedFilter


def spaced_filter(settings: ShaperSettings) -> SpacedFilter:
    """Make the filter of a block whose rows follow a spacing, at rest at 0.

    Parameters
    ----------
    settings : ShaperSettings
        Constants of the block.

    Raises
    ------
    ControllerError
        If the rows differ in their law or their spacing, or commands are too large for 64 bits.
    """
    taps = settings.bank.rows[0].taps
    is_original = isinstance(taps, SpacedTaps) and taps.law == "original"
    return OriginalFilter(settings) if is_original else ModifiedFilter(settings)
