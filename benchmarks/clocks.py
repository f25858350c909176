"""The clocks in generated C, tick by tick: the phase clock and the modified law beside the tick clock.

All have the three taps of zvd, and a new command in every tick; the phase clock and the modified law on a
rope that is hoisted. Cycles of a tick are the least of many runs, without what else the machine does;
the worst tick is the most expensive one of those. Reading the counter is not counted.
"""

import ctypes
import tempfile
from pathlib import Path

import numpy as np

from swayless.cli.generate import provenance
from swayless.codegen import GeneratedFile, generate
from swayless.machine import load_machine
from swayless.machine.designing import design_machine
from swayless.machine.running import shaper_settings
from swayless.verify import find_compiler

MACHINE = """
name = "{name}"
[crane]
rope_length = [3, 9]
hoist_speed = 0.4
max_speed = 0.8
acceleration = 0.4
[drive]
counts_per_m_s = 1000000
[controller]
tick = "10 ms"
law = "{law}"
[[row]]
name = "row"
family = "zvd"
tolerance = "10 %"
{place}
"""
PLACES = {"fixed": "rope_length = 5", "phase": "", "modified": ""}
TICKS = 4000
RUNS = 200

LOOP = """
#include "@_shaper.h"
#include <time.h>
extern void run(unsigned long *least, long ticks, long runs);
static unsigned long cycles(void)
{
#if defined(__x86_64__)
    unsigned low, high;
    __asm__ volatile("lfence; rdtsc; lfence" : "=a"(low), "=d"(high) : : "memory");
    return ((unsigned long)high << 32) | low;
#else
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (unsigned long)now.tv_sec * 1000000000ul + (unsigned long)now.tv_nsec;
#endif
}
void run(unsigned long *least, long ticks, long runs)
{
    static @_shaper_t shaper;
    @_shaper_input_t input = { 0 };
    @_shaper_output_t output;
    unsigned long empty = 1000000ul; /* what reading the counter takes */
    long r, i;
    for (i = 0; i < 10000; ++i) {
        unsigned long before = cycles();
        unsigned long spent = cycles() - before;
        empty = (spent < empty) ? spent : empty;
    }
    for (r = 0; r < runs; ++r) {
        @_shaper_init(&shaper);
        input.enable = true;
        input.selector = 1u;
        for (i = 0; i < ticks; ++i) {
            unsigned long before, spent;
            long ramp = i % 500;
            input.command = (@_real_t)((double)(ramp < 250 ? ramp : 500 - ramp) / 250.0 * FULL);
            ROPE
            before = cycles();
            @_shaper_step(&shaper, &input, &output);
            spent = cycles() - before;
            spent = (spent > empty) ? spent - empty : 0ul;
            if ((r == 0) || (spent < least[i])) {
                least[i] = spent;
            }
        }
    }
}
"""
ROPE = """{
                long phase = i % 3000;
                double up = (phase < 1500) ? 0.3 : -0.3;
                double length = 4.0 + 0.003 * (double)((phase < 1500) ? phase : 3000 - phase);
                input.ROPE_LENGTH = (@_real_t)(length * SCALE);
                input.HOIST_SPEED = (@_real_t)(up * SCALE);
                input.rope_length_valid = true;
            }"""


def report() -> list[str]:
    """Count the cycles of each clock in each number type."""
    lines = []
    for number in ("double", "float", "int32"):
        mean, worst = _cycles("fixed", number)
        for law in ("phase", "modified"):
            its_mean, its_worst = _cycles(law, number)
            lines.append(
                f"a tick of law {law}, {number}: mean {its_mean / mean:.2f} and worst "
                f"{its_worst / worst:.2f} times the tick clock's ({mean:.0f} and {worst:.0f} cycles)"
            )
    return lines


def _cycles(law: str, number: str) -> tuple[float, float]:
    """Mean and largest cost of a tick."""
    name = f"bench_{law}"
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        (folder / "machine.toml").write_text(MACHINE.format(name=name, law=law, place=PLACES[law]))
        design = design_machine(load_machine(folder / "machine.toml"))
        settings = shaper_settings(design, number=number)
        files = generate(settings, provenance(design), "c")
        whole = settings.number.is_integer
        rope = "" if settings.rope is None else ROPE
        if settings.rope is not None:
            measured = settings.rope.measured
            rope = rope.replace("ROPE_LENGTH", measured.c_value(is_integer=whole))
            rope = rope.replace("HOIST_SPEED", measured.c_speed(is_integer=whole))
        loop = LOOP.replace("ROPE", rope).replace("SCALE", "1000.0" if whole else "1.0").replace("@", name)
        loop = loop.replace("FULL", repr(float(settings.limits.max_command)))
        for file in (*files, GeneratedFile("loop.c", loop)):
            (folder / file.path).write_text(file.text)
        library = folder / "loop.so"
        flags = ["-std=c99", "-D_POSIX_C_SOURCE=199309L", "-O2", "-ffp-contract=off", "-shared", "-fPIC"]
        sources = [str(folder / "loop.c"), str(folder / f"{name}_shaper.c")]
        find_compiler()._run([*flags, *sources, "-o", str(library)], "the benchmark", folder)
        least = np.zeros(TICKS, dtype=np.dtype("L"))
        ctypes.CDLL(str(library)).run(
            ctypes.c_void_p(least.ctypes.data), ctypes.c_long(TICKS), ctypes.c_long(RUNS)
        )
        moving = least[1000:]
        return float(moving.mean()), float(moving.max())
