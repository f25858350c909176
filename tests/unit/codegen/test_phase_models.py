"""The models of blocks with a measured rope: pins, bits, names and what the head says."""

import re

import pytest

from swayless.codegen import TARGETS, generate
from swayless.codegen.c_model import CModel
from swayless.codegen.interface import input_pins
from swayless.codegen.provenance import header_lines
from swayless.controller.status import ROPE_BITS
from tests.unit.codegen.test_provenance import ORIGIN
from tests.unit.controller.blocks import ZVD, block, phase_block

NUMBERS = TARGETS["c"].number_types


@pytest.mark.parametrize(
    ("number", "pins"),
    [
        ("double", ["rope_length_m", "hoist_speed_m_s", "rope_length_valid"]),
        ("float", ["rope_length_m", "hoist_speed_m_s", "rope_length_valid"]),
        ("int32", ["rope_length_mm", "hoist_speed_mm_s", "rope_length_valid"]),
    ],
)
def test_pins_of_a_measured_rope_come_last_and_say_their_unit(number, pins):
    found = input_pins(phase_block(number))
    assert [pin.c_name for pin in found[-3:]] == pins
    assert [pin.st_name for pin in found[-3:]] == ["RopeLength", "HoistSpeed", "RopeLengthValid"]
    assert found[:-3] == input_pins(block(ZVD, number=number, max_speed_m_s=0.8))


@pytest.mark.parametrize("number", NUMBERS)
def test_generated_text_keeps_to_the_line_width_and_ends_no_line_in_a_space(number):
    for file in generate(phase_block(number), ORIGIN, "c"):
        assert max(map(len, file.text.split("\n"))) <= 120
        assert not re.search(r"[ \t]+$", file.text, re.MULTILINE)


@pytest.mark.parametrize("number", NUMBERS)
def test_every_symbol_starts_with_the_machine_name(number):
    header, source, _ = generate(phase_block(number), ORIGIN, "c")
    code = re.sub(r"/\*.*?\*/|///.*?$", "", header.text + source.text, flags=re.DOTALL | re.MULTILINE)
    defined = re.findall(
        r"^(?:static )?(?:const )?(?:void|bool|u?int\w+|crane_\w+) (\w+)[(\[ ]", code, re.MULTILINE
    )
    defined += re.findall(r"^#define (\w+)|^\} (\w+);", code, re.MULTILINE)[0]
    assert len(defined) > 60
    assert [name for name in defined if name and not name.lower().startswith("crane_")] == []


def test_a_measured_rope_adds_its_bits_to_the_status_word():
    added = {bit.name for bit in CModel(phase_block(), ORIGIN).status_bits}
    added -= {bit.name for bit in CModel(block(ZVD), ORIGIN).status_bits}
    assert added == {bit.name for bit in ROPE_BITS}


@pytest.mark.parametrize("number", NUMBERS)
def test_the_tick_clock_prints_nothing_of_ropes_and_phases(number):
    text = "".join(file.text for file in generate(block(ZVD, number=number), ORIGIN, "c"))
    for word in ("rope_length", "ROPE_", "hoist", "quanta", "QUANTA", "stretch"):
        assert word not in text


@pytest.mark.parametrize("number", NUMBERS)
def test_the_phase_clock_uses_no_function_of_a_library_and_no_ticks_of_the_tick_clock(number):
    source = generate(phase_block(number), ORIGIN, "c")[1].text
    assert re.findall(r"#include\s+(\S+)", source) == ['"crane_shaper.h"']
    for word in ("LAST_TICKS", "TAIL_TICKS", "still_ticks", "DELAY_TICKS"):
        assert word not in source


def test_the_head_names_the_law_the_signs_and_what_bad_readings_do():
    text = " ".join(header_lines(phase_block(), ORIGIN, []))
    for words in (
        "law phase (hoisting while travelling)",
        "positive when the load sinks",
        "the last one holds, shaping goes on",
        "exact on a rope that is held still",
        "but never the maximum",
        "Rope 3 to 9 m, hoisted with at most 0.4 m/s.",
        "on every rope of the range that is held still",
    ):
        assert words in text
    assert "law fixed (tick clock)" in " ".join(header_lines(block(ZVD), ORIGIN, []))


def test_the_memory_of_the_ring_follows_the_longest_lag_on_the_longest_rope():
    short, long = (phase_block(rope_length_m=(3.0, longest)) for longest in (4.0, 9.0))
    small, large = (CModel(settings, ORIGIN).state.ram_bytes for settings in (short, long))
    cell_bytes = 40  # two parts, two inverses that are foreseen, and a gap, aligned
    assert large - small == cell_bytes * (long.longest_delay_ticks - short.longest_delay_ticks)
