"""The design file: the JSON document that is the golden input of code generation. Load it, store it, hash it.

Not for: what stands in it (`swayless.machine.design_document`).
"""

from __future__ import annotations

import hashlib
import json
import textwrap
from collections import Counter
from pathlib import Path
from typing import Any

from swayless.errors import FileError
from swayless.machine.checks import choice
from swayless.machine.design_document import SCHEMA, DesignFile
from swayless.machine.problems import Place, Report, shown
from swayless.machine.record import document_of, read_record
from swayless.machine.source import read_source

MAX_BYTES = 4_000_000
_LINE_LENGTH = 100
_INDENT = "  "
_OTHERS = {
    "swayless.adaptive/1": "an adaptive shaper",
    "swayless.profile/1": "the block of a motion profile",
}
"""Stored files of other kinds, by their schema."""


def load_design(path: Path | str) -> DesignFile:
    """Load a design file.

    Parameters
    ----------
    path : Path or str
        A JSON file; ``docs/design-file.md`` says what stands in it.

    Raises
    ------
    FileError
        With every problem found: file, key, value and what is allowed.
    """
    path = Path(path)
    return _read_design(read_source(path, max_bytes=MAX_BYTES), Report(str(path)))


def save_text(design: DesignFile) -> str:
    """Give the canonical text of a design file: ASCII, LF, fixed order of keys, numbers rounded for storage.

    The text is read back before it is given, so that no file is written that cannot be loaded.

    Raises
    ------
    FileError
        If the design breaks a rule that `load_design` checks.
    """
    text = _layout(document_of(design), "") + "\n"
    _read_design(text, Report("design"))
    return text


def as_stored(design: DesignFile) -> DesignFile:
    """Give a design with every number as its file holds it.

    Code is made from these numbers from the start: made from longer ones, it would change once the file is
    read back.

    Raises
    ------
    FileError
        If the design breaks a rule that `load_design` checks.
    """
    return _read_design(save_text(design), Report("design"))


def design_sha256(design: DesignFile) -> str:
    """Give the SHA-256, in hexadecimal, of the compact JSON: what `save_text` gives, without blanks.

    A design and its saved file have the same hash, however the file is indented.
    """
    compact = json.dumps(document_of(design), separators=(",", ":"))
    return hashlib.sha256(compact.encode("ascii")).hexdigest()


def _read_design(text: str, report: Report) -> DesignFile:
    document = _parse(text, report)
    _check_schema(document, report)
    design = read_record(DesignFile, document, Place(report, ""))
    if design is None or report.problems:
        raise FileError(report.problems)
    return design


def _check_schema(document: object, report: Report) -> None:
    """Refuse what is another kind of file: nothing else that stands in it is worth a word then."""
    schema = document.get("schema", SCHEMA) if isinstance(document, dict) else SCHEMA
    if isinstance(schema, str) and schema in _OTHERS:
        reason = f"stores {_OTHERS[schema]}, which 'swayless generate' and 'swayless verify' take"
        raise FileError([f"{report.file}: schema = {shown(schema)}: must be {SCHEMA}: this file {reason}"])
    choice("schema", (SCHEMA,))(schema, Place(report, "schema"))
    if report.problems:
        raise FileError(report.problems)


def _parse(text: str, report: Report) -> object:
    if not text.strip():
        reason = "is empty: a design file is JSON that 'swayless design' or 'swayless build' writes"
        raise FileError([f"{report.file}: {reason}"])

    def without_twins(pairs: list[tuple[str, object]]) -> dict[str, object]:
        for key, times in Counter(key for key, _ in pairs).items():
            if times > 1:
                Place(report, "").problem(f"key {shown(key)} stands {times} times in one object")
        return dict(pairs)

    try:
        return json.loads(text, object_pairs_hook=without_twins)
    except json.JSONDecodeError as error:
        reason = f"line {error.lineno}, column {error.colno}: not valid JSON: {error.msg}"
        raise FileError([f"{report.file}: {reason}"]) from error
    except (ValueError, RecursionError) as error:
        raise FileError([f"{report.file}: not valid JSON: {error}"]) from error


def _layout(value: Any, indent: str) -> str:
    """Print objects over several lines, and an array on one line where it fits; a text is never broken."""
    deeper = indent + _INDENT
    if isinstance(value, dict):
        lines = [f"{deeper}{json.dumps(key)}: {_layout(item, deeper)}" for key, item in value.items()]
        return "{\n" + ",\n".join(lines) + f"\n{indent}}}"
    text = json.dumps(value)
    is_long = isinstance(value, list) and len(indent) + len(text) > _LINE_LENGTH
    if (
        isinstance(value, list)
        and value
        and (isinstance(value[0], dict) or (is_long and isinstance(value[0], str)))
    ):
        items = [deeper + _layout(item, deeper) for item in value]
        return "[\n" + ",\n".join(items) + f"\n{indent}]"
    if is_long:
        numbers = textwrap.fill(text[1:-1], _LINE_LENGTH, initial_indent=deeper, subsequent_indent=deeper)
        return f"[\n{numbers}\n{indent}]"
    return text
