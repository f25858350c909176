"""Which parts of the law a Structured Text block has; declarations say which needs them. Not for: text."""

from __future__ import annotations

from typing import Literal, TypeAlias

from swayless.codegen.features import features_of
from swayless.controller.settings import ShaperSettings
from swayless.controller.spaced_taps import SpacingLaw

BlockLaw: TypeAlias = Literal["fixed", "phase"] | SpacingLaw
"""What a tap waits for: ticks, a phase of the pendulum, or multiples of a spacing looked up each tick."""


def law_of(settings: ShaperSettings) -> BlockLaw:
    """Name the law of a block.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    """
    return features_of(settings).spacing_law or ("fixed" if settings.clock is None else "phase")


def parts_in_use(settings: ShaperSettings) -> frozenset[str]:
    """Name the parts of the law that a block uses, its law among them.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    """
    features, law = features_of(settings), law_of(settings)
    parts = {
        "all": True,
        law: True,
        "ticks": law != "phase",
        "spacing": settings.is_spaced,
        "rope": features.has_rope,
        "rope rows": features.has_rope_rows,
        "minimum": features.has_minimum,
        "resolution": features.has_resolution,
        "inching": features.has_inching,
        "waiting": features.has_waiting_rows,
    }
    return frozenset(name for name, used in parts.items() if used)
