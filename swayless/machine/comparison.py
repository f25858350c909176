"""How far a fresh design differs from a stored one: another solver or library may move the last digits.

Not for: whether the stored design still holds what it promises; that is proved again.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from swayless.machine.design_document import DesignFile
from swayless.machine.problems import shown
from swayless.machine.record import document_of

RELATIVE = 1e-9
_PROVENANCE = frozenset({"generator"})


def same_design(stored: DesignFile, fresh: DesignFile, *, relative: float = RELATIVE) -> list[str]:
    """Give every difference between two designs, one line each; the version of the generator is none.

    Parameters
    ----------
    stored, fresh : DesignFile
        The two designs, compared as they are stored.
    relative : float
        Largest difference of two numbers that counts as none. It is relative to the larger of the two; in an
        array of numbers to the largest of them, so that a tiny amplitude is weighed against its neighbours.

    Returns
    -------
    list of str
        Such as ``"shapers[0].times_s[1]: stored 1.5, fresh 1.6"``; empty if the designs are the same.
    """
    return list(_differences("", document_of(stored), document_of(fresh), relative))


def _differences(path: str, stored: Any, fresh: Any, relative: float) -> Iterator[str]:
    if isinstance(stored, dict) and isinstance(fresh, dict):
        for key in stored | fresh:
            if key not in _PROVENANCE:
                place = f"{path}.{key}" if path else key
                yield from _differences(place, stored.get(key), fresh.get(key), relative)
    elif isinstance(stored, list) and isinstance(fresh, list):
        yield from _in_arrays(path, stored, fresh, relative)
    elif not _same(stored, fresh, 0.0, relative):
        yield f"{path}: stored {shown(stored)}, fresh {shown(fresh)}"


def _in_arrays(path: str, stored: list[Any], fresh: list[Any], relative: float) -> Iterator[str]:
    if len(stored) != len(fresh):
        yield f"{path}: stored {len(stored)} items, fresh {len(fresh)}"
        return
    scale = max((abs(item) for item in (*stored, *fresh) if isinstance(item, float)), default=0.0)
    for index, (old, new) in enumerate(zip(stored, fresh, strict=True)):
        if isinstance(old, dict | list):
            yield from _differences(f"{path}[{index}]", old, new, relative)
        elif not _same(old, new, scale, relative):
            yield f"{path}[{index}]: stored {shown(old)}, fresh {shown(new)}"


def _same(stored: Any, fresh: Any, scale: float, relative: float) -> bool:
    if isinstance(stored, float) and isinstance(fresh, float):
        return abs(stored - fresh) <= relative * max(abs(stored), abs(fresh), scale)
    return bool(stored == fresh)
