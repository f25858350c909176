"""What a Structured Text block declares for steps, switches, ways, drives and tuning. Not for: their law."""

from __future__ import annotations

from swayless.codegen.st_parts import parts_in_use
from swayless.codegen.st_types import Constant, RealConstant, StTypes, Table, st_table
from swayless.controller.approach import Approach
from swayless.controller.planned_move import PlannedMove
from swayless.controller.settings import ShaperSettings
from swayless.controller.step_motion import StepMotion

ZERO, FALSE, TRUE = "0.0", "FALSE", "TRUE"

OPERATOR_STATE = (
    ("bool", "CommandLocked", "a command does nothing until it has been 0", TRUE, "locked at first"),
    ("bool", "CommandLocked", "a command does nothing until it has been 0", FALSE, "free at first"),
    ("bool", "ForwardShut", "a command forward does nothing until it has been 0", FALSE, "stop switches"),
    ("bool", "ReverseShut", "the same of a command in reverse", FALSE, "stop switches"),
    ("bool", "DriveOff", "the drive was not ready", TRUE, "feedback"),
    ("real", "WayForward", "[{units} times ticks] way left to the end ahead", ZERO, "way"),
    ("real", "WayReverse", "[{units} times ticks] way left to the end behind", ZERO, "way"),
    ("row", "NextRow", "the one row that may take over while the crane moves", "0", "way"),
    ("bool", "Stepping", "steps run", FALSE, "steps"),
    ("bool", "ArmedForward", "the step button was seen released", FALSE, "steps"),
    ("bool", "ArmedReverse", "the same of the other one", FALSE, "steps"),
    ("word", "StepRefusal", "status bit of a press that does not count", "0", "steps"),
    ("real", "StepsLeft", "[{units} times ticks] what is not yet travelled of steps", ZERO, "steps"),
    ("real", "StepsQueued", "[{units} times ticks] presses that wait for the next move", ZERO, "steps"),
    ("real", "StepSpeed", "[{units}] speed of the move of steps", ZERO, "step rows wait"),
    ("bool", "StepFalls", "it goes down", FALSE, "step rows wait"),
)
"""Kind, name, comment, value after power-on, and the part of the law that needs each."""

OPERATOR_SCRATCH = (
    ("real", "SpeedLimitNow", "[{units}] checked speed limit", "speed limit"),
    ("real", "RopeGiven", "[m] rope length with its offset", "offset"),
    ("real", "Counted", "[{units}] speed of the drive that the command counts as", "contactor"),
    ("real", "PendingNow", "[{units} times ticks] references to come from what is under way", "pending"),
    ("real", "Heading", "where the motion, or what is pending, leads to", "stop switches"),
    ("bool", "Halted", "the reference is 0 at once", "halt"),
    ("bool", "ForwardTaken", "the distance ahead is a number and valid", "way"),
    ("bool", "ReverseTaken", "the same of that behind", "way"),
    ("real", "StoppingSum", "[{units} times ticks] what stopping takes", "way"),
    ("bool", "PressedForward", "the step button is pressed in this call", "steps"),
    ("bool", "PressedReverse", "the same of the other one", "steps"),
    ("bool", "StepCounts", "the press counts", "steps"),
    ("real", "StepWay", "[{units} times ticks] way of the press", "steps"),
    ("bool", "RowLocked", "steps ran as the call began: no other row", "steps"),
    ("bool", "Forward", "the direction of the motion; commands below are turned ahead", "ahead"),
    ("real", "Now", "[{units}] ramped command", "ahead"),
    ("real", "Most", "[{units}] target, or largest command", "ahead"),
    ("real", "Way", "[{units} times ticks] sum of the commands that may still come", "ahead"),
    ("real", "WayLeft", "[{units} times ticks] the same to the end of the travel", "way and steps"),
    ("real", "After", "[{units}] next command", "ahead"),
    ("real", "RampAfter", "[{units}] the same by the ramp alone", "way"),
    ("real", "Gentle", "[{units}] next command that a deceleration undoes", "ahead"),
    ("real", "GlideNow", "[{units} times ticks] commands of the ramp from now to 0", "ahead"),
    ("real", "GlideSum", "[{units} times ticks] the same from a command considered", "ahead"),
    ("bool", "KeepsWay", "the next command keeps within the way", "plan"),
    ("word", "PlanSteps", "steps of the ramp that the move may rise", "plan"),
    ("bool", "PlanFits", "the largest command fits", "plan"),
    ("real", "Trial", "[{units}] command that is tried", "plan"),
    ("real", "Share", "[{units}] share of the way of each tick of the shortest hold", "plan"),
    ("real", "PlannedSpeed", "[{units}] speed of the move", "plan"),
)
"""Kind, name, comment, and the part of the law that needs each."""


def operator_constants(settings: ShaperSettings, types: StTypes) -> list[Constant]:
    """List the constants of the operator's functions; nothing where there are none.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    types : StTypes
        Its types.
    """
    made = (_commands, _ways, _steps, _plan)
    return [each for of_subject in made for each in types.constants(of_subject(settings))]


def _commands(settings: ShaperSettings) -> list[RealConstant]:
    operator, units = settings.operator, settings.limits.units
    reals: list[RealConstant] = [
        (name, value, f"[{units}] speed that the drive knows besides 0")
        for name, value in zip(contactor_names(settings), operator.contactor_commands, strict=True)
    ]
    if operator.slow_command is not None:
        reals.append(("SlowCommand", operator.slow_command, f"[{units}] slow_speed"))
    if operator.rope_offset is not None:
        low, high = operator.rope_offset
        reals += [("LowestOffset", low, "[m] rope_offset"), ("HighestOffset", high, "[m] rope_offset")]
    return reals


def _ways(settings: ShaperSettings) -> list[RealConstant]:
    way, units = settings.operator.way, settings.limits.units
    if way is None:
        return []
    return [
        ("LimitMargin", way.margin, "[m] way that is kept free before each end"),
        ("FarthestWay", way.farthest, "[m] longer than every stop: ways beyond count as this"),
        ("UnitTicksPerMetre", way.scale, f"[{units} times ticks per m] way"),
        ("LongestWay", way.most, f"[{units} times ticks] FarthestWay"),
        ("LeastWay", way.least, f"[{units} times ticks] way that is worth leaving rest for"),
    ]


def _steps(settings: ShaperSettings) -> list[RealConstant]:
    steps, units = settings.operator.steps, settings.limits.units
    if steps is None:
        return []
    rounding = StepMotion(settings, None).rounding
    return [
        ("StepCommand", steps.command, f"[{units}] largest speed of a step"),
        ("StepCapacity", steps.capacity, f"[{units} times ticks] most that may be pressed and not travelled"),
        ("StepRounding", rounding, f"[{units} times ticks] way that rounding may leave over"),
    ]


def _plan(settings: ShaperSettings) -> list[RealConstant]:
    used, units = parts_in_use(settings), settings.limits.units
    if "ahead" not in used:
        return []
    approach = Approach(settings.limits, settings.number)
    gentle: RealConstant = (
        "GentleStep",
        approach.gentle_step,
        f"[{units} per tick] the smaller step of the ramp",
    )
    if "plan" not in used:
        return [gentle]
    plan = PlannedMove(settings, approach)
    return [
        gentle,
        ("PlanHold", plan.hold, "[ticks] a speed is held until all has settled"),
        ("PlanShortest", plan.shortest, "[ticks] references of the shortest move"),
        ("PerPlanShortest", plan.reciprocal, "1 / PlanShortest"),
    ]


def contactor_names(settings: ShaperSettings) -> list[str]:
    """Name the constants of the speeds that a drive behind contactors knows, rising.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    """
    names = ["SlowContactor", "FastContactor"]
    return names[len(names) - len(settings.operator.contactor_commands) :]


def plan_strides(settings: ShaperSettings) -> list[int]:
    """List the steps by which the speed of a planned move is searched, falling to 1; at least one.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    """
    bits = PlannedMove(settings, Approach(settings.limits, settings.number)).step_bits
    return [1 << power for power in reversed(range(max(bits, 1)))]


def operator_tables(settings: ShaperSettings, types: StTypes) -> list[Table]:
    """List the tables of the operator's functions; nothing where there are none.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    types : StTypes
        Its types.
    """
    used, steps, units = parts_in_use(settings), settings.operator.steps, settings.limits.units
    tables = []
    if steps is not None:
        sizes = [[types.literal(size) for size in steps.sizes]]
        doc = f"[{units} times ticks] Way of each size of step."
        tables.append(st_table("StepSizes", types.real, sizes, doc))
    if "plan" in used:
        strides = [[str(stride) for stride in plan_strides(settings)]]
        tables.append(st_table("PlanStrides", "DINT", strides, "Steps of the search for a speed."))
    return tables
