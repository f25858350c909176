"""The design room beside what one writes first. Alone: `python benchmarks/design.py`."""

import numpy as np
from scipy.optimize import root

from benchmarks.timing import best_s, line
from swayless.design import FAMILIES, Family, Shaper, design_shaper, guarantee_of, residual_vibration
from swayless.plant import Mode

FREQUENCIES_HZ = np.linspace(0.0, 4.0, 10_000)
TOLERANCE = 0.05
MODE = Mode(1.0, 0.1)
PARAMETERS = {"zvm": {"order": 5}, "oatf": {"delay_s": 0.3}}
SOLVED = ("ei", "ei2", "ei3", "um-zv", "um-zvd", "um-ei")


def report() -> list[str]:
    """Time the sensitivity of a shaper, and every family: its impulses alone, and with the proven band."""
    designs = [text for family in FAMILIES.values() for text in _family(family)]
    return [*_sensitivity(0.0), *_sensitivity(0.05), *designs]


def _sensitivity(damping_ratio: float) -> list[str]:
    shaper = design_shaper("ei3", Mode(1.0, damping_ratio))
    ours_s = best_s(lambda: residual_vibration(shaper, FREQUENCIES_HZ, damping_ratio=damping_ratio))
    broadcast_s = best_s(lambda: _broadcast(shaper, damping_ratio))
    loop_s = best_s(lambda: _loop(shaper, damping_ratio), repeats=3)
    what = f"10,000 frequencies, 5 impulses, damping {damping_ratio}"
    return [
        line(what, ours_s, "1.5 ms", "one broadcast complex exp", broadcast_s),
        line(what, ours_s, "1.5 ms", "a loop over frequencies", loop_s),
    ]


def _broadcast(shaper: Shaper, damping_ratio: float) -> np.ndarray:
    angular = 2.0 * np.pi * FREQUENCIES_HZ[:, np.newaxis]
    pole = angular * (damping_ratio + 1j * np.sqrt(1.0 - damping_ratio**2))
    phasors = np.exp(pole * shaper.times_s) @ shaper.amplitudes
    return np.exp(-damping_ratio * angular[:, 0] * shaper.times_s[-1]) * np.abs(phasors)


def _loop(shaper: Shaper, damping_ratio: float) -> list[float]:
    values = []
    for frequency_hz in FREQUENCIES_HZ:
        angular = 2.0 * np.pi * frequency_hz
        growth = shaper.amplitudes * np.exp(damping_ratio * angular * shaper.times_s)
        phase = angular * np.sqrt(1.0 - damping_ratio**2) * shaper.times_s
        size = np.hypot(growth @ np.cos(phase), growth @ np.sin(phase))
        values.append(np.exp(-damping_ratio * angular * shaper.times_s[-1]) * size)
    return values


def _family(family: Family) -> list[str]:
    name, parameters = family.name, PARAMETERS.get(family.name, {})
    own = {**parameters, **({"tolerance": TOLERANCE} if "tolerance" in family.parameters else {})}
    solve_s = best_s(lambda: family.solve(MODE, **own))
    whole_s = best_s(lambda: design_shaper(name, MODE, tolerance=TOLERANCE, **parameters))
    proof = line(f"{name}: the same with its proven band", whole_s, "-")
    if name not in SOLVED:
        return [line(f"{name}: impulses, closed form", solve_s, "50 us"), proof]
    peer = _Naive(name)
    verdict = "same root" if peer.agrees() else "not the root"
    what = f"{name}: impulses, solved"
    return [line(what, solve_s, "1 ms", f"scipy root ({verdict})", best_s(peer.solve, repeats=3)), proof]


class _Naive:
    """The same equations for a general solver, from undamped impulses scaled by the decay between them."""

    def __init__(self, name: str) -> None:
        self.exact = design_shaper(name, MODE, tolerance=TOLERANCE)
        self.fixed = name.startswith("um")
        self.double = name == "um-zvd"
        undamped = design_shaper(name, Mode(MODE.frequency_hz), tolerance=TOLERANCE)
        times_s = undamped.times_s * MODE.damped_period_s * MODE.frequency_hz
        scaled = undamped.amplitudes * np.exp(-MODE.damping_ratio * MODE.angular_frequency_rad_s * times_s)
        amplitudes = np.empty(0) if self.fixed else scaled / scaled.sum()
        zeros, humps = _marks(undamped)
        self.zero_at_mode, self.hump_at_mode = (bool(np.any(np.abs(m - 1.0) < 1e-3)) for m in (zeros, humps))
        zeros, humps = (marks[np.abs(marks - 1.0) >= 1e-3] for marks in (zeros, humps))
        self.cuts = np.cumsum([amplitudes.size, times_s.size - 1, zeros.size])
        self.start = np.concatenate([amplitudes, times_s[1:], zeros, humps])

    def solve(self) -> np.ndarray:
        return root(self._residuals, self.start).x

    def agrees(self) -> bool:
        times_s = np.split(self.solve(), self.cuts)[1]
        return bool(np.allclose(times_s, self.exact.times_s[1:], atol=1e-6))

    def _residuals(self, unknowns: np.ndarray) -> np.ndarray:
        amplitudes, times_s, zeros, humps = np.split(unknowns, self.cuts)
        impulses = self.exact.amplitudes if self.fixed else amplitudes
        times_s = np.concatenate([[0.0], times_s])
        zeros = np.append(zeros, [1.0] * self.zero_at_mode)
        humps = np.append(humps, [1.0] * self.hump_at_mode)
        zero, zero_slope = _phasor(impulses, times_s, zeros)
        hump, hump_slope = _phasor(impulses, times_s, humps)
        parts = [zero.real, zero.imag, np.abs(hump) - TOLERANCE, (hump.conj() * hump_slope).real]
        parts += [zero_slope.real, zero_slope.imag] if self.double else []
        parts += [] if self.fixed else [[impulses.sum() - 1.0]]
        return np.concatenate(parts)


def _phasor(
    amplitudes: np.ndarray, times_s: np.ndarray, frequency_hz: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    pole = 2.0 * np.pi * complex(MODE.damping_ratio, np.sqrt(1.0 - MODE.damping_ratio**2))
    lag_s = times_s - times_s[-1]
    terms = amplitudes * np.exp(pole * frequency_hz[:, np.newaxis] * lag_s)
    return terms.sum(axis=1), pole * terms @ lag_s


def _marks(shaper: Shaper) -> tuple[np.ndarray, np.ndarray]:
    """Places of zeros and humps of an undamped shaper in its band, to the grid they are read on."""
    band = guarantee_of(shaper, Mode(1.0), tolerance=TOLERANCE).band
    frequency_hz = np.linspace(band.low_hz, band.high_hz, 20_001)
    ratio = residual_vibration(shaper, frequency_hz)
    before, here, after = ratio[:-2], ratio[1:-1], ratio[2:]
    inner_hz = frequency_hz[1:-1]
    return inner_hz[(here < before) & (here <= after)], inner_hz[(here > before) & (here >= after)]


if __name__ == "__main__":
    print("\n".join(report()))
