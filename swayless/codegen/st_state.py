"""What lives in a Structured Text block from call to call. Not for: results on the way, see `st_scratch`."""

from __future__ import annotations

from swayless.codegen.st_parts import parts_in_use
from swayless.codegen.st_rope import of_measured
from swayless.codegen.st_spacing import spacing_arrays, spacing_variables
from swayless.codegen.st_types import StTypes, Variable
from swayless.controller.phase_clock import PhaseClock
from swayless.controller.phase_filter import last_cell
from swayless.controller.settings import ShaperSettings

ZERO, FALSE = "0.0", "FALSE"

STATE = (
    ("real", "Base", "command of the last rest", ZERO, "all"),
    ("real", "Target", "target of the ramp", ZERO, "all"),
    ("real", "Ramped", "ramped command", ZERO, "all"),
    ("real", "ReferenceNow", "reference, also while a call works on it", ZERO, "all"),
    ("real", "Pending", "sum of the references still to come", ZERO, "fixed"),
    ("real", "Fresh", "the same from the commands of this lap alone", ZERO, "fixed"),
    ("word", "Head", "cell of the newest command", "LastTicks", "ticks"),
    ("word", "StillTicks", "ticks without change, up to the longest delay", "LastTicks", "ticks"),
    ("word", "Head", "cell of the newest change", "LastCell", "phase"),
    ("word", "StillQuanta", "phase without change, up to the largest lag", "LastQuanta", "phase"),
    ("row", "ActiveRow", "row in use", "0", "all"),
    ("row", "SelectedRow", "last valid selector", "0", "all"),
    ("row", "WantedRow", "row that takes over when settled", "0", "all"),
    ("bool", "Lapped", "the ring is full of commands since the last rest", FALSE, "ticks"),
    ("bool", "InvalidLatched", "a command was not finite", FALSE, "all"),
    ("bool", "QuickLatched", "quick stop is latched", FALSE, "all"),
    ("bool", "EmergencyLatched", "emergency stop is latched", FALSE, "all"),
    ("real", "HeldCommand", "command held until it changes by the resolution", ZERO, "resolution"),
    ("bool", "InchingNow", "a small command passes unshaped", FALSE, "inching"),
    ("real", "RopeNow", "[m] rope length taken last", "LongestRope", "rope"),
    ("word", "HeldTicks", "ticks for which it has been held", "0", "rope"),
    ("real", "UnmovedWay", "[m] way that the hoist says it went without a change of it", ZERO, "rope"),
    ("row", "RopeRow", "row of the rope", "1", "rope rows"),
    ("real", "LapSum", "sum of the commands of the last full lap", ZERO, "spacing"),
    ("word", "StartSpacing", "[ticks] spacing until the last rest ended", "0", "spacing"),
    ("word", "PartCell", "cell of the parts of this call", "0", "original"),
    ("word", "Age", "calls since the last rest, up to the longest delay", "0", "original"),
    ("word", "RunNumber", "run since the last rest; never reset: older ones do not count", "", "original"),
    ("bool", "Running", "changes are under way", FALSE, "phase"),
    ("real", "Shaped", "command that the taps have taken in", ZERO, "phase"),
    ("real", "Level", "sum of all releases: the reference", ZERO, "phase"),
    ("real", "Late", "what the last call left for this one", ZERO, "phase"),
    ("real", "Mass", "sum of the parts under way", ZERO, "phase"),
    ("real", "FreshMass", "the same from the changes of this lap alone", ZERO, "phase"),
    ("real", "Moment", "sum of the parts under way times phase to go", ZERO, "phase"),
    ("real", "FreshMoment", "Moment from the changes of this lap alone", ZERO, "phase"),
    ("real", "Answered", "[m/s] hoist speed whose kick is undone", ZERO, "phase"),
    ("real", "SwingPlace", "swing that is run beside the reference: place times frequency", ZERO, "phase"),
    ("real", "SwingPace", "its speed", ZERO, "phase"),
)
"""Kind, name, comment, value after power-on, and the part of the law that needs each."""


def state_of(settings: ShaperSettings, types: StTypes) -> list[Variable]:
    """List what lives from call to call.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    types : StTypes
        Its types.
    """
    used = parts_in_use(settings)
    chosen = [
        Variable(name, types.type_of(kind), doc, st_reset=reset)
        for kind, name, doc, reset, part in STATE
        if part in used
    ]
    scalars = of_measured(settings, chosen)
    if settings.clock is not None:
        return [*_phase_arrays(settings, types), *scalars, *_phase_reading(settings.clock, types)]
    ring = types.array_of("real", settings.longest_delay_ticks)
    commands = Variable("Ring", ring, "last ramped commands")
    if not settings.is_spaced:
        return [commands, *scalars]
    return [*spacing_arrays(settings, types, commands), *scalars, *spacing_variables(settings)]


def _phase_arrays(settings: ShaperSettings, types: StTypes) -> list[Variable]:
    """List the ring of the phase clock, and the pointers of its taps."""
    last = last_cell(settings)
    most_taps = max(len(table.lags) for table in settings.row_tables)
    parts = types.array_of("real", (most_taps - 1) * (last + 1) - 1)
    return [
        Variable("Parts", parts, "ring for each later tap: what it releases of each change"),
        Variable("Gaps", types.array_of("word", last), "[quanta] ring: phase until the next change"),
        Variable("Foreseen", parts, "ring for each later tap: 1 / quanta of the tick that is to release it"),
        Variable("TapCells", types.array_of("word", most_taps - 1), "cell that each tap reaches next"),
        Variable("TapAhead", types.array_of("word", most_taps - 1), "[quanta] phase until then"),
    ]


def _phase_reading(clock: PhaseClock, types: StTypes) -> list[Variable]:
    """List what is read off the phase table: after power-on of the longest rope."""
    quanta = types.number.scalar(clock.fewest_quanta)
    inverse = types.number.scalar(1) / quanta
    return [
        Variable("Quanta", "DINT", "phase of this tick", st_reset=str(clock.fewest_quanta)),
        Variable("QuantaReal", types.real, "the same as a real", st_reset=types.literal(quanta)),
        Variable("InverseQuanta", types.real, "1 / QuantaReal", st_reset=types.literal(inverse)),
    ]
