"""The identifier of a design."""

import zlib
from dataclasses import replace
from pathlib import Path

from swayless.machine.design_file import load_design, save_text
from swayless.machine.design_id import design_id

STORED = sorted((Path(__file__).parents[2] / "golden").rglob("*.design.json"))


def test_the_identifier_is_what_a_crc_tool_says_of_the_saved_file(tmp_path):
    design = load_design(STORED[0])
    path = tmp_path / "design.json"
    path.write_text(save_text(design), encoding="ascii", newline="\n")
    assert design_id(design) == zlib.crc32(path.read_bytes())
    assert design_id(load_design(path)) == design_id(design)


def test_another_name_or_number_type_is_another_design():
    design = load_design(STORED[0])
    other = "float" if design.number == "double" else "double"
    found = {design_id(each) for each in (design, replace(design, name="x"), replace(design, number=other))}
    assert len(found) == 3
