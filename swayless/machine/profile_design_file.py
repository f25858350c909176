"""The stored file of a motion profile: JSON, proved again when it is read, compared with a fresh one.

Not for: what stands in it (`profile_design_record`).
"""

from __future__ import annotations

import json
import re
import textwrap
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from swayless.errors import FileError
from swayless.machine.problems import Place, Report
from swayless.machine.profile_design import ProfileDesign
from swayless.machine.profile_design_check import problems_of
from swayless.machine.profile_design_document import design_of, record_of
from swayless.machine.profile_design_record import ProfileRecord
from swayless.machine.record import document_of, read_record
from swayless.machine.source import read_source

MAX_BYTES = 20_000_000
_LINE_LENGTH = 100
_NUMBERS = re.compile(r"\[[^\[\]{}]*\]")
_RELATIVE = 1e-9
_MADE = frozenset(
    {"generator", "guarantee", "hold_ratio", "max_travel", "extremes", "table", "model", "stop"}
)


def profile_design_text(design: ProfileDesign) -> str:
    """Give the text of a stored design: ASCII, LF, fixed order of keys."""
    text = json.dumps(document_of(record_of(design)), indent=2)
    return _NUMBERS.sub(lambda found: _wrapped(found[0]), text) + "\n"


def load_profile_design(path: Path) -> ProfileDesign:
    """Load a stored design, and prove it again.

    Parameters
    ----------
    path : Path
        Of a ``.profile.json`` that `profile_design_text` gave.

    Raises
    ------
    FileError
        With every problem found: file, key, value and what is allowed.
    """
    report = Report(str(path))
    try:
        document = json.loads(read_source(path, max_bytes=MAX_BYTES))
    except (ValueError, RecursionError) as error:
        raise FileError([f"{path}: not valid JSON: {error}"]) from error
    place = Place(report, "")
    record = read_record(ProfileRecord, document, place)
    design = None if record is None or report.problems else design_of(record, place)
    if design is not None:
        report.problems.extend(f"{path}: {key}: {reason}" for key, reason in problems_of(design))
    if design is None or report.problems:
        raise FileError(report.problems)
    return design


def same_profile(stored: ProfileDesign, fresh: ProfileDesign) -> list[str]:
    """Give every difference between what two designs are made from, one line each.

    What is made from it is proved whenever it is loaded; another mathematical library may cut pieces
    elsewhere, and that is no difference. Nor is the version of the generator.

    Parameters
    ----------
    stored, fresh : ProfileDesign
        Compared as they are stored, numbers to 1e-9 of the largest beside them.
    """
    first, second = (document_of(record_of(design)) for design in (stored, fresh))
    asked = {key: value for key, value in first.items() if key not in _MADE}
    return list(_differences("", asked, second))


def _differences(path: str, stored: Any, fresh: Any) -> Iterator[str]:
    if isinstance(stored, dict):
        for key, value in stored.items():
            yield from _differences(f"{path}.{key}" if path else key, value, fresh[key])
    elif not _same(stored, fresh):
        numbers = isinstance(stored, list)
        yield f"{path}: differs" if numbers else f"{path}: stored {stored!r}, fresh {fresh!r}"


def _same(stored: Any, fresh: Any) -> bool:
    if isinstance(stored, str) or stored is None or fresh is None:
        return bool(stored == fresh)
    one, other = np.array(stored, dtype=np.float64), np.array(fresh, dtype=np.float64)
    if one.shape != other.shape:
        return False
    return bool((np.abs(one - other) <= _RELATIVE * np.abs(other).max()).all())


def _wrapped(numbers: str) -> str:
    """Print an array of numbers in as few lines as it needs."""
    flat = " ".join(numbers.split()).replace("[ ", "[").replace(" ]", "]")
    return "\n".join(textwrap.wrap(flat, _LINE_LENGTH, break_long_words=False))
