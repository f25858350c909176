"""How well and how fast swings with known truth are identified: `python -m benchmarks.identification`."""

import csv
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

import numpy as np

from benchmarks.timing import best_s, line
from swayless.machine.identified_record import Reading, read_swings
from swayless.machine.identified_table import load_table
from swayless.plant.identification import Quantity, SwingRecord, identify_swing
from tests.unit.plant.identification.swings import Truth, pendulum_swing, random_record

RECORDS, SEED = 200, 2026
Drawn: TypeAlias = tuple[Truth, SwingRecord, np.ndarray]
SAMPLES = 100_000


def report() -> list[str]:
    """Judge 200 records with known truth of either kind, and time long ones: identified, and read as well."""
    return [
        *_judgement("waves", random_record),
        *_judgement("simulated loads on a rope", _random_load),
        *_speed(),
    ]


def _judgement(what: str, random: Callable[[np.random.Generator], Drawn]) -> list[str]:
    rng = np.random.default_rng(SEED)
    stated, allowed, times_s = [], [], []
    for _ in range(RECORDS):
        truth, record, bounds = random(rng)
        start = time.perf_counter()
        mode = identify_swing(record).modes[0]
        times_s.append(time.perf_counter() - start)
        errors = np.abs([mode.frequency_hz - truth.frequency_hz, mode.damping_ratio - truth.damping_ratio])
        limits = 0.005 * np.array([truth.frequency_hz, truth.damping_ratio])
        stated.append(errors <= 2.0 * np.array([mode.frequency_hz_std, mode.damping_ratio_std]))
        allowed.append(errors <= np.maximum(limits, 3.0 * bounds))
    within = 100.0 * np.mean(stated, axis=0)
    inside = 100.0 * np.mean(allowed, axis=0)
    return [
        f"{RECORDS} {what}, two stated standard deviations: frequency {within[0]:.1f} %, damping"
        f" {within[1]:.1f} %   target 92 %",
        f"{RECORDS} {what}, 0.5 % or three Cramer-Rao bounds: frequency {inside[0]:.1f} %, damping"
        f" {inside[1]:.1f} %   expected of an ideal estimate 99.7 % to 100 %",
        line(f"one of {RECORDS} {what}, median", float(np.median(times_s)), "50 ms"),
    ]


def _random_load(rng: np.random.Generator) -> Drawn:
    """Integrate a load that swings up to 40 degrees far; the bounds are those of a small swing like it."""
    angle_rad = np.radians(10.0 ** rng.uniform(0.0, np.log10(40.0)))
    truth = Truth(10.0 ** rng.uniform(-1.0, 0.0), 10.0 ** rng.uniform(-4.0, -1.0), angle_rad)
    swings = rng.uniform(5.0, 40.0)
    time_s = np.linspace(0.0, swings / truth.frequency_hz, int(30.0 * swings))
    noise = angle_rad * rng.choice([0.002, 0.2, rng.uniform(0.0, 0.2)])
    angle = pendulum_swing(time_s, truth.frequency_hz, truth.damping_ratio, angle_rad)
    value = angle + angle_rad * rng.normal() + noise * rng.normal(size=time_s.size)
    return truth, SwingRecord(time_s, value, Quantity.angle), truth.bounds(time_s, noise)


def _speed() -> list[str]:
    rng = np.random.default_rng(SEED)
    even_s, uneven_s = 1e-3 * np.arange(SAMPLES), np.sort(rng.uniform(0.0, 1e-3 * SAMPLES, SAMPLES))
    one = SwingRecord(even_s, _wave(rng, even_s, 3.0))
    records = {
        "one mode": one,
        "one mode of 19 Hz": SwingRecord(even_s, _wave(rng, even_s, 119.4)),
        "a load, two modes, uneven times, bent drift": SwingRecord(
            uneven_s,
            _wave(rng, uneven_s, 3.0) + 0.2 * np.cos(3.4 * uneven_s) + (uneven_s / 100.0) ** 2,
            Quantity.angle,
        ),
    }
    spectrum_s = best_s(lambda: np.fft.rfft(one.value, 2**18), repeats=5)
    took_s = {
        what: best_s(lambda each=each: identify_swing(each), repeats=3) for what, each in records.items()
    }
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "swing.csv")
        np.savetxt(path, np.column_stack([even_s, one.value]), "%.6g", ",", header="time_s,x", comments="")
        read_s = best_s(lambda: read_swings(load_table(path), Reading()), repeats=3)
        peer_s = best_s(lambda: _plain_csv(path), repeats=3)
    return [
        *(
            line(f"{SAMPLES:,} samples, {what}", ours_s, "1 s")
            + f" {ours_s / spectrum_s:8.1f} x the time of one Fourier transform of it"
            for what, ours_s in took_s.items()
        ),
        line(f"{SAMPLES:,} samples read from a file", read_s, "0.5 s", "csv.reader and float", peer_s),
    ]


def _wave(rng: np.random.Generator, time_s: np.ndarray, frequency_rad_s: float) -> np.ndarray:
    noise = 0.1 * rng.normal(size=time_s.size)
    return 0.2 * (np.exp(-0.01 * time_s) * np.cos(frequency_rad_s * time_s) + noise)


def _plain_csv(path: Path) -> object:
    with path.open() as stream:
        rows = list(csv.reader(stream))
    return np.array([[float(cell) for cell in row] for row in rows[1:]])


if __name__ == "__main__":
    for text in report():
        print(text)
