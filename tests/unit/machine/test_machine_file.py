from __future__ import annotations

from pathlib import Path

import pytest

from swayless.machine import (
    EXAMPLE_NAMES,
    ControllerSection,
    DriveSection,
    Machine,
    example_text,
    load_machine,
)
from swayless.machine.machine_file import load_axes
from swayless.plant import pendulum_frequency_hz, pendulum_mode

SMALLEST = """
name = "c"
[crane]
rope_length = 4
max_speed = 1
[controller]
tick = 0.01
[[row]]
name = "only"
family = "zv"
rope_length = 4
"""


@pytest.fixture
def load(tmp_path: Path):
    def from_text(text: str) -> Machine:
        path = tmp_path / "crane.toml"
        path.write_text(text, encoding="utf-8", newline="")
        return load_machine(path)

    return from_text


def test_what_a_small_file_leaves_out_has_the_documented_defaults(load) -> None:
    machine = load(SMALLEST)
    assert machine.source == "crane.toml"
    assert machine.drive == DriveSection("m/s", None, 1.0, None, None, None, 0.0, 0.0, 0.0)
    assert machine.controller == ControllerSection(0.01, "double", "fixed")
    assert machine.plant.rope_length_m == (4.0, 4.0)
    assert machine.plant.damping_ratio == 0.0
    row = machine.rows[0]
    assert (row.mode, row.rope_length_m) == (pendulum_mode(4.0), 4.0)
    assert (row.tolerance, row.order, row.delay_s) == (0.05, None, None)


def test_every_key_of_the_documented_file_arrives_in_si(load, machine_text: str) -> None:
    machine = load(machine_text)
    assert machine.name == "yard_crane"
    assert machine.plant.rope_length_m == (1.8288, 9.144)
    assert machine.plant.frequency_hz == (pendulum_frequency_hz(9.144), pendulum_frequency_hz(1.8288))
    assert machine.drive == DriveSection(
        units="rpm of the motor",
        counts_per_m_s=2400.0,
        max_speed_m_s=0.6096,
        acceleration_m_s2=0.3,
        deceleration_m_s2=0.4,
        quick_stop_m_s2=0.9,
        minimum_speed_m_s=0.02032,
        inching_speed_m_s=0.04064,
        command_resolution_m_s=0.00254,
    )
    assert [row.mode.damping_ratio for row in machine.rows[:2]] == [0.005, 0.01]


@pytest.mark.parametrize("name", EXAMPLE_NAMES)
def test_each_example_loads_and_is_named_after_its_file(name: str, tmp_path) -> None:
    text = example_text(name)
    (tmp_path / "crane.toml").write_text(text)
    assert load_axes(tmp_path / "crane.toml").name == name.replace("-", "_")
    assert text.isascii()
    assert "\r" not in text


def test_srtc_gantry_is_the_crane_of_the_paper(load) -> None:
    machine = load(example_text("srtc-gantry"))
    assert machine.plant.rope_length_m == (2.7432, 8.8392)
    assert [row.rope_length_m for row in machine.rows] == [7.3152, 4.8768, 3.3528]
    assert {row.family for row in machine.rows} == {"um-zv"}
    assert (machine.plant.damping_ratio, machine.controller) == (
        0.0,
        ControllerSection(0.01, "double", "fixed"),
    )


def test_ends_of_a_range_are_stored_rising_whatever_their_order(load) -> None:
    machine = load(SMALLEST.replace("rope_length = 4\nmax", 'frequency = [0.3, "200 mHz"]\nmax'))
    assert (machine.plant.rope_length_m, machine.plant.frequency_hz) == (None, (0.2, 0.3))


def test_ramps_may_stand_in_the_drive_section_and_default_to_the_acceleration(load) -> None:
    drive = load(SMALLEST + "[drive]\nacceleration = 0.4\nquick_stop = 1\n").drive
    assert (drive.acceleration_m_s2, drive.deceleration_m_s2, drive.quick_stop_m_s2) == (0.4, 0.4, 1.0)


def test_deceleration_and_quick_stop_are_allowed_without_acceleration(load) -> None:
    drive = load(SMALLEST + "[drive]\ndeceleration = 0.4\nquick_stop = 1\n").drive
    assert (drive.acceleration_m_s2, drive.deceleration_m_s2, drive.quick_stop_m_s2) == (None, 0.4, 1.0)


def test_counts_without_a_unit_are_called_counts(load) -> None:
    assert load(SMALLEST + "[drive]\ncounts_per_m_s = 1000\n").drive.units == "counts"


def test_an_order_and_a_delay_reach_the_row(load) -> None:
    assert load(SMALLEST.replace('"zv"', '"zvm"\norder = 2')).rows[0].order == 2
    assert load(SMALLEST.replace('"zv"', '"oatf"\ndelay = "250 ms"')).rows[0].delay_s == 0.25


@pytest.mark.parametrize("text", [SMALLEST.replace("\n", "\r\n"), "\ufeff" + SMALLEST])
def test_windows_line_ends_and_a_byte_order_mark_change_nothing(load, text: str) -> None:
    assert load(text) == load(SMALLEST)


def test_an_arm_has_no_rope(load) -> None:
    machine = load(
        SMALLEST.replace("[crane]\nrope_length", "[arm]\nfrequency").replace("rope_length", "frequency")
    )
    assert (machine.plant.kind, machine.plant.rope_length_m, machine.rows[0].rope_length_m) == (
        "arm",
        None,
        None,
    )
