"""What a Structured Text block computes on its way through one call. Not for: what lives longer."""

from __future__ import annotations

from swayless.codegen.st_parts import parts_in_use
from swayless.codegen.st_rope import of_measured
from swayless.codegen.st_types import StTypes, Variable
from swayless.controller.settings import ShaperSettings

SCRATCH = (
    ("real", "Accepted", "checked command", "all"),
    ("real", "Goal", "command that the row in use lets pass", "all"),
    ("real", "Before", "ramped command of the last call", "all"),
    ("real", "Reach", "command or reference one tick on", "all"),
    ("real", "Lowest", "least that the reference can be but for rounding", "fixed"),
    ("real", "Highest", "most that the reference can be but for rounding", "fixed"),
    ("real", "LapSum", "part of the reference from this lap", "fixed"),
    ("real", "Start", "command from which the stop ramp starts", "all"),
    ("real", "RampStep", "step of a ramp", "all"),
    ("real", "StepsPerUnit", "1 / RampStep", "all"),
    ("real", "Anchor", "ramp anchor with the sign of the command", "anchor"),
    ("real", "Steps", "the same as a real", "all"),
    ("real", "DownSum", "sum of the commands of the stop ramp", "all"),
    ("real", "StopSum", "sum of the references to come", "all"),
    ("word", "WholeSteps", "whole steps of a ramp before its last", "all"),
    ("word", "DownTicks", "ticks of the stop ramp", "all"),
    ("word", "StopTicks", "ticks until the reference is 0", "all"),
    ("row", "RestRow", "row at the end of the stop", "all"),
    ("word", "FirstTap", "first tap of the row", "all"),
    ("word", "TapCount", "taps of the row", "all"),
    ("word", "Tap", "tap", "all"),
    ("word", "Delay", "its delay", "ticks"),
    ("word", "i", "counter", "all"),
    ("word", "Bits", "status bits of this call", "all"),
    ("bool", "Faulty", "an input of this call cannot be right", "all"),
    ("bool", "Valid", "the command is finite", "all"),
    ("bool", "Landed", "a ramp has landed", "all"),
    ("bool", "InRange", "the command is within the maximum", "all"),
    ("bool", "ZeroCommanded", "the command is a valid 0", "all"),
    ("bool", "Stopped", "a stop is latched", "all"),
    ("bool", "IsSettled", "nothing is pending", "all"),
    ("real", "RiseSum", "sum of the commands of the ramp to the target", "waiting"),
    ("real", "SettledSum", "sum of the references until the block settles", "waiting"),
    ("word", "RiseTicks", "its ticks", "waiting"),
    ("word", "HoldTicks", "ticks at the target until settled", "waiting"),
    ("bool", "RowWaits", "the row has negative amplitudes", "waiting"),
    ("bool", "StopWaits", "a stop waits until settled", "waiting"),
    ("real", "HoistNow", "[m/s] checked hoist speed", "rope"),
    ("real", "RopeBefore", "[m] rope length of the last call", "rope"),
    ("real", "RopeRead", "[m] rope length as read, within the range", "rope"),
    ("real", "RopeReach", "[m] farthest that the rope can have moved since the last reading", "rope"),
    ("bool", "RopeTaken", "the reading can be true", "rope"),
    ("bool", "AtRest", "nothing is pending, so that every rope length is taken", "rope"),
    ("word", "Piece", "piece of a table over the rope length", "pieces"),
    ("real", "CommandSum", "sum of the commands of this lap", "spacing"),
    ("real", "DelaySum", "sum of the commands that a tap has still to release", "spacing"),
    ("word", "LagTicks", "delay of the last tap while the spacing stays", "spacing"),
    ("bool", "Resting", "nothing is pending", "spacing"),
    ("word", "SpacingBefore", "[ticks] spacing of the last call", "original"),
    ("bool", "Disturbed", "a new spacing disturbs a steady command", "original"),
    ("real", "Part", "part of a command that a tap releases", "original"),
    ("word", "Cell", "cell of the call in which it does", "original"),
    ("word", "SpacingThen", "[ticks] spacing of a past command", "modified"),
    ("word", "WantedDelay", "[ticks] what the command that a tap read by its delay wants", "modified"),
    ("word", "AgreedDelay", "[ticks] what the command of that delay wants", "modified"),
    ("real", "PastCommand", "command that a tap releases", "modified"),
    ("real", "TablePlace", "place of the rope length in the table", "phase table"),
    ("word", "TableCell", "its cell", "phase table"),
    ("word", "Quanta", "phase of this tick", "quanta of the sway"),
    ("real", "QuantaReal", "the same as a real", "quanta of the sway"),
    ("word", "ElapsedQuanta", "quanta of the last tick", "phase"),
    ("real", "HoistRate", "checked hoist speed times quanta", "phase"),
    ("word", "j", "counter", "inner loop"),
    ("word", "Cell", "cell that a tap has reached", "phase"),
    ("word", "Ahead", "[quanta] phase until it is passed", "phase"),
    ("real", "AheadReal", "the same as a real", "phase"),
    ("real", "Part", "part of a change that a tap releases", "phase"),
    ("real", "PartMoment", "part times phase that it still had to go", "phase"),
    ("real", "Passed", "sum of the same over the parts released", "phase"),
    ("real", "FreshPassed", "the same from the changes of this lap alone", "phase"),
    ("real", "LowStretch", "least change of sqrt(L) that the rope allows, relative", "phase"),
    ("real", "HighStretch", "most of the same", "phase"),
    ("real", "Stretch", "change of sqrt(L) until a tap releases, relative", "phase"),
    ("real", "StretchTail", "its series but for the first orders", "phase"),
    ("real", "Excess", "how much more a part would have to be on the rope as it is, relative", "phase"),
    ("real", "Lack", "the same of this part", "phase"),
    ("real", "Delayed", "what of it comes a tick later", "phase"),
    ("real", "Release", "what the taps release in this tick", "phase"),
    ("real", "Kick", "step of the trolley's speed that undoes the kick of the hoist", "phase"),
    ("real", "Wanted", "step that the swing wants: the kick, and what parts lack", "phase"),
    ("real", "Lean", "how far its answer leans up or down", "phase"),
    ("bool", "Pushing", "a change or an answer goes through the taps", "phase"),
    ("real", "Change", "change of the command", "phase"),
    ("real", "NowPart", "its part that is released at once", "phase"),
    ("real", "ChangeMoment", "sum of part times phase to go of its later parts", "phase"),
    ("real", "WeightSum", "sum of the weights", "phase"),
    ("real", "WeightShare", "1 / WeightSum", "phase"),
    ("real", "Angle", "[rad] phase of this tick", "phase"),
    ("real", "Pace", "speed of the swing after the step of the reference", "phase"),
    ("real", "Place", "place of the swing half a tick later", "phase"),
    ("word", "LagLeft", "phase until the last tap has passed", "phase"),
    ("bool", "Shaping", "the taps run in this call", "phase"),
)
"""Kind, name, comment, and the part of the law that needs each."""


def scratch_of(settings: ShaperSettings, types: StTypes) -> list[Variable]:
    """List what a call computes on its way.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    types : StTypes
        Its types.
    """
    used = parts_in_use(settings)
    chosen = [Variable(name, types.type_of(kind), doc) for kind, name, doc, part in SCRATCH if part in used]
    scalars = of_measured(settings, chosen)
    if settings.clock is None:
        return scalars
    most_taps = max(len(table.lags) for table in settings.row_tables)
    weights = types.array_of("real", most_taps - 1)
    return [*scalars, Variable("Weights", weights, "weights of the taps for a change now")]
