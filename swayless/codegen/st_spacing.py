"""What a Structured Text block declares for taps that follow a spacing. Not for: their law."""

from __future__ import annotations

from swayless.codegen.st_parts import law_of
from swayless.codegen.st_types import Constant, StTypes, Table, Variable, st_table
from swayless.controller.original_filter import MOST_RUNS
from swayless.controller.settings import ShaperSettings
from swayless.controller.spacing import Spacing
from swayless.controller.spacing_filter import spacing_of


def strides(spacing: Spacing) -> list[int]:
    """List the steps of the look-up: powers of two, falling to 1, that reach the last piece together.

    At least two, as loops of one trip are not portable.

    Parameters
    ----------
    spacing : Spacing
        The table.

    Examples
    --------
    >>> strides(Spacing((3.0, 4.0, 5.0, 6.0, 7.0, 8.0), (4, 5, 6, 7, 8, 9)))
    [4, 2, 1]
    """
    last = len(spacing.ticks) - 1
    return [1 << power for power in reversed(range(max(last.bit_length(), 2)))]


def spacing_constants(settings: ShaperSettings) -> list[Constant]:
    """List the constants of the look-up; nothing where taps follow no spacing.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    """
    if not settings.is_spaced:
        return []
    last = len(spacing_of(settings).ticks) - 1
    pieces = Constant("LastPiece", "DINT", str(last), "last piece of the table of spacings")
    if law_of(settings) == "modified":
        return [pieces]
    return [pieces, Constant("MostRuns", "DINT", str(MOST_RUNS), "runs are numbered up to here")]


def spacing_tables(settings: ShaperSettings, types: StTypes) -> list[Table]:
    """List the tables of the look-up; nothing where taps follow no spacing.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    types : StTypes
        Its types.
    """
    if not settings.is_spaced:
        return []
    spacing = spacing_of(settings)
    steps = [[str(stride) for stride in strides(spacing)]]
    starts = [[types.literal(start) for start in spacing.starts]]
    ticks = [[str(each) for each in spacing.ticks]]
    unit = settings.rope.measured.unit if settings.rope else ""
    return [
        st_table("Strides", "DINT", steps, "Steps of the look-up in the tables below."),
        st_table("SpacingStarts", types.real, starts, f"[{unit}] Where each piece of the spacing begins."),
        st_table("SpacingTicks", "DINT", ticks, "[ticks] Spacing of each piece: half a period."),
    ]


def spacing_arrays(settings: ShaperSettings, types: StTypes, commands: Variable) -> list[Variable]:
    """List the rings of the law, and what else it keeps for each tap.

    The original law scatters commands at once, and needs none of them later.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    types : StTypes
        Its types.
    commands : Variable
        Ring of the last ramped commands.
    """
    last, law = settings.longest_delay_ticks, law_of(settings)
    sums = Variable("CommandSums", types.array_of("real", last), "ring: sum of the commands of this lap")
    if law == "original":
        return [
            sums,
            Variable("Parts", types.array_of("real", last), "ring: what is released in a call to come"),
            Variable("PartRuns", types.array_of("word", last), "ring: run that has put it there"),
        ]
    later_taps = max(len(table.lags) for table in settings.row_tables) - 1
    return [
        commands,
        sums,
        Variable("Spacings", types.array_of("word", last), "[ticks] ring: spacing of each command"),
        Variable("TapDelays", types.array_of("word", later_taps), "[ticks] delay of each tap"),
    ]


def spacing_variables(settings: ShaperSettings) -> list[Variable]:
    """List the spacing itself: after power-on of the longest period.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    """
    widest = str(spacing_of(settings).most)
    return [Variable("Spacing", "DINT", "[ticks] between taps, now", st_reset=widest)]
