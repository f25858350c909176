"""The machine file of an adaptive shaper: what it says, and every refusal."""

from pathlib import Path

import pytest

from swayless.errors import FileError
from swayless.machine.adaptive_file import adaptive_text, is_adaptive, load_adaptive

EXAMPLE = Path(__file__).parents[3] / "examples" / "adaptive-robot.toml"
GOOD = """
name = "robot"
[adaptive]
delay = "24 ms"
cycle = "2 s"
max_command = 0.8
vibration_scale = 30
max_reference = 1.2
lag = "3 ms"
dead_zone = 0.01
frequency = "16 Hz"
damping_ratio = 0.02
[controller]
tick = "4 ms"
number = "float"
"""


def written(tmp_path, text):
    path = tmp_path / "robot.toml"
    path.write_text(text)
    return path


def test_every_key_is_read():
    settings = load_adaptive(EXAMPLE).settings
    assert (settings.delay_ticks, settings.cycle_ticks, settings.tick_s) == (25, 4000, 0.001)


def test_what_is_stored_is_what_was_read(tmp_path):
    machine = load_adaptive(written(tmp_path, GOOD))
    settings = machine.settings
    assert (settings.delay_ticks, settings.cycle_ticks, settings.lag_ticks) == (6, 500, 1)
    assert (settings.peak_factor, settings.dead_zone_ratio, settings.number.name) == (
        1.2 / 0.8,
        0.01,
        "float",
    )
    stored = tmp_path / "robot.adaptive.json"
    stored.write_text(adaptive_text(machine))
    assert load_adaptive(stored) == machine


def test_the_largest_reference_may_be_eight_times_the_largest_command(tmp_path):
    text = GOOD.replace("max_command = 0.8", "max_command = 1e6").replace("= 1.2", "= 8e6")
    assert load_adaptive(written(tmp_path, text)).settings.peak_factor == 8.0


def test_only_a_file_with_the_section_is_adaptive(tmp_path):
    assert is_adaptive(EXAMPLE)
    assert not is_adaptive(EXAMPLE.with_name("srtc-gantry.toml"))
    assert not is_adaptive(written(tmp_path, "no TOML"))


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('delay = "24 ms"', "", "[adaptive] delay: missing"),
        (
            'delay = "24 ms"',
            'delay = "25 ms"',
            "[adaptive] delay = 0.025: must be a whole number of ticks of 0.004 s",
        ),
        ('delay = "24 ms"', 'delay = "32 ms"', "[adaptive] delay = 0.032 s: |cos(w Td)| = 0.9"),
        (
            'delay = "24 ms"',
            'delay = "8 ms"',
            "which take max_reference = 5.5291 times max_command; with max_reference = 1.5 times",
        ),
        ('delay = "24 ms"', 'delay = "600 s"', "delay = 600.0: must be from 1 to 125000 ticks of 0.004 s"),
        ('delay = "24 ms"', "delay = 0", "[adaptive] delay = 0: must be > 0"),
        ('cycle = "2 s"', "cycle = 0", "[adaptive] cycle = 0: must be > 0"),
        ('cycle = "2 s"', 'cycle = "1 ms"', "cycle = 0.001: must be from 1 to 1000000 ticks of 0.004 s"),
        ('frequency = "16 Hz"', "", "[adaptive] damping_ratio = 0.02: needs frequency beside it"),
        ('number = "float"', 'number = "int32"', "[controller] number"),
        (
            "max_reference = 1.2",
            "max_reference = 0.1",
            "[adaptive] max_reference = 0.1: must be from max_command = 0.8 to 8 times that",
        ),
        ("max_command = 0.8", "max_command = -1", "[adaptive] max_command = -1"),
        ("dead_zone = 0.01", "dead_zon = 0.01", "[adaptive] dead_zon: unknown key; nearest: dead_zone"),
        ("[controller]", "[controler]", "controler: unknown section"),
        ('name = "robot"', 'name = "a b"', 'name = "a b"'),
        ('name = "robot"', "name", "not valid TOML"),
        ("[adaptive]", "adaptive = 1\n[other]", "adaptive = 1: must be a section"),
    ],
)
def test_what_cannot_be_is_refused_with_file_key_and_value(tmp_path, old, new, message):
    assert old in GOOD
    path = written(tmp_path, GOOD.replace(old, new))
    with pytest.raises(FileError) as refused:
        load_adaptive(path)
    assert message in str(refused.value)
    assert str(path) in str(refused.value)
