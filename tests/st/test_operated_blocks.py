"""Structured Text of the operator's functions and diagnostics equals the reference in every bit."""

import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from swayless.codegen import generate
from swayless.controller import Bank, Status
from swayless.controller.diagnostics import Diagnostics
from swayless.controller.operator_settings import NO_OPTIONS
from swayless.controller.sway import sway_settings
from swayless.controller.tables import design_facts, tables_of
from swayless.plant import Mode
from swayless.verify.builder import Builder
from swayless.verify.comparison import compare
from swayless.verify.reference_run import run_reference
from swayless.verify.st_run import EvaluatedBlock
from swayless.verify.stimulus import soak, stimuli
from tests.compiled.operated_blocks import ALONE, BLOCKS, DESIGN_ID, alone
from tests.unit.codegen.test_provenance import ORIGIN
from tests.unit.controller.blocks import EI, UM_ZV, ZVD, block
from tests.unit.controller.operator_blocks import operated

TICKS = {"double": 10_000, "float": 3_000}
HABITS = {
    *("step buttons", "switches at the ends", "ways to the ends", "drive trips", "tuning"),
    "everything at once",
}
"""What blocks with functions are put through besides, each for a tenth of the ticks; the rest is a soak."""

CASES = [(name, "double") for name in BLOCKS] + [(name, "float") for name in ("mixed", "phase", "by rope")]


def text_of(settings):
    return generate(settings, ORIGIN, "st")[0].text


@cache
def known_run(name, number="double"):
    """Settings, their text, inputs of everything at once, and what the reference makes of them."""
    settings, ticks = BLOCKS[name](number), TICKS[number]
    by_themselves = [
        stimulus.inputs
        for stimulus in stimuli(settings, ticks=ticks // 10)
        if stimulus.name in HABITS and stimulus.inputs.size == ticks // 10
    ]
    rest = soak(settings, ticks=ticks - sum(each.size for each in by_themselves))
    inputs = np.concatenate([*by_themselves, rest.inputs])
    inputs["command"][:3] = settings.limits.max_command  # what a start from zero locks
    return settings, text_of(settings), inputs, run_reference(settings, inputs)


@pytest.mark.parametrize(("name", "number"), CASES)
def test_block_equals_the_reference_in_every_bit(name, number):
    settings, text, inputs, expected = known_run(name, number)
    assert compare(expected, EvaluatedBlock(text, settings).run(inputs)).first_difference is None
    if number == "double":
        operated = settings.operator.status_bits | settings.diagnostics.status_bits
        assert operated & ~int(np.bitwise_or.reduce(expected["status"])) == Status.TABLES_INVALID


@pytest.mark.parametrize("name", ["mixed", "contactor"])
def test_block_equals_the_reference_under_every_habit_by_itself(name):
    settings, text, *_ = known_run(name)
    block = EvaluatedBlock(text, settings)
    for stimulus in stimuli(settings, ticks=400):
        found = compare(run_reference(settings, stimulus.inputs), block.run(stimulus.inputs))
        assert (stimulus.name, found.first_difference) == (stimulus.name, None)


@pytest.mark.parametrize("name", ALONE)
def test_each_function_by_itself_equals_the_reference_and_declares_what_it_uses(name):
    settings = alone(name, "double")
    text, inputs = text_of(settings), soak(settings, ticks=1000).inputs
    assert compare(run_reference(settings, inputs), EvaluatedBlock(text, settings).run(inputs)).is_equal
    assert unused(text) == []


def only(settings, name):
    """The block with one of its diagnostics."""
    bare = replace(settings, diagnostics=Diagnostics())
    one = design_facts(bare, 7) if name == "facts" else getattr(settings.diagnostics, name)
    return replace(bare, diagnostics=Diagnostics(**{name: one}))


@pytest.mark.parametrize("name", ["sway", "rope_bounds", "tracking", "facts"])
@pytest.mark.parametrize("kind", ["by rope", "original", "phase", "mixed"])
def test_each_diagnostic_by_itself_equals_the_reference_and_declares_what_it_uses(kind, name):
    settings = replace(BLOCKS[kind]("double"), operator=NO_OPTIONS)
    if getattr(settings.diagnostics, name) is None:
        return
    one = only(settings, name)
    text, inputs = text_of(one), soak(one, ticks=400).inputs
    assert compare(run_reference(one, inputs), EvaluatedBlock(text, one).run(inputs)).is_equal
    assert unused(text) == []


def unused(text):
    """Declared names that no statement, nor another declaration, mentions."""
    code = re.sub(r"\(\*.*?\*\)", "", text, flags=re.DOTALL)
    declared = re.findall(r"^  (\w+) : ", text, re.MULTILINE)
    return [name for name in declared if len(re.findall(rf"\b{name}\b", code)) < 2]


@pytest.mark.parametrize("name", BLOCKS)
def test_text_with_every_function_is_tidy(name):
    text = known_run(name)[1]
    assert unused(text) == []
    assert max(map(len, text.split("\n"))) <= 120
    assert not re.search(r"[ \t]+$|\n\n\n|\n\n +(END_|ELSE)", text, re.MULTILINE)
    functions = set(re.findall(r"\b([A-Z_]+)\(", re.sub(r"\(\*.*?\*\)", "", text, flags=re.DOTALL)))
    assert functions <= {"ABS", "TRUNC", "DINT_TO_LREAL", "OR", "AND", "NOT", "IF"}


def test_head_explains_the_functions_that_are_there_and_no_others():
    head = known_run("mixed")[1].split("*)")[0]
    assert "a press is a way of 0.05, 0.21 or 1 m by StepSize 1 to 3, at most 0.4 m/s" in head
    assert "the shaped stop ends 0.1 m" in head
    numbers = re.search(r"sums up the (\d+) numbers of all tables", head)
    assert int(numbers[1]) == sum(len(table.numbers) for table in tables_of(BLOCKS["mixed"]("double")))
    plain = text_of(alone("slow switches", "double")).split("*)")[0]
    assert "SlowForward, SlowReverse: at most 0.15 m/s towards a made switch." in plain
    assert not re.search("Step|Stop[FR]|Distance|Drive|Limit:|Offset|Predicted|Design[I]d", plain)


def test_a_block_that_is_initialized_again_remembers_nothing():
    for name in BLOCKS:
        settings, text, inputs, _ = known_run(name)
        inputs = inputs[:1200].copy()
        inputs["selector"] = np.minimum(inputs["selector"], 1)
        inputs["selector"][600] = 77
        once, again = "IF NOT Initialized THEN", "IF (NOT Initialized) OR (Selector = 77) THEN"
        restarted = EvaluatedBlock(text.replace(once, again), settings).run(inputs)[600:]
        assert compare(run_reference(settings, inputs[600:]), restarted).is_equal, name


REFUSED = Status.TABLES_INVALID | Status.UNSHAPED
TABLE = re.compile(r"  (\w+) : ARRAY\[0\.\.\d+\] OF (\w+) := \[\n    (.*)\n")
NOT_SUMMED = {"Strides", "BoundStrides", "PlanStrides", "StepSizes"}
"""Constants of formulas, and scalars by size."""


def changed(value, kind):
    """A literal with one of its lowest bits changed."""
    if kind == "BOOL":
        return {"TRUE": "FALSE", "FALSE": "TRUE"}[value]
    if kind == "DINT":
        return str(int(value) + 1)
    return f"{np.nextafter(float(value), 2.0):.17E}"


@pytest.mark.parametrize("name", ["mixed", "by rope", "phase", "modified"])
def test_a_number_of_any_table_that_changes_by_its_last_bit_is_refused_for_ever(name):
    settings, text, inputs, expected = known_run(name)
    assert set(expected["design_id"]) == {DESIGN_ID}
    tables = [found for found in TABLE.finditer(text) if found[1] not in NOT_SUMMED]
    assert len(tables) >= 8
    for found in tables:
        # A first row of the ends of rows belongs to row 0 and is not read.
        place = 1 if found[1] in {"RowShortest", "RowLongest"} else 0
        numbers = found[3].split(", ")
        numbers[place] = changed(numbers[place].rstrip(","), found[2]) + (
            "," if "," in numbers[place] else ""
        )
        wrong = text[: found.start(3)] + ", ".join(numbers) + text[found.end(3) :]
        outputs = EvaluatedBlock(wrong, settings).run(inputs[:3])
        assert set(outputs["status"].tolist()) == {int(REFUSED)}, found[1]
        assert not outputs["reference"].any()
        assert outputs["error"].all()
        assert set(outputs["residual_bound"].tolist()) == {1.0}


CHANGES = {
    "mixed": (
        ("PressedForward := StepForward AND ArmedForward", "PressedForward := StepForward"),
        ("ArmedReverse := NOT StepReverse", "ArmedReverse := TRUE"),
        ("RowLocked := Stepping", "RowLocked := FALSE"),
        ("Stepping OR (IsSettled AND", "Stepping AND (IsSettled AND"),
        ("(PressedForward AND PressedReverse)", "(PressedForward AND Enable)"),
        ("OR (SpeedLimitNow <= 0.0) THEN", "THEN"),
        ("> StepCapacity THEN", "> MaxCommand THEN"),
        ("StepsQueued := StepsQueued + StepWay", "StepsQueued := StepWay"),
        ("StepsLeft := StepsLeft + StepsQueued", "StepsLeft := StepsQueued"),
        ("StepFalls := (Now > 0.0)", "StepFalls := FALSE"),
        ("Stepping := (StepsLeft <> 0.0) OR (StepsQueued <> 0.0)", "Stepping := (StepsLeft <> 0.0)"),
        ("ELSIF Stepping THEN\n    CommandLocked := TRUE;", ""),
        ("DownSum := StepsLeft + StepsQueued", "DownSum := StepsLeft"),
        ("DownTicks := DownTicks + 1", "DownTicks := DownTicks"),
        ("(ForwardShut OR StopForward)", "StopForward"),
        ("OR (StopReverse AND (Heading < 0.0))", ""),
        ("Accepted := -SlowCommand", "Accepted := SlowCommand"),
        ("(SlowReverse AND (NOT Forward))", "SlowReverse"),
        ("WayForward := WayForward - ReferenceNow", "WayForward := WayForward"),
        ("(WayReverse + MaxCommand)", "WayReverse"),
        ("< LeastWay) THEN", "< 0.0) THEN"),
        ("WayLeft := GlideNow", "WayLeft := 0.0"),
        ("(Most = 0.0) AND (Way > GlideNow)", "(Most < 0.0) AND (Way > GlideNow)"),
        ("PlanSteps := PlanSteps + PlanStrides", "PlanSteps := PlanStrides"),
        ("(PlanHold * Trial)", "Trial"),
        ("Gentle := Now + GentleStep", "Gentle := Now"),
        ("After := Way - GlideNow", "After := Way"),
        ("After := (After + RampAnchor) - RampAnchor", "After := After"),
        ("IF DriveOff AND DriveReady THEN\n    QuickLatched := TRUE;", "IF DriveOff AND DriveReady THEN"),
        ("DriveOff := NOT DriveReady", "DriveOff := FALSE"),
        ("Accepted := 0.0 - SpeedLimitNow", "Accepted := SpeedLimitNow"),
        ("LastLow := LowReference", "LastLow := ReferenceNow"),
        ("WindowTicks >= TrackingWindow", "WindowTicks > TrackingWindow"),
        ("OutsideTicks > TrackingTicks", "OutsideTicks >= TrackingTicks"),
        ("SwayReference := ReferenceNow", "SwayReference := Ramped"),
        ("(SwayPlace * TurnCosine) + (PaceBefore", "(SwayPlace * TurnCosine) + (SwayPace"),
    ),
    "by rope": (
        ("SwayPlace * (Longer * SwayInverse)", "SwayPlace * Longer"),
        ("Longer := SwayQuanta", "Longer := QuantaReal"),
        ("SwayPace := SwayPace * (Shorter * Shorter)", "SwayPace := SwayPace * Shorter"),
        ("RopeKnown := (Bits = BitsBefore) OR", "RopeKnown := (Bits >= BitsBefore) OR"),
        ("FirstPiece + BoundCounts[i - 1]", "FirstPiece + 0"),
        ("<= RopeNow THEN\n          Piece", "< ShortestRope THEN\n          Piece"),
        ("RopeGiven := RopeLength + RopeGiven", "RopeGiven := RopeLength"),
        ("RopeGiven := LowestOffset", "RopeGiven := HighestOffset"),
        ("CommandLocked := TRUE;\n  ForwardShut", "CommandLocked := FALSE;\n  ForwardShut"),
    ),
    "contactor": (
        ("ELSIF (Most >= Now) AND ((Now + GlideNow) <= Way) THEN", "ELSIF Most >= Now THEN"),
        ("Counted := -Counted", "Counted := Counted"),
        ("(Counted = 0.0) AND (Accepted <> 0.0)", "(Counted <> 0.0) AND (Accepted <> 0.0)"),
        ("IF Reach >= FastContactor THEN", "IF Reach > FastContactor THEN"),
        ("Share := Share * PerPlanShortest", "Share := Share"),
        ("PlannedSpeed := Share", "PlannedSpeed := Most"),
    ),
}


@pytest.mark.parametrize(
    ("name", "right", "wrong"), [(name, *change) for name, changes in CHANGES.items() for change in changes]
)
def test_a_wrong_term_is_found_within_10000_ticks(name, right, wrong):
    settings, text, inputs, expected = known_run(name)
    assert right in text
    block = EvaluatedBlock(text.replace(right, wrong), settings)
    # Most are found at once.
    assert any(not compare(expected[:n], block.run(inputs[:n])).is_equal for n in (500, 2500, inputs.size))


def reversals(settings):
    """Moves that turn round, and a stop switch at either end that is made ever later during them."""
    build = Builder(settings, 1)
    segments = []
    for made_at in range(2, 34):
        for name in ("stop_forward", "stop_reverse"):
            segment = build.blank(90)
            segment["command"][2:14] = settings.limits.max_command
            segment["command"][14:30] = -settings.limits.max_command
            segment[name][made_at:70] = True
            segments.append(segment)
    return np.concatenate(segments)


@pytest.mark.parametrize(
    ("rows", "limits", "wrong"),
    [
        ((UM_ZV,), {"acceleration_m_s2": 1000.0}, ("Heading := PendingNow", "Heading := 0.0")),
        ((ZVD,), {"quick_stop_m_s2": 0.1}, ("  Halted := TRUE;\n", "")),
        ((ZVD,), {}, ("  QuickLatched := TRUE;\n  Halted", "  Halted")),
    ],
)
def test_what_is_pending_turns_towards_no_stop_switch(rows, limits, wrong):
    settings = operated(block(*rows, **limits), stop_switches=True)
    text, inputs = text_of(settings), reversals(settings)
    expected = run_reference(settings, inputs)
    assert compare(expected, EvaluatedBlock(text, settings).run(inputs)).first_difference is None
    assert wrong[0] in text
    assert not compare(expected, EvaluatedBlock(text.replace(*wrong), settings).run(inputs)).is_equal


def test_the_sway_is_that_of_the_mode_of_the_row_in_use_and_is_forgotten_at_rest():
    base = block(ZVD, EI)
    modes = (Mode(0.5, 0.2), Mode(0.8, 0.3))
    rows = tuple(
        replace(row, taps=replace(row.taps, guarantee=replace(row.taps.guarantee, mode=mode)))
        for row, mode in zip(base.bank.rows, modes, strict=True)
    )
    bank = Bank(rows)
    sway = sway_settings(bank, base.limits)
    settings = replace(base, bank=bank, diagnostics=Diagnostics(sway=sway))
    inputs = np.concatenate([soak(settings, ticks=1500).inputs, Builder(settings, 1).blank(1500)])
    text, expected = text_of(settings), run_reference(settings, inputs)
    assert compare(expected, EvaluatedBlock(text, settings).run(inputs)).first_difference is None
    assert expected["predicted_sway"][-1] == 0.0
    for right, wrong in (
        ("SwayRow := ActiveRow", "SwayRow := 1"),
        ("SwayPlace := 0.0;\nEND_IF", "END_IF"),
        ("TurnSines[SwayRow - 1]", "TurnSines[0]"),
    ):
        assert right in text
        assert not compare(
            expected, EvaluatedBlock(text.replace(right, wrong), settings).run(inputs)
        ).is_equal
