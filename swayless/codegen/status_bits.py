"""Bits of a block's status word, as templates print them. Not for: what sets them."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from enum import IntFlag
from typing import Any, NamedTuple


class StatusBit(NamedTuple):
    """One bit of the status word.

    Parameters
    ----------
    name : str
        In upper case, without a prefix.
    position, value : int
        Place from 0, and 2 to that power.
    meaning : str
        In a few words.
    """

    name: str
    position: int
    value: int
    meaning: str


def status_bits(bits: Iterable[IntFlag], explain: Callable[[Any], str]) -> tuple[StatusBit, ...]:
    """Describe bits in their order.

    Parameters
    ----------
    bits : iterable of IntFlag
        Those of a block.
    explain : callable
        Gives the meaning of one.

    Examples
    --------
    >>> from swayless.controller.adaptive import AdaptiveStatus, explain_adaptive
    >>> status_bits(AdaptiveStatus, explain_adaptive)[1].value
    2
    """
    return tuple(StatusBit(str(bit.name), int(bit).bit_length() - 1, int(bit), explain(bit)) for bit in bits)
