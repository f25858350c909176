"""The variables of a Structured Text block, in sections. Not for: what each is for."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from swayless.codegen.st_diagnostics import DIAGNOSTIC_SCRATCH, DIAGNOSTIC_STATE
from swayless.codegen.st_operator import OPERATOR_SCRATCH, OPERATOR_STATE
from swayless.codegen.st_parts import parts_in_use
from swayless.codegen.st_rope import of_measured
from swayless.codegen.st_scratch import scratch_of
from swayless.codegen.st_state import state_of
from swayless.codegen.st_types import StTypes, Variable
from swayless.controller.settings import ShaperSettings


@dataclass(frozen=True)
class Section:
    """Variables of one subject.

    Parameters
    ----------
    title : str
        Comment above them; without one they follow those before.
    variables : tuple of Variable
        At least one.
    """

    title: str
    variables: tuple[Variable, ...]


def sections_of(settings: ShaperSettings, types: StTypes) -> list[Section]:
    """List all variables: first what lives from call to call, then what a call computes on its way.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    types : StTypes
        Its types.
    """
    scratch = ((kind, name, doc, "", part) for kind, name, doc, part in OPERATOR_SCRATCH)
    of_call = ((kind, name, doc, "", part) for kind, name, doc, part in DIAGNOSTIC_SCRATCH)
    sections = (
        ("", state_of(settings, types)),
        ("State of what the operator and the drive add.", _chosen(OPERATOR_STATE, settings, types)),
        ("State of the diagnostics.", _chosen(DIAGNOSTIC_STATE, settings, types)),
        ("Intermediate results of one call.", scratch_of(settings, types)),
        ("Those of what the operator and the drive add.", _chosen(scratch, settings, types)),
        ("Those of the diagnostics.", _chosen(of_call, settings, types)),
    )
    return [Section(title, tuple(variables)) for title, variables in sections if variables]


def _chosen(
    rows: Iterable[tuple[str, str, str, str, str]], settings: ShaperSettings, types: StTypes
) -> list[Variable]:
    """Declare what the block uses of a table of kind, name, comment, reset and part."""
    used = parts_in_use(settings)
    found = [
        Variable(name, types.type_of(kind), doc, st_reset=reset)
        for kind, name, doc, reset, part in rows
        if part in used
    ]
    units = settings.limits.units
    return [
        replace(each, st_doc=each.st_doc.replace("{units}", units)) for each in of_measured(settings, found)
    ]
