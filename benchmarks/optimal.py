"""How long moves computed ahead take to find: `python -m benchmarks.optimal`."""

import numpy as np
from scipy.optimize import linprog

from benchmarks.timing import best_s, line
from swayless.design.optimal import LinearPlant, MoveTask, Robustness, least_energy, time_optimal, track
from swayless.design.optimal.program import Program

TWO_MASSES = LinearPlant.from_transfer_function([1.0], [0.01, 0.0, 1.0, 0.0, 0.0])
OSCILLATOR = LinearPlant.from_transfer_function([1.0], [0.01, 0.0, 1.0])
TWO_MODES = LinearPlant.from_transfer_function(
    [1.0], np.polymul([0.01, 0.002, 1.0], np.polymul([1.0 / 900.0, 0.001, 1.0], [1.0, 0.0, 0.0]))
)
TARGETS = {200: "0.5 s", 2000: "20 s"}


def report() -> list[str]:
    """Time moves of about 200 and 2000 ticks: fastest, with a rate limit, of two modes, smooth, tracking."""
    return [text for ticks in TARGETS for text in _of(ticks)]


def _of(ticks: int) -> list[str]:
    fast = MoveTask(TWO_MASSES, 2.25 / ticks, (-1.0, 1.0), 1.0, robustness=Robustness(1))
    limited = MoveTask(
        TWO_MASSES, 2.3 / ticks, (-1.0, 1.0), 1.0, rate_limit_per_s=20.0, robustness=Robustness(1)
    )
    hard = MoveTask(TWO_MODES, 2.4 / ticks, (-1.0, 1.0), 1.0, rate_limit_per_s=20.0, robustness=Robustness(2))
    along = MoveTask(OSCILLATOR, 2.0 / ticks, (-5.0, 5.0), 1.0, robustness=Robustness(1))
    k = np.arange(1, ticks + 1) / ticks
    wanted = 10.0 * k**3 - 15.0 * k**4 + 6.0 * k**5
    found, slower, hardest = time_optimal(fast), time_optimal(limited), time_optimal(hard)
    works = {
        f"fastest, {found.ticks} ticks": lambda: time_optimal(fast),
        f"fastest with a rate limit, {slower.ticks} ticks": lambda: time_optimal(limited),
        f"two modes, rate limit, 2nd order, {hardest.ticks} ticks": lambda: time_optimal(hard),
        f"the same, least energy, {2 * ticks} ticks": lambda: least_energy(hard, 2 * ticks),
        f"least energy, {ticks + ticks // 2} ticks": lambda: least_energy(fast, ticks + ticks // 2),
        f"along a trajectory, {ticks} ticks": lambda: track(along, wanted, 0.02),
    }
    peer_s = best_s(lambda: _one_by_one(fast, found.ticks), repeats=1) if ticks == 200 else None
    return [
        line(what, best_s(work, repeats=3 if ticks == 200 else 1), TARGETS[ticks])
        if index or peer_s is None
        else line(what, best_s(work, repeats=3), TARGETS[ticks], "raising the length tick by tick", peer_s)
        for index, (what, work) in enumerate(works.items())
    ]


def _one_by_one(task: MoveTask, ticks: int) -> None:
    """Do what the paper does: raise the length until it is enough; here HiGHS says whether it is."""
    for length in range(len(task.rest.final), ticks + 1):
        rows, values, _ = Program(task, length).orthonormal
        linprog(np.zeros(length), A_eq=rows, b_eq=values, bounds=(-1.0, 1.0))


if __name__ == "__main__":
    for text in report():
        print(text)
