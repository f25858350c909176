"""Machine files with `law = "original"` or `"modified"`: read, designed, stored and run, or refused."""

import json

import numpy as np
import pytest

from swayless.controller import CommandShaper, ShaperInput
from swayless.controller.measured import ARM_ANGLE, ROPE
from swayless.controller.spaced_taps import SpacedTaps, worst_truncated_residual
from swayless.errors import ControllerError, DesignError, FileError
from swayless.machine import (
    example_text,
    load_design,
    load_machine,
    same_design,
    save_text,
)
from swayless.machine.designing import design_machine
from swayless.machine.running import shaper_settings, stored_taps

LAWS = ["original", "modified"]
HOIST = ('law = "phase" ', 'law = "modified"')
COUNTS = ("[controller]", "[drive]\ncounts_per_m_s = 20000\n[controller]")


@pytest.fixture
def arm(tmp_path, arm_text):
    return lambda *changes: designed(tmp_path, arm_text, *changes)


@pytest.fixture
def crane(tmp_path):
    return lambda *changes: designed(tmp_path, example_text("hoisting-gantry"), HOIST, *changes)


def designed(folder, text, *changes):
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    path = folder / "machine.toml"
    path.write_text(text)
    return design_machine(load_machine(path))


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        ('hoist_speed = "0.4 m/s"', "", "[crane] hoist_speed: missing"),
        ("rope_length = [3, 9]", "rope_length = 5", 'law = "modified" needs two lengths'),
        ("rope_length = [3, 9]", "frequency = [0.2, 0.3]", "it needs a [crane] with its shortest and"),
        ("[crane]", "[crane]\nsling_length = 1\nhook_mass = 1\nload_mass = 1", "without a sling"),
        ('family = "zvd"', 'family = "um-zv"', 'unknown family for law = "modified"'),
        ('family = "zvd"', 'family = "si"', 'unknown family for law = "modified"'),
        ('family = "zvd"', 'family = "zvd"\nrope_length = 5', "follows what is measured"),
        ("[controller]", "[drive]\ncontactor = true\n[controller]", "contactor"),
    ],
)
def test_a_crane_that_a_spacing_cannot_follow_is_refused(crane, old, new, reason):
    with pytest.raises(FileError) as caught:
        crane((old, new))
    assert any(reason in problem for problem in caught.value.problems)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("family", ["zv", "zvd", "zvddd", "ei", "ei2"])
def test_taps_cut_to_whole_ticks_hold_the_tolerance_everywhere(crane, law, family):
    design = crane(('"zvd"', f'"{family}"'), ('"modified"', f'"{law}"'))
    settings = shaper_settings(design)
    (row,) = settings.bank.rows
    assert isinstance(row.taps, SpacedTaps)
    assert row.taps.law == law
    assert worst_truncated_residual(row.taps) <= 0.05
    (shaper,) = design.shapers
    assert shaper.taps.guarantee.rope_length_m == (3.0, 9.0)
    # Stored with 12 digits, those of a guarantee rounded inward.
    assert shaper.taps.guarantee.frequency_hz == pytest.approx(design.plant.frequency_hz, rel=1e-11)
    assert settings.rope.measured is ROPE
    # pi sqrt(9 m / g) is 3.0096 s: 300 ticks at most.
    assert shaper.taps.duration_s == pytest.approx(3.0 * (len(shaper.amplitudes) - 1))


@pytest.mark.parametrize(("hertz", "worst"), [("[5.6, 10.4]", 0.0955), ("[5.6, 6.2]", 0.0302)])
def test_what_the_cut_leaves_is_known_and_refused_where_it_is_too_much(arm, hertz, worst):
    """At 10 ms, 10.4 Hz are a half period of 4.8 ticks and 6.2 Hz of 8.1: a cut by up to one tick.

    cos(pi / 2 * 4 / 5)^2 = 0.0955 and cos(pi / 2 * 8 / 9)^2 = 0.0302, but for damping.
    """
    changes = [
        ('["-30 deg", "0 deg", "45 deg"]', '["-30 deg", "45 deg"]'),
        ("[5.2, 4.4, 5.6]", hertz),
        ('"5 ms"', '"10 ms"'),
        ('"1 %"', "0"),
    ]
    with pytest.raises(DesignError, match="while nothing but the command moves, more than 2 %; a finer tick"):
        arm(*changes)
    (shaper,) = arm(*changes, ('"2 %"', '"10 %"')).shapers
    assert shaper.taps.guarantee.worst_residual_ratio == pytest.approx(worst, abs=5e-5)  # as printed


def test_damped_ei_has_impulses_elsewhere_and_is_refused(arm):
    with pytest.raises(DesignError, match="takes impulses half a damped period apart, and those of family"):
        arm(('"zvd"', '"ei"'))


def test_spacings_that_change_within_a_whole_millimetre_are_refused_in_int32(arm):
    """From 4.4 to 5.6 Hz a 100 us tick has 243 spacings: more than 200 mrad."""
    places = ('["-30 deg", "0 deg", "45 deg"]', "[0, 0.1, 0.2]")
    with pytest.raises(DesignError, match=r"number = 'int32': the spacing changes twice between 0\.0"):
        arm(places, ('"40 deg/s"', "1.0"), COUNTS, ('tick = "5 ms"', 'tick = "100 us"\nnumber = "int32"'))


def test_a_half_period_below_a_tick_is_refused(arm):
    with pytest.raises(DesignError, match="the tick is too coarse or too fine"):
        arm(('"5 ms"', '"200 ms"'))


def test_the_spacing_of_an_arm_is_half_its_damped_period_in_whole_ticks(arm):
    design = arm()
    position, spacing = design.plant.position, design.spacing
    places = np.linspace(position.places[0], position.places[-1], 1001)
    half_ticks = 0.5 / np.interp(places, position.places, position.frequency_hz)
    half_ticks /= np.sqrt(1.0 - 0.01**2) * design.tick_s
    looked_up = np.array(spacing.ticks)[np.searchsorted(spacing.starts, places, side="right") - 1]
    away = np.abs(half_ticks - np.round(half_ticks)) > 1e-9  # at a start itself either may be right
    assert (looked_up == np.floor(half_ticks))[away].all()


def test_a_stored_design_gives_the_same_block_in_every_number_type(arm, tmp_path):
    design = arm(COUNTS)
    path = tmp_path / "stored.json"
    path.write_text(save_text(design))
    stored = load_design(path)
    assert stored == design
    assert same_design(stored, design) == []
    for number, per in (("double", 1.0), ("float", 1.0), ("int32", 1e-3)):
        settings = shaper_settings(stored, number=number)
        taps = settings.bank.rows[0].taps
        assert taps.spacing.ticks == design.spacing.ticks
        # In int32 a piece begins at the next whole mrad; float has 24 bits.
        assert np.allclose(np.array(taps.spacing.starts, float) * per, design.spacing.starts, atol=1e-3)
        assert settings.rope.measured is ARM_ANGLE
        assert settings.status_bits[-1].name
        shaper = CommandShaper(settings)
        half = settings.number.scalar(settings.number.scalar(0.5) if per == 1.0 else 5000)
        turned = settings.number.scalar(0.2 if per == 1.0 else 200)
        still = ShaperInput(half, rope_length=turned, hoist_speed=settings.number.scalar(0))
        outputs = [shaper.step(still) for _ in range(100)]
        assert outputs[0].reference != half
        assert outputs[-1].reference == half
        assert outputs[-1].settled


def test_a_spacing_that_is_not_that_of_the_positions_does_not_run(arm, tmp_path):
    document = json.loads(save_text(arm()))
    document["spacing"]["starts"][1] += 1e-6
    path = tmp_path / "stored.json"
    path.write_text(json.dumps(document))
    with pytest.raises(ControllerError, match="spacing: is not that of the stored ropes or positions"):
        shaper_settings(load_design(path))


@pytest.mark.parametrize(
    ("path", "value", "reason"),
    [
        ("law", "fixed", "spacing: must not stand there: law"),
        ("law", "phase", "shapers[0].taps: must have phases_rad"),
        ("plant.position.speed_per_s", None, "plant.position.speed_per_s: is null, and law"),
        ("plant.position.frequency_hz", [5.2, 4.4], "plant.position.frequency_hz: has 2 values, places 3"),
        ("plant.position.places", [0.0, 0.0, 1.0], "plant.position.places: must rise"),
        ("plant.position.unit", "deg", "plant.position.unit"),
        ("plant.position", None, "plant.position = null: must be an object"),
        ("plant.frequency_hz", [4.4, 5.5], "plant.frequency_hz: is not the range of position.frequency_hz"),
        ("plant.kind", "mode", 'plant.position: is not null, and kind = "mode"'),
        ("plant.damping_ratio", 0.02, "shapers[0].mode.damping_ratio: 0.01 is not plant.damping_ratio"),
        (
            "shapers.0.mode.frequency_hz",
            4.5,
            "shapers[0].mode.frequency_hz: 4.5 is not plant.freq",
        ),
        ("spacing.ticks", [17], "spacing.ticks: has 1 values, starts has"),
        ("spacing", None, "spacing = null: must be an object"),
        ("shapers.0.taps.delays_spacings", [0, 1, 3], "must be 0, 1, 2 and so on"),
        ("shapers.0.taps.delays_spacings", [0, 1], "amplitudes: has 3 values, delays_spacings has 2"),
        ("shapers.0.taps.duration_s", 1.0, "shapers[0].taps.duration_s: 1.0 is not the time"),
    ],
)
def test_what_does_not_fit_together_in_a_stored_design_is_refused(arm, tmp_path, path, value, reason):
    document = json.loads(save_text(arm()))
    *parents, last = path.split(".")
    target = document
    for key in parents:
        target = target[int(key) if key.isdigit() else key]
    target[last] = value
    file = tmp_path / "stored.json"
    file.write_text(json.dumps(document))
    with pytest.raises(FileError) as caught:
        load_design(file)
    assert any(reason in problem for problem in caught.value.problems), caught.value.problems


def test_a_design_without_positions_or_spacing_has_no_such_keys(tmp_path):
    document = json.loads(save_text(designed(tmp_path, example_text("flexible-arm"))))
    assert "position" not in document["plant"]
    assert "spacing" not in document


def test_taps_are_drawn_where_the_machine_vibrates_slowest(arm):
    design = arm()
    (taps,) = stored_taps(design)
    widest = max(design.spacing.ticks)
    assert taps.delays_ticks.tolist() == [0, widest, 2 * widest]
    assert taps.guarantee.band.low_hz < design.plant.frequency_hz[0] < taps.guarantee.band.high_hz
