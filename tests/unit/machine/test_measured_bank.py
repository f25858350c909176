"""Banks whose rows the measured rope chooses: read, stored, run, or refused."""

import dataclasses

import pytest

from swayless.errors import ControllerError, FileError
from swayless.machine import example_text, load_machine
from swayless.machine.designing import design_machine
from swayless.machine.running import shaper_settings

GOOD = (
    example_text("srtc-gantry-bank")
    .replace('label_step = "1 ft"', 'hysteresis = "6 in"\nselection = "rope_length"')
    .replace("[controller]", "hoist_speed = 0.3\n[controller]", 1)
    .replace('amplitudes = "bounded"', 'amplitudes = "positive"')
    .replace('duration = "3 s"', 'duration = "5.2 s"')
)


def loaded(folder, text):
    path = folder / "crane.toml"
    path.write_text(text)
    return load_machine(path)


def test_rows_work_between_their_switching_lengths_and_half_the_hysteresis_beyond(tmp_path):
    design = design_machine(loaded(tmp_path, GOOD))
    assert design.bank.selection == "rope_length"
    rows = shaper_settings(design).bank.by_rope
    (place,) = design.bank.switching_rope_length_m
    assert rows.lower == pytest.approx((place - 0.0762, 9 * 0.3048), abs=1e-12)
    assert rows.upper == pytest.approx((29 * 0.3048, place + 0.0762), abs=1e-12)
    for shaper, low_m, high_m in zip(design.shapers, rows.lower, rows.upper, strict=True):
        held_m = shaper.taps.guarantee.rope_length_m
        assert held_m[0] <= low_m * (1 + 1e-9)
        assert high_m <= held_m[1] * (1 + 1e-9)


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        ("hoist_speed = 0.3\n", "", "needs hoist_speed in [crane]"),
        ('hysteresis = "6 in"\n', "", "do not change to and fro"),
        ('"rope_length"', '"rope"', "unknown selection"),
    ],
)
def test_what_a_measured_bank_lacks_is_said(tmp_path, old, new, reason):
    assert old in GOOD
    with pytest.raises(FileError) as caught:
        loaded(tmp_path, GOOD.replace(old, new))
    assert any(reason in problem for problem in caught.value.problems)


def test_rows_that_do_not_hold_what_they_would_be_chosen_for_are_refused(tmp_path):
    design = design_machine(loaded(tmp_path, GOOD))
    wide = dataclasses.replace(design.bank, hysteresis_m=1.0)
    with pytest.raises(ControllerError, match="would be chosen from"):
        shaper_settings(dataclasses.replace(design, bank=wide))


def test_the_five_impulses_of_kriikku_section_iii_make_a_bank_on_ticks(tmp_path):
    options = {"tolerance": "5 %", "duration": "3 s", "amplitudes": "unity-magnitude", "impulses": "5"}
    path = tmp_path / "crane.toml"
    path.write_text(example_text("srtc-gantry"))
    design = design_machine(load_machine(path, options))
    places_ft = [place / 0.3048 for place in design.bank.switching_rope_length_m]
    assert places_ft == pytest.approx([24.654, 20.230, 9.830], abs=2e-3)
    assert all(shaper.taps.guarantee.worst_residual_ratio <= 0.05 for shaper in design.shapers)
