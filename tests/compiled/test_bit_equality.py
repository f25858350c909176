"""Generated C equals the reference in every bit of every output: every example, number type and compiler.

Examples whose law or taps others have too run in their own number type only; `test_phase_clock` and
`test_spacing_laws` have the rest.

Also the Structured Text where its number types allow. No tolerance anywhere.
"""

import dataclasses
import subprocess
import tomllib
from pathlib import Path

import pytest

from swayless.cli.generate import provenance
from swayless.codegen import TARGETS, generate
from swayless.machine import load_machine
from swayless.machine.designing import design_machine
from swayless.machine.machine_file import load_axes
from swayless.machine.running import shaper_settings
from swayless.verify import COMPILERS, find_compiler, verification, verify_block
from swayless.verify.operator_stimulus import habits

EXAMPLES = sorted(
    path
    for path in (Path(__file__).parents[2] / "examples").glob("*.toml")
    if {"crane", "arm", "axis"} & set(tomllib.loads(path.read_text()))  # the other blocks: test_adaptive, ...
)

EVERYTHING = """
name = "everything"
[crane]
rope_length = [4, 9]
damping_ratio = 0.02
max_speed = 0.6
[drive]
acceleration = 0.5
deceleration = 0.35
quick_stop = 1.2
minimum_speed = 0.02
inching_speed = 0.07
command_resolution = 0.01
counts_per_m_s = 9000
[controller]
tick = "20 ms"
[[row]]
name = "calm"
family = "ei"
rope_length = 6
[[row]]
name = "quick"
family = "um-zvd"
rope_length = 5
[[row]]
name = "plain"
family = "zv"
rope_length = 8
"""
"""Every optional part of the law: inching, minimum, resolution, waiting rows, three different ramps."""

IN_FULL = ("srtc-gantry", "double")
"""Runs as many ticks as `swayless verify`; the others run the same law for fewer."""

COUNTS_PER_M_S = 12_000.0
"""For examples that say nothing of counts."""


@pytest.fixture(scope="session")
def designs(tmp_path_factory):
    extra = tmp_path_factory.mktemp("machines") / "everything.toml"
    extra.write_text(EVERYTHING)
    machines = {**MACHINES, "everything": load_machine(extra)}
    return {name: with_counts(design_machine(machine)) for name, machine in machines.items()}


def with_counts(design):
    drive = design.drive
    if drive.counts_per_m_s is None:
        drive = dataclasses.replace(drive, counts_per_m_s=COUNTS_PER_M_S)
    return dataclasses.replace(design, drive=drive)


PRESENT = [compiler for compiler in COMPILERS if compiler.name == "zig" or compiler.is_installed()]
"""zig comes with the [verify] extra and must be there; gcc and clang are the machine's own."""

MACHINES = {
    f"{path.stem}{machine.axis and '-' + machine.axis}": machine
    for path in EXAMPLES
    for machine in load_axes(path).machines
}
NAMES = [*MACHINES, "everything"]


IN_DOUBLE_ONLY = {"double-pendulum", "elbow-arm", "hoisting-gantry", "srtc-gantry-bank"}
IN_DOUBLE_ONLY |= {"two-axis-crane-bridge", "two-axis-crane-trolley"}
CASES = [
    (name, number)
    for name in NAMES
    for number in ("double", "float", "int32")
    if number == "double" or name not in IN_DOUBLE_ONLY
]


@pytest.mark.parametrize(("name", "number"), CASES)
def test_generated_code_equals_the_reference(designs, name, number, monkeypatch):
    design = designs[name]
    settings = shaper_settings(design, number=number)
    if (name, number) != IN_FULL:  # and many stimuli more with functions, which test_operator_functions runs
        monkeypatch.setattr(verification, "STIMULUS_TICKS", 1_200 if habits(settings) else 5_000)
    origin = provenance(design)
    st_files = generate(settings, origin, "st") if number in TARGETS["st"].number_types else ()
    verdicts = list(
        verify_block(
            settings,
            origin,
            c_files=generate(settings, origin, "c"),
            st_files=st_files,
            compiler=find_compiler(),
            soak_ticks=1_000_000 if (name, number) == IN_FULL else 10_000,
        )
    )
    made = 7 + (0 if settings.rope is None else 6) + settings.is_spaced
    of_operator = habits(settings)
    made += len(of_operator) + (1 if of_operator else 0)
    assert len(verdicts) == made * (1 + len(st_files))
    assert [v for v in verdicts if not v.comparison.is_equal] == []


@pytest.mark.parametrize("compiler", PRESENT, ids=lambda compiler: compiler.name)
@pytest.mark.parametrize("number", ["double", "float", "int32"])
def test_every_compiler_on_this_machine_agrees(designs, compiler, number, monkeypatch):
    design = designs["everything"]
    settings, origin = shaper_settings(design, number=number), provenance(design)
    files = generate(settings, origin, "c")
    monkeypatch.setattr(verification, "STIMULUS_TICKS", 5_000)
    verdicts = list(verify_block(settings, origin, c_files=files, compiler=compiler, soak_ticks=0))
    assert [v for v in verdicts if not v.comparison.is_equal] == []


def test_the_example_program_arrives_and_comes_to_rest(designs, tmp_path):
    for name, design in designs.items():
        files = generate(shaper_settings(design), provenance(design), "c")
        for file in files:
            (tmp_path / file.path).write_text(file.text)
        sources = [tmp_path / file.path for file in files if file.path.endswith(".c")]
        program = tmp_path / f"{name}.exe"
        compiler = find_compiler()
        subprocess.run([*compiler.command, "-std=c99", "-o", program, *sources], check=True)
        printed = subprocess.run([program], check=True, capture_output=True, text=True).stdout
        lines = [[float(value) for value in line.split()] for line in printed.splitlines()]
        assert lines[-1][1:] == [0.0, 0.0, 0.0], name
        assert max(line[2] for line in lines) == max(line[1] for line in lines), name


def test_a_header_of_another_design_does_not_compile(designs, tmp_path):
    design = designs["srtc-gantry"]
    other = dataclasses.replace(design, source="other.toml")
    header = generate(shaper_settings(other), provenance(other), "c")[0]
    source = generate(shaper_settings(design), provenance(design), "c")[1]
    (tmp_path / header.path).write_text(header.text)
    (tmp_path / source.path).write_text(source.text)
    compiler = find_compiler()
    command = [*compiler.command, "-c", tmp_path / source.path, "-o", tmp_path / "x.o"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode != 0
    assert "belong to different designs" in done.stderr


def test_every_example_is_a_machine_file_that_builds(designs):
    assert len(EXAMPLES) >= 3
    for path in EXAMPLES:
        document = tomllib.loads(path.read_text())
        name, axes = document["name"], document.get("axis")
        expected = {f"{name}_{axis}" for axis in axes} if axes else {name}
        made = {designs[key].name for key in designs if key == path.stem or key.startswith(f"{path.stem}-")}
        assert expected <= made
