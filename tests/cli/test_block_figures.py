"""The timing diagrams of the data sheet are runs of the reference of today."""

from __future__ import annotations

import importlib
import json
import re
import sys
from pathlib import Path

import pytest

from swayless.controller import Status

DOCS = Path(__file__).parents[2] / "docs"
PAGE = (DOCS / "block.md").read_text(encoding="utf-8")

sys.path.insert(0, str(DOCS))
block, drawing = importlib.import_module("block"), importlib.import_module("block_drawing")
sys.path.remove(str(DOCS))

SCENES = block.SCENES


@pytest.fixture(scope="module")
def played():
    """Every scene, played once."""
    return {name: block.play(scene) for name, scene in SCENES.items()}


@pytest.mark.parametrize("name", SCENES)
def test_a_diagram_is_what_the_reference_does(name, played):
    svg = (block.FOLDER / f"{name}.svg").read_text(encoding="utf-8")
    references, statuses = json.loads(re.findall(r"<!-- (\[\[.*\]\]) -->", svg)[-1])
    fresh = json.loads(block.drawn_from(played[name]))
    # Stored to six decimals; designs may differ in their twelfth digit.
    assert references == pytest.approx(fresh[0], abs=2e-6)
    assert statuses == fresh[1]
    assert f"(block/{name}.svg)" in PAGE


@pytest.mark.parametrize("name", SCENES)
def test_every_lane_of_a_diagram_shows_something(name, played):
    scene = SCENES[name]
    for lane in (*scene.inputs, *scene.lanes):
        assert any(drawing.values_of(played[name], lane)), lane


def test_there_is_a_diagram_for_every_status_bit_but_those_without_motion():
    shown = {lane for scene in SCENES.values() for lane in scene.lanes} & set(Status.__members__)
    told = {"SELECTOR_INVALID", "ROPE_OUT_OF_RANGE", "HOIST_SPEED_INVALID", "STEP_SIZE_INVALID"}
    told |= {"ROPE_OFFSET_INVALID", "TABLES_INVALID"}
    assert set(Status.__members__) - shown == told


def test_no_other_figure_stands_there():
    assert {path.stem for path in block.FOLDER.glob("*")} - {"__pycache__"} == set(SCENES)


def test_a_diagram_is_drawn_without_a_warning(played):
    assert drawing.draw(SCENES["knob"], played["knob"]).get_suptitle() == SCENES["knob"].title
