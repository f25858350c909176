"""Count instructions of the profile C step on a Cortex-M4F: `python -m benchmarks.profile_instructions`.

Needs what `benchmarks.adaptive_instructions` needs. Every output is compared with the reference.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from benchmarks.adaptive_instructions import FLAGS, Machine
from swayless.codegen.profile_files import generate_profile
from swayless.codegen.profile_model import ProfileCode
from swayless.verify.profile_stimulus import profile_stimuli
from tests.compiled.profile_blocks import BLOCKS, block

TICKS = 4000
GLUE = """
#include "cart_profile.h"
cart_profile_t state; cart_profile_input_t input; cart_profile_output_t output;
void *memcpy(void *to, const void *from, unsigned n)
{ char *a = to; const char *b = from; while (n--) *a++ = *b++; return to; }
void *memset(void *to, int value, unsigned n) { char *a = to; while (n--) *a++ = (char)value; return to; }
void start(void) { cart_profile_init(&state); }
void step(void) { cart_profile_step(&state, &input, &output); }
void _start(void) { start(); step(); }
"""


def compiled(code: ProfileCode) -> bytes:
    """Compile the block for a Cortex-M4F."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for file in generate_profile(code, "c"):
            (folder / file.path).write_text(file.text)
        (folder / "glue.c").write_text(GLUE)
        sources = [str(folder / "glue.c"), str(folder / "cart_profile.c")]
        program = folder / "program.elf"
        zig = [sys.executable, "-m", "ziglang", "cc", *FLAGS.split(), "-Wl,--image-base=0x10000"]
        subprocess.run([*zig, *sources, "-o", str(program)], check=True)
        return program.read_bytes()


def main() -> None:
    """Print the instructions of each kind of block: in a move, after an abort, at rest, and at most."""
    for name in BLOCKS:
        code = block(name, "float")
        machine = Machine(compiled(code))
        machine.call("start")
        stimulus = next(each for each in profile_stimuli(code, 0) if each.name == "aborts")
        expected, counts = stimulus.expected[:TICKS], []
        for record, wanted in zip(stimulus.inputs[:TICKS], expected, strict=True):
            machine.core.mem_write(machine.symbols["input"], record.tobytes())
            counts.append(machine.call("step"))
            given = machine.core.mem_read(machine.symbols["output"], expected.dtype.itemsize)
            assert np.frombuffer(bytes(given), expected.dtype)[0] == wanted
        taken, stops = np.array(counts), expected["status"] >= 128
        moves = expected["busy"] & ~stops
        print(
            f"{name}: a tick of a move {int(np.median(taken[moves]))}, after an abort"
            f" {int(np.median(taken[stops]))}, at rest {int(np.median(taken[~expected['busy']]))},"
            f" at most {taken.max()}"
        )


if __name__ == "__main__":
    main()
