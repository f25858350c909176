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
}

ROPE_BITS = (
    Status.ROPE_INVALID
    | Status.ROPE_OUT_OF_RANGE
    | Status.ROPE_JUMP
    | Status.ROPE_FROZEN
    | Status.HOIST_SPEED_INVALID
)
"""Bits that only a block with a measured rope has."""

ERROR_BITS = (
    Status.COMMAND_INVALID
    | Status.SELECTOR_INVALID
    | Status.ROPE_INVALID
    | Status.ROPE_JUMP
    | Status.ROPE_FROZEN
    | Status.HOIST_SPEED_INVALID
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
