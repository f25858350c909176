"""Count instructions of the adaptive C step on a Cortex-M4F: `python -m benchmarks.adaptive_instructions`.

Needs ziglang, as verification does, and `pip install unicorn`. Every output is compared with the reference.
"""

from __future__ import annotations

import struct
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from swayless.codegen.adaptive_files import generate_adaptive
from swayless.codegen.adaptive_model import AdaptiveModel
from swayless.controller import number_type
from swayless.controller.adaptive import AdaptiveSettings
from swayless.verify.adaptive import adaptive_stimuli, run_adaptive_reference

TICKS = 8000
RETURN = 0x3FFFF0
STACK = 0x20008000
GLUE = """
#include "robot_adaptive.h"
robot_adaptive_t state; robot_adaptive_input_t input; robot_adaptive_output_t output;
void *memcpy(void *to, const void *from, unsigned n)
{ char *a = to; const char *b = from; while (n--) *a++ = *b++; return to; }
void *memset(void *to, int value, unsigned n) { char *a = to; while (n--) *a++ = (char)value; return to; }
void start(void) { robot_adaptive_init(&state); }
void step(void) { robot_adaptive_step(&state, &input, &output); }
void _start(void) { start(); step(); }
"""
FLAGS = (
    "-target thumb-freestanding-eabihf -mcpu=cortex_m4+vfp4d16sp -O2 -ffp-contract=off -nostdlib -fno-builtin"
)


class Machine:
    """The program in an emulated Cortex-M4F."""

    def __init__(self, image: bytes) -> None:
        import unicorn
        from unicorn import arm_const

        self.registers = arm_const
        self.core = unicorn.Uc(unicorn.UC_ARCH_ARM, unicorn.UC_MODE_THUMB | unicorn.UC_MODE_MCLASS)
        self.core.ctl_set_cpu_model(arm_const.UC_CPU_ARM_CORTEX_M4)
        self.core.mem_map(0, 0x400000)
        self.core.mem_map(STACK - 0x8000, 0x10000)
        programs, sections = struct.unpack_from("<II", image, 28)
        counts = struct.unpack_from("<HHHH", image, 42)
        for index in range(counts[1]):
            kind, offset, address, _, size = struct.unpack_from("<5I", image, programs + 32 * index)
            if kind == 1:
                self.core.mem_write(address, image[offset : offset + size])
        headers = [struct.unpack_from("<10I", image, sections + 40 * n) for n in range(counts[3])]
        self.symbols = _symbols(image, headers)
        self.count = 0
        self.core.hook_add(unicorn.UC_HOOK_CODE, self._counted)

    def _counted(self, *_: Any) -> None:
        self.count += 1

    def call(self, name: str) -> int:
        """Call a function; give the instructions that it took."""
        self.core.reg_write(self.registers.UC_ARM_REG_SP, STACK)
        self.core.reg_write(self.registers.UC_ARM_REG_LR, RETURN | 1)
        self.count = 0
        self.core.emu_start(self.symbols[name] | 1, RETURN)
        return self.count


def _symbols(image: bytes, headers: list[tuple[int, ...]]) -> dict[str, int]:
    found = {}
    for table in (header for header in headers if header[1] == 2):
        names = headers[table[6]][4]
        for at in range(table[4], table[4] + table[5], 16):
            name, value = struct.unpack_from("<II", image, at)
            found[image[names + name : image.index(b"\0", names + name)].decode()] = value
    return found


def compiled(model: AdaptiveModel) -> bytes:
    """Compile the block for a Cortex-M4F."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for file in generate_adaptive(model, "c"):
            (folder / file.path).write_text(file.text)
        (folder / "glue.c").write_text(GLUE)
        sources = [str(folder / "glue.c"), str(folder / "robot_adaptive.c")]
        program = folder / "program.elf"
        zig = [sys.executable, "-m", "ziglang", "cc", *FLAGS.split(), "-Wl,--image-base=0x10000"]
        subprocess.run([*zig, *sources, "-o", str(program)], check=True)
        return program.read_bytes()


def main() -> None:
    """Print the instructions of each stimulus."""
    settings = AdaptiveSettings(25, 0.001, 1.0, 100.0, 4000, number=number_type("float"))
    machine = Machine(compiled(AdaptiveModel(settings, "robot", "swayless")))
    for stimulus in adaptive_stimuli(settings):
        inputs = stimulus.inputs[:TICKS]
        expected = run_adaptive_reference(settings, inputs)
        first, counts = machine.call("start"), []
        for record, wanted in zip(inputs, expected, strict=True):
            machine.core.mem_write(machine.symbols["input"], record.tobytes())
            counts.append(machine.call("step"))
            given = machine.core.mem_read(machine.symbols["output"], expected.dtype.itemsize)
            assert np.frombuffer(bytes(given), expected.dtype)[0] == wanted
        middle, most = int(np.median(counts)), max(counts)
        print(f"{stimulus.name}: init {first}, a tick {min(counts)} to {most}, median {middle}")


if __name__ == "__main__":
    main()
