"""The status word: one bit for each reason why a block is not active or not exact.

The reference, the C header, the ST comment and the documentation all read this one table.
"""

from __future__ import annotations

from enum import IntFlag


class Status(IntFlag):
    """Bits of the status word; :func:`explain` says what each means."""

    DISABLED = 1 << 0
    UNSHAPED = 1 << 1
    ROW_WAITS = 1 << 2
    COMMAND_WAITS = 1 << 3
    COMMAND_CLAMPED = 1 << 4
    COMMAND_INVALID = 1 << 5
    SELECTOR_INVALID = 1 << 6
    QUICK_STOP = 1 << 7
    EMERGENCY_STOP = 1 << 8
    BELOW_MINIMUM = 1 << 9
    INCHING = 1 << 10
    ROPE_INVALID = 1 << 11
    ROPE_OUT_OF_RANGE = 1 << 12
    ROPE_JUMP = 1 << 13
    ROPE_FROZEN = 1 << 14
    HOIST_SPEED_INVALID = 1 << 15
    STEPPING = 1 << 16
    STEP_REFUSED = 1 << 17
    STEP_SIZE_INVALID = 1 << 18
    COMMAND_LOCKED = 1 << 19
    STOP_SWITCH = 1 << 20
    SLOW_SWITCH = 1 << 21
    WAY_LIMITS = 1 << 22
    WAY_TOO_SHORT = 1 << 23
    DISTANCE_INVALID = 1 << 24
    DRIVE_NOT_READY = 1 << 25
    SPEED_LIMIT_INVALID = 1 << 26
    ROPE_OFFSET_INVALID = 1 << 27
    TRACKING = 1 << 28
    TABLES_INVALID = 1 << 29


_MEANINGS: dict[Status, str] = {
    Status.DISABLED: "enable is false: row 0 (ramped, unshaped) is wanted",
    Status.UNSHAPED: "row 0 is in use: the command is ramped, not shaped",
    Status.ROW_WAITS: "another row is wanted; it takes over when the block has settled",
    Status.COMMAND_WAITS: "a new command waits until the block has settled",
    Status.COMMAND_CLAMPED: "the command is beyond the maximum and was clamped to it",
    Status.COMMAND_INVALID: "a command was not finite: counted as 0 until a finite 0 is commanded",
    Status.SELECTOR_INVALID: "the selector names no row: the last valid one is kept",
    Status.QUICK_STOP: "quick stop is latched until released, at rest, and the command is 0",
    Status.EMERGENCY_STOP: "emergency stop is latched until released and the command is 0",
    Status.BELOW_MINIMUM: "the command is below the minimum and counts as 0",
    Status.INCHING: "inching: a small command from rest passes unshaped",
    Status.ROPE_INVALID: "the rope length is not valid or not finite: the last one holds",
    Status.ROPE_OUT_OF_RANGE: "the rope length is out of range and was clamped to it",
    Status.ROPE_JUMP: "the rope length is farther off than the hoist could move: the last one holds",
    Status.ROPE_FROZEN: "the hoist moves and the rope length does not: one of them is wrong",
    Status.HOIST_SPEED_INVALID: "the hoist speed is not finite and counts as 0",
    Status.STEPPING: "steps run: the row is locked and velocity commands do nothing",
    Status.STEP_REFUSED: "a step was pressed and does not count: not at rest, a command, a stop, or too many",
    Status.STEP_SIZE_INVALID: "a step was pressed with a size that is not 1 to 3: refused",
    Status.COMMAND_LOCKED: "a command does nothing until it has been 0",
    Status.STOP_SWITCH: "a stop switch is made: commands and steps towards it count as 0",
    Status.SLOW_SWITCH: "a slow switch is made: the command towards it is limited to the slow speed",
    Status.WAY_LIMITS: "the way left to the end of travel limits the speed",
    Status.WAY_TOO_SHORT: "the way left to the end of travel is too short to stop in by the ramp",
    Status.DISTANCE_INVALID: "a distance is not valid or not finite: the last one less the way since holds",
    Status.DRIVE_NOT_READY: "the drive is not ready: the reference is 0",
    Status.SPEED_LIMIT_INVALID: "the speed limit is not from 0 to the maximum and was clamped",
    Status.ROPE_OFFSET_INVALID: "the rope offset is out of its range and was clamped, or not finite: 0",
    Status.TRACKING: "the drive does not follow the reference",
    Status.TABLES_INVALID: "the tables of the block are not those of its design: the reference stays 0",
}

ROPE_BITS = (
    Status.ROPE_INVALID
    | Status.ROPE_OUT_OF_RANGE
    | Status.ROPE_JUMP
    | Status.ROPE_FROZEN
    | Status.HOIST_SPEED_INVALID
)
"""Bits that only a block with a measured rope has."""

OPTIONAL_BITS = (
    Status.STEPPING
    | Status.STEP_REFUSED
    | Status.STEP_SIZE_INVALID
    | Status.COMMAND_LOCKED
    | Status.STOP_SWITCH
    | Status.SLOW_SWITCH
    | Status.WAY_LIMITS
    | Status.WAY_TOO_SHORT
    | Status.DISTANCE_INVALID
    | Status.DRIVE_NOT_READY
    | Status.SPEED_LIMIT_INVALID
    | Status.ROPE_OFFSET_INVALID
    | Status.TRACKING
    | Status.TABLES_INVALID
)
"""Bits that only a block with the function of their name has."""

ERROR_BITS = (
    Status.COMMAND_INVALID
    | Status.SELECTOR_INVALID
    | Status.ROPE_INVALID
    | Status.ROPE_JUMP
    | Status.ROPE_FROZEN
    | Status.HOIST_SPEED_INVALID
    | Status.STEP_SIZE_INVALID
    | Status.WAY_TOO_SHORT
    | Status.DISTANCE_INVALID
    | Status.SPEED_LIMIT_INVALID
    | Status.ROPE_OFFSET_INVALID
    | Status.TRACKING
    | Status.TABLES_INVALID
)
"""Bits that also raise the `error` output: an input that cannot be right."""


def explain(bit: Status) -> str:
    """Say what one status bit means, in one line.

    Examples
    --------
    >>> explain(Status.UNSHAPED)
    'row 0 is in use: the command is ramped, not shaped'
    """
    return _MEANINGS[bit]
