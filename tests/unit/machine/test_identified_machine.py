from __future__ import annotations

import tomllib
from dataclasses import replace

import pytest

from swayless.errors import FileError
from swayless.machine import EXAMPLE_NAMES, example_text, load_machine
from swayless.machine.identified import IdentifiedPlant, new_machine_text, write_identified
from swayless.machine.identified_text import entries, replaced
from swayless.plant import Band, pendulum_frequency_hz

BAND = Band(0.1981234567, 0.2018765432)
PLANT = IdentifiedPlant("crane", (BAND,), 0.00412345, (0.003, 0.0052))
ON_A_ROPE = replace(PLANT, rope_offset_m=(0.25, 0.5))


def holds(frequency_hz, band):
    low_hz, high_hz = frequency_hz
    # Rounded outward to six digits.
    return low_hz <= band.low_hz <= low_hz * 1.00002 and high_hz >= band.high_hz >= high_hz * 0.99998


@pytest.mark.parametrize("name", EXAMPLE_NAMES)
def test_every_example_keeps_all_but_the_plant_and_says_what_was_exchanged(tmp_path, name):
    path = tmp_path / f"{name}.toml"
    path.write_text(example_text(name))
    if name in {"double-pendulum", "elbow-arm"}:
        with pytest.raises(FileError, match=r"makes several modes of it: write what was identified by hand"):
            write_identified(path, PLANT)
        assert path.read_text() == example_text(name)
        return
    arm = replace(PLANT, bands=(Band(3.9, 4.1),))
    said = write_identified(path, arm if name == "flexible-arm" else ON_A_ROPE)
    before, after = example_text(name).splitlines(), path.read_text().splitlines()
    changed = [line for line in after if line not in before]
    assert len(changed) == 2
    assert len([line for line in before if line not in after]) in {1, 2}
    for line in (line for line in before if "#" in line):
        assert any(new.endswith(line[line.index("#") :]) for new in after)
    assert said.startswith(("[crane] rope_length = [", "[arm] frequency = ["))
    assert "(was [" in said
    assert [path.name for path in tmp_path.iterdir()] == [path.name]


def test_the_band_of_the_machine_is_what_was_identified(tmp_path):
    path = tmp_path / "crane.toml"
    path.write_text(example_text("workshop-crane").replace("rope_length = [2.0, 10.0]", "rope_length = 6"))
    write_identified(path, PLANT)
    plant = load_machine(path).plant
    assert holds(plant.frequency_hz, BAND)
    assert plant.damping_ratio == pytest.approx(0.004123)
    # Once written it is still one rope, and can be written again.
    write_identified(path, PLANT)
    assert holds(load_machine(path).plant.frequency_hz, BAND)


def test_a_range_of_ropes_is_kept_and_corrected_by_the_offset(tmp_path):
    path = tmp_path / "crane.toml"
    path.write_text(example_text("workshop-crane"))
    said = write_identified(path, ON_A_ROPE)
    assert said.startswith(
        "[crane] rope_length = [2.25, 10.5] (was [2.0, 10.0];"
        " the pendulum is +0.25 to +0.5 m longer than shown)"
    )
    assert "rope_length = [2.25, 10.5] " in path.read_text()
    path.write_text(example_text("srtc-gantry"))
    write_identified(path, replace(PLANT, rope_offset_m=(0.3048, 0.6096)))
    assert ' ft"' in path.read_text().partition("rope_length = ")[2].splitlines()[0]
    corrected = Band(pendulum_frequency_hz(31.0 * 0.3048), pendulum_frequency_hz(10.0 * 0.3048))
    assert holds(load_machine(path).plant.frequency_hz, corrected)


def test_ropes_are_corrected_once(tmp_path):
    path = tmp_path / "crane.toml"
    path.write_text(example_text("workshop-crane"))
    write_identified(path, ON_A_ROPE)
    assert "  # pendulum lengths by swayless identify; shown: [2.0, 10.0]  " in path.read_text()
    once = path.read_text()
    with pytest.raises(
        FileError, match=r"= \[2\.25, 10\.5\]: are pendulum lengths already, says their comment"
    ):
        write_identified(path, ON_A_ROPE)
    assert path.read_text() == once


@pytest.mark.parametrize(
    ("old", "new", "why"),
    [
        (
            "[0.17, 0.3]",
            "[0.17, 0.3]",
            "frequency = [0.17, 0.3] (kept; a range, and it holds 0.19812 to 0.20188 Hz)",
        ),
        (
            '[0.2, "280 mHz"]',
            '[0.198123, "280 mHz"]',
            '(was [0.2, "280 mHz"]; a range, widened to hold 0.19812 to 0.20188 Hz)',
        ),
        ('["200 mHz", 0.21]', '["198.123 mHz", "201.877 mHz"]', "; two standard deviations to either side)"),
        ("0.2", "[0.198123, 0.201877]", "(was 0.2; two standard deviations to either side)"),
    ],
)
def test_a_range_of_frequencies_is_kept_or_widened_and_a_single_one_exchanged(tmp_path, old, new, why):
    path = tmp_path / "crane.toml"
    path.write_text(f"[crane]\nfrequency = {old}  # Hz\n")
    assert why in write_identified(path, PLANT)
    assert path.read_text() == f"[crane]\nfrequency = {new}  # Hz\ndamping_ratio = 0.004123\n"


def test_what_lies_outside_of_a_range_of_frequencies_is_refused(tmp_path):
    path = tmp_path / "arm.toml"
    path.write_text(example_text("flexible-arm"))
    with pytest.raises(
        FileError, match=r"0\.19812 to 0\.20188 Hz, lies outside of it: write the range by hand"
    ):
        write_identified(path, PLANT)
    assert path.read_text() == example_text("flexible-arm")


@pytest.mark.parametrize(
    ("plant", "problem"),
    [
        (
            PLANT,
            r"rope_length = \[2\.0, 10\.0\]: is a range of ropes, and .*: give --rope-length",
        ),
        (replace(PLANT, rope_offset_m=(-2.5, -2.4)), r"its shortest would be -0\.5 m: must be > 0"),
    ],
)
def test_a_range_of_ropes_is_not_narrowed_to_the_one_that_was_measured(tmp_path, plant, problem):
    path = tmp_path / "crane.toml"
    path.write_text(example_text("workshop-crane"))
    with pytest.raises(FileError, match=problem):
        write_identified(path, plant)
    assert path.read_text() == example_text("workshop-crane")


def test_damping_that_is_not_known_leaves_that_of_the_file(tmp_path):
    path = tmp_path / "crane.toml"
    path.write_text(example_text("workshop-crane"))
    write_identified(path, replace(ON_A_ROPE, damping_ratio=None))
    assert load_machine(path).plant.damping_ratio == 0.002


@pytest.mark.parametrize("bands", [(BAND,), (BAND, Band(0.9, 0.95))])
def test_a_new_file_is_a_machine_that_holds_the_bands(tmp_path, bands):
    path = tmp_path / "Yard Crane 2.toml"
    plant = IdentifiedPlant("arm", bands, 0.004, (0.003, 0.005))
    assert write_identified(path, plant) == "written; edit max_speed and tick, then build it"
    machine = load_machine(path)
    assert machine.name == "machine"
    row = machine.rows[0]
    for held, band in zip(row.bands, bands, strict=True):
        assert holds((held.low_hz, held.high_hz), band)
    assert row.damping_ratios == (0.003, 0.005)


@pytest.mark.parametrize("low_hz", [0.100001, 0.270271, 0.999999])
def test_the_row_of_a_new_file_is_wider_than_its_plant_by_a_digit(low_hz):
    band = Band(low_hz, 1.0005 * low_hz)
    document = tomllib.loads(new_machine_text("yard", IdentifiedPlant("crane", (band,), 0.0, (0.0, 0.0))))
    plant, row = document["crane"]["frequency"], document["row"][0]["frequency"]
    # A last digit of six is at most 1e-5 of the number, and outward rounding adds another.
    assert plant[0] * (1.0 - 3e-5) < row[0] < plant[0] * (1.0 - 5e-7)
    assert plant[1] * (1.0 + 5e-7) < row[1] < plant[1] * (1.0 + 3e-5)


@pytest.mark.parametrize(("high_hz", "tick"), [(0.2, "10 ms"), (4.5, "2 ms"), (20.0, "1 ms")])
def test_a_new_file_has_a_tick_that_suits_the_mode(high_hz, tick):
    plant = IdentifiedPlant("arm", (Band(0.99 * high_hz, high_hz),), 0.0, (0.0, 0.0))
    assert f'tick = "{tick}"' in new_machine_text("arm", plant)


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("crane = { rope_length = 3 }\n", r"\[crane\]: is not written as a section"),
        ("[crane]\nmax_speed = 1\n", r"\[crane\]: there is no frequency: write"),
        ("[drive]\n", "has neither"),
        ("[crane\n", "not valid TOML"),
    ],
)
def test_what_cannot_be_edited_is_refused_and_left(tmp_path, text, problem):
    path = tmp_path / "crane.toml"
    path.write_text(text)
    with pytest.raises(FileError, match=problem):
        write_identified(path, PLANT)
    assert path.read_text() == text


TRICKY = '''# [crane]
name = "x [crane] = 1"
[crane] # a head
# frequency = 9
max_speed = """
frequency = 1
"""
frequency = [   # of many lines
    0.1,        # ] not the end
    "0.2, Hz",
]   # after
[axis.crane]
frequency = 7
'''


def test_only_the_value_is_exchanged_whatever_stands_around_it():
    new = replaced(TRICKY, "crane", {"frequency": "[1, 2]", "damping_ratio": "0.1"})
    old = '[   # of many lines\n    0.1,        # ] not the end\n    "0.2, Hz",\n]'
    assert new == TRICKY.replace(old, "[1, 2]").replace("# after\n", "# after\ndamping_ratio = 0.1\n")
    assert [entry.key for entry in entries(TRICKY, "crane")] == ["max_speed", "frequency"]


def test_items_of_an_array_take_the_places_of_those_before_and_comments_stay():
    new = replaced(TRICKY, "crane", {"frequency": ("3", "4")}, {"frequency": "new"})
    assert new == TRICKY.replace("0.1,", "3,").replace('"0.2, Hz"', "4").replace(
        "]   # after", "]  # new   # after"
    )
    one = "[crane]\nfrequency = [ # Hz\n  3\n]\n"
    assert replaced(one, "crane", {"frequency": ("3", "4")}) == one.replace("3", "3, 4")


def test_line_ends_and_a_missing_last_one_stay(tmp_path):
    path = tmp_path / "arm.toml"
    path.write_bytes(b"[arm]\r\nmax_speed = 1\r\nfrequency = 4 # Hz")
    write_identified(path, PLANT)
    assert path.read_bytes() == (
        b"[arm]\r\nmax_speed = 1\r\nfrequency = [0.198123, 0.201877] # Hz\r\ndamping_ratio = 0.004123\r\n"
    )


def test_ropes_are_those_of_the_band(tmp_path):
    path = tmp_path / "crane.toml"
    path.write_text("[crane]\nrope_length = 5\n")
    band = Band(pendulum_frequency_hz(6.0), pendulum_frequency_hz(5.0))
    write_identified(path, IdentifiedPlant("crane", (band,), None, (0.0, 0.0)))
    # Six digits, rounded outward: the band is that of 5 and 6 m to rounding.
    low, high = (
        float(text) for text in path.read_text().splitlines()[1].partition("[")[2].rstrip("]").split(",")
    )
    assert low == pytest.approx(5.0, rel=2e-5)
    assert high == pytest.approx(6.0, rel=2e-5)
    assert low <= 5.0 + 1e-12
    assert high >= 6.0 - 1e-12
