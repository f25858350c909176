"""Generated adaptive shapers equal the reference in every bit: C and Structured Text, double and float."""

import dataclasses

import pytest

from swayless.codegen.adaptive_files import generate_adaptive
from swayless.codegen.adaptive_model import AdaptiveModel
from swayless.controller import number_type
from swayless.controller.adaptive import AdaptiveSettings, AdaptiveStatus
from swayless.errors import CodegenError
from swayless.verify import COMPILERS, adaptive, find_compiler
from swayless.verify.adaptive import adaptive_stimuli, run_adaptive_reference, verify_adaptive

PRESENT = [compiler for compiler in COMPILERS if compiler.name == "zig" or compiler.is_installed()]

SMALL = AdaptiveSettings(3, 0.004, 0.7, 25.0, 200, max_reference=2.1, lag_ticks=2)
SMALLEST = AdaptiveSettings(1, 0.01, 5.0, 0.01, 1, max_reference=40.0, dead_zone_ratio=0.0)
ROBOT = AdaptiveSettings(25, 0.001, 1.0, 100.0, 4000)


def model_of(settings, number):
    return AdaptiveModel(dataclasses.replace(settings, number=number_type(number)), "robot", "swayless")


@pytest.mark.parametrize("number", ["double", "float"])
@pytest.mark.parametrize(("settings", "moves"), [(SMALL, 30), (ROBOT, 9)], ids=["small", "robot"])
def test_every_bit_of_every_output_is_the_reference_s(settings, moves, number, monkeypatch):
    monkeypatch.setattr(adaptive, "MOVES", moves)
    model = model_of(settings, number)
    files = {target: generate_adaptive(model, target) for target in ("c", "st")}
    verdicts = verify_adaptive(model, c_files=files["c"], st_files=files["st"], compiler=find_compiler())
    found = [(each.code, each.stimulus, each.comparison.first_difference) for each in verdicts]
    assert len(found) == 10
    assert [difference for *_, difference in found] == [None] * 10


@pytest.mark.parametrize("compiler", PRESENT, ids=lambda compiler: compiler.name)
def test_every_compiler_accepts_the_code_without_a_warning(compiler, monkeypatch):
    monkeypatch.setattr(adaptive, "MOVES", 4)
    model = model_of(SMALLEST, "float")
    verdicts = verify_adaptive(model, c_files=generate_adaptive(model, "c"), compiler=compiler)
    assert all(each.comparison.is_equal for each in verdicts)


def test_the_stimuli_reach_every_status_bit():
    settings, seen = model_of(SMALL, "double").settings, 0
    for each in (settings, dataclasses.replace(settings, max_reference=None)):
        for stimulus in adaptive_stimuli(each):
            for status in set(run_adaptive_reference(each, stimulus.inputs)["status"].tolist()):
                seen |= status
    assert AdaptiveStatus(seen) == AdaptiveStatus((1 << 10) - 1)


@pytest.mark.parametrize(
    ("right", "wrong"), [("Shaping AND Fresh", "Shaping"), ("DiffW * PastUw", "DiffW * PastUu")]
)
def test_what_is_left_out_or_wrong_is_found(right, wrong, monkeypatch):
    monkeypatch.setattr(adaptive, "MOVES", 10)
    model = model_of(SMALL, "double")
    (file,) = generate_adaptive(model, "st")
    changed = dataclasses.replace(file, text=file.text.replace(right, wrong))
    assert changed != file
    verdicts = verify_adaptive(model, st_files=[changed])
    assert any(not each.comparison.is_equal for each in verdicts)


def test_the_header_states_the_memory_and_refuses_more():
    header = generate_adaptive(model_of(ROBOT, "double"), "c")[0].text
    assert "#define ROBOT_ADAPTIVE_RAM (1068u)" in header


def test_reserved_names_and_targets_are_refused():
    with pytest.raises(CodegenError, match="reserved"):
        AdaptiveModel(ROBOT, "int", "swayless")
    with pytest.raises(CodegenError, match="target 'ada': must be one of c, st"):
        generate_adaptive(model_of(ROBOT, "double"), "ada")
