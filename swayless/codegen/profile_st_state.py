"""Variables of the motion profile in Structured Text. Not for: pins, constants and tables; C has them too."""

from __future__ import annotations

from swayless.codegen.st_types import Variable

ST_VARIABLES = (
    Variable("Executed", "bool", "Execute of the call before", st_reset="FALSE"),
    Variable("Placed", "bool", "a move was accepted: Start no longer matters at rest", st_reset="FALSE"),
    Variable("Playing", "bool", "a move or a stop plays", st_reset="FALSE"),
    Variable("Aborting", "bool", "Abort was TRUE: what plays ends as aborted", st_reset="FALSE"),
    Variable("HasArrived", "bool", "as the output Done", st_reset="FALSE"),
    Variable("HasStopped", "bool", "as the output Aborted", st_reset="FALSE"),
    Variable("Piece", "word", "of the move or the stop, that plays next", st_reset="0"),
    Variable("PieceTick", "word", "ticks of it that have played", st_reset="0"),
    Variable("Refused", "word", "status bits of the last refusal", st_reset="0"),
    Variable(
        "HeldPosition", "real", "where the plant rests, or will after the stop", st_reset="FirstPosition"
    ),
    Variable("MoveStart", "real", "of the move that plays", st_reset="0.0"),
    Variable("MoveTarget", "real", "of the same", st_reset="0.0"),
    Variable("Travel", "real", "of the same", st_reset="0.0"),
    Variable("WasPlaying", "bool", "Playing when this call began"),
    Variable("Bits", "word", "status of this call"),
    Variable("Rises", "bool", "Execute rises in this call"),
    Variable("InRange", "bool", "intermediate result of one call"),
    Variable("AtRest", "real", "reference that holds Start"),
    Variable("Local", "real", "variable of a piece's polynomial, -1 to 1"),
    Variable("Distance", "real", "Target less Start"),
    Variable("Sum", "real", "sum of products, and the shape"),
    Variable("Term", "word", "loop"),
    Variable("Row", "word", "loop"),
    Variable("Column", "word", "loop"),
)
"""Variables; their type is a kind of `StTypes.type_of`."""

ST_STOP_VARIABLES = (
    Variable("StopPlays", "bool", "a stop plays", st_reset="FALSE"),
    Variable("MoveTick", "word", "ticks of the move that have played", st_reset="0"),
    Variable(
        "StopRange", "word", "range of its ticks in which a stop may begin, that is not over", st_reset="0"
    ),
    Variable("GainRow", "word", "row of gains"),
)
"""More of them, where a stop can be sooner than the end of the move."""

ST_ARRAYS = (
    Variable("Plant", "real", "states of the plant in a move by 1, and the shape of the last tick"),
    Variable("Results", "real", "change of each state, and the position, in this tick"),
)
"""Arrays, one cell longer than the plant has states."""

ST_STOP_ARRAYS = (Variable("StopFrom", "real", "states and shape when the stop began"),)
"""The same, for stops."""

ST_TERMS = Variable("StopTerms", "real", "coefficients of the piece of the stop that plays")
"""An array that only stops in pieces have."""
