"""The code models: what they refuse, and that the same settings give the same bytes."""

import hashlib
import os
import re
import subprocess
import sys

import pytest

from swayless.codegen import TARGETS, generate
from swayless.codegen.c_model import CModel
from swayless.codegen.st_model import StModel
from swayless.controller.status import ROPE_BITS
from swayless.errors import CodegenError
from tests.unit.codegen.test_provenance import ORIGIN
from tests.unit.controller.blocks import EI, UM_SPLIT, ZVD, block

EVERYTHING = {
    "minimum_speed_m_s": 0.03,
    "inching_speed_m_s": 0.08,
    "command_resolution_m_s": 0.02,
    "deceleration_m_s2": 0.7,
    "quick_stop_m_s2": 2.0,
}
CASES = [(target, number) for target in TARGETS for number in TARGETS[target].number_types]


def digests():
    """SHA-256 of all files of all targets and number types."""
    found = []
    for target, number in CASES:
        for limits in ({}, EVERYTHING):
            for file in generate(block(ZVD, UM_SPLIT, EI, number=number, **limits), ORIGIN, target):
                found.append(f"{file.path} {hashlib.sha256(file.text.encode()).hexdigest()}")
    return found


def test_same_settings_give_the_same_bytes_in_another_process_and_order_of_hashing():
    command = [
        sys.executable,
        "-c",
        "from tests.unit.codegen.test_models import digests; print(*digests(), sep='\\n')",
    ]
    for seed in ("1", "2"):
        done = subprocess.run(
            command, env=os.environ | {"PYTHONHASHSEED": seed}, capture_output=True, text=True, check=True
        )
        assert done.stdout.split("\n")[:-1] == digests()


@pytest.mark.parametrize(("target", "number"), CASES)
def test_generated_text_names_no_clock_path_or_host_and_keeps_to_the_line_width(target, number):
    for file in generate(block(ZVD, UM_SPLIT, number=number, **EVERYTHING), ORIGIN, target):
        assert not re.search(r"/(home|work|tmp|usr|root)/|[0-9]{2}:[0-9]{2}|20[0-9]{2}-", file.text)
        assert max(map(len, file.text.split("\n"))) <= 120
        assert not re.search(r"[ \t]+$", file.text, re.MULTILINE)


def test_a_target_or_number_type_that_does_not_exist_is_refused():
    with pytest.raises(CodegenError, match="target 'ada': must be one of c, st"):
        generate(block(ZVD), ORIGIN, "ada")
    with pytest.raises(CodegenError, match="number = 'int32': target 'st' calculates in double or float"):
        generate(block(ZVD, number="int32"), ORIGIN, "st")
    with pytest.raises(CodegenError, match="number = 'int32': Structured Text calculates in LREAL"):
        StModel(block(ZVD, number="int32"), ORIGIN)


def test_every_symbol_of_the_c_starts_with_the_machine_name():
    for number in TARGETS["c"].number_types:
        header, source, _ = generate(block(ZVD, UM_SPLIT, number=number, **EVERYTHING), ORIGIN, "c")
        code = re.sub(r"/\*.*?\*/|///.*?$", "", header.text + source.text, flags=re.DOTALL | re.MULTILINE)
        defined = re.findall(
            r"^(?:static )?(?:const )?(?:void|bool|u?int\w+|crane_\w+) (\w+)[(\[ ]", code, re.MULTILINE
        )
        defined += re.findall(r"^#define (\w+)", code, re.MULTILINE) + re.findall(
            r"^\} (\w+);", code, re.MULTILINE
        )
        assert len(defined) > 40
        assert [name for name in defined if not name.lower().startswith("crane_")] == []


def test_status_bits_of_both_languages_are_those_of_the_reference():
    settings = block(ZVD)
    bits = {bit.name: 1 << bit.position for bit in CModel(settings, ORIGIN).status_bits}
    expected = {bit.name: bit.value for bit in settings.status_bits}
    assert bits == StModel(settings, ORIGIN).st_bits == expected
    assert not ROPE_BITS & sum(expected.values())  # no measured rope


@pytest.mark.parametrize("number", ["double", "float", "int32"])
def test_parts_of_the_law_that_a_design_does_not_use_are_not_printed(number):
    plain = generate(block(ZVD, number=number), ORIGIN, "c")[1].text
    full = generate(block(ZVD, UM_SPLIT, number=number, **EVERYTHING), ORIGIN, "c")[1].text
    for word in ("INCHING_COMMAND", "MINIMUM_COMMAND", "COMMAND_RESOLUTION", "WAITS["):
        assert word not in plain
        assert word in full
