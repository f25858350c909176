"""The way of optional functions: machine file, design file, constants of the block."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from swayless.controller import OperatorOptions, ShaperSettings, operator_settings
from swayless.controller.settings import NO_DIAGNOSTICS, NO_OPTIONS
from swayless.errors import FileError
from swayless.machine import DesignFile, Machine, load_design, load_machine, same_design, save_text
from swayless.machine.design_id import design_id
from swayless.machine.designing import design_machine
from swayless.machine.diagnostics_section import DiagnosticsSection, TrackingSection
from swayless.machine.running import shaper_settings

PLAIN = """name = "yard"
[crane]
rope_length = [3, 9]
hoist_speed = "15 m/min"
max_speed = "30 m/min"
acceleration = 0.3
[controller]
tick = "20 ms"
KEYS
[bank]
selection = "rope_length"
tolerance = "5 %"
longest_duration = 5.0
hysteresis = 0.1
"""

ASKED = """start_from_zero = true
predicted_sway = true
residual_bound_at_rope = true
design_check = true
[drive]
counts_per_m_s = 100000
feedback = true
tracking_tolerance = "3 m/min"
[steps]
sizes = ["50 mm", "100 mm", "250 mm"]
speed = "12 m/min"
[limits]
stop_switches = true
slow_speed = "6 m/min"
margin = "30 cm"
[tuning]
speed_limit = true
rope_offset = ["50 cm", "-30 cm"]
"""

OPTIONS = OperatorOptions(
    step_sizes_m=(0.05, 0.1, 0.25),
    step_speed_m_s=0.2,
    stop_switches=True,
    slow_speed_m_s=0.1,
    limit_margin_m=0.3,
    drive_feedback=True,
    speed_limit=True,
    rope_offset_m=(-0.3, 0.5),
    start_from_zero=True,
)


def _machine(folder: Path, keys: str) -> Machine:
    path = folder / "yard.toml"
    path.write_text(PLAIN.replace("KEYS", keys))
    return load_machine(path)


@pytest.fixture(scope="module")
def asked(tmp_path_factory: pytest.TempPathFactory) -> DesignFile:
    """A design that asks for every function."""
    return design_machine(_machine(tmp_path_factory.mktemp("yard"), ASKED))


def test_a_machine_asks_for_its_functions_in_si(tmp_path: Path) -> None:
    machine = _machine(tmp_path, ASKED)
    assert machine.operator == OPTIONS
    tracking = TrackingSection(tolerance_m_s=0.05, time_s=0.5, delay_s=0.2)
    assert machine.diagnostics == DiagnosticsSection(True, True, tracking, design_check=True)


def test_a_machine_that_asks_for_nothing_has_a_plain_block(tmp_path: Path) -> None:
    design = design_machine(_machine(tmp_path, ""))
    settings = shaper_settings(design)
    assert (settings.operator, settings.diagnostics) == (NO_OPTIONS, NO_DIAGNOSTICS)
    assert not {"operator", "diagnostics"} & json.loads(save_text(design)).keys()


@pytest.mark.parametrize("number", ["double", "float", "int32"])
def test_the_block_has_what_the_design_asks_for_in_every_number_type(asked: DesignFile, number: str) -> None:
    settings = shaper_settings(asked, number=number)
    assert settings.operator == operator_settings(OPTIONS, settings.bank, settings.limits)
    told = settings.diagnostics
    assert None not in (told.sway, told.rope_bounds, told.tracking, told.facts)
    assert told.facts is not None
    assert told.facts.design_id == design_id(asked)


def test_a_stored_design_is_read_back_as_it_was(asked: DesignFile, tmp_path: Path) -> None:
    path = tmp_path / "yard.design.json"
    path.write_text(save_text(asked))
    assert load_design(path) == asked


def test_a_function_more_is_a_difference(asked: DesignFile) -> None:
    plain = replace(asked, operator=None)
    assert same_design(plain, asked) == ["operator: stored null, fresh {...}"]
    assert asked.operator is not None
    other = replace(asked, operator=replace(asked.operator, step_sizes_m=(0.05, 0.1, 0.3)))
    assert same_design(asked, other) == ["operator.step_sizes_m[2]: stored 0.25, fresh 0.3"]


def _refused(design: DesignFile, **changes: object) -> list[str]:
    assert design.operator is not None
    with pytest.raises(FileError) as caught:
        save_text(replace(design, operator=replace(design.operator, **changes)))  # type: ignore[arg-type]  # wrong on purpose
    return list(caught.value.problems)


def test_a_design_with_functions_that_exclude_each_other_is_refused(asked: DesignFile) -> None:
    assert _refused(asked, step_sizes_m=None) == [
        "design: operator.step_speed_m_s: is not null, and step_sizes_m is"
    ]
    assert _refused(asked, contactor_speeds_m_s=(0.1, 0.5)) == [
        f"design: operator.{key}: needs speeds between those of contactor_speeds_m_s"
        for key in ("step_sizes_m", "drive_feedback", "speed_limit")
    ]
    assert _refused(asked, rope_offset_m=(0.1, 0.5)) == [
        "design: operator.rope_offset_m: must be the low end, at most 0, then the high end, at least 0"
    ]


CONTACTOR = """name = "hoist"
[crane]
rope_length = [4, 8]
max_speed = 0.5
[drive]
contactor = true
contactor_speeds = ["6 m/min", "30 m/min"]
[controller]
tick = "20 ms"
[[row]]
name = "one"
family = "um-zv"
rope_length = 6
tolerance = 0.1
"""


def test_contactors_take_commands_of_their_speeds_only(tmp_path: Path) -> None:
    path = tmp_path / "hoist.toml"
    path.write_text(CONTACTOR)
    settings: ShaperSettings = shaper_settings(design_machine(load_machine(path)))
    assert settings.operator.contactor_commands == (0.1, 0.5)
