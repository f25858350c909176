"""Robust designs beside the same programs on a grid, solved by HiGHS: `python benchmarks/robust.py`."""

import numpy as np
from scipy.optimize import linprog

from benchmarks.timing import best_s, line
from swayless.design.robust import specified_insensitivity
from swayless.design.robust.bank import ContinuousRows, cover, cover_with
from swayless.plant import Band

LOW_HZ, HIGH_HZ = 0.16750, 0.30067  # the gantry, 29 ft to 9 ft
TOLERANCE, TIMES, FREQUENCIES, PHASES = 0.05, 161, 61, 32


def report() -> list[str]:
    """Time single shapers beside one program of a bisection, and banks."""
    singles = [
        _single(damping_ratio, kind) for damping_ratio in (0.0, 0.02) for kind in ("positive", "bounded")
    ]
    rows = ContinuousRows(amplitudes="bounded")
    by_tolerance = best_s(
        lambda: cover(LOW_HZ, HIGH_HZ, rows, tolerance=TOLERANCE, duration_s=3.0), repeats=1
    )
    by_number = best_s(lambda: cover_with(3, LOW_HZ, HIGH_HZ, rows, duration_s=3.0), repeats=1)
    return [
        *singles,
        line("bank of the gantry, 3.0 s, 5 %, bounded", by_tolerance, "3 s"),
        line("bank of the gantry, 3.0 s, three rows, bounded", by_number, "3 s"),
    ]


def _single(damping_ratio: float, kind: str) -> str:
    def ours() -> float:
        design = specified_insensitivity(
            Band(LOW_HZ, HIGH_HZ), tolerance=TOLERANCE, damping_ratio=damping_ratio, amplitudes=kind
        )
        return design.shaper.duration_s

    duration = ours() * LOW_HZ
    ours_s = best_s(ours, repeats=3)
    peer_s = best_s(lambda: _program(duration, damping_ratio, kind == "bounded"), repeats=1)
    what = f"shortest {kind} shaper of the gantry, damping {damping_ratio}"
    return line(
        what, ours_s, "1 s" if damping_ratio else "0.3 s", "one program of a bisection, HiGHS", peer_s
    )


def _program(duration: float, damping_ratio: float, bounded: bool) -> float:
    times, frequency = np.linspace(0.0, duration, TIMES), np.linspace(1.0, HIGH_HZ / LOW_HZ, FREQUENCIES)
    turn = 2.0 * np.pi * complex(damping_ratio, np.sqrt(1.0 - damping_ratio**2))
    columns = np.exp(np.multiply.outer(frequency * turn, times - duration))
    phases = np.exp(-2j * np.pi * np.arange(PHASES) / PHASES)
    planes = np.multiply.outer(phases, columns).real.reshape(-1, TIMES)
    limits, right = np.hstack([planes, -np.ones((len(planes), 1))]), np.zeros(len(planes))
    bounds = [(0.0, None)] * (TIMES + 1)
    if bounded:
        sums = np.hstack([np.tri(TIMES), np.zeros((TIMES, 1))])
        limits = np.vstack([limits, sums, -sums])
        right = np.concatenate([right, np.ones(TIMES), np.zeros(TIMES)])
        bounds = [(None, None)] * TIMES + [(0.0, None)]
    cost, whole = np.append(np.zeros(TIMES), 1.0), np.append(np.ones(TIMES), 0.0)
    return linprog(cost, A_ub=limits, b_ub=right, A_eq=whole[np.newaxis], b_eq=[1.0], bounds=bounds).fun


if __name__ == "__main__":
    print("\n".join(report()))
