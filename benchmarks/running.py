"""What runs: a record shaped in numpy, and generated C, held and changing, beside scipy and plain code."""

import ctypes
import tempfile
from pathlib import Path

import numpy as np
from scipy.signal import lfilter, oaconvolve

from benchmarks.timing import best_s, line
from swayless.cli.generate import provenance
from swayless.codegen import GeneratedFile, generate
from swayless.controller import shaped
from swayless.machine import load_machine
from swayless.machine.designing import design_machine
from swayless.machine.running import shaper_settings
from swayless.verify import find_compiler

EXAMPLE = Path(__file__).parents[1] / "examples" / "srtc-gantry.toml"
SAMPLES = 100_000

LOOP = """
#include "srtc_gantry_shaper.h"
extern double run(int changing, long ticks, int selector);
double run(int changing, long ticks, int selector)
{
    static srtc_gantry_shaper_t shaper;
    static double ring[4096];
    srtc_gantry_shaper_input_t input = { 0 };
    srtc_gantry_shaper_output_t output;
    unsigned random = 1u;
    double sum = 0.0;
    long i;
    srtc_gantry_shaper_init(&shaper);
    input.enable = true;
    input.selector = (unsigned char)selector;
    input.command = 0.3;
    for (i = 0; i < ticks; ++i) {
        if (changing == 1) {
            /* a joystick in motion: a triangle of 500 ticks */
            input.command = (double)((i % 500) < 250 ? (i % 500) : (500 - (i % 500))) / 250.0 - 0.5;
        } else if (changing > 1) {
            random = random * 1664525u + 1013904223u;
            input.command = (double)(random >> 8) / 16777216.0 - 0.5;
        } else {
            /* held */
        }
        if (changing < 3) {
            srtc_gantry_shaper_step(&shaper, &input, &output);
            sum += output.reference;
        } else {
            /* a plain ring with modulo and three taps, without ramp, rows and stops */
            ring[i % 182] = input.command;
            sum += 0.25 * ring[i % 182] + 0.5 * ring[(i + 91) % 182] + 0.25 * ring[(i + 1) % 182];
        }
    }
    return sum;
}
"""


def report() -> list[str]:
    """Time the numpy path and the generated C."""
    design = design_machine(load_machine(EXAMPLE))
    settings = shaper_settings(design)
    taps = settings.bank.rows[0].taps
    commands = np.random.default_rng(1).normal(size=SAMPLES)
    dense = np.zeros(taps.longest_delay_ticks + 1)
    dense[taps.delays_ticks] = taps.amplitudes
    ours_s = best_s(lambda: shaped(taps, commands))
    dense_s = best_s(lambda: np.convolve(commands, dense))
    filter_s = best_s(lambda: lfilter(dense, 1.0, commands))
    overlap_s = best_s(lambda: oaconvolve(commands, dense))
    what = f"{SAMPLES} samples shaped in numpy"
    lines = [
        line(what, ours_s, "1 ms", "numpy.convolve", dense_s),
        line(what, ours_s, "1 ms", "scipy lfilter", filter_s),
        line(what, ours_s, "1 ms", "scipy oaconvolve", overlap_s),
    ]
    return lines + _generated(list(generate(settings, provenance(design), "c")))


def _generated(files: list[GeneratedFile]) -> list[str]:
    compiler = find_compiler()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for file in (*files, GeneratedFile("loop.c", LOOP)):
            (folder / file.path).write_text(file.text)
        library = folder / "loop.so"
        sources = [folder / "loop.c", folder / "srtc_gantry_shaper.c"]
        flags = ["-std=c99", "-O2", "-ffp-contract=off", "-shared", "-fPIC"]
        compiler._run([*flags, *map(str, sources), "-o", str(library)], "the benchmark", folder)
        run = ctypes.CDLL(str(library)).run
        run.restype = ctypes.c_double
        plain_s = best_s(lambda: run(3, SAMPLES, 0))
        held_s, moving_s, noisy_s = (best_s(lambda kind=kind: run(kind, SAMPLES, 1)) for kind in (0, 1, 2))
    peer = "a bare three-tap ring with modulo"
    return [
        line(f"{SAMPLES} ticks of generated C, command held", held_s, "1 ms", peer, plain_s),
        line(f"{SAMPLES} ticks of generated C, command moving", moving_s, "3 ms", peer, plain_s),
        line(f"{SAMPLES} ticks of generated C, command white noise", noisy_s, "3 ms", peer, plain_s),
    ]
