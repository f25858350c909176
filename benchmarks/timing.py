"""Time a piece of work: the least of several runs, what the machine does when it is not disturbed."""

import time
from collections.abc import Callable


def best_s(work: Callable[[], object], *, repeats: int = 7, at_least_s: float = 0.02) -> float:
    """Seconds of one call: the best of `repeats` rounds that last at least `at_least_s` each."""
    work()
    calls = 1
    while True:
        start = time.perf_counter()
        for _ in range(calls):
            work()
        took_s = time.perf_counter() - start
        if took_s >= at_least_s:
            break
        calls *= 2
    rounds = [took_s]
    for _ in range(repeats - 1):
        start = time.perf_counter()
        for _ in range(calls):
            work()
        rounds.append(time.perf_counter() - start)
    return min(rounds) / calls


def line(what: str, ours_s: float, target: str, peer: str = "", peer_s: float | None = None) -> str:
    """One line of a report, with the ratio to a peer measured in the same run."""
    text = f"{what:<58} {_time(ours_s):>10}   target {target:<8}"
    return text if peer_s is None else f"{text} {peer_s / ours_s:8.1f} x faster than {peer} ({_time(peer_s)})"


def _time(seconds: float) -> str:
    for unit, size in (("s", 1.0), ("ms", 1e-3)):
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds / 1e-6:.3g} us"
