"""How the rows of a design share the range of a machine, as a design file holds it.

Not for: the rows themselves (`swayless.machine.design_document`).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated, TypeAlias

from swayless.machine.design_members import LABEL, NOT_NEGATIVE, POSITIVE, TOLERANCE, word
from swayless.machine.record import Member, Record, optional, several

MAX_SHAPERS = 8
SELECTIONS = ("knob", "rope_length")

_BETWEEN = {"at_least": 0, "at_most": MAX_SHAPERS - 1}
_PLACES: Member = several(POSITIVE, **_BETWEEN)
_OVERLAPS: Member = several(NOT_NEGATIVE, **_BETWEEN)

Floats: TypeAlias = tuple[float, ...]


@dataclass(frozen=True)
class BankRecord(Record):
    """Where the knob is to be turned, and what neighbours have in common there.

    On a machine given by ropes the lengths are in m and those in Hz are null; on others the other way round.
    """

    selection: Annotated[str, word("selection", SELECTIONS)]
    tolerance: Annotated[float, TOLERANCE]
    hysteresis_m: Annotated[float | None, optional(NOT_NEGATIVE)]
    hysteresis_hz: Annotated[float | None, optional(NOT_NEGATIVE)]
    switching_frequency_hz: Annotated[Floats, _PLACES]
    switching_rope_length_m: Annotated[Floats | None, optional(_PLACES)]
    overlap_m: Annotated[Floats | None, optional(_OVERLAPS)]
    overlap_hz: Annotated[Floats | None, optional(_OVERLAPS)]
    labels: Annotated[tuple[str, ...], several(LABEL, at_least=1, at_most=MAX_SHAPERS)]

    def disagreements(self) -> Iterator[tuple[str, str]]:
        """Require one place and one overlap between neighbours, in order, in m or in Hz."""
        yield from _either(self)
        switches = len(self.labels) - 1
        for key in ("switching_frequency_hz", "switching_rope_length_m", "overlap_m", "overlap_hz"):
            values = getattr(self, key)
            if values is not None and len(values) != switches:
                yield key, f"has {len(values)} values, one between neighbours of {len(self.labels)} labels"
        if not _rises(self.switching_frequency_hz):
            yield "switching_frequency_hz", "must rise from row to row"
        if self.switching_rope_length_m is not None and not _rises(self.switching_rope_length_m[::-1]):
            yield "switching_rope_length_m", "must fall from row to row"


def _either(bank: BankRecord) -> Iterator[tuple[str, str]]:
    in_m = {key: getattr(bank, key) for key in ("hysteresis_m", "switching_rope_length_m", "overlap_m")}
    in_hz = {key: getattr(bank, key) for key in ("hysteresis_hz", "overlap_hz")}
    on_rope = bank.hysteresis_m is not None
    for key, value in (in_m | in_hz).items():
        wanted = on_rope == (key in in_m)
        if wanted and value is None:
            yield key, f"is null, and the bank switches in {'m' if on_rope else 'Hz'}"
        if not wanted and value is not None:
            yield key, f"must be null: the bank switches in {'m' if on_rope else 'Hz'}"


def _rises(values: Sequence[float]) -> bool:
    return all(low < high for low, high in pairwise(values))
