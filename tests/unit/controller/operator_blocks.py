"""Blocks with the operator's functions, built from plain numbers, and what tests ask of them."""

from dataclasses import replace

from swayless.controller import OperatorOptions, ShaperInput, operator_settings
from tests.unit.controller.blocks import UM_SPLIT, UM_ZV, ZVD, block, phase_block
from tests.unit.controller.spaced_blocks import rope_block

STEP_SIZES_M = (0.05, 0.21, 1.0)
PHASE_TICK_S = 0.05
ROPE_LENGTH_M = 4.0
KINDS = ("zvd", "um-zv", "um-split", "phase", "modified", "original")
"""Rows that take commands at once, rows that wait, and the laws that follow a rope."""


def operated(settings, **options):
    """The same block with functions, named as in OperatorOptions."""
    operator = operator_settings(OperatorOptions(**options), settings.bank, settings.limits)
    return replace(settings, operator=operator)


def block_of(kind, number, **limits):
    """A block of one row of a kind; ramps of 10 ticks unless given."""
    if kind == "phase":
        return phase_block(number, rope_length_m=(3.0, 9.0), tick_s=PHASE_TICK_S, **limits)
    if kind in {"original", "modified"}:
        return rope_block(number, kind, **limits)
    return block({"zvd": ZVD, "um-zv": UM_ZV, "um-split": UM_SPLIT}[kind], number=number, **limits)


def operator_block(kind, number, limits=None, **options):
    """A block of one row of a kind, with functions."""
    return operated(block_of(kind, number, **(limits or {})), **options)


def hands_off(settings, **fields):
    """Inputs of a tick in which nothing is touched, on a rope that stands."""
    scalar, per_m = settings.number.scalar, 1000 if settings.number.is_integer else 1
    far = settings.number.scalar(1000 * per_m)
    return ShaperInput(
        scalar(0),
        rope_length=scalar(ROPE_LENGTH_M * per_m),
        distance_forward=far,
        distance_reverse=far,
        speed_limit=settings.limits.max_command,
    )._replace(**fields)


def metres(settings, distance_m):
    """A distance in the unit of the block."""
    return round(distance_m * 1000) if settings.number.is_integer else settings.number.scalar(distance_m)


def travelled_m(settings, outs):
    """Way of some references, in metres."""
    total = sum(float(out.reference) for out in outs)
    return total * settings.tick_s / settings.limits.units_per_m_s


def to_rest(shaper, inputs, most=4000):
    """Outputs from now on until nothing is pending and nothing runs, the inputs being the same."""
    outs = []
    while not outs or outs[-1].stop_time_ticks > 0:
        outs.append(shaper.step(inputs))
        assert len(outs) < most, "the block does not come to rest"
    return outs
