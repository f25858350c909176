"""Banks: the rows share the range of the machine, and neighbours hold what the knob says they hold."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from itertools import pairwise
from pathlib import Path

import pytest

from swayless.errors import DesignError, FileError
from swayless.machine import DesignFile, Machine, load_machine
from swayless.machine.banking import Switching
from swayless.machine.designing import design_machine
from swayless.plant import pendulum_rope_length_m

FOOT_M = 0.3048
GANTRY = """
name = "gantry"
[crane]
rope_length = ["9 ft", "29 ft"]
max_speed = 0.5
[controller]
tick = "10 ms"
"""
BANK = """
[bank]
tolerance = 0.05
duration = 3
amplitudes = "bounded"
"""
ARM = GANTRY.replace('[crane]\nrope_length = ["9 ft", "29 ft"]', '[arm]\nfrequency = ["120 rpm", "180 rpm"]')


@pytest.fixture
def load(tmp_path: Path) -> Callable[..., Machine]:
    def from_text(text: str, options: Mapping[str, object] | None = None) -> Machine:
        path = tmp_path / "gantry.toml"
        path.write_text(text, encoding="utf-8")
        return load_machine(path, options)

    return from_text


def _ropes_m(design: DesignFile) -> list[tuple[float, float]]:
    return [shaper.taps.guarantee.rope_length_m for shaper in design.shapers if shaper.taps is not None]


def test_the_bounded_bank_of_the_gantry_switches_where_the_issue_says(load) -> None:
    design = design_machine(load(GANTRY + BANK))
    assert design.bank is not None
    assert design.bank.switching_rope_length_m is not None
    switches_ft = [length_m / FOOT_M for length_m in design.bank.switching_rope_length_m]
    # Two decimals are what the issue gives; taps on 10 ms reach 0.0003 ft less than continuous time.
    assert switches_ft == pytest.approx([24.65, 20.23, 9.72], abs=0.006)
    assert design.bank.labels == ("1: 29-24.65 ft", "2: 24.65-20.23 ft", "3: 20.23-9.72 ft", "4: 9.72-9 ft")
    assert [shaper.name for shaper in design.shapers] == [label[3:] for label in design.bank.labels]


def test_three_rows_for_the_gantry_leave_about_what_the_issue_says(load) -> None:
    design = design_machine(load(GANTRY + BANK.replace("tolerance = 0.05", "rows = 3")))
    assert design.bank is not None
    assert design.bank.tolerance == pytest.approx(0.054, abs=0.001)
    assert len(design.shapers) == 3


def test_rows_of_a_bank_meet_without_a_gap_and_hold_the_whole_range(load) -> None:
    ropes_m = _ropes_m(design_machine(load(GANTRY + BANK)))
    assert ropes_m[0][1] == 29 * FOOT_M
    assert ropes_m[-1][0] <= 9 * FOOT_M
    assert all(upper[1] >= lower[0] for lower, upper in pairwise(ropes_m))


def test_a_label_step_puts_the_knob_at_whole_feet_that_both_neighbours_hold(load) -> None:
    design = design_machine(load(GANTRY + BANK + 'label_step = "1 ft"\n'))
    assert design.bank is not None
    assert design.bank.switching_rope_length_m is not None
    assert design.bank.labels == ("1: 29-25 ft", "2: 25-21 ft", "3: 21-16 ft", "4: 16-9 ft")
    ropes_m = _ropes_m(design)
    for switch_m, lower, upper in zip(
        design.bank.switching_rope_length_m, ropes_m[:-1], ropes_m[1:], strict=True
    ):
        assert switch_m / FOOT_M == pytest.approx(round(switch_m / FOOT_M), abs=1e-9)  # 12 digits
        assert lower[0] <= switch_m <= upper[1]


def test_a_hysteresis_makes_neighbours_overlap_and_the_knob_turns_within(load) -> None:
    design = design_machine(load(GANTRY + BANK.replace("= 3", "= 3.5") + "hysteresis = 0.5\n"))
    assert design.bank is not None
    assert design.bank.hysteresis_m == 0.5
    assert design.bank.switching_rope_length_m is not None
    assert design.bank.overlap_m is not None
    ropes_m = _ropes_m(design)
    for switch_m, overlap_m, lower, upper in zip(
        design.bank.switching_rope_length_m, design.bank.overlap_m, ropes_m[:-1], ropes_m[1:], strict=True
    ):
        assert overlap_m >= 0.5 - 1e-9  # 9 decimals
        assert upper[1] - lower[0] == pytest.approx(overlap_m, abs=2e-9)
        assert switch_m == pytest.approx(0.5 * (upper[1] + lower[0]), abs=1e-9)


@pytest.mark.parametrize("hysteresis", [0.0, 0.3])
@pytest.mark.parametrize("step_m", [None, 0.25])
def test_the_next_row_starts_beyond_the_switch_and_never_in_a_gap(
    hysteresis: float, step_m: float | None
) -> None:
    switching = Switching(on_rope=True, hysteresis=hysteresis, step_m=step_m)
    for end_hz in (0.171234567890123, 0.2, 0.31):
        end_m, place_m = pendulum_rope_length_m(end_hz), switching.place(end_hz)
        start_m = pendulum_rope_length_m(switching.next_start_hz(end_hz))
        assert end_m + hysteresis / 2 <= place_m <= start_m - hysteresis / 2 + 1e-12
        assert switching.next_start_hz(end_hz) <= end_hz
        if step_m is not None:
            assert place_m / step_m == round(place_m / step_m)


def test_an_arm_switches_in_hz_and_is_labelled_in_the_unit_of_its_file(load) -> None:
    bank = 'tolerance = 0.05\nlongest_duration = 0.35\nhysteresis = "3 rpm"\n'
    design = design_machine(load(ARM + "[bank]\n" + bank))
    assert design.bank is not None
    assert design.bank.hysteresis_hz == 0.05
    assert (design.bank.hysteresis_m, design.bank.switching_rope_length_m, design.bank.overlap_m) == (
        None,
        None,
        None,
    )
    assert design.bank.overlap_hz is not None
    assert min(design.bank.overlap_hz) >= 0.05 - 1e-9  # 9 decimals
    assert design.bank.labels[0].startswith("1: 120-")
    assert design.bank.labels[-1].endswith("-180 rpm")
    durations_s = [shaper.taps.duration_s for shaper in design.shapers if shaper.taps is not None]
    assert max(durations_s) <= 0.35 + 1e-12
    assert durations_s[-1] == min(durations_s)


def test_labels_get_decimals_until_they_differ(load) -> None:
    narrow = GANTRY.replace('["9 ft", "29 ft"]', "[5.001, 5.004]")
    design = design_machine(load(narrow + "[bank]\ntolerance = 0.05\nlongest_duration = 2.3\n"))
    assert design.bank is not None
    assert design.bank.labels == ("1: 5.004-5.001 m",)
    assert (design.bank.switching_frequency_hz, design.bank.overlap_m) == ((), ())


def test_options_take_the_place_of_rows_and_of_what_they_exclude(load) -> None:
    rows = '[[row]]\nname = "a"\nfamily = "zv"\nrope_length = 5\n'
    machine = load(GANTRY + rows, {"rows": "2", "duration": "5 s", "hysteresis": "1 ft"})
    assert machine.rows == ()
    assert machine.bank is not None
    assert (machine.bank.rows, machine.bank.tolerance, machine.bank.duration_s) == (2, None, 5.0)
    assert machine.bank.hysteresis == FOOT_M
    machine = load(GANTRY + BANK, {"rows": 3})
    assert machine.bank is not None
    assert (machine.bank.rows, machine.bank.tolerance, machine.bank.rule.amplitudes) == (3, None, "bounded")


def test_a_wrong_option_is_called_one(load) -> None:
    with pytest.raises(
        FileError, match=r"gantry\.toml: bank option rows = 9: must be an integer from 1 to 8"
    ):
        load(GANTRY + BANK, {"rows": "9"})


def test_no_options_take_the_bank_as_it_is_or_miss_it(load) -> None:
    assert load(GANTRY + BANK, {}).bank == load(GANTRY + BANK).bank
    rows = '[[row]]\nname = "a"\nfamily = "zv"\nrope_length = 5\n'
    with pytest.raises(FileError, match=r"\[\[row\]\] or \[bank\]: exactly one .* none is there"):
        load(GANTRY + rows, {})


def test_a_range_that_no_rows_cover_names_the_bank(load) -> None:
    with pytest.raises(DesignError, match=r"^gantry\.toml: \[bank\]: duration_s = 2\.7: too short"):
        design_machine(load(GANTRY + BANK.replace("= 3", "= 2.7").replace("bounded", "positive")))
