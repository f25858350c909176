"""The scenes of the timing diagrams of `block.md`: a machine, what is pressed when, and what is shown.

Not for: playing or drawing them (`block.py`, `block_drawing.py`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

MACHINE = """name = "yard"
[crane]
rope_length = [3, 9]
hoist_speed = 0.5
max_speed = 0.5
acceleration = 0.4
quick_stop = 0.8
[controller]
tick = 0.02
"""
ZVD = '[[row]]\nname = "zvd"\nfamily = "zvd"\nrope_length = 6\n'
ZV = '[[row]]\nname = "zv"\nfamily = "zv"\nrope_length = 6\n'
UM_ZV = '[[row]]\nname = "um-zv"\nfamily = "um-zv"\nrope_length = 6\n'
BANK = '[bank]\nselection = "rope_length"\ntolerance = 0.05\nlongest_duration = 4\nhysteresis = 0.2\n'
CONTACTOR = """name = "yard"
[crane]
rope_length = [3, 9]
max_speed = 0.5
[drive]
contactor = true
contactor_speeds = [0.1, 0.5]
[controller]
tick = 0.02
[[row]]
name = "um-zv"
family = "um-zv"
rope_length = 6
tolerance = 0.1
"""

TREMBLING = ((1, 0.03), (3, 0.3), (4, 0.32), (5, 0.29), (6, 0.31), (9, 0.7), (14, 0.0))

Change = tuple[float, Mapping[str, Any]]
"""From a time in s on, inputs have these values."""


@dataclass(frozen=True)
class Moment:
    """What the world around the block knows as a tick begins."""

    time_s: float
    position_m: float
    reference_m_s: float


@dataclass(frozen=True)
class Scene:
    """One diagram: a machine, what is pressed when, and what is shown.

    Parameters
    ----------
    title : str
        Of the figure.
    machine : str
        Machine file.
    changes : sequence of Change
        What is pressed when.
    last_s : float
        Length of the run.
    inputs : sequence of str
        Inputs shown as lanes.
    number : str
        Output, input or ``position`` shown below the speed; none if empty.
    lanes : sequence of str
        Outputs and status bits shown as lanes.
    world : callable
        Inputs that follow from where the crane is.
    """

    title: str
    machine: str
    changes: Sequence[Change]
    last_s: float
    inputs: Sequence[str]
    number: str
    lanes: Sequence[str]
    world: Callable[[Moment], Mapping[str, Any]] = field(default=lambda _: {})


def to_end(end_m: float) -> Callable[[Moment], Mapping[str, Any]]:
    """Measure the way to an end so far ahead; the other end is far."""
    return lambda moment: {"distance_forward": end_m - moment.position_m}


def stuck(from_s: float) -> Callable[[Moment], Mapping[str, Any]]:
    """Drive that follows, until it stays where it is."""
    return lambda moment: {"actual_speed": moment.reference_m_s if moment.time_s < from_s else 0.1}


def hoisted(moment: Moment) -> Mapping[str, Any]:
    """Rope from 8 to 4 m at 0.5 m/s, from 3 s on."""
    rope_m = min(8.0, max(4.0, 8.0 - 0.5 * (moment.time_s - 3.0)))
    return {"rope_length": rope_m, "hoist_speed": -0.5 if 4.0 < rope_m < 8.0 else 0.0}


def jump_of_the_end(at_s: float) -> Callable[[Moment], Mapping[str, Any]]:
    """Measure the way to an end at 8 m, and from a time on to one at 1.8 m."""
    return lambda moment: {"distance_forward": (8.0 if moment.time_s < at_s else 1.8) - moment.position_m}


def faulty_rope(moment: Moment) -> Mapping[str, Any]:
    """Rope that seems 2 m shorter for a while, and then seems to stand while the hoist moves."""
    jumps, hoists = 3.0 <= moment.time_s < 5.0, 8.0 <= moment.time_s < 11.0
    return {"rope_length": 4.0 if jumps else 6.0, "hoist_speed": -0.2 if hoists else 0.0}


def press(from_s: float, to_s: float, speed: float = 0.5) -> list[Change]:
    """Hold a command."""
    return [(from_s, {"command": speed}), (to_s, {"command": 0.0})]


def pulse(name: str, from_s: float, to_s: float) -> list[Change]:
    """Hold an input TRUE."""
    return [(from_s, {name: True}), (to_s, {name: False})]


def ordered(*parts: Sequence[Change]) -> list[Change]:
    """Put changes into the order of time."""
    return sorted((change for part in parts for change in part), key=lambda change: change[0])


SCENES: Mapping[str, Scene] = {
    "press": Scene(
        "A press and its release",
        MACHINE + ZVD,
        press(1, 8),
        16,
        (),
        "stop_distance",
        ("settled", "active"),
    ),
    "waits": Scene(
        "A short jog in a row with negative amplitudes",
        MACHINE + UM_ZV,
        press(1, 1.2),
        8,
        (),
        "stop_distance",
        ("settled", "COMMAND_WAITS"),
    ),
    "knob": Scene(
        "The knob and enable on the way",
        MACHINE + ZVD + ZV,
        ordered(press(1, 8), [(3, {"selector": 2}), (14, {"enable": False})]),
        18,
        ("selector", "enable"),
        "",
        ("row", "ROW_WAITS", "settled", "DISABLED", "UNSHAPED"),
    ),
    "quick-stop": Scene(
        "Quick stop",
        MACHINE + ZVD,
        ordered(press(1, 10), pulse("quick_stop", 6, 6.3), press(11, 13)),
        21,
        ("quick_stop",),
        "stop_distance",
        ("QUICK_STOP", "active"),
    ),
    "emergency-stop": Scene(
        "Emergency stop",
        MACHINE + ZVD,
        ordered(press(1, 9), pulse("emergency_stop", 6, 7), press(10, 13)),
        22,
        ("emergency_stop",),
        "stop_distance",
        ("EMERGENCY_STOP", "active"),
    ),
    "bad-command": Scene(
        "A command that is not a number",
        MACHINE + ZVD,
        [
            (1, {"command": 0.5}),
            (4, {"command": math.nan}),
            (5, {"command": 0.5}),
            (9, {"command": 0.0}),
            (11, {"command": 0.25}),
            (14, {"command": 0.0}),
        ],
        20,
        (),
        "",
        ("COMMAND_INVALID", "error"),
    ),
    "inching": Scene(
        "Inching: below inching_speed, from rest",
        MACHINE + "[drive]\ninching_speed = 0.1\n" + ZVD,
        ordered(press(1, 3, 0.08), [(6, {"command": 0.08}), (7.5, {"command": 0.5}), (15, {"command": 0.0})]),
        22,
        (),
        "",
        ("INCHING", "settled", "COMMAND_WAITS"),
    ),
    "start-from-zero": Scene(
        "Power-on with a button held",
        MACHINE + "start_from_zero = true\n" + ZVD,
        [(0, {"command": 0.5}), (3, {"command": 0.0}), (4, {"command": 0.5}), (8, {"command": 0.0})],
        15,
        (),
        "",
        ("COMMAND_LOCKED",),
    ),
    "steps": Scene(
        "Three presses of 0.25 m, one back, and what is refused",
        MACHINE + "[steps]\nsizes = [0.05, 0.1, 0.25]\nspeed = 0.3\n" + ZVD,
        ordered(
            [(0, {"step_size": 3})],
            *(pulse("step_forward", at, at + 0.3) for at in (1, 2, 3)),
            pulse("step_reverse", 13, 13.3),
            press(14, 15.5),
            press(23, 25, 0.3),
            pulse("step_forward", 24, 24.5),
        ),
        32,
        ("step_forward", "step_reverse", "step_size"),
        "position",
        ("STEPPING", "STEP_REFUSED", "COMMAND_LOCKED"),
    ),
    "stop-switch": Scene(
        "A stop switch on the way",
        MACHINE + "[limits]\nstop_switches = true\n" + ZVD,
        ordered(
            pulse("stop_forward", 6, 19),
            [
                (1, {"command": 0.5}),
                (9, {"command": 0.0}),
                (10, {"command": 0.5}),
                (11, {"command": 0.0}),
                (12, {"command": -0.5}),
                (20, {"command": 0.0}),
            ],
        ),
        27,
        ("stop_forward",),
        "position",
        ("STOP_SWITCH", "QUICK_STOP", "COMMAND_LOCKED"),
    ),
    "slow-switch": Scene(
        "A slow-down switch",
        MACHINE + "[limits]\nslow_speed = 0.1\n" + ZVD,
        ordered(pulse("slow_forward", 7, 16), press(1, 19)),
        27,
        ("slow_forward",),
        "stop_distance",
        ("SLOW_SWITCH",),
    ),
    "distances": Scene(
        "The way to the end is measured: 5 m, margin 0.3 m; invalid from 7 s to 9 s",
        MACHINE + "[limits]\nmargin = 0.3\n" + ZVD,
        [
            (1, {"command": 0.5}),
            (7, {"distance_valid": False}),
            (9, {"distance_valid": True}),
            (20, {"command": 0.0}),
        ],
        22,
        ("distance_valid",),
        "distance_forward",
        ("WAY_LIMITS", "DISTANCE_INVALID"),
        to_end(5.0),
    ),
    "drive": Scene(
        "The drive trips, and comes back at 0.3 m/s",
        MACHINE + "[drive]\nfeedback = true\n" + ZVD,
        [
            (0.5, {"command": 0.5}),
            (6, {"drive_ready": False, "actual_speed": 0.3}),
            (7, {"drive_ready": True}),
            (9, {"command": 0.0}),
            (10, {"command": 0.5}),
            (13, {"command": 0.0}),
        ],
        20,
        ("drive_ready",),
        "",
        ("DRIVE_NOT_READY", "QUICK_STOP", "active"),
    ),
    "contactor": Scene(
        "A pendant with two speeds on contactors",
        CONTACTOR,
        [(1, {"command": 0.1}), (2, {"command": 0.5}), (7, {"command": 0.3}), (10, {"command": 0.0})],
        14,
        (),
        "stop_distance",
        ("settled", "COMMAND_WAITS"),
    ),
    "speed-limit": Scene(
        "The speed limit is lowered on the way, and then set to a value that it cannot have",
        MACHINE + "[tuning]\nspeed_limit = true\n" + ZVD,
        ordered(press(1, 18), [(6, {"speed_limit": 0.2}), (12, {"speed_limit": 0.9})]),
        25,
        (),
        "speed_limit",
        ("SPEED_LIMIT_INVALID", "error"),
    ),
    "hoisting": Scene(
        'Hoisting while travelling under law = "phase"; the encoder fails from 13 s to 15 s',
        MACHINE + 'law = "phase"\n[[row]]\nname = "zvd"\nfamily = "zvd"\n',
        ordered(press(1, 12), [(13, {"rope_length_valid": False}), (15, {"rope_length_valid": True})]),
        19,
        ("rope_length_valid",),
        "rope_length",
        ("settled", "ROPE_INVALID", "error"),
        hoisted,
    ),
    "rows-by-rope": Scene(
        "The measured rope chooses the row, and the residual bound is that of the rope of now",
        MACHINE + "residual_bound_at_rope = true\n" + BANK,
        press(1, 9),
        18,
        (),
        "residual_bound",
        ("row", "ROW_WAITS", "settled"),
        hoisted,
    ),
    "small-commands": Scene(
        "A minimum of 0.05 m/s, a resolution of 0.05 m/s, and the maximum",
        MACHINE + "[drive]\nminimum_speed = 0.05\ncommand_resolution = 0.05\n" + ZVD,
        [(at, {"command": speed}) for at, speed in TREMBLING],
        24,
        (),
        "",
        ("BELOW_MINIMUM", "COMMAND_CLAMPED", "settled"),
    ),
    "too-short": Scene(
        "The measured way gets 6.2 m shorter at 6 s: too short to stop in",
        MACHINE + "[limits]\nmargin = 0.1\n" + ZVD,
        press(1, 14),
        16,
        (),
        "distance_forward",
        ("WAY_LIMITS", "WAY_TOO_SHORT", "error"),
        jump_of_the_end(6.0),
    ),
    "rope-faults": Scene(
        "A length that jumps from 3 s to 5 s, and one that stands while the hoist moves, from 8 s on",
        MACHINE + 'law = "phase"\n[[row]]\nname = "zvd"\nfamily = "zvd"\n',
        press(1, 12),
        19,
        (),
        "rope_length",
        ("ROPE_JUMP", "ROPE_FROZEN", "error"),
        faulty_rope,
    ),
    "tracking": Scene(
        "A drive that stays at 0.1 m/s from 5 s on; tolerance 0.05 m/s for 0.5 s",
        MACHINE + "[drive]\ntracking_tolerance = 0.05\n" + ZVD,
        press(1, 11),
        18,
        (),
        "actual_speed",
        ("TRACKING", "error"),
        stuck(5.0),
    ),
    "sway": Scene(
        "Predicted sway, shaped and then unshaped",
        MACHINE + "predicted_sway = true\n" + ZVD,
        ordered(
            press(1, 5),
            [(14, {"selector": 0})],
            press(15, 19),
        ),
        30,
        ("selector",),
        "predicted_sway",
        ("UNSHAPED",),
    ),
}
