"""The models of blocks whose taps follow a spacing: pins, names, memory and what the head says."""

import re

import pytest

from swayless.codegen import TARGETS, generate
from swayless.codegen.c_model import CModel
from swayless.codegen.interface import input_pins
from swayless.codegen.provenance import header_lines
from tests.compiled.spacing_blocks import BLOCKS, arm, rope
from tests.unit.codegen.test_provenance import ORIGIN
from tests.unit.controller.blocks import ZVD, block, phase_block
from tests.unit.controller.spaced_blocks import rope_block

LAWS, NUMBERS = ("original", "modified"), TARGETS["c"].number_types
CASES = [(name, law, number) for name in BLOCKS for law in LAWS for number in NUMBERS]


@pytest.mark.parametrize(
    ("number", "pins"),
    [
        ("double", ["position_rad", "position_speed_rad_s", "position_valid"]),
        ("float", ["position_rad", "position_speed_rad_s", "position_valid"]),
        ("int32", ["position_mrad", "position_speed_mrad_s", "position_valid"]),
    ],
)
def test_pins_of_an_arm_come_last_and_say_their_unit(number, pins):
    found = input_pins(arm("modified", number))[-3:]
    assert [pin.c_name for pin in found] == pins
    assert [pin.st_name for pin in found] == ["Position", "PositionSpeed", "PositionValid"]
    unit = "mrad" if number == "int32" else "rad"
    texts = [pin.text(is_integer=number == "int32") for pin in found]
    assert [text.split()[0] for text in texts[:2]] == [f"[{unit}]", f"[{unit}/s]"]


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("law", LAWS)
def test_the_c_of_an_arm_names_neither_rope_nor_hoist_but_for_the_status_bits(law, number):
    text = "".join(file.text for file in generate(arm(law, number), ORIGIN, "c"))
    text = re.sub(r"CRANE_SHAPER_(ROPE|HOIST)_\w+|a slack rope", "", text)
    assert not re.search("rope|hoist", text, re.IGNORECASE)
    assert "position" in text


@pytest.mark.parametrize(("name", "law", "number"), CASES)
def test_generated_text_keeps_to_the_line_width_and_every_symbol_to_its_prefix(name, law, number):
    header, source, example = generate(BLOCKS[name](law, number), ORIGIN, "c")
    for file in (header, source, example):
        assert max(map(len, file.text.split("\n"))) <= 120
        assert not re.search(r"[ \t]+$", file.text, re.MULTILINE)
    code = re.sub(r"/\*.*?\*/|///.*?$", "", header.text + source.text, flags=re.DOTALL | re.MULTILINE)
    defined = re.findall(
        r"^(?:static )?(?:const )?(?:void|bool|u?int\w+|crane_\w+) (\w+)[(\[ ]", code, re.MULTILINE
    )
    assert len(defined) > 40
    assert [symbol for symbol in defined if not symbol.startswith("crane_")] == []


@pytest.mark.parametrize("number", NUMBERS)
def test_blocks_of_other_laws_print_nothing_of_a_spacing(number):
    for settings in (block(ZVD, number=number), phase_block(number)):
        text = "".join(file.text for file in generate(settings, ORIGIN, "c"))
        assert not re.search("spacing|piece|disturbed|lap_sum", text, re.IGNORECASE)


@pytest.mark.parametrize("law", LAWS)
def test_the_head_names_the_law_its_price_memory_and_worst_tick(law):
    settings = rope(law, "double")
    model = CModel(settings, ORIGIN)
    head = " ".join(line.strip() for line in model.provenance)
    price = {
        "original": "leaves gaps and surplus that shake the load",
        "modified": "longer or shorter than commanded",
    }
    for words in (
        f"law {law} (command shaping by a spacing)",
        f"Settled after {settings.longest_delay_ticks} ticks without change at the widest spacing.",
        "1 row 1: zvd at multiples of 8 to 15 ticks, damping ratio 0",
        "at every rope length of the range that is held still",
        price[law],
        "exact once the rope length has been still for the longest delay",
        f"State: {model.state.ram_bytes} bytes at most",
        "at most 5, and 3 looks into the table of the spacing; none when settled",
        "Rope 3 to 9 m, hoisted with at most 0.4 m/s.",
    ):
        assert words in head
    assert "Position -0.5 to 0.9 rad, moved with at most 1.5 rad/s." in header_lines(
        arm(law, "float"), ORIGIN, []
    )


@pytest.mark.parametrize(
    ("law", "number", "cell_bytes"),
    [
        ("original", "double", 20),  # a sum, what is released, and the number of the run
        ("original", "float", 12),
        ("modified", "double", 18),  # a sum, a command and the spacing of its tick
        ("modified", "int32", 14),
    ],
)
def test_memory_grows_by_a_few_bytes_for_each_tick_of_the_longest_delay(law, number, cell_bytes):
    coarse, fine = (rope_block(number, law, tick_s=tick_s, tolerance=0.2) for tick_s in (0.1, 0.01))
    ticks = fine.longest_delay_ticks - coarse.longest_delay_ticks
    small, large = (CModel(settings, ORIGIN).state.ram_bytes for settings in (coarse, fine))
    assert abs(large - small - cell_bytes * ticks) < 8  # alignment
