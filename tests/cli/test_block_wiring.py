"""The wiring of every function in the data sheet: it compiles, runs, and gives what the reference gives."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

from swayless.cli.generate import provenance
from swayless.codegen import generate
from swayless.controller import CommandShaper, ShaperInput, Status
from swayless.machine import example_text, load_machine
from swayless.machine.designing import design_machine
from swayless.machine.running import shaper_settings
from swayless.verify import find_compiler
from swayless.verify.structured_text import load

PAGE = (Path(__file__).parents[2] / "docs" / "block.md").read_text(encoding="utf-8")
SECTION = PAGE.partition("### All of it")[2].partition("\n## ")[0]
TICKS = 1500
FREE_M = 30.0


@pytest.fixture(scope="module")
def bridge(tmp_path_factory):
    """The bridge of the example: its block, and where it comes from."""
    path = tmp_path_factory.mktemp("machine") / "two-axis-crane.toml"
    path.write_text(example_text("two-axis-crane"))
    design = design_machine(load_machine(path, axis="bridge"))
    return shaper_settings(design), provenance(design)


def signals(tick):
    """What happens at the crane: steps, a drive that trips, half speed, switches, a blind laser."""
    return {
        "joystick_m_s": 1.0 if 400 <= tick < 800 or 900 <= tick < 1300 else 0.0,
        "shaping": True,
        "step_forward": tick in {5, 25},
        "step_reverse": False,
        "step_size": 3,
        "end_forward_free": tick < 1350,
        "end_reverse_free": True,
        "fast_forward_free": tick < 1200,
        "fast_reverse_free": True,
        "laser_forward_m": FREE_M,
        "laser_reverse_m": FREE_M,
        "lasers_valid": not 1000 <= tick < 1100,
        "encoder_m": 5.0,
        "encoder_m_s": 0.0,
        "encoder_valid": tick != 450,
        "sling_m": 1.5,
        "drive_runs": not 600 <= tick < 650,
        "drive_m_s": 0.1 if tick == 650 else 0.0,
        "slow_load": tick >= 900,
    }


def wired(now):
    """The same as inputs of the reference."""
    return ShaperInput(
        command=now["joystick_m_s"],
        selector=1,
        enable=now["shaping"],
        rope_length=now["encoder_m"],
        hoist_speed=now["encoder_m_s"],
        rope_length_valid=now["encoder_valid"],
        step_forward=now["step_forward"],
        step_reverse=now["step_reverse"],
        step_size=now["step_size"],
        stop_forward=not now["end_forward_free"],
        stop_reverse=not now["end_reverse_free"],
        slow_forward=not now["fast_forward_free"],
        slow_reverse=not now["fast_reverse_free"],
        distance_forward=now["laser_forward_m"],
        distance_reverse=now["laser_reverse_m"],
        distance_valid=now["lasers_valid"],
        drive_ready=now["drive_runs"],
        actual_speed=now["drive_m_s"],
        speed_limit=0.5 if now["slow_load"] else 1.0,
        rope_offset=now["sling_m"],
    )


@pytest.fixture(scope="module")
def expected(bridge):
    """What the reference does."""
    shaper = CommandShaper(bridge[0])
    return [shaper.step(wired(signals(tick))) for tick in range(TICKS)]


def test_the_run_touches_what_it_is_to_show(expected):
    seen = 0
    for out in expected:
        seen |= out.status
    for bit in (
        *(Status.STEPPING, Status.DRIVE_NOT_READY, Status.QUICK_STOP, Status.SLOW_SWITCH),
        *(Status.STOP_SWITCH, Status.DISTANCE_INVALID, Status.ROPE_INVALID),
    ):
        assert seen & bit, bit
    assert max(out.reference for out in expected) > 0.2


def test_the_wiring_in_structured_text_gives_the_reference(bridge, expected):
    settings, origin = bridge
    (text,) = re.findall(r"```iecst\n(.*?)```", SECTION, re.DOTALL)
    (block,) = generate(settings, origin, "st")
    outer = load(block.text + text).instantiate()
    names = {"fast_forward_free": "FastForwardFree", "encoder_m": "Encoder", "encoder_m_s": "EncoderSpeed"}
    names |= {"sling_m": "Sling", "drive_m_s": "DriveSpeed", "joystick_m_s": "Joystick"}
    names |= {"laser_forward_m": "LaserForward", "laser_reverse_m": "LaserReverse"}
    for tick, want in enumerate(expected):
        now = {names.get(key, key.title().replace("_", "")): value for key, value in signals(tick).items()}
        out = outer.step(now)
        assert (out["SpeedReference"], out["StopsIn"]) == (want.reference, want.stop_distance), tick
        assert (out["Sway"], out["Fault"]) == (want.predicted_sway, want.error), tick
        assert out["Locked"] == bool(want.status & Status.COMMAND_LOCKED), tick
        assert not out["WrongProgram"]


MAIN = """
#include <stdio.h>
int main(void)
{
    bridge_signals_t signals;
    bool fault, locked;
    static const double rows[][19] = {
@ROWS@
    };
    unsigned tick;
    bridge_start();
    for (tick = 0u; tick < sizeof rows / sizeof rows[0]; ++tick) {
        const double *row = rows[tick];
@READ@
        const double reference = bridge_reference(&signals, &fault, &locked);
        printf("%.17g %d %d\\n", reference, (int)fault, (int)locked);
    }
    return 0;
}
"""


def test_the_wiring_in_c_gives_the_reference(bridge, expected, tmp_path):
    settings, origin = bridge
    for file in generate(settings, origin, "c"):
        (tmp_path / file.path).write_text(file.text)
    (wiring,) = re.findall(r"```c\n(.*?)```", SECTION, re.DOTALL)
    fields = list(signals(0))
    kinds = {float: "{}", int: "(uint8_t){}", bool: "{} != 0.0"}
    read = [
        f"        signals.{name} = {kinds[type(value)].format(f'row[{place}]')};"
        for place, (name, value) in enumerate(signals(0).items())
    ]
    rows = [
        f"        {{{', '.join(repr(float(signals(tick)[name])) for name in fields)}}},"
        for tick in range(TICKS)
    ]
    main = MAIN.replace("@ROWS@", "\n".join(rows)).replace("@READ@", "\n".join(read))
    (tmp_path / "main.c").write_text(wiring + main)
    program = tmp_path / "main.exe"
    sources = [tmp_path / "main.c", tmp_path / "two_axis_crane_bridge_shaper.c"]
    flags = ["-std=c99", "-ffp-contract=off", "-Wall", "-Wextra", "-Werror", "-o", program]
    subprocess.run([*find_compiler().command, *flags, *sources], check=True)
    printed = subprocess.run([program], capture_output=True, text=True, check=True).stdout.splitlines()
    found = [(float(a), b == "1", c == "1") for a, b, c in map(str.split, printed)]
    assert found == [(out.reference, out.error, bool(out.status & Status.COMMAND_LOCKED)) for out in expected]
