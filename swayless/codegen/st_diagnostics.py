"""What a Structured Text block declares to say something of itself. Not for: what it says."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import chain
from typing import Any

from swayless.codegen.st_types import Constant, RealConstant, StTypes, Table, st_table
from swayless.controller.rope_bound import RopeBounds
from swayless.controller.settings import ShaperSettings
from swayless.controller.sway import SwaySettings

ZERO = "0.0"

DIAGNOSTIC_STATE = (
    ("bool", "TablesMatch", "the tables are those of the design", "FALSE", "facts"),
    ("real", "SwayPace", "[{units}] speed of the load against the trolley", ZERO, "sway"),
    ("real", "SwayPlace", "[{units}] its place times the frequency", ZERO, "sway"),
    ("real", "SwayReference", "[{units}] reference of the last call", ZERO, "sway"),
    ("row", "SwayRow", "row whose mode the load swings in", "1", "sway rows"),
    ("real", "SwayQuanta", "[quanta] phase of a tick that the turn below is of", ZERO, "sway rope"),
    ("real", "SwayInverse", "1 / SwayQuanta", ZERO, "sway rope"),
    ("real", "TurnCosine", "cosine of the turn of a tick, less what damping takes", ZERO, "sway rope"),
    ("real", "TurnSine", "its sine, likewise", ZERO, "sway rope"),
    ("real", "TurnMetres", "[m] deflection for a place of 1", ZERO, "sway rope"),
    ("real", "LowReference", "[{units}] least reference of the window that fills", ZERO, "tracking"),
    ("real", "HighReference", "[{units}] its largest", ZERO, "tracking"),
    ("real", "LastLow", "[{units}] least reference of the last full window", ZERO, "tracking"),
    ("real", "LastHigh", "[{units}] its largest", ZERO, "tracking"),
    ("word", "WindowTicks", "ticks of the window that fills", "0", "tracking"),
    ("word", "OutsideTicks", "ticks for which the drive has not followed", "0", "tracking"),
)
"""Kind, name, comment, value after power-on, and the part of the law that needs each."""

DIAGNOSTIC_SCRATCH = (
    ("word", "BitsBefore", "status bits before those of the rope", "bounds"),
    ("bool", "RopeKnown", "the rope length in use is the one that hangs there", "bounds"),
    ("real", "BoundNow", "residual vibration that is left at most", "bounds"),
    ("word", "FirstPiece", "first piece of the row in the tables of bounds", "bounds"),
    ("word", "PieceCount", "its pieces", "bounds"),
    ("real", "SwayStep", "[{units}] step of the reference", "sway"),
    ("real", "PaceBefore", "[{units}] SwayPace after that step", "sway"),
    ("real", "TurnCosine", "cosine of the turn of a tick, less what damping takes", "sway rows"),
    ("real", "TurnSine", "its sine, likewise", "sway rows"),
    ("real", "TurnMetres", "[m] deflection for a place of 1", "sway rows"),
    ("real", "Shorter", "new phase of a tick over the old one", "sway rope"),
    ("real", "Longer", "[quanta] the old one", "sway rope"),
    ("real", "Turn", "[rad] turn of a tick", "sway rope"),
    ("real", "TurnSquare", "its square", "sway rope"),
    ("real", "Kept", "what a turn keeps of the swing", "sway rope"),
    ("real", "RangeLow", "[{units}] least reference of both windows", "tracking"),
    ("real", "RangeHigh", "[{units}] their largest", "tracking"),
    ("bool", "Follows", "the drive is within the range of references", "tracking"),
    ("word", "FirstSum", "checksum of the tables: sum of the digits", "facts"),
    ("word", "SecondSum", "sum of all first sums", "facts"),
    ("word", "Digit", "digit to the base 65536", "facts"),
    ("word", "DigitCount", "digits of the number", "facts"),
    ("word", "DigitUnit", "size of the digit of a whole number", "facts"),
    ("word", "Whole", "a whole number, or what is left of it", "facts"),
    ("real", "Number", "a real, or what is left of it", "facts"),
    ("real", "NumberLimit", "power of two above every real of the table", "facts"),
    ("real", "PerNumberLimit", "1 / NumberLimit", "facts"),
    ("real", "LeastDigit", "size of the last digit", "facts"),
    ("bool", "IsReal", "the table is one of reals", "facts"),
    ("bool", "Fits", "the real may be one of its table", "facts"),
)
"""Kind, name, comment, and the part of the law that needs each."""


def diagnostic_constants(settings: ShaperSettings, types: StTypes) -> list[Constant]:
    """List the constants of the diagnostics; nothing where there are none.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    types : StTypes
        Its types.
    """
    asked, units, found = settings.diagnostics, settings.limits.units, []
    if asked.sway is not None:
        found += types.constants(_of_sway(asked.sway, units))
        if asked.sway.rope is not None and settings.clock is None:
            found += table_constants(asked.sway.rope.clock.nodes, asked.sway.rope.clock.cells_per_unit, types)
    if asked.tracking is not None:
        tolerance = (
            "TrackingTolerance",
            asked.tracking.tolerance,
            f"[{units}] allowed beside the references",
        )
        window = "[ticks] references of at least so many count as followed"
        found += [
            *types.constants([tolerance]),
            Constant("TrackingTicks", "DINT", str(asked.tracking.time_ticks), "[ticks] outside is allowed"),
            Constant("TrackingWindow", "DINT", str(asked.tracking.window_ticks), window),
        ]
    if asked.facts is not None:
        number = str(signed_word(asked.facts.design_id))
        found.append(Constant("DesignNumber", "DINT", number, "CRC-32 of the design file, its 32 bits"))
    return found


def table_constants(nodes: tuple[int, ...], cells_per_metre: Any, types: StTypes) -> list[Constant]:
    """List the constants of the table of phases over the rope length.

    Parameters
    ----------
    nodes : tuple of int
        The table.
    cells_per_metre : float
        Cells of it in a metre.
    types : StTypes
        Types of the block.
    """
    last = Constant("LastTableCell", "DINT", str(len(nodes) - 2), "last cell of the phase table")
    per_metre: RealConstant = ("CellsPerMetre", cells_per_metre, "[1/m] cells of the phase table")
    return [last, *types.constants([per_metre])]


def signed_word(bits: int) -> int:
    """Give 32 bits as a whole number with a sign.

    Examples
    --------
    >>> signed_word(7), signed_word(0xFFFF_FFFE)
    (7, -2)
    """
    return bits - (1 << 32) if bits >= 1 << 31 else bits


def _of_sway(sway: SwaySettings, units: str) -> list[RealConstant]:
    reals: list[RealConstant] = [
        ("LargestSwing", sway.largest, f"[{units}] where the model of the load ends"),
        ("ForgottenSwing", sway.forgotten, f"[{units}] a smaller swing at a steady reference is none"),
    ]
    if sway.rope is None:
        return reals
    return [
        *reals,
        ("SwayQuantum", sway.rope.quantum, "[rad] turn of a quantum"),
        ("SwayHeld", sway.held, "kept of a turn without damping"),
        ("SwayLoss", sway.rope.loss, "[1/rad] lost by damping"),
        ("SwayMetres", sway.rope.metres, "[m] deflection for a place of 1, times quanta of a tick"),
        ("OneSixth", 1.0 / 6.0, "of the series of the sine"),
        ("OneTwelfth", 1.0 / 12.0, "of the series of the cosine"),
    ]


def bound_strides(bounds: RopeBounds) -> list[int]:
    """List the steps of the look-up of a bound: powers of two, falling to 1; at least two.

    Parameters
    ----------
    bounds : RopeBounds
        Bounds of every row.
    """
    most = max(len(row) for row in bounds.starts)
    return [1 << power for power in reversed(range(max((most - 1).bit_length(), 2)))]


def diagnostic_tables(settings: ShaperSettings, types: StTypes) -> list[Table]:
    """List the tables of the diagnostics; nothing where there are none.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    types : StTypes
        Its types.
    """
    bounds, sway, tables = settings.diagnostics.rope_bounds, settings.diagnostics.sway, []

    def reals(name: str, rows: Iterable[Iterable[Any]], doc: str) -> Table:
        return st_table(name, types.real, [[types.literal(each) for each in row] for row in rows], doc)

    if bounds is not None:
        counts = [[str(len(row)) for row in bounds.starts]]
        steps = [[str(stride) for stride in bound_strides(bounds)]]
        tables += [
            st_table("BoundCounts", "DINT", counts, "Pieces of the rope's range, of rows 1 and on."),
            reals("BoundStarts", bounds.starts, "[m] Rope length at which each piece begins, by row."),
            reals("RopeBounds", bounds.bounds, "Residual vibration at most on each piece, by row."),
            st_table("BoundStrides", "DINT", steps, "Steps of the look-up in the tables above."),
        ]
    if sway is not None and sway.rope is None:
        cosines, sines, metres = zip(*sway.turns, strict=True)
        tables += [
            reals("TurnCosines", [cosines], "Cosine of the turn of a tick, of the mode of rows 1 and on."),
            reals("TurnSines", [sines], "Sine of the same."),
            reals("TurnDeflections", [metres], "[m] Deflection for a place of 1."),
        ]
    elif sway is not None and sway.rope is not None and settings.clock is None:
        nodes = list(chain(sway.rope.clock.nodes))
        tables.append(reals("PhaseTable", [nodes], "[quanta] Phase of a tick over the rope length."))
    return tables
