"""Names of the status bits in Structured Text, and which of them a block sets. Not for: their meaning."""

from __future__ import annotations

from swayless.codegen.st_parts import parts_in_use
from swayless.codegen.st_rope import st_said
from swayless.codegen.st_types import Constant
from swayless.controller.measured import ROPE
from swayless.controller.settings import ShaperSettings
from swayless.controller.status import Status

PARTS_OF_BITS = {
    Status.COMMAND_WAITS: {"waiting", "inching"},
    Status.BELOW_MINIMUM: {"minimum", "contactor"},
    Status.INCHING: {"inching"},
}
"""Parts of the law that set a bit, any of them, where not every block of its kind does."""


def status_names(settings: ShaperSettings) -> dict[str, str]:
    """Name the constant of each bit of the status word.

    Parameters
    ----------
    settings : ShaperSettings
        The block.

    Returns
    -------
    dict of str to str
        Such as ``StatusRowWaits`` for ``ROW_WAITS``.
    """
    names = [bit.name or "" for bit in settings.status_bits]
    return {name: "Status" + "".join(word.capitalize() for word in name.split("_")) for name in names}


def status_constants(settings: ShaperSettings) -> list[Constant]:
    """List the constants of the bits that the block sets, each with its meaning.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    """
    measured = ROPE if settings.rope is None else settings.rope.measured
    used, names = parts_in_use(settings), status_names(settings)
    return [
        Constant(st_said(measured, names[bit.name or ""]), "DINT", str(bit.value), measured.explain(bit))
        for bit in settings.status_bits
        if used & PARTS_OF_BITS.get(bit, used)
    ]
