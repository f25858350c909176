"""What the operator's functions need in the C block: constants and state. Not for: diagnostics, nor code."""

from __future__ import annotations

from swayless.codegen.c_types import CConstant, CField, CTypes
from swayless.codegen.features import Features
from swayless.controller.approach import Approach
from swayless.controller.operator_settings import StepSettings, WaySettings
from swayless.controller.planned_move import PlannedMove
from swayless.controller.settings import ShaperSettings
from swayless.controller.step_motion import StepMotion

CONTACTOR_NAMES = ("CONTACTOR_1", "CONTACTOR_2")
"""Commands that the drive knows besides 0, rising."""


def operator_constants(settings: ShaperSettings, types: CTypes, features: Features) -> list[CConstant]:
    """List the scalar constants, each with its origin.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    types : CTypes
        Its types.
    features : Features
        Parts of the law in use.
    """
    operator, units = settings.operator, settings.limits.units
    reals = [
        (name, value, f"{units}: speed that the drive knows")
        for name, value in zip(CONTACTOR_NAMES, operator.contactor_commands, strict=False)
    ]
    if operator.slow_command is not None:
        reals.append(("SLOW_COMMAND", operator.slow_command, f"{units}: slow_speed"))
    if operator.rope_offset is not None:
        low, high = operator.rope_offset
        unit = "mm" if types.number.is_integer else "m"
        reals += [
            ("LEAST_OFFSET", low, f"{unit}: rope_offset"),
            ("MOST_OFFSET", high, f"{unit}: rope_offset"),
        ]
    constants = [CConstant(types.real, name, types.literal(value), doc) for name, value, doc in reals]
    if features.has_approach:
        gentle = Approach(settings.limits, settings.number).gentle_step
        doc = f"{units} per tick: a step up that a deceleration can undo"
        constants.append(CConstant(types.real, "GENTLE_STEP", types.literal(gentle), doc))
    constants += _plan_constants(settings, types) if features.has_plan else []
    constants += [] if operator.way is None else _way_constants(operator.way, types)
    return constants + ([] if operator.steps is None else _step_constants(operator.steps, settings, types))


def _plan_constants(settings: ShaperSettings, types: CTypes) -> list[CConstant]:
    """List what a planned move needs."""
    plan = PlannedMove(settings, Approach(settings.limits, settings.number))
    bit = 1 << plan.step_bits >> 1
    scale = ", over 2^30" if types.number.is_integer else ""
    return [
        CConstant(types.sum, "HOLD_TICKS", types.wide(plan.hold), "hold of a planned move"),
        CConstant(
            types.sum, "SHORTEST_HOLD", types.wide(plan.shortest), "ticks: hold, and a step up and down"
        ),
        CConstant(types.sum, "PER_SHORTEST", types.wide(plan.reciprocal), f"1 / SHORTEST_HOLD{scale}"),
        CConstant(
            "uint32_t", "MOST_STEPS_BIT", f"{bit}u", "highest bit of the steps of a ramp to the maximum"
        ),
    ]


def _way_constants(way: WaySettings, types: CTypes) -> list[CConstant]:
    """List what the distance inputs need."""
    unit, sums = ("mm", "counts times ticks") if types.number.is_integer else ("m", "units times ticks")
    wide = [
        ("WAY_MARGIN", way.margin, f"{unit}: kept free before each end"),
        ("FARTHEST_WAY", way.farthest, f"{unit}: longer than any stop, and counts for all longer ones"),
        ("WAY_SCALE", way.scale, f"{sums} per {unit}{', scaled' if way.shift else ''}"),
        ("MOST_WAY", way.most, f"{sums}: the farthest way"),
        ("LEAST_WAY", way.least, f"{sums}: least way worth leaving rest for"),
    ]
    if way.shift:
        wide.append(("WAY_UNIT", 1 << way.shift, "WAY_SCALE is so much too large"))
    return [CConstant(types.sum, name, types.wide(value), doc) for name, value, doc in wide]


def _step_constants(steps: StepSettings, settings: ShaperSettings, types: CTypes) -> list[CConstant]:
    """List what Step Mode needs."""
    whole = types.number.is_integer
    sums = "counts times ticks" if whole else "units times ticks"
    wide = [(f"STEP_SIZE_{i}", size, f"{sums}: way of a step") for i, size in enumerate(steps.sizes, start=1)]
    wide.append(("STEP_CAPACITY", steps.capacity, f"{sums}: most pressed, not yet travelled"))
    if not whole:
        rounding = StepMotion(settings, None).rounding
        wide.append(("STEP_ROUNDING", rounding, f"{sums}: more than a ramp to rest misses by rounding"))
    command = types.literal(steps.command)
    return [
        *(CConstant(types.sum, name, types.wide(value), doc) for name, value, doc in wide),
        CConstant(types.real, "STEP_COMMAND", command, f"{settings.limits.units}: largest command of a step"),
    ]


def operator_sums(settings: ShaperSettings, types: CTypes, features: Features) -> list[CField]:
    """List sums and commands that the functions remember.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    types : CTypes
        Its types.
    features : Features
        Parts of the law in use.
    """
    zero, most, found = types.literal(0), types.literal(settings.limits.max_command), []
    if features.has_way:
        found += [
            (types.sum, "way_forward", "sum of references that may come before that end", zero),
            (types.sum, "way_reverse", "the same of the other end", zero),
        ]
    if features.has_steps:
        found += [
            (types.sum, "left", "what is left of steps, with its sign", zero),
            (types.sum, "queued", "presses that are not part of it yet", zero),
        ]
    if features.has_steps and features.has_waiting_rows:
        found.append((types.real, "step_speed", "speed of a planned step", zero))
    if features.has_slow_switches:
        found += [
            (types.real, "most_forward", "largest command in that direction", most),
            (types.real, "most_reverse", "the same of the other direction", most),
        ]
    if features.has_speed_limit:
        found.append((types.real, "speed_limit", "largest command", most))
    if features.has_rope_offset:
        found.append((types.real, "rope_offset", "added to the rope length", zero))
    if features.has_steps:
        found.append(("uint32_t", "refusal", "status bit of a refused press", "0u"))
    return [CField(kind, name, doc, "", initial) for kind, name, doc, initial in found]


def next_row(features: Features) -> list[CField]:
    """List the row that may take over while the crane moves, where ways to the ends are kept.

    Parameters
    ----------
    features : Features
        Parts of the law in use.
    """
    doc = "the one row that may take over in the next tick while the crane moves"
    return [CField("uint8_t", "next_row", doc, "", "0u")] if features.has_way else []


def operator_flags(features: Features) -> list[CField]:
    """List the flags that the functions remember.

    Parameters
    ----------
    features : Features
        Parts of the law in use.
    """
    found = [
        (
            features.has_lock,
            "locked",
            "a command does nothing until it has been 0",
            features.starts_from_zero,
        ),
        (features.has_feedback, "drive_off", "the drive is not ready", True),
    ]
    if features.has_stop_switches:
        found += [
            (True, "shut_forward", "the stop switch at that end is made", False),
            (True, "shut_reverse", "the same of the other end", False),
            (True, "locked_forward", "a command towards it does nothing until it was 0", False),
            (True, "locked_reverse", "the same of the other end", False),
        ]
    if features.has_steps:
        found += [
            (True, "armed_forward", "the button was seen released", False),
            (True, "armed_reverse", "the same of the other button", False),
            (True, "row_locked", "steps ran when the tick began", False),
            (True, "stepping", "steps run", False),
            (features.has_waiting_rows, "falls", "a planned step goes down", False),
        ]
    return [
        CField("bool", name, doc, "", "true" if initial else "false")
        for is_there, name, doc, initial in found
        if is_there
    ]
