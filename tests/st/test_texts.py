"""What people read in a Structured Text file, and which names it may not have."""

import re
from dataclasses import replace

import pytest

from swayless.codegen import generate
from swayless.codegen.axes_model import AxisBlock, generate_axes
from swayless.codegen.names import check_st_names
from swayless.errors import CodegenError
from tests.st.test_spacing_blocks import arm
from tests.unit.codegen.test_provenance import ORIGIN
from tests.unit.controller.blocks import EI, ZVD, block


def text_of(settings):
    return generate(settings, ORIGIN, "st")[0].text


def test_head_of_an_arm_names_what_shakes_an_arm():
    assert "slack rope" in text_of(block(ZVD))
    text = generate(arm("modified", "double"), replace(ORIGIN, is_arm=True), "st")[0].text
    assert "Wind, pushes and a load that slips are beyond" in text


@pytest.mark.parametrize(
    ("rows", "said"), [((ZVD,), "0 unshaped, 1 the row;"), ((ZVD, EI), "0 unshaped, 1 to 2 rows;")]
)
def test_the_selector_says_which_rows_there_are(rows, said):
    assert said in text_of(block(*rows))


def test_no_line_of_the_head_of_several_axes_begins_with_a_single_space():
    blocks = [AxisBlock(axis, block(ZVD), ORIGIN) for axis in ("bridge", "trolley")]
    head = generate_axes("yard", blocks, "st")[0].text.split("*)")[0]
    assert "\nyard: one pendant" in head
    assert not re.search(r"^ \S", head, re.MULTILINE)


@pytest.mark.parametrize("word", ["SizeOf", "adr", "PARAMS", "persistent", "ret", "indexof"])
def test_words_that_an_ide_takes_are_refused_as_names(word):
    with pytest.raises(CodegenError, match=f"name '{word}' is reserved in Structured Text"):
        check_st_names("crane", [word])
