"""What a stored motion profile promises, proved again. Not for: whether its values can be read."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from swayless.controller.profile import ProfileModel
from swayless.controller.profile.compression import widest_tolerance
from swayless.errors import DesignError
from swayless.machine.profile_design import ProfileDesign
from swayless.machine.profile_design_promise import broken_promises
from swayless.machine.profile_design_proof import ProfileProof, proved
from swayless.machine.profile_design_rate import check_rate, longest_travel
from swayless.machine.profile_design_settings import block_model, check_own_move

_NEAR = {"double": 1e-9, "float": 1e-6}
"""How near a stored model must be to the plant's: another mathematical library moves last digits."""


def problems_of(design: ProfileDesign) -> Iterator[tuple[str, str]]:
    """Give the key and the reason of everything that is not as it is promised."""
    settings, numbered = design.settings, design.numbered
    try:
        own = block_model(numbered)
    except DesignError as error:
        yield "plant", str(error)
        return
    if settings.pieces.ticks != design.move.command.values.size:
        yield "table", f"lasts {settings.pieces.ticks} ticks, the command {design.move.command.values.size}"
        return
    number, shape = settings.number, numbered.shape
    # A little more than pieces are made to: that was a sum too.
    if not (np.abs(settings.pieces.values(number) - shape) <= 1.01 * widest_tolerance(shape, number)).all():
        yield "table", "does not play the command from start to target"
        return
    near = _NEAR[settings.number.name]
    if own.order != settings.model.order or not _near(settings.model, own, near):
        yield "model", "is not the one of this plant, tick and robustness"
        return
    held = numbered.model.hold_ratio
    if not abs(settings.hold_ratio - held) <= near * abs(held):
        yield "hold_ratio", f"= {settings.hold_ratio!r}: must be {held!r}, as of this plant"
    yield from _of_proof(design, proved(numbered, settings.pieces, settings.model, settings.stop))


def _of_proof(design: ProfileDesign, proof: ProfileProof) -> Iterator[tuple[str, str]]:
    """Compare what was found with what is stored."""
    settings, numbered = design.settings, design.numbered
    has_stop = settings.stop is not None
    for key, reason in broken_promises(design.guarantee, numbered, proof, has_stop):
        yield f"guarantee.{key}", reason
    if proof.extremes != settings.extremes:
        yield "extremes", f"must be {proof.extremes}, of all that can be played"
    most = longest_travel(numbered, proof)
    if settings.max_travel != most:
        yield "max_travel", f"= {settings.max_travel!r}: must be {most!r}, by the limit of the rate"
    try:
        proof.check_rest(settings.number.name)
        check_rate(numbered, proof)
        check_own_move(numbered, settings)
    except DesignError as error:
        yield "limit", str(error)


def _near(stored: ProfileModel, own: ProfileModel, ratio: float) -> bool:
    """Whether two models are the same but for rounding."""
    for one, other in (
        (stored.change, own.change),
        (stored.input, own.input),
        (stored.output, own.output),
        (np.array([stored.feedthrough]), np.array([own.feedthrough])),
    ):
        if not (np.abs(one - other) <= ratio * max(1e-300, float(np.abs(other).max()))).all():
            return False
    return True
