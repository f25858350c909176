"""Draw the figures and print the tables of `kriikku-1997.md`: `python docs/papers/kriikku_1997.py`.

The page holds the tables word for word, and the figures stand beside it; a test compares both with what this
script makes. Not for: numbers of other papers.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Sequence
from pathlib import Path

from matplotlib.figure import Figure

from swayless.design import (
    Shaper,
    design_shaper,
    residual_vibration,
    rope_length_interval_m,
    worst_residual,
)
from swayless.design.robust import fixed_duration, specified_insensitivity
from swayless.plant import Band, pendulum_frequency_hz, pendulum_mode
from swayless.report import PlottedShaper, bank_figure, figure_bytes, response_figure, sensitivity_figure

FOLDER = Path(__file__).with_suffix("")
FOOT_M = 0.3048
DURATION_S = 3.0
TOLERANCE = 0.05
UM_ZV_TOLERANCE = 0.2
LONGEST_FT, SHORTEST_FT = 29.0, 9.0
PAPER_ENDS_FT = (24.0, 19.0, 9.0)
UM_ZV_FT = {24.0: (29.0, 20.0), 16.0: (20.0, 13.0), 11.0: (13.0, 9.0)}
"""Length designed for, and the lengths between which the paper's operator uses it."""


def frequency_hz(rope_ft: float) -> float:
    """Frequency of the load on so many feet of rope."""
    return pendulum_frequency_hz(rope_ft * FOOT_M)


def band_of(long_ft: float, short_ft: float) -> Band:
    """Frequencies between two lengths of rope."""
    return Band(frequency_hz(long_ft), frequency_hz(short_ft))


def held_ft(shaper: Shaper) -> tuple[float, float]:
    """Longest and shortest rope at which a shaper holds its tolerance."""
    shortest_m, longest_m = rope_length_interval_m(shaper.guarantee.band)
    return longest_m / FOOT_M, shortest_m / FOOT_M


def fixed_duration_row(start_ft: float, impulses: int | None = None) -> Shaper:
    """Do steps 3 and 4 of the algorithm: 3.0 s, 5 %, from a length of rope on."""
    return fixed_duration(
        DURATION_S,
        frequency_hz(start_ft),
        tolerance=TOLERANCE,
        amplitudes="unity-magnitude",
        impulses=impulses,
    ).shaper


def algorithm_rows(impulses: int | None = None) -> list[Shaper]:
    """Design three rows, each from where the one before ends: step 5 of the algorithm."""
    rows = [fixed_duration_row(LONGEST_FT, impulses)]
    while len(rows) < len(PAPER_ENDS_FT):
        rows.append(fixed_duration_row(held_ft(rows[-1])[1], impulses))
    return rows


def rows_from_paper_lengths(impulses: int | None = None) -> list[Shaper]:
    """Design three rows, each from the length at which the paper switches to it."""
    return [fixed_duration_row(start_ft, impulses) for start_ft in (LONGEST_FT, *PAPER_ENDS_FT[:-1])]


def um_zv_rows() -> list[Shaper]:
    """Design the three UM ZV shapers of figure 11; their bands are those at 20 %."""
    return [
        design_shaper("um-zv", pendulum_mode(rope_ft * FOOT_M), tolerance=UM_ZV_TOLERANCE)
        for rope_ft in UM_ZV_FT
    ]


def left_by(rows: Sequence[Shaper]) -> list[float]:
    """Compute what rows leave at worst between the paper's own switch lengths."""
    starts_ft = (LONGEST_FT, *PAPER_ENDS_FT[:-1])
    return [
        worst_residual(row, band_of(start_ft, end_ft))
        for row, start_ft, end_ft in zip(rows, starts_ft, PAPER_ENDS_FT, strict=True)
    ]


def specified_rows() -> dict[str, Shaper]:
    """Design specified-insensitivity shapers for the example crane, 20 to 4 ft."""
    band = band_of(20.0, 4.0)
    return {
        "positive": specified_insensitivity(band).shaper,
        "unity magnitude": specified_insensitivity(band, amplitudes="unity-magnitude").shaper,
    }


def table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Lay out a Markdown table."""
    lines = [heads, ["---"] * len(heads), *rows]
    return "".join("| " + " | ".join(cells) + " |\n" for cells in lines)


def percent(ratio: float) -> str:
    """Print a ratio in percent, to a tenth."""
    return f"{100.0 * ratio:.1f} %"


def times(shaper: Shaper) -> str:
    """Print the times of impulses, in seconds."""
    return ", ".join(f"{time_s:.4g}" for time_s in shaper.times_s)


def example_table() -> str:
    """Section III, the crane of 20 to 4 ft."""
    rows = [
        (name, f"{shaper.duration_s:.3f} s", str(shaper.times_s.size), times(shaper))
        for name, shaper in specified_rows().items()
    ]
    return table(("amplitudes", "shortest", "impulses", "at (s)"), rows)


def algorithm_table(impulses: int | None) -> str:
    """Section III, steps 3 to 5: three rows of the gantry."""
    rows = [
        (str(number), *(f"{end_ft:.2f} ft" for end_ft in held_ft(row)), times(row))
        for number, row in enumerate(algorithm_rows(impulses), 1)
    ]
    return table(("row", "from", "down to", "impulses +1, -1, ..., +1 at (s)"), rows)


def paper_lengths_table() -> str:
    """Section IV: what is left between the switch lengths of the paper."""
    kinds = {
        "as many impulses as it takes, each row from where the one before ends": algorithm_rows(),
        "five impulses, each row from where the one before ends": algorithm_rows(5),
        "as many impulses as it takes, each row from the paper's length": rows_from_paper_lengths(),
        "five impulses, each row from the paper's length": rows_from_paper_lengths(5),
    }
    rows = [(name, *(percent(left) for left in left_by(shapers))) for name, shapers in kinds.items()]
    return table(("rows of 3.0 s at 5 %", "29 to 24 ft", "24 to 19 ft", "19 to 9 ft"), rows)


def um_zv_table() -> str:
    """Section IV, figure 11: three UM ZV shapers."""
    rows = []
    for (design_ft, (long_ft, short_ft)), shaper in zip(UM_ZV_FT.items(), um_zv_rows(), strict=True):
        left = residual_vibration(shaper, [frequency_hz(long_ft), frequency_hz(short_ft)])
        longest_ft, shortest_ft = held_ft(shaper)
        rows.append(
            (
                f"{design_ft:g} ft",
                f"{shaper.duration_s:.3f} s",
                f"{percent(left[0])} at {long_ft:g} ft",
                f"{percent(left[1])} at {short_ft:g} ft",
                f"{longest_ft:.2f} to {shortest_ft:.2f} ft",
            )
        )
    return table(("designed for", "duration", "leaves", "leaves", "holds 20 %"), rows)


def tables() -> dict[str, str]:
    """All tables of the page."""
    return {
        "section III, example": example_table(),
        "section III, gantry": algorithm_table(None),
        "section III, gantry, five impulses": algorithm_table(5),
        "section IV, switch lengths": paper_lengths_table(),
        "section IV, UM ZV": um_zv_table(),
    }


def plotted(shapers: Sequence[Shaper], labels: Sequence[str]) -> list[PlottedShaper]:
    """Name shapers for a figure."""
    return [
        PlottedShaper(label, shaper, shaper.guarantee) for label, shaper in zip(labels, shapers, strict=True)
    ]


def from_names(shapers: Sequence[Shaper]) -> list[str]:
    """Name rows by the length that they start from."""
    return [f"{number}: from {held_ft(shaper)[0]:.2f} ft" for number, shaper in enumerate(shapers, 1)]


def figures() -> dict[str, tuple[Figure, list[Shaper]]]:
    """All figures of the page, each with the shapers that it shows."""
    specified = specified_rows()
    fixed, from_lengths, um_zv = algorithm_rows(), rows_from_paper_lengths(), um_zv_rows()
    gantry_m = (SHORTEST_FT * FOOT_M, LONGEST_FT * FOOT_M)
    return {
        "fig-6": (sensitivity_figure(plotted([*specified.values()], [*specified])), [*specified.values()]),
        "fig-7": (response_figure(plotted(um_zv[:1], ["UM ZV for 24 ft"])[0]), um_zv[:1]),
        "fig-9": (bank_figure(plotted(fixed, from_names(fixed)), rope_length_m=gantry_m), fixed),
        "fig-10": (
            bank_figure(plotted(from_lengths, from_names(from_lengths)), rope_length_m=gantry_m),
            from_lengths,
        ),
        "fig-11": (
            bank_figure(plotted(um_zv, [f"UM ZV {ft:g} ft" for ft in UM_ZV_FT]), rope_length_m=gantry_m),
            um_zv,
        ),
    }


def drawn_from(shapers: Sequence[Shaper]) -> str:
    """Write down what a figure was drawn from: matplotlib's versions differ in their bytes, not in this."""
    return json.dumps([[*shaper.times_s.round(6), *shaper.amplitudes.round(6)] for shaper in shapers])


def shortened(svg: str) -> str:
    """Write each path of a figure on one line, rounded to a hundredth of a point, which nobody sees."""

    def rounded(path: re.Match[str]) -> str:
        return re.sub(r"\d+\.\d{3,}", lambda number: f"{float(number[0]):.2f}", path[0].replace("\n", ""))

    return re.sub(r' d="[^"]*"', rounded, svg)


def main() -> None:
    """Write the figures and print the tables."""
    FOLDER.mkdir(exist_ok=True)
    for name, (figure, shapers) in figures().items():
        text = shortened(figure_bytes(figure, "svg").decode())
        (FOLDER / f"{name}.svg").write_text(f"{text}<!-- {drawn_from(shapers)} -->\n", encoding="utf-8")
    for name, text in tables().items():
        print(f"{name}\n\n{text}")


if __name__ == "__main__":
    main()
