"""Robust rows: what a file asks for is what is designed, stored, and proved again before it runs."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from swayless.design import residual_vibration
from swayless.errors import DesignError
from swayless.machine import DesignFile, Machine, load_design, load_machine, save_text
from swayless.machine.designing import design_machine, design_mode
from swayless.machine.plant_section import DoublePendulum, rope_bands
from swayless.machine.problems import Report, Table
from swayless.machine.robust_row import RobustRow
from swayless.machine.row_section import read_row
from swayless.machine.running import shaper_settings, stored_taps
from swayless.plant import Band, pendulum_frequency_hz
from swayless.plant.double_pendulum import double_pendulum_modes

CRANE = """
name = "c"
[crane]
rope_length = [4, 8]
max_speed = 1
[controller]
tick = 0.02
[[row]]
name = "only"
family = "si"
"""


@pytest.fixture
def load(tmp_path: Path) -> Callable[[str], Machine]:
    def from_text(text: str) -> Machine:
        path = tmp_path / "crane.toml"
        path.write_text(text, encoding="utf-8")
        return load_machine(path)

    return from_text


def _only(machine: Machine) -> RobustRow:
    (row,) = machine.rows
    assert isinstance(row, RobustRow)
    return row


def _dense_worst(design: DesignFile) -> float:
    """Largest residual of the taps on 20001 frequencies of each band, at 9 damping ratios."""
    (taps,), (shaper,) = stored_taps(design), design.shapers
    assert shaper.taps is not None
    promised = shaper.taps.guarantee
    return max(
        float(residual_vibration(taps, np.linspace(*band, 20001), damping_ratio=damping_ratio).max())
        for band in (promised.frequency_hz, *promised.further_frequency_hz)
        for damping_ratio in np.linspace(*promised.damping_ratio, 9).tolist()
    )


def test_a_range_of_ropes_becomes_the_band_that_contains_it_to_12_digits(load) -> None:
    row = _only(load(CRANE + "rope_length = [8, 4]\n"))
    (band,) = row.bands
    exact = Band(pendulum_frequency_hz(8.0), pendulum_frequency_hz(4.0))
    assert band.low_hz <= exact.low_hz <= band.low_hz * (1.0 + 1e-11)  # a unit in the 12th digit at most
    assert band.high_hz * (1.0 - 1e-11) <= exact.high_hz <= band.high_hz
    assert row.rope_range_m == (4.0, 8.0)


def test_what_a_robust_row_leaves_out_has_the_documented_defaults(load) -> None:
    row = _only(load(CRANE + "frequency = [0.2, 0.3]\n"))
    assert (row.tolerance, row.amplitudes, row.impulses, row.duration_s) == (0.05, "positive", None, None)
    assert (row.bands, row.rope_range_m, row.damping_ratios) == ((Band(0.2, 0.3),), None, (0.0, 0.0))


def test_every_key_of_a_robust_row_arrives(load) -> None:
    keys = 'bands = [[0.2, "300 mHz"], [1, 2]]\ndamping_ratio = [0, "1 %"]\ntolerance = "8 %"\n'
    row = _only(load(CRANE + keys + 'amplitudes = "unity-magnitude"\nimpulses = 5\n'))
    assert row.bands == (Band(0.2, 0.3), Band(1.0, 2.0))
    assert (row.damping_ratios, row.tolerance) == ((0.0, 0.01), 0.08)
    assert (row.amplitudes, row.impulses) == ("unity-magnitude", 5)


def test_the_ropes_asked_for_are_stored_as_they_were_given(load) -> None:
    design = design_machine(load(CRANE + 'rope_length = ["13.1 ft", 8]\n'))
    (shaper,) = design.shapers
    assert shaper.taps is not None
    assert shaper.guarantee.rope_length_m == shaper.taps.guarantee.rope_length_m == (3.99288, 8.0)
    assert shaper.lower_bound_s is not None
    assert shaper.lower_bound_s <= shaper.duration_s <= 1.003 * shaper.lower_bound_s  # the 0.3 %
    assert shaper.taps.duration_s >= shaper.lower_bound_s


def test_a_fixed_duration_reaches_from_the_longest_rope_and_its_taps_no_farther_than_its_impulses(
    load,
) -> None:
    design = design_machine(load(CRANE.replace('"si"', '"fd"') + "rope_length = 8\nduration = 3\n"))
    (shaper,) = design.shapers
    assert shaper.taps is not None
    assert shaper.taps.duration_s == shaper.duration_s == 3.0
    assert shaper.taps.guarantee.rope_length_m[1] == 8.0
    assert shaper.taps.guarantee.rope_length_m[0] >= shaper.guarantee.rope_length_m[0]
    assert _dense_worst(design) <= 0.05 * (1.0 + 1e-9)  # rounding of the 12th digit of amplitudes


def test_both_modes_of_a_double_pendulum_are_held_at_every_rope(load) -> None:
    crane = CRANE.replace("max_speed", 'sling_length = 3\nhook_mass = 400\nload_mass = "1.2 t"\nmax_speed')
    design = design_machine(load(crane + "rope_length = [4, 8]\n"))
    assert design.plant.kind == "double_pendulum"
    (taps,) = stored_taps(design)
    for rope_m in np.linspace(4.0, 8.0, 101).tolist():
        for mode in double_pendulum_modes(rope_m, 3.0, 400.0, 1200.0):
            assert float(residual_vibration(taps, mode.frequency_hz)) <= 0.05 * (1.0 + 1e-9)
    assert design.shapers[0].guarantee.rope_length_m == (4.0, 8.0)
    assert design.plant.double_pendulum is not None
    upper_hz = design.plant.double_pendulum.upper_frequency_hz
    assert design.shapers[0].guarantee.further_frequency_hz[0] == pytest.approx(upper_hz, rel=1e-11)


@pytest.mark.parametrize("masses", [(1.0, 1000.0), (1000.0, 1.0), (300.0, 300.0)])
def test_both_frequencies_of_a_double_pendulum_fall_with_the_rope(masses: tuple[float, float]) -> None:
    pendulum = DoublePendulum(3.0, *masses)
    ropes_m = np.geomspace(0.5, 50.0, 200).tolist()
    modes = np.array([[mode.frequency_hz for mode in pendulum.modes(rope_m)] for rope_m in ropes_m])
    assert (np.diff(modes, axis=0) < 0.0).all()
    bands = rope_bands((0.5, 50.0), pendulum)
    assert [(band.low_hz, band.high_hz) for band in bands] == list(zip(modes[-1], modes[0], strict=True))


def test_bands_and_a_range_of_damping_are_stored_and_proved_again(load, tmp_path: Path) -> None:
    keys = "bands = [[0.2, 0.25], [0.7, 0.9]]\ndamping_ratio = [0, 0.03]\n"
    design = design_machine(load(CRANE + keys))
    path = tmp_path / "c.design.json"
    path.write_text(save_text(design))
    assert load_design(path) == design
    assert _dense_worst(design) <= 0.05 * (1.0 + 1e-9)
    (row,) = shaper_settings(design).bank.rows
    assert row.taps.guarantee.damping_ratios == (0.0, 0.03)
    assert [(band.low_hz, band.high_hz) for band in row.taps.guarantee.bands] == [(0.2, 0.25), (0.7, 0.9)]


def test_bands_that_overlap_are_one(load) -> None:
    (shaper,) = design_machine(load(CRANE + "bands = [[0.25, 0.3], [0.2, 0.26]]\n")).shapers
    assert (shaper.guarantee.frequency_hz, shaper.guarantee.further_frequency_hz) == ((0.2, 0.3), ())


def test_unity_magnitude_taps_have_levels_of_a_tick_and_hold_the_band(load) -> None:
    design = design_machine(load(CRANE + 'rope_length = [6, 8]\namplitudes = "unity-magnitude"\n'))
    (shaper,) = design.shapers
    assert (shaper.amplitude_rule, set(map(abs, shaper.amplitudes))) == ("unity-magnitude", {1.0})
    assert _dense_worst(design) <= 0.05 * (1.0 + 1e-9)


def test_options_of_a_row_are_designed_without_a_machine(load) -> None:
    options = {"name": "si", "family": "si", "frequency": [0.2, 0.3], "damping_ratio": [0, 0.02]}
    row = read_row("crane", Table(options, Report(""), ""), damping_ratio=0.0)
    assert row is not None
    drive = load(CRANE + "frequency = [0.2, 0.3]\n").drive
    design = design_mode(row, drive=drive, name="si", tick_s=None, number="double")
    assert (design.plant.kind, design.plant.frequency_hz) == ("mode", (0.2, 0.3))
    assert design.shapers[0].guarantee.damping_ratio == (0.0, 0.02)
    assert design.shapers[0].taps is None


@pytest.mark.parametrize(
    "row", ['"si"\nrope_length = [7, 8]', '"fd"\nrope_length = 8\nduration = 3', '"um-zvd"\nrope_length = 6']
)
def test_a_contactor_drive_is_only_asked_for_0_or_full_speed_and_its_promise_holds(load, row: str) -> None:
    crane = CRANE.replace("[controller]", "[drive]\ncontactor = true\n[controller]")
    design = design_machine(load(crane.replace('"si"\n', f"{row}\n")))
    (taps,) = stored_taps(design)
    assert set(np.cumsum(taps.amplitudes).tolist()) == {0.0, 1.0}
    assert _dense_worst(design) <= design.shapers[0].guarantee.tolerance * (1.0 + 1e-9)


def test_a_contactor_drive_that_cannot_follow_a_row_is_refused_with_what_would_do(load) -> None:
    crane = CRANE.replace("[controller]", "[drive]\ncontactor = true\n[controller]").replace("0.02", "0.5")
    with pytest.raises(DesignError, match=r'^crane\.toml: \[\[row\]\] 1 \("only"\): .*a finer tick'):
        design_machine(load(crane + "rope_length = [4, 8]\ntolerance = 0.01\n"))


def test_a_number_of_impulses_is_kept(load) -> None:
    keys = 'rope_length = [6, 8]\namplitudes = "unity-magnitude"\nimpulses = 5\n'
    (shaper,) = design_machine(load(CRANE + keys)).shapers
    assert (shaper.impulses, shaper.amplitudes) == (5, (1.0, -1.0, 1.0, -1.0, 1.0))
