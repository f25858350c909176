"""Structured Text of Magee and Book's laws equals the reference in every bit of every output."""

import re
from dataclasses import replace

import numpy as np
import pytest

from swayless.controller import Bank, Row, Status, number_type
from swayless.controller.measured import ARM_ANGLE
from swayless.controller.original_filter import MOST_RUNS
from swayless.controller.rope import rope_settings
from swayless.controller.spaced_taps import spaced_taps
from swayless.controller.spacing import sampled_spacing
from swayless.design import design_shaper
from swayless.plant import Mode
from swayless.verify.comparison import compare
from swayless.verify.reference_run import run_reference
from swayless.verify.st_run import EvaluatedBlock
from tests.st.test_phase_blocks import EVERYTHING, History, difference, text_of
from tests.unit.controller.spaced_blocks import rope_block, settings_of, spaced_block

TICKS = 10_000
LAWS = ("original", "modified")
NUMBERS = ("double", "float")
LOOSE = 0.9
"""Residual promised, which the law does not read: few ticks leave as much, and lap rings often."""

SPACINGS = (3, 4, 5, 9, 14)


def jumping(law, number):
    """Spacings that jump, as every reading of a position of 1 to 5 is taken; every optional part."""
    return spaced_block(number, law, amplitudes=[0.25, 0.5, 0.25], ticks=SPACINGS, **EVERYTHING)


def creeping(law, number):
    """Rows of two and five taps on a rope whose hoist creeps and whose readings fail."""
    base = rope_block(number, law, family="zv", tick_s=0.25, tolerance=LOOSE)
    shaper = design_shaper("zvddd", Mode(1.0))
    spacing = base.bank.rows[0].taps.spacing
    guarantee = replace(shaper.guarantee, tolerance=LOOSE)
    taps = spaced_taps(shaper, spacing, law, tick_s=0.25, guarantee=guarantee, number=base.number)
    return replace(base, bank=Bank((*base.bank.rows, Row("far", "zvddd", taps))))


def arm(law, number):
    """An arm whose frequency rises and falls over its angle, from -0.5 rad on."""
    kind, tick_s = number_type(number), 0.02
    angles = (-0.5, 0.2, 0.9)
    spacing = sampled_spacing(angles, [2.0, 5.5, 3.0], 0.02, tick_s=tick_s, number=kind)
    shaper = design_shaper("zvd", Mode(1.0, 0.02))
    guarantee = replace(shaper.guarantee, tolerance=LOOSE)
    taps = spaced_taps(shaper, spacing, law, tick_s=tick_s, guarantee=guarantee, number=kind)
    rope = rope_settings((angles[0], angles[-1]), 1.5, tick_s=tick_s, number=kind, measured=ARM_ANGLE)
    return settings_of(taps, rope, tick_s=tick_s)


def inputs_of(settings, ticks):
    """What an operator and a fault would do; positions creep, jump, and tremble where the spacing changes."""
    history = History(settings, ticks)
    made = history.inputs()
    starts = np.array(settings.bank.rows[0].taps.spacing.starts, dtype=float)
    last = settings.longest_delay_ticks
    jumps = history.held(starts, last)
    trembling = jumps + history.random.normal(0.0, 0.01, ticks)
    creeps = starts[0] + (starts[-1] - starts[0]) * np.abs(np.arange(ticks) % (8 * last) / (4 * last) - 1.0)
    ways = np.stack([jumps, trembling, creeps, made["rope_length"], history.held(starts, 20 * last)])
    made["rope_length"] = ways[history.held(range(len(ways)), 8 * last), np.arange(ticks)]
    # In between commands are held for long enough to settle at speed, and change together with the knob.
    held, steady = history.held(range(12), 5 * last), history.held([False, True], 20 * last)
    levels = np.array([0.0, 1.0, -0.6, 0.3]) * float(settings.limits.max_command)
    made["command"] = np.where(steady, levels[held % 4], made["command"])
    made["selector"] = np.where(steady, held // 4, made["selector"])
    return made


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("made", [jumping, creeping, arm])
def test_spaced_block_equals_the_reference_in_every_bit(made, law, number):
    settings = made(law, number)
    inputs = inputs_of(settings, TICKS)
    assert difference(settings, inputs) is None
    seen = int(np.bitwise_or.reduce(run_reference(settings, inputs)["status"]))
    expected = Status.ROW_WAITS | Status.ROPE_INVALID | Status.ROPE_OUT_OF_RANGE | Status.EMERGENCY_STOP
    assert seen & expected == expected


@pytest.fixture(scope="module")
def known_runs():
    runs = {}
    for law in LAWS:
        settings = jumping(law, "double")
        inputs = inputs_of(settings, 4000)
        runs[law] = settings, inputs, run_reference(settings, inputs)
    return runs


@pytest.mark.parametrize(
    ("law", "right", "wrong"),
    [
        ("original", "SpacingBefore := Spacing", "SpacingBefore := LastTicks"),
        ("original", "AND (Ramped <> 0.0)", "AND (Ramped = 0.0)"),
        ("original", " OR Disturbed", ""),
        ("original", "StartSpacing := SpacingBefore", "StartSpacing := Spacing"),
        ("original", "Age := 0;\n      (*", "(*"),
        ("original", "Part := Parts[Cell] + Part", "Part := Part"),
        ("original", "PartRuns[PartCell] := 0", "Part := 0.0"),
        ("original", "> Age) THEN", ">= Age) THEN"),
        ("original", "RunNumber := RunNumber + 1", "RunNumber := RunNumber"),
        ("modified", "StartSpacing := Spacing", "StartSpacing := 0"),
        ("modified", "SpacingThen := StartSpacing", "SpacingThen := Spacing"),
        ("modified", "AgreedDelay := i * SpacingThen", "AgreedDelay := WantedDelay"),
        ("modified", "IF Delay < AgreedDelay THEN", "IF FALSE THEN"),
        ("modified", "TapDelays[i] := Delay", "Delay := Delay"),
        ("modified", "Delay := TapDelays[i];\n      END_IF", "Delay := i * Spacing;\n      END_IF"),
        *(
            (law, right, wrong)
            for law in LAWS
            for right, wrong in (
                ("(Piece + Strides[i]) <= LastPiece", "(Piece + Strides[i]) < LastPiece"),
                ("CommandSums[Head] := CommandSum + Ramped", "CommandSums[Head] := Ramped"),
                ("LapSum := CommandSums[Head]", "LapSum := 0.0"),
                ("(LapSum - CommandSums[", "(0.0 - CommandSums["),
                ("DINT_TO_LREAL((Delay - Head) - 1)", "DINT_TO_LREAL(Delay - Head)"),
                ("LagTicks := (TapCount - 1) * Spacing", "LagTicks := LastTicks"),
            )
        ),
    ],
)
def test_a_wrong_term_of_the_law_is_found_within_4000_ticks(known_runs, law, right, wrong):
    settings, inputs, expected = known_runs[law]
    text = text_of(settings)
    assert right in text
    block = EvaluatedBlock(text.replace(right, wrong), settings)
    # Most are found at once.
    assert any(not compare(expected[:n], block.run(inputs[:n])).is_equal for n in (400, inputs.size))


def test_runs_of_the_original_law_can_be_numbered_anew_after_as_many_as_the_ring_has_cells():
    settings = jumping("original", "double")
    cells = settings.longest_delay_ticks + 1
    inputs = inputs_of(settings, 3000)
    inputs["enable"], inputs["selector"], inputs["quick_stop"] = True, 1, False
    inputs["emergency_stop"] = np.arange(3000) % 3 == 0
    inputs["command"] = np.where(np.arange(3000) % 3 < 2, 0.0, 0.4)  # so that a run has one tick
    text = text_of(settings)
    assert f"MostRuns : DINT := {MOST_RUNS};" in text
    assert difference(settings, inputs, text.replace(str(MOST_RUNS), str(cells))) is None
    assert difference(settings, inputs, text.replace(str(MOST_RUNS), "2")) is not None


@pytest.mark.parametrize("law", LAWS)
def test_a_block_that_is_initialized_again_remembers_nothing(law):
    settings = jumping(law, "double")
    inputs = inputs_of(settings, 2000)
    inputs["selector"][1000:] = np.minimum(inputs["selector"][1000:], 1)
    inputs["selector"][1000] = 77
    once, again = "IF NOT Initialized THEN", "IF (NOT Initialized) OR (Selector = 77) THEN"
    restarted = EvaluatedBlock(text_of(settings).replace(once, again), settings).run(inputs)[1000:]
    assert compare(run_reference(settings, inputs[1000:]), restarted).is_equal


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("made", [jumping, creeping, arm])
def test_every_declared_name_is_used_and_none_is_of_another_law(made, law):
    text = text_of(made(law, "double"))
    declared = re.findall(r"^  (\w+) : ", text, re.MULTILINE)
    code = re.sub(r"\(\*.*?\*\)", "", text, flags=re.DOTALL)
    assert [name for name in declared if len(re.findall(rf"\b{name}\b", code)) < 2] == []
    assert not {"MomentTicks", "DelayTicks", "Pending", "Quanta"} & set(declared)


@pytest.mark.parametrize("law", LAWS)
def test_head_says_the_law_its_memory_and_its_work(law):
    settings = rope_block("double", law)
    head = text_of(settings).split("*)")[0]
    assert f"law {law}" in head
    assert "at most 3 taps, and a look-up of 5 steps; no division, no functions but ABS and TRUNC" in head
    assert "load it with a cold start" in head
    stated = re.search(r"Memory: (\d+) bytes of variables for each instance, (\d+) of tables", head)
    rings = 121 * (8 + 8 + 4)
    assert rings < int(stated[1]) < rings + 500
    assert 27 * (8 + 4) < int(stated[2]) < 27 * (8 + 4) + 150


@pytest.mark.parametrize("law", LAWS)
def test_an_arm_reads_a_position_and_nothing_of_a_rope(law):
    text = text_of(arm(law, "double"))
    pins = ("Position : LREAL; (* [rad]", "PositionSpeed : LREAL; (* [rad/s]", "PositionValid : BOOL := TRUE")
    for declared in pins:
        assert declared in text
    assert "LowestPosition : LREAL := -0.5" in text
    assert not re.search("rope|hoist", text.split("NOT A SAFETY FUNCTION", 1)[1].split("\n", 3)[3].lower())
