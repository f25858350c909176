"""How well and how fast swings with known truth are identified: `python -m benchmarks.identification`."""

import csv
import tempfile
import time
from pathlib import Path

import numpy as np

from benchmarks.timing import best_s, line
from swayless.machine.identified_record import Reading, read_swings
from swayless.machine.identified_table import load_table
from swayless.plant.identification import SwingRecord, identify_swing
from tests.unit.plant.identification.swings import random_record

RECORDS, SEED = 200, 2026
SAMPLES = 100_000


def report() -> list[str]:
    """Judge 200 records with known truth, and time a long one: identified, and read from a file as well."""
    return [*_judgement(), *_speed()]


def _judgement() -> list[str]:
    rng = np.random.default_rng(SEED)
    stated, allowed, times_s = [], [], []
    for _ in range(RECORDS):
        truth, record, bounds = random_record(rng)
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
        f"{RECORDS} swings, two stated standard deviations: frequency {within[0]:.1f} %, damping"
        f" {within[1]:.1f} %   target 92 %",
        f"{RECORDS} swings, 0.5 % or three Cramer-Rao bounds: frequency {inside[0]:.1f} %, damping"
        f" {inside[1]:.1f} %   expected of an ideal estimate 99.7 % to 100 %",
        line(f"one of {RECORDS} swings, median", float(np.median(times_s)), "50 ms"),
    ]


def _speed() -> list[str]:
    time_s = 1e-3 * np.arange(SAMPLES)
    noise = 0.1 * np.random.default_rng(SEED).normal(size=SAMPLES)
    record = SwingRecord(time_s, np.exp(-0.01 * time_s) * np.cos(3.0 * time_s) + noise)
    spectrum_s = best_s(lambda: np.fft.rfft(record.value, 2**18), repeats=5)
    ours_s = best_s(lambda: identify_swing(record), repeats=3)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "swing.csv")
        np.savetxt(path, np.column_stack([time_s, record.value]), "%.6g", ",", header="time_s,x", comments="")
        read_s = best_s(lambda: read_swings(load_table(path), Reading()), repeats=3)
        peer_s = best_s(lambda: _plain_csv(path), repeats=3)
    return [
        line(f"{SAMPLES:,} samples identified", ours_s, "1 s")
        + f" {ours_s / spectrum_s:8.1f} x the time of one Fourier transform of it",
        line(f"{SAMPLES:,} samples read from a file", read_s, "0.5 s", "csv.reader and float", peer_s),
    ]


def _plain_csv(path: Path) -> object:
    with path.open() as stream:
        rows = list(csv.reader(stream))
    return np.array([[float(cell) for cell in row] for row in rows[1:]])


if __name__ == "__main__":
    for text in report():
        print(text)
