"""Designs for a drive that feels the load: what they promise, against eigenvalues of a matrix."""

from __future__ import annotations

import numpy as np
import pytest

from swayless.design import FAMILIES
from swayless.machine import load_design, load_machine, save_text
from swayless.machine.as_pendulum import pendulum_design
from swayless.machine.designing import design_machine
from swayless.machine.running import shaper_settings
from swayless.plant import FreeRopes, ServoDrive, pendulum_frequency_hz
from tests.unit.plant.linear_drive import state_matrix

HEAD = """name = "driven"
[crane]
rope_length = [4, 9]
hoist_speed = 0.3
max_speed = 0.6
damping_ratio = 0.002
[drive]
trolley_mass = "2 t"
load_mass = "6 t"
{loop}
[controller]
tick = "20 ms"
"""
STIFF = "speed_loop_lag = 0.1"
LOOPS = {
    STIFF: ServoDrive.from_lag(2000.0, 6000.0, 0.1),
    "speed_loop_gain = 100e3\nspeed_loop_integral_time = '2 s'": ServoDrive(2000.0, 6000.0, 1e5, 2.0),
}
OWN = 0.002
KEYS = {"zvm": "order = 2", "oatf": "delay = 1.5", "fd": "duration = 4"}
NAMED = [name for name in FAMILIES if name not in {"zvdd", "zvddd"}]
"""All but two that `zvm` stands for."""


@pytest.fixture
def designed(tmp_path):
    def designed(body, loop=STIFF):
        path = tmp_path / "driven.toml"
        path.write_text(HEAD.format(loop=loop) + body)
        return design_machine(load_machine(path))

    return designed


def row(family, rope="6", more=""):
    named = f'[[row]]\nname = "{family}"\nfamily = "{family}"\nrope_length = {rope}\n'
    return f"{named}{KEYS.get(family, '')}\n{more}\n"


def pole(drive, rope_m, own=OWN):
    values = np.linalg.eigvals(state_matrix(drive, rope_m, own))
    values = values[values.imag > 1e-6 * abs(values)]
    return values[(-values.real / abs(values)).argmin()]


def left_on(drive, times_s, amplitudes, range_m, own=OWN, samples=300):
    """Largest |sum A_i exp(s (t_n - t_i))| over ropes, ends included."""
    before_s = times_s[-1] - np.array(times_s)
    return max(
        abs(np.dot(amplitudes, np.exp(pole(drive, rope_m, own) * before_s)))
        for rope_m in np.linspace(*range_m, samples)
    )


def assert_promises_hold(design, drive, own=OWN):
    for shaper in design.shapers:
        promise = shaper.guarantee
        assert (
            left_on(drive, shaper.times_s, shaper.amplitudes, promise.rope_length_m, own) <= promise.tolerance
        )
        promise, taps = shaper.taps.guarantee, shaper.taps
        times_s = 0.02 * np.array(taps.delays_ticks)
        assert left_on(drive, times_s, taps.amplitudes, promise.rope_length_m, own) <= promise.tolerance


@pytest.mark.parametrize(
    ("loop", "drive", "families"),
    list(zip(LOOPS, LOOPS.values(), (NAMED, ["zv", "ei", "um-ei"]), strict=True)),
    ids=["P", "PI"],
)
def test_rows_of_named_families_are_made_for_the_eigenvalue_and_hold_the_ropes_they_promise(
    designed, loop, drive, families
):
    s = pole(drive, 6.0)
    for names in (families[:8], families[8:]):
        if not names:
            continue
        design = designed("".join(row(name) for name in names), loop)
        for shaper in design.shapers:
            # 12 digits are stored.
            assert shaper.mode.frequency_hz == pytest.approx(abs(s) / (2 * np.pi), rel=1e-9)
            assert shaper.mode.damping_ratio == pytest.approx(-s.real / abs(s), rel=1e-9)
            low_m, high_m = shaper.taps.guarantee.rope_length_m
            assert low_m < 6.0 < high_m
        assert_promises_hold(design, drive)


def test_the_ropes_promised_end_where_the_tolerance_is_reached(designed):
    (shaper,) = designed(row("zvd")).shapers
    drive, times_s = LOOPS[STIFF], 0.02 * np.array(shaper.taps.delays_ticks)
    for end_m, beyond_m in zip(shaper.taps.guarantee.rope_length_m, (-1e-3, 1e-3), strict=True):
        left = left_on(drive, times_s, shaper.taps.amplitudes, (end_m, end_m), samples=1)
        # 1e-4 of it stays free for narrower number types: MARGIN is 1e-5.
        assert left == pytest.approx(0.05, rel=1e-4)
        beyond = end_m + beyond_m
        assert left_on(drive, times_s, shaper.taps.amplitudes, (beyond, beyond), samples=1) > 0.05
    # And not where a pendulum's frequency leaves the band: at 8.36 m.
    assert FreeRopes().rope_length_m(shaper.taps.guarantee.frequency_hz[0]) > beyond_m + end_m + 0.01


@pytest.mark.parametrize(("loop", "drive"), LOOPS.items(), ids=["P", "PI"])
def test_an_si_row_holds_frequency_and_damping_of_all_its_ropes(designed, loop, drive):
    design = designed(row("si", "[4, 9]"), loop)
    (shaper,) = design.shapers
    poles = np.array([pole(drive, rope_m) for rope_m in np.linspace(4.0, 9.0, 50)])
    ratios, frequencies = -poles.real / abs(poles), abs(poles) / (2 * np.pi)
    held = shaper.taps.guarantee
    assert held.rope_length_m == (4.0, 9.0)
    # Rounded outward to 12 digits.
    assert held.frequency_hz == pytest.approx((frequencies.min(), frequencies.max()), rel=1e-9)
    assert held.damping_ratio[0] <= ratios.min() * (1 + 1e-9)
    assert held.damping_ratio[1] >= ratios.max() * (1 - 1e-9)
    assert shaper.lower_bound_s < shaper.duration_s
    assert_promises_hold(design, drive)


def test_an_fd_row_reaches_from_its_longest_rope(designed):
    design = designed(row("fd", "9"))
    (shaper,) = design.shapers
    low_m, high_m = shaper.taps.guarantee.rope_length_m
    assert low_m < 7.5
    assert high_m >= 9.0
    assert shaper.duration_s == 4.0
    assert_promises_hold(design, LOOPS[STIFF])


def test_the_rows_of_a_bank_hold_their_own_ropes_and_hand_over_at_true_frequencies(designed):
    keys = "tolerance = 0.08\nlongest_duration = 4.2\nselection = 'rope_length'\nhysteresis = 0.3"
    design, drive = designed(f"[bank]\n{keys}\n"), LOOPS[STIFF]
    bank, held = design.bank, [shaper.taps.guarantee for shaper in design.shapers]
    assert len(held) == 2
    (place_m,) = bank.switching_rope_length_m
    half_m = 0.5 * bank.hysteresis_m
    assert held[0].rope_length_m[0] <= place_m - half_m
    assert held[0].rope_length_m[1] >= 9.0
    assert held[1].rope_length_m[0] <= 4.0
    assert held[1].rope_length_m[1] >= place_m + half_m
    assert bank.overlap_m[0] == pytest.approx(held[1].rope_length_m[1] - held[0].rope_length_m[0], rel=1e-9)
    assert bank.switching_frequency_hz[0] == pytest.approx(abs(pole(drive, place_m)) / (2 * np.pi), rel=1e-9)
    assert {promise.tolerance for promise in held} == {bank.tolerance} == {0.08}
    assert_promises_hold(design, drive)
    assert shaper_settings(design).bank.rows[1].name == design.shapers[1].name


def test_a_bank_of_so_many_rows_promises_what_they_leave_at_the_damping_of_each_rope(designed):
    design = designed("[bank]\nrows = 1\nduration = 4.2\n")
    (shaper,) = design.shapers
    promise = shaper.taps.guarantee
    assert promise.rope_length_m[0] <= 4.0
    assert promise.rope_length_m[1] >= 9.0
    times_s = 0.02 * np.array(shaper.taps.delays_ticks)
    left = left_on(LOOPS[STIFF], times_s, shaper.taps.amplitudes, (4.0, 9.0))
    # 300 ropes miss a maximum by a thousandth of it.
    assert design.bank.tolerance == promise.tolerance == pytest.approx(left, rel=1e-3)


def test_a_contactor_row_holds_its_ropes(designed):
    design = designed(row("um-ei", "6"), f"{STIFF}\ncontactor = true")
    assert set(map(abs, design.shapers[0].taps.amplitudes)) == {1.0}
    assert_promises_hold(design, LOOPS[STIFF])


@pytest.mark.parametrize("number", ["float", "int32"])
def test_the_ropes_promised_are_held_in_narrower_number_types(designed, number):
    design = designed(row("ei") + row("zvd"), f"{STIFF}\nunits = 'mm/s'\ncounts_per_m_s = 1e6")
    settings = shaper_settings(design, number=number)
    for shaper, made in zip(design.shapers, settings.bank.rows, strict=True):
        taps, promise = made.taps, shaper.taps.guarantee
        left = left_on(LOOPS[STIFF], taps.times_s, taps.amplitudes, promise.rope_length_m)
        assert left <= promise.tolerance


def test_the_damping_of_a_row_is_the_ropes_own(designed):
    (shaper,) = designed(row("zvd", more="damping_ratio = '1 %'")).shapers
    s = pole(LOOPS[STIFF], 6.0, 0.01)
    assert shaper.mode.damping_ratio == pytest.approx(-s.real / abs(s), rel=1e-9)


def test_the_design_file_says_what_the_drive_is_and_reads_back(designed, tmp_path):
    design = designed(row("zvd"), "speed_loop_lag = 0.1\nspeed_loop_integral_time = 2")
    path = tmp_path / "driven.json"
    path.write_text(save_text(design))
    assert load_design(path) == design
    loop = design.drive.speed_loop
    assert (loop.trolley_mass_kg, loop.load_mass_kg, loop.gain_n_s_m) == (2000.0, 6000.0, 80e3)
    assert loop.integral_time_s == 2.0
    low_hz, high_hz = design.plant.frequency_hz
    drive = ServoDrive.from_lag(2000.0, 6000.0, 0.1, 2.0)
    assert low_hz == pytest.approx(abs(pole(drive, 9.0)) / (2 * np.pi), rel=1e-9)
    assert high_hz == pytest.approx(abs(pole(drive, 4.0)) / (2 * np.pi), rel=1e-9)
    assert design.plant.damping_ratio == OWN


def test_a_machine_without_a_speed_loop_has_none_in_its_design_file(tmp_path):
    path = tmp_path / "free.toml"
    keys = 'trolley_mass = "2 t"\nload_mass = "6 t"\n{loop}\n'
    path.write_text(HEAD.replace(keys, "") + row("zvd"))
    design = design_machine(load_machine(path))
    assert design.drive.speed_loop is None
    assert "speed_loop" not in save_text(design)
    assert design.shapers[0].mode.frequency_hz == pytest.approx(pendulum_frequency_hz(6.0), rel=1e-11)


def test_the_same_rows_for_a_pendulum_stand_beside(designed):
    design = designed(row("zvd") + row("si", "[5, 8]") + row("fd", "9"))
    free = pendulum_design(design)
    assert free.drive.speed_loop is None
    zvd, si, fd = free.shapers
    assert zvd.mode.frequency_hz == pytest.approx(pendulum_frequency_hz(6.0), rel=1e-12)
    assert zvd.mode.damping_ratio == si.mode.damping_ratio == fd.mode.damping_ratio == OWN
    expected = pendulum_frequency_hz(8.0), pendulum_frequency_hz(5.0)
    assert si.guarantee.frequency_hz == pytest.approx(expected, rel=1e-9)
    assert fd.duration_s == 4.0
    # On the driven crane they break the promise that those for the true mode keep.
    for shaper, true in zip((zvd, si), design.shapers, strict=False):
        ropes_m = true.taps.guarantee.rope_length_m
        times_s = 0.02 * np.array(shaper.taps.delays_ticks)
        assert left_on(LOOPS[STIFF], times_s, shaper.taps.amplitudes, ropes_m) > 0.0515
