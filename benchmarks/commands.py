"""Whole commands as a user waits for them: each in a process of its own, the median of five runs."""

import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from benchmarks.timing import line

EXAMPLE = Path(__file__).parents[1] / "examples" / "srtc-gantry.toml"


def report() -> list[str]:
    """Time `--help` and a build of the gantry without compiling, beside an empty interpreter."""
    empty_s = _median_s([sys.executable, "-c", "pass"])
    numpy_s = _median_s([sys.executable, "-c", "import numpy, scipy.optimize, matplotlib.figure"])
    help_s = _median_s([sys.executable, "-m", "swayless", "--help"])
    with tempfile.TemporaryDirectory() as folder:
        build = ["build", str(EXAMPLE), "-o", f"{folder}/x", "--no-verify"]
        command = [sys.executable, "-m", "swayless", *build]
        build_s = _median_s(command)
    return [
        line("swayless --help", help_s, "0.3 s", "an empty interpreter", empty_s),
        line("swayless build of the gantry, --no-verify", build_s, "3 s", "importing its libraries", numpy_s),
    ]


def _median_s(command: list[str], runs: int = 5) -> float:
    times = []
    for _ in range(runs):
        start = time.perf_counter()
        subprocess.run(command, check=True, capture_output=True)
        times.append(time.perf_counter() - start)
    return statistics.median(times)
