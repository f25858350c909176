from __future__ import annotations

import re
from pathlib import Path

import pytest

from swayless.design import FAMILIES
from swayless.machine import (
    Machine,
    bank_section,
    design_document,
    load_machine,
    machine_file,
    move_section,
    operator_record,
)
from swayless.machine.bank_section import OptionedTable
from swayless.machine.problems import Table
from swayless.machine.record import Record, members

DOCS = Path(__file__).parents[3] / "docs"

OTHER_KEYS = """
[[row]]
name = "a"
family = "zvm"
order = 2
rope_length = 5
[[row]]
name = "b"
family = "oatf"
delay = 1
rope_length = 5
[[row]]
name = "c"
family = "fd"
duration = 3
rope_length = 5
"""
"""Rows whose families take keys that the documented rows do not have."""

FUNCTIONS = ("[steps]", "[limits]", "[tuning]")
"""Sections that share a page."""

SAME_PAGE = {"[arm]": "[crane]"}


def _keys_asked_for(path: Path, monkeypatch: pytest.MonkeyPatch) -> dict[str, set[str]]:
    """Every key that the loader asks a section for."""
    asked: dict[str, set[str]] = {}

    class Watched(Table):
        def close(self) -> None:
            section = re.sub(r"(\[\[\w+\]\]).*", r"\1", self.prefix).strip()
            asked.setdefault(section, set()).update(self.asked)
            super().close()

    class WatchedOptions(OptionedTable, Watched):
        pass

    for module in (machine_file, move_section):
        monkeypatch.setattr(module, "Table", Watched)
    monkeypatch.setattr(bank_section, "OptionedTable", WatchedOptions)
    assert isinstance(load_machine(path), Machine)
    return asked


def test_every_key_of_the_machine_file_is_documented_in_its_section(
    tmp_path: Path, machine_text: str, bank_text: str, arm_text: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: dict[str, set[str]] = {}
    for text in (machine_text + OTHER_KEYS, bank_text, arm_text):
        path = tmp_path / "crane.toml"
        path.write_text(text)
        for section, keys in _keys_asked_for(path, monkeypatch).items():
            asked.setdefault(SAME_PAGE.get(section, section), set()).update(keys)
    pages = re.split(r"\n## ", (DOCS / "machine-file.md").read_text(encoding="utf-8"))
    section_pages = {"": "At the top", "[crane]": "`[crane]`", "[drive]": "`[drive]`"}
    section_pages |= {"[controller]": "`[controller]`", "[[row]]": "`[[row]]`", "[bank]": "`[bank]`"}
    section_pages |= {"[[move]]": "`[[move]]`"}
    section_pages |= dict.fromkeys(FUNCTIONS, "`[steps]`")
    assert asked.keys() == section_pages.keys()
    together = set().union(*(asked[section] for section in FUNCTIONS))
    for section, keys in (asked | dict.fromkeys(FUNCTIONS, together)).items():
        page = next(page for page in pages if page.startswith(section_pages[section]))
        documented = set(re.findall(r"`(\w+)`", " ".join(re.findall(r"^\|([^|]*)\|", page, re.MULTILINE))))
        sections_of_their_own = (
            {"crane", "arm", "drive", "controller", "row", "bank", "move", "steps", "limits", "tuning"}
            if not section
            else set()
        )
        assert keys - sections_of_their_own == documented


def test_every_key_of_the_design_file_is_documented() -> None:
    page = (DOCS / "design-file.md").read_text(encoding="utf-8")
    documented = set(re.findall(r"^\| `(\w+)`", page, re.MULTILINE))
    records = [
        value
        for module in (design_document, operator_record)
        for value in vars(module).values()
        if isinstance(value, type)
    ]
    known = {key for cls in records if issubclass(cls, Record) for key in members(cls)}
    assert documented == known


def test_every_family_is_documented_on_its_side() -> None:
    page = (DOCS / "machine-file.md").read_text(encoding="utf-8")
    positive, negative = page.split("Families with positive amplitudes")[1].split(
        "Families with negative amplitudes"
    )
    for family in FAMILIES.values():
        assert (f"`{family.name}`" in negative) is family.negative
        assert (f"`{family.name}`" in positive) is not family.negative
