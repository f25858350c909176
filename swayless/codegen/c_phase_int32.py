"""Constants of the answer to hoisting in int32. Not for: double and float (`c_phase_float`)."""

from __future__ import annotations

from swayless.codegen.c_phase_float import ANSWER_DOC, LEAN_DOC
from swayless.codegen.c_types import CConstant, CTable, CTypes, c_table
from swayless.controller.hoist_answers import leaning_from
from swayless.controller.hoist_int32 import LARGEST_SWING, LARGEST_WANTED, ONE, IntegerHoist
from swayless.controller.phase_filter_int32 import command_shift
from swayless.controller.settings import ShaperSettings


def integer_hoist(settings: ShaperSettings) -> IntegerHoist:
    """Make the answer to hoisting, which knows its numbers.

    Parameters
    ----------
    settings : ShaperSettings
        The block in int32, with a phase clock.
    """
    return IntegerHoist(settings, int(settings.limits.max_command) << command_shift(settings))


def integer_constants(settings: ShaperSettings, types: CTypes) -> list[CConstant]:
    """List the scalar constants, each with its origin.

    Parameters
    ----------
    settings : ShaperSettings
        The block, with a phase clock.
    types : CTypes
        Its types.
    """
    hoist = integer_hoist(settings)
    return [
        *(CConstant("uint32_t", name, f"{value}u", doc) for name, value, doc in _counters(hoist)),
        CConstant(
            "uint64_t",
            "INVERSE_SCALE",
            f"UINT64_C({1 << hoist.inverse_shift})",
            "over quanta: their reciprocal",
        ),
        CConstant(
            types.real,
            "LEANING_FROM",
            types.literal(leaning_from(settings)),
            "from here on answers lean away from the maximum",
        ),
        *(
            CConstant("int64_t", name, f"INT64_C({value})", doc)
            for name, value, doc in (*_scales(settings), *_ratios(hoist))
        ),
    ]


def _counters(hoist: IntegerHoist) -> list[tuple[str, int, str]]:
    return [
        ("RATIO_SHIFT", hoist.inverse_shift - 30, "from quanta times a reciprocal to 2^30"),
        ("TICKS_SHIFT", hoist.inverse_shift - 31, "from there over 2^31 to ticks"),
    ]


def _scales(settings: ShaperSettings) -> list[tuple[str, int, str]]:
    scale = 1 << command_shift(settings)
    return [
        ("SCALE", scale, "commands are scaled by it"),
        ("SCALE_HALF", scale >> 1, "rounds to the nearest count"),
    ]


def _ratios(hoist: IntegerHoist) -> list[tuple[str, int, str]]:
    return [
        ("KICK", hoist.kick_scale.factor, "quantum / (9806.65 mm/s2 tick), scaled"),
        ("KICK_SCALE", 1 << hoist.kick_scale.shift, "KICK is so much too large"),
        ("STRETCH_SCALE", 1 << hoist.stretch_shift, "STRETCH is so much too large"),
        ("PER_SCALE", 1 << 22, "from 2^52 to 2^30"),
        ("PER_MOST", hoist.per_most, "2^52 / quanta of a tick on the shortest rope"),
        ("PER_FEWEST", hoist.per_fewest, "2^52 / quanta of a tick on the longest rope"),
        ("LOSS", hoist.loss, "twice the damping ratio of the swing, over 2^30"),
        ("LONGEST_STRETCH", hoist.longest, "most change of sqrt(rope length), over 2^30"),
        ("LARGEST_SWING", LARGEST_SWING, "keeps products of the swing within 64 bits"),
        ("LARGEST_WANTED", LARGEST_WANTED, "keeps answers within 64 bits"),
        ("LARGEST_EXCESS", ONE >> 1, "largest relative correction of a part, over 2^30"),
        ("LEAST_MISMATCH", hoist.mismatch, "least relative error corrected, over 2^30"),
        ("LEAST_ANSWER", hoist.least_answer, "scaled: smaller kicks are collected"),
        ("LEAST_LACK", hoist.least_lack, "scaled: smaller corrections are left out"),
    ]


def integer_tables(settings: ShaperSettings, types: CTypes) -> list[CTable]:
    """List what hoisting does to each tap, and the series of its weight.

    Parameters
    ----------
    settings : ShaperSettings
        The block, with a phase clock.
    types : CTypes
        Its types.
    """
    del types  # commands have no part in them
    hoist = integer_hoist(settings)
    stretches = [[str(value) for value in row] for row in hoist.stretch]
    steps = [[str(even) for even, _ in row] for row in hoist.answers]
    leans = [[str(lean) for _, lean in row] for row in hoist.answers]
    series = [f"INT64_C({value})" for value in hoist.series]
    doc = "relative change of sqrt(rope length) until each tap, by row, per mm/s and quantum, scaled"
    return [
        c_table("int32_t", "STRETCH", stretches, doc),
        c_table("int64_t", "SERIES", [series], "(1 + z)^(-1/2) = 1 + z (s0 + z (s1 + ...)), over 2^30"),
        c_table("int32_t", "ANSWER", steps, f"{ANSWER_DOC}, over 2^30"),
        c_table("int32_t", "LEAN", leans, f"{LEAN_DOC}, over 2^30"),
    ]
