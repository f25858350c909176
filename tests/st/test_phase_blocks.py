"""Structured Text of the phase clock equals the reference in every bit of every output, LREAL and REAL."""

import re
from dataclasses import replace

import numpy as np
import pytest

from swayless.codegen import generate
from swayless.controller import Bank, Row, ShaperSettings, Status
from swayless.controller.phase_clock import phase_clock
from swayless.controller.phase_taps import phase_taps
from swayless.controller.rope import rope_settings
from swayless.design import design_shaper
from swayless.plant import Mode
from swayless.verify.comparison import compare
from swayless.verify.reference_run import run_reference
from swayless.verify.st_run import EvaluatedBlock
from tests.unit.codegen.test_provenance import ORIGIN
from tests.unit.controller.blocks import EI, TICK_S, ZVD, block, phase_block

TICKS = 10_000
HOIST_M_S = 0.6
EVERYTHING = {
    "minimum_speed_m_s": 0.03,
    "inching_speed_m_s": 0.08,
    "command_resolution_m_s": 0.02,
    "deceleration_m_s2": 0.7,
    "quick_stop_m_s2": 2.0,
}


def one_row(number):
    """A row of two later taps; short ropes, so that the ring is lapped often."""
    return phase_block(number, rope_length_m=(1.0, 4.0), hoist_speed_m_s=HOIST_M_S, tick_s=0.02)


def everything(number):
    """Rows of one to four later taps, a damped one too, with every optional part of the law."""
    base = phase_block(number, rope_length_m=(1.0, 8.5), hoist_speed_m_s=HOIST_M_S, tick_s=0.02, **EVERYTHING)
    shapers = [
        design_shaper(*row) for row in (("zvddd", Mode(1.0)), ("zv", Mode(1.0)), ("ei", Mode(1.0, 0.05)))
    ]
    phases_rad = [2.0 * np.pi * shaper.times_s for shaper in shapers]
    most_phase_rad = max(float(each[-1]) for each in phases_rad)
    clock = phase_clock(base.rope, tick_s=base.tick_s, most_phase_rad=most_phase_rad, number=base.number)
    rows = [
        Row(
            shaper.family,
            shaper.family,
            phase_taps(
                each,
                shaper.amplitudes,
                tick_s=base.tick_s,
                guarantee=replace(shaper.guarantee, tolerance=0.06),
                clock=clock,
            ),
        )  # the split between ticks needs some
        for shaper, each in zip(shapers, phases_rad, strict=True)
    ]
    return replace(base, bank=Bank(tuple(rows)))


def rope_on_ticks(number):
    """A measured rope without a phase clock: readings are checked, and move no tap."""
    plain = block(ZVD, EI, number=number)
    rope = rope_settings((1.0, 4.0), HOIST_M_S, tick_s=TICK_S, number=plain.number)
    return ShaperSettings(plain.bank, plain.limits, rope)


class History:
    """Random inputs of a block, from one seeded generator."""

    def __init__(self, settings, ticks, seed=1):
        self.settings, self.ticks = settings, ticks
        self.random = np.random.default_rng(seed)
        self.real = np.float32 if settings.number.name == "float" else np.float64

    def held(self, values, longest):
        """Values held for random times up to `longest` ticks."""
        lengths = self.random.integers(1, longest + 1, size=2 * self.ticks // longest + 20)
        picked = self.random.choice(np.asarray(values), size=lengths.size)
        return np.resize(np.repeat(picked, lengths), self.ticks)

    def hoist(self):
        """A hoist that runs and stops between the ends of the rope, and what its encoder reads."""
        rope, tick_s = self.settings.rope, self.settings.tick_s
        low, high = float(rope.shortest), float(rope.longest)
        speed = self.held([0.0, 0.0, 1.0, -1.0, 0.4, -0.3], 120) * HOIST_M_S
        length = np.empty(self.ticks)
        now = high
        for tick, wanted in enumerate(speed.tolist()):
            length[tick] = now = min(max(now + wanted * tick_s, low - 0.05), high + 0.05)
        noise = self.random.normal(0.0, 0.002, self.ticks)
        return length + noise, speed + self.held([0.0, 0.0, 0.01], 50) * noise

    def inputs(self):
        """Everything an operator and a fault would do; in between a joystick that never rests."""
        settings, last = self.settings, self.settings.longest_delay_ticks
        length, speed = self.hoist()
        frozen = self.held([False] * 5 + [True], 60)
        length = np.where(frozen, np.maximum.accumulate(np.where(frozen, 0.0, length)), length)
        length = length + self.held([0.0] * 40 + [np.nan, np.inf, -np.inf, 0.7, -0.9, 1e30], 8)
        speed = speed + self.held([0.0] * 40 + [np.nan, -np.inf, 2.0, -3.0], 8)
        levels = self.held([0.0, 0.0, 0.5, -0.5, 1.0, -1.0, 0.06, 0.02, 1.3], last)
        levels = levels + self.held([0.0] * 30 + [np.nan], 10)
        calm = self.held([False, True], 5 * last)
        noisy = self.random.normal(0.0, 0.4, self.ticks)
        command = np.where(calm, np.where(np.abs(noisy) < 0.02, 0.0, noisy), levels)
        columns = {
            "enable": calm | self.held([True] * 12 + [False], last),
            "emergency_stop": ~calm & self.held([False] * 60 + [True], 10),
            "quick_stop": ~calm & self.held([False] * 60 + [True], 10),
            "command": command * float(settings.limits.max_command),
            "selector": self.held([*range(len(settings.bank.rows) + 1), 1, 1, 1, 200], 2 * last),
            "rope_length": length,
            "hoist_speed": speed,
            "rope_length_valid": self.held([True] * 20 + [False], 40),
        }
        kinds = {np.dtype(float): self.real, np.dtype(int): np.uint8}
        fields = [(name, kinds.get(column.dtype, column.dtype)) for name, column in columns.items()]
        made = np.zeros(self.ticks, dtype=fields)
        for name, column in columns.items():
            made[name] = column
        return made


def text_of(settings):
    return generate(settings, ORIGIN, "st")[0].text


def difference(settings, inputs, text=None):
    """The first difference of the text from the reference; None where every bit is equal."""
    evaluated = EvaluatedBlock(text or text_of(settings), settings).run(inputs)
    return compare(run_reference(settings, inputs), evaluated).first_difference


@pytest.mark.parametrize("number", ["double", "float"])
@pytest.mark.parametrize("made", [one_row, everything, rope_on_ticks])
def test_block_with_a_rope_equals_the_reference_in_every_bit(made, number):
    settings = made(number)
    inputs = History(settings, TICKS).inputs()
    assert difference(settings, inputs) is None
    seen = int(np.bitwise_or.reduce(run_reference(settings, inputs)["status"]))
    unused = 0 if made is everything else Status.BELOW_MINIMUM | Status.INCHING | Status.COMMAND_WAITS
    assert seen == sum(settings.status_bits) & ~unused


@pytest.fixture(scope="module")
def known_run():
    settings = everything("double")
    inputs = History(settings, 5000).inputs()
    return settings, inputs, run_reference(settings, inputs)


@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        ("Wanted := Wanted + Lack", "Wanted := Lack"),
        ("(Wanted * Answers[Tap])", "(Wanted * Leans[Tap])"),
        ("Answered := HoistNow;\n  END_IF", "Answered := 0.0;\n  END_IF"),
        ("(Stretch * FourthOrder)", "0.0"),
        ("Release - Kick", "Release"),
        ("Stretch := HighStretch", "Stretch := LongestStretch"),
        ("DINT_TO_LREAL(HeldTicks + 1)", "DINT_TO_LREAL(HeldTicks)"),
        ("Moment := FreshMoment", "FreshMoment := 0.0"),
        ("StillQuanta + ElapsedQuanta", "StillQuanta + Quanta"),
        ("IF Cell <= Head THEN", "IF Cell < 0 THEN"),
        ("(LagLeft + (Quanta - 1)) / Quanta", "LagLeft / Quanta"),
        ("UnmovedWay := 0.0;\nELSE", "UnmovedWay := UnmovedWay;\nELSE"),
        ("SwingPlace := SwingPlace * ", "SwingPace := SwingPace * "),
    ],
)
def test_a_wrong_term_of_the_law_is_found_within_5000_ticks(known_run, right, wrong):
    settings, inputs, expected = known_run
    text = text_of(settings)
    assert right in text
    evaluated = EvaluatedBlock(text.replace(right, wrong), settings).run(inputs)
    assert not compare(expected, evaluated).is_equal


@pytest.mark.parametrize("number", ["double", "float"])
def test_as_many_cells_a_tick_are_passed_as_the_range_of_the_rope_allows_and_no_more(number):
    settings = everything(number)  # ropes of 1 to 8.5 m: 2.9 times the phase a tick
    inputs = np.zeros_like(History(settings, 1200).inputs())
    inputs["enable"], inputs["selector"], inputs["rope_length_valid"] = True, 1, True
    inputs["command"] = np.linspace(0.0, 0.8, 1200)
    inputs["rope_length"] = 8.5
    # The length is lost for as long as the hoist takes, and found on the shortest rope with taps under way.
    inputs["rope_length_valid"][100:800] = False
    inputs["rope_length"][800:] = 1.0
    text = text_of(settings)
    assert "FOR j := 1 TO 3 DO" in text
    assert difference(settings, inputs, text) is None
    fewer = text.replace("FOR j := 1 TO 3 DO", "FOR j := 1 TO 2 DO")
    assert difference(settings, inputs, fewer) is not None


@pytest.mark.parametrize(
    "made", [one_row, everything, rope_on_ticks, lambda number: block(ZVD, number=number)]
)
def test_every_declared_name_is_used(made):
    text = text_of(made("double"))
    declared = re.findall(r"^  (\w+) : ", text, re.MULTILINE)
    code = re.sub(r"\(\*.*?\*\)", "", text, flags=re.DOTALL)
    assert len(declared) > 60
    assert [name for name in declared if len(re.findall(rf"\b{name}\b", code)) < 2] == []


def test_head_says_which_way_the_hoist_counts_and_what_a_bad_rope_length_does():
    head = text_of(one_row("double")).split("*)")[0]
    assert "law phase (hoisting while travelling)" in head
    assert "positive when the load sinks" in head
    assert "is not taken: the last one holds" in head
    assert "at most 3 taps of 2 cells of the ring each; three divisions, no functions" in head
    assert "8192 the rope length is farther off than the hoist could move" in head


def test_block_of_the_tick_clock_without_a_rope_knows_no_rope():
    assert not re.search("rope|hoist|quanta", text_of(block(ZVD, EI)).lower().split("*)", 1)[1])
