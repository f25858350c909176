"""What a Structured Text block knows of the rope or position that it measures. Not for: how it is read."""

from __future__ import annotations

from swayless.codegen.st_types import Constant, RealConstant, StTypes, Variable
from swayless.controller.measured import ROPE, Measured
from swayless.controller.rope import MOST_HELD_TICKS
from swayless.controller.settings import ShaperSettings


def st_said(measured: Measured, text: str) -> str:
    """Say of a measured quantity what Structured Text, or a comment, says of a rope.

    Parameters
    ----------
    measured : Measured
        What is measured.
    text : str
        Names of variables, statements or words.

    Examples
    --------
    >>> from swayless.controller.measured import ARM_ANGLE
    >>> st_said(ARM_ANGLE, "IF RopeLengthValid AND (HoistNow > 0.0) THEN (* [m/s] hoist speed *)")
    'IF PositionValid AND (PositionSpeedNow > 0.0) THEN (* [rad/s] position speed *)'
    >>> st_said(ROPE, "LongestRope")
    'LongestRope'
    """
    if measured is ROPE:
        return text
    names = (
        ("ShortestRope", f"Lowest{measured.st_name}"),
        ("LongestRope", f"Highest{measured.st_name}"),
        (ROPE.st_name, measured.st_name),
        (ROPE.st_speed, measured.st_speed),
        ("Rope", measured.st_name),
        ("Hoist", measured.st_speed),
        (ROPE.c_name, measured.c_name),
        (ROPE.c_speed_name, measured.c_speed_name),
        ("[m", f"[{measured.unit}"),
        ("the rope", f"the {measured.mover}"),
        ("The rope", f"The {measured.title}"),
    )
    for old, new in names:
        text = text.replace(old, new)
    return measured.said(text)


def of_measured(settings: ShaperSettings, variables: list[Variable]) -> list[Variable]:
    """Name variables after what the block measures.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    variables : list of Variable
        As they are called where it is a rope.
    """
    if settings.rope is None:
        return variables
    measured = settings.rope.measured
    return [
        Variable(
            st_said(measured, each.st_name),
            each.st_type,
            st_said(measured, each.st_doc),
            st_reset=st_said(measured, each.st_reset),
        )
        for each in variables
    ]


def rope_constants(settings: ShaperSettings, types: StTypes) -> list[Constant]:
    """List what the block knows of its rope; nothing where it is not measured.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    types : StTypes
        Its types.
    """
    rope = settings.rope
    if rope is None:
        return []
    reals: list[RealConstant] = [
        ("ShortestRope", rope.shortest, "[m] rope_length"),
        ("LongestRope", rope.longest, "[m] rope_length"),
        ("FastestHoist", rope.hoist_speed, "[m/s] hoist_speed"),
        ("RopeJump", rope.jump, "[m] difference of two readings that is always taken"),
        ("RopeWayPerTick", rope.way_per_tick, "[m] farthest that the rope moves in a tick"),
    ]
    said = [(st_said(rope.measured, name), value, st_said(rope.measured, doc)) for name, value, doc in reals]
    held = rope.measured.said("[ticks] a held length is counted up to here")
    return [*types.constants(said), Constant("MostHeldTicks", "DINT", str(MOST_HELD_TICKS), held)]
