"""The pins of the motion profile block, for C and Structured Text alike. Not for: what they do inside."""

from __future__ import annotations

from swayless.codegen.pin import pin

INPUTS = (
    pin("execute", "bool", "its rising edge starts a move; ignored while one runs"),
    pin("abort", "bool", "true in any tick of a move: it is brought to rest; while true none starts"),
    pin("start", "real", "where the move starts; before the first move the block holds there"),
    pin("target", "real", "where it ends; read, as start is, when execute rises"),
)
"""Pins that the block reads."""

OUTPUTS = (
    pin("reference", "real", "for the drive, in units of the plant's input"),
    pin("position", "real", "where the plant is now, by its model: the reference of a feedback"),
    pin("busy", "bool", "a move or a stop plays"),
    pin("done", "bool", "the target is reached; true while execute is, and for one tick at least"),
    pin("aborted", "bool", "it rests after an abort; true as long as done would be"),
    pin("status", "word", "sum of the status bits"),
)
"""Pins that it writes."""
