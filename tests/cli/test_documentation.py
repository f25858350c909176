"""What the pages for users say is what the program does."""

from __future__ import annotations

import re
import shlex
import subprocess
from pathlib import Path

import numpy as np
import pytest
import typer

from swayless.cli.app import app
from swayless.cli.generate import provenance
from swayless.codegen import generate
from swayless.codegen.interface import input_pins, output_pins
from swayless.controller import CommandShaper, ShaperInput, Status, explain
from swayless.controller.status import ERROR_BITS
from swayless.machine import example_text, load_machine
from swayless.machine.designing import design_machine
from swayless.machine.running import shaper_settings
from swayless.verify import find_compiler
from swayless.verify.structured_text import load

ROOT = Path(__file__).parents[2]
COMMANDS = (ROOT / "docs" / "commands.md").read_text(encoding="utf-8")
BLOCK = (ROOT / "docs" / "block.md").read_text(encoding="utf-8")
EVERYDAY = (ROOT / "README.md").read_text(encoding="utf-8").partition("## Everyday commands")[2]


def blocks(page: str, language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", page, re.DOTALL)


def cells(page: str, first_head: str) -> list[list[str]]:
    """Cells of the table whose first head is given, without its heads."""
    table = re.search(rf"^\| {re.escape(first_head)} \|.*\n\|[-|]+\n((?:\|.*\n)+)", page, re.MULTILINE)
    assert table
    return [[cell.strip().strip("`") for cell in line.split("|")[1:-1]] for line in table[1].splitlines()]


def shown(page: str) -> list[tuple[str, str | None]]:
    """Command lines of a page in their order, each with the output that follows its block, if one does."""
    found: list[tuple[str, str | None]] = []
    for lines, output in re.findall(r"```sh\n(.*?)```\n(?:\n```text\n(.*?)```)?", page, re.DOTALL):
        commands = [line for line in lines.splitlines() if line.startswith("swayless ")]
        found += [(command, None) for command in commands[:-1]]
        found += [(command, output or None) for command in commands[-1:]]
    return found


def comparable(output: str) -> list[str]:
    """Lines of an output but for those that name the compiler or count ticks."""
    return [line for line in output.splitlines() if not line.startswith("verified: ")]


@pytest.mark.usefixtures("blank_figures")
@pytest.mark.parametrize("page", [COMMANDS, EVERYDAY], ids=["commands.md", "README.md"])
def test_every_command_line_works_and_prints_what_is_shown(run, page):
    lines = shown(page)
    assert len(lines) >= 7
    for line, output in lines:
        arguments = shlex.split(line, comments=True)[1:]
        proves = arguments[0] in {"build", "verify"} and not {"--check", "--no-verify"} & set(arguments)
        done = run(*arguments, *(["--soak-ticks", "100"] if proves else []))
        assert (done.code, done.err) == (0, ""), line
        if output is not None:
            assert comparable(done.out) == comparable(output), line


def test_the_command_lines_of_the_tradeoff_page_work(run):
    assert run("init", "crane.toml").code == 0
    lines = shown((ROOT / "docs" / "tradeoff.md").read_text(encoding="utf-8"))
    assert len(lines) >= 2
    for line, _ in lines:
        done = run(*shlex.split(line)[1:])
        assert (done.code, done.err) == (0, ""), line


HEADINGS = {"design FAMILY": "design"} | {
    name: name
    for name in (
        *("init", "build", "design si", "design fd", "design bank", "design recommend"),
        *("plot", "simulate", "identify", "generate", "verify"),
        *("profile optimal", "profile simulate", "profile invert", "profile tune"),
    )
}


@pytest.mark.parametrize("command", HEADINGS)
def test_every_option_is_in_the_table_of_its_command_and_no_other(command):
    section = COMMANDS.partition(f"\n## {HEADINGS[command]}\n")[2].partition("\n## ")[0]
    documented = [name.strip("` ") for row in cells(section, "option") for name in row[0].split(",")]
    found = typer.main.get_command(app)
    for name in command.split():
        found = found.commands[name]
    parameters = found.params
    names = [
        name
        for parameter in parameters
        if parameter.name != "help"
        for name in ([parameter.metavar] if parameter.param_type_name == "argument" else parameter.opts)
    ]
    assert documented == names


FULL = """name = "full"
[crane]
rope_length = [3, 9]
hoist_speed = 0.25
max_speed = 0.5
acceleration = 0.3
[controller]
tick = 0.02
law = "phase"
predicted_sway = true
design_check = true
[drive]
counts_per_m_s = 100000
feedback = true
tracking_tolerance = 0.05
[steps]
sizes = [0.05, 0.1, 0.25]
[limits]
stop_switches = true
slow_speed = 0.1
margin = 0.3
[tuning]
speed_limit = true
rope_offset = [-0.5, 0.5]
[[row]]
name = "any rope"
family = "zvd"
"""

PAGES = sorted([*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")])


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_every_link_of_a_page_leads_somewhere(page):
    for target in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", page.read_text(encoding="utf-8")):
        assert (page.parent / target).exists(), target


@pytest.fixture(scope="module")
def workshop(tmp_path_factory):
    """The machine of the wiring examples: its block as settings, and where it comes from."""
    path = tmp_path_factory.mktemp("machine") / "workshop-crane.toml"
    path.write_text(example_text("workshop-crane"))
    design = design_machine(load_machine(path))
    return shaper_settings(design), provenance(design)


def test_the_status_table_is_that_of_the_controller():
    assert cells(BLOCK, "value") == [
        [str(bit.value), bit.name, explain(bit), "yes" if bit & ERROR_BITS else ""] for bit in Status
    ]


def test_the_pin_tables_are_those_of_the_generators(workshop):
    settings, _ = workshop
    inputs, outputs = (cells(BLOCK.partition(head)[2], "C") for head in ("## Inputs", "## Outputs"))
    assert [row[:2] for row in inputs] == [[pin.c_name, pin.st_name] for pin in input_pins(settings)]
    assert [row[:2] for row in outputs] == [[pin.c_name, pin.st_name] for pin in output_pins(settings)]
    units = {"command": settings.limits.units}
    assert [[units.get(row[4], row[4]), row[5]] for row in outputs] == [
        [pin.unit, pin.integer_unit] for pin in output_pins(settings)
    ]
    kinds = {"bool": ("bool", "BOOL"), "real": ("P_real_t", "LREAL`, `REAL")}
    kinds |= {"row": ("uint8_t", "DINT"), "word": ("uint32_t", "DINT")}
    for row, pin in zip([*inputs, *outputs], [*input_pins(settings), *output_pins(settings)], strict=True):
        assert tuple(row[2:4]) == kinds[pin.kind]


def tables(section, first_head):
    """Cells of every table of a section that begins with a head, one below the other."""
    found = re.findall(rf"^\| {re.escape(first_head)} \|.*\n\|[-|]+\n(?:\|.*\n)+", section, re.MULTILINE)
    return [row for table in found for row in cells(table, first_head)]


@pytest.mark.parametrize("number", ["double", "int32"])
def test_the_tables_of_optional_pins_are_those_of_a_block_that_has_every_function(tmp_path, number):
    (tmp_path / "full.toml").write_text(FULL)
    settings = shaper_settings(design_machine(load_machine(tmp_path / "full.toml")), number=number)
    places = (BLOCK.partition("## Inputs")[2].partition("## Outputs")[0], BLOCK.partition("## Outputs")[2])
    for place, pins in zip(places, (input_pins(settings), output_pins(settings)), strict=True):
        rows = tables(place.partition("\n## ")[0], "C")
        names = [(re.search(r"named `(\w+)", " | ".join(row)) or [0, row[0]])[1] for row in rows]
        names = names if number == "int32" else [row[0] for row in rows]
        assert names == [pin.c_name for pin in pins]
        assert [row[1] for row in rows] == [pin.st_name for pin in pins]


class Trolley:
    """The wiring example in Structured Text, on a trolley that follows its reference."""

    def __init__(self, workshop):
        settings, origin = workshop
        (block,) = generate(settings, origin, "st")
        wiring, _ = blocks(BLOCK, "iecst")
        self.block = load(block.text + wiring).instantiate()
        self.tick_s, self.full = settings.tick_s, float(settings.limits.max_command)
        self.position, self.speeds = 0.0, []

    def run(self, ticks, **inputs):
        wired = {"Pendant": self.full, "Knob": 1, "DriveReady": True, "SoftEnd": 1000.0, **inputs}
        for _ in range(ticks):
            speed = self.block.step({**wired, "Position": np.float32(self.position)})["SpeedReference"]
            self.position += float(speed) * self.tick_s
            self.speeds.append(float(speed))
        return self.speeds[-1]


def test_the_wiring_waits_for_the_pendant_to_be_released_when_the_drive_becomes_ready(workshop):
    trolley = Trolley(workshop)
    assert trolley.run(5, DriveReady=False) == 0.0
    assert trolley.run(50) == 0.0
    trolley.run(1, Pendant=0.0)
    assert trolley.run(50) > 0.0


def test_the_wiring_stops_at_a_limit_switch_and_only_leaves_it_backwards(workshop):
    trolley = Trolley(workshop)
    assert trolley.run(1500) == np.float32(trolley.full)
    before = trolley.position
    # The quick stop at 1 m/s2 from 0.667 m/s: v^2 / 2a = 0.222 m, less half a tick's way.
    assert trolley.run(1500, EndForward=True) == 0.0
    assert trolley.position - before == pytest.approx(0.219, abs=2e-3)
    assert trolley.run(500, EndForward=True, Pendant=0.0) == 0.0
    assert trolley.run(500, EndForward=True) == 0.0
    assert trolley.run(500, EndForward=True, Pendant=-trolley.full) < 0.0


def test_the_wiring_stops_at_the_soft_end_to_within_the_way_of_one_tick(workshop):
    trolley = Trolley(workshop)
    trolley.run(3000, SoftEnd=5.0)
    assert trolley.speeds[-1] == 0.0
    way_of_a_tick_m = trolley.full * trolley.tick_s
    # 1e-5: float32 holds a position of 5 m to 5e-7, and a stop of some hundred ticks to a few of those.
    assert 5.0 - way_of_a_tick_m - 1e-5 <= trolley.position <= 5.0 + way_of_a_tick_m + 1e-5


HARNESS = """
#include <stdio.h>
void trolley_start(void);
float trolley_reference(float wanted_m_s, uint8_t knob, bool drive_ready, bool at_end);
int main(void)
{
    int tick;
    trolley_start();
    for (tick = 0; tick < 1000; ++tick) {
        const bool ready = (tick != 0);
        const float wanted = (tick > 1 && tick < 800) ? 0.5f : 0.0f;
        printf("%.9g\\n", (double)trolley_reference(wanted, 2u, ready, tick > 900));
    }
    return 0;
}
"""


def test_the_wiring_in_c_compiles_with_the_flags_given_and_gives_the_reference(workshop, tmp_path):
    settings, origin = workshop
    for file in generate(settings, origin, "c"):
        (tmp_path / file.path).write_text(file.text)
    wiring, _ = blocks(BLOCK, "c")
    (tmp_path / "main.c").write_text(wiring + HARNESS)
    program = tmp_path / "main.exe"
    sources = [tmp_path / "main.c", tmp_path / "workshop_crane_shaper.c"]
    assert "`-std=c99 -ffp-contract=off`" in BLOCK
    flags = ["-std=c99", "-ffp-contract=off", "-o", program]
    subprocess.run([*find_compiler().command, *flags, *sources], check=True)
    printed = subprocess.run([program], capture_output=True, text=True, check=True).stdout.split()
    shaper = CommandShaper(settings)
    number = settings.number.scalar
    expected = [
        shaper.step(
            ShaperInput(number(0.5 if 1 < tick < 800 else 0.0), 2, True, tick > 900, tick == 0)
        ).reference
        for tick in range(1000)
    ]
    assert [np.float32(text) for text in printed] == expected
    assert max(expected) == np.float32(0.5)


def test_the_figures_of_the_data_sheet_are_those_of_the_examples(tmp_path):
    for name in ("srtc-gantry", "flexible-arm"):
        (tmp_path / f"{name}.toml").write_text(example_text(name))
    memory = []
    for name in ("srtc-gantry", "flexible-arm"):
        design = design_machine(load_machine(tmp_path / f"{name}.toml"))
        header = generate(shaper_settings(design), provenance(design), "c")[0].text
        memory.append(int(re.search(r"_SHAPER_RAM \((\d+)\)", header)[1]))
    assert f"{memory[0] / 1000:.1f} kB for the gantry crane in double" in BLOCK
    assert f"{memory[1] / 1000:.1f} kB for the flexible arm in int32" in BLOCK
