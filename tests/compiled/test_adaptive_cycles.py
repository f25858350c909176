"""A robot under generated adaptive shapers, with 5 % of noise: a thousand cycles in C, fewer in ST."""

import cmath
import math

import numpy as np
import pytest

from swayless.codegen.adaptive_files import generate_adaptive
from swayless.codegen.adaptive_model import AdaptiveModel
from swayless.codegen.render import GeneratedFile
from swayless.controller import number_type
from swayless.controller.adaptive import AdaptiveSettings, AdaptiveStatus
from swayless.plant.simulation.flexible_robot import FlexibleRobot
from swayless.verify import find_compiler
from swayless.verify.c_run import CompiledProgram
from swayless.verify.structured_text import load
from tests.unit.controller.adaptive_moves import LEFT, free_amplitude, trapezoids

TICK_S, NOISE = 0.004, 0.05
CYCLE, SCALE = trapezoids(TICK_S), free_amplitude(LEFT, TICK_S)
CYCLES = np.dtype(
    [("measured", float), ("vibration", float), ("coefficient", float, 3), ("status", np.uint32)], align=True
)
"""Of each cycle: mean squares of what is learned from, what is learned in the end, all bits of the status."""

DRIVER = """
#include <stdio.h>
#include <string.h>
#include "robot_adaptive.h"

int main(void)
{
    static robot_adaptive_t shaper;
    robot_adaptive_input_t input = { true, 0, 0 };
    robot_adaptive_output_t output;
    struct { double measured; double vibration; double coefficient[3]; uint32_t status; } cycle;
    double sample[2], speed = 0.0, re = 0.0, im = 0.0, vibration = 0.0;
    unsigned long tick = 0u, learned = 0u;

    robot_adaptive_init(&shaper);
    (void)memset(&cycle, 0, sizeof cycle);
    while (fread(sample, sizeof sample, 1u, stdin) == 1u) { /* command and noise */
        double before;
        input.command = (REAL)sample[0];
        input.vibration = (REAL)(vibration + sample[1]);
        robot_adaptive_step(&shaper, &input, &output);
        if (output.adapting) {
            cycle.measured += (vibration + sample[1]) * (vibration + sample[1]);
            cycle.vibration += vibration * vibration;
            ++learned;
        }
        cycle.status |= output.status;
        re += (double)output.reference - speed; /* the tip of the link, from tick to tick */
        speed = (double)output.reference;
        before = re;
        re = (re * TURN_RE) - (im * TURN_IM);
        im = (before * TURN_IM) + (im * TURN_RE);
        vibration = -((re * GAIN_IM) + (im * GAIN_RE));
        if (++tick == CYCLE_TICKS) {
            int n;
            for (n = 0; n < 3; ++n) {
                cycle.coefficient[n] = (double)output.coefficient[n];
            }
            cycle.measured /= (double)learned;
            cycle.vibration /= (double)learned;
            (void)fwrite(&cycle, sizeof cycle, 1u, stdout);
            (void)memset(&cycle, 0, sizeof cycle);
            tick = 0u;
            learned = 0u;
        }
    }
    return 0;
}
"""


def model_of(delay_ticks, number):
    settings = AdaptiveSettings(
        delay_ticks, TICK_S, 1.0, SCALE, CYCLE.size, max_reference=8.0, number=number_type(number)
    )
    return AdaptiveModel(settings, "robot", "swayless")


def driver(number):
    """The robot around the block, in C."""
    angular = LEFT.angular_frequency_rad_s
    pole = angular * complex(-LEFT.damping_ratio, math.sqrt(1.0 - LEFT.damping_ratio**2))
    turn, gain = cmath.exp(pole * TICK_S), pole * pole / pole.imag
    constants = {"TURN_RE": turn.real, "TURN_IM": turn.imag, "GAIN_RE": gain.real, "GAIN_IM": gain.imag}
    lines = [f"#define {name} ({value!r})" for name, value in constants.items()]
    lines += [f"#define REAL {number}", f"#define CYCLE_TICKS {CYCLE.size}u"]
    return GeneratedFile("harness.c", "\n".join(lines) + DRIVER)


def disturbed(cycles):
    """Command and noise of every tick."""
    noise = NOISE * SCALE * np.random.default_rng(1).standard_normal(cycles * CYCLE.size)
    return np.column_stack([np.tile(CYCLE, cycles), noise])


def check(cycles):
    """Down to the noise, and to stay there."""
    measured, vibration = (np.sqrt(cycles[name]) / (NOISE * SCALE) for name in ("measured", "vibration"))
    assert vibration[0] > 9.0
    assert measured[10:].max() < 2.0  # as asked
    assert vibration[10:].max() < 0.1
    assert ((cycles["status"][10:] & AdaptiveStatus.FROZEN) > 0).all()
    assert not (cycles["status"][10:] & (AdaptiveStatus.LEARNING_AGAIN | AdaptiveStatus.SET_REFUSED)).any()
    # It does not drift: not a bit changes in the last nine tenths.
    assert (cycles["coefficient"][cycles.size // 10 :] == cycles["coefficient"][-1]).all()


@pytest.mark.parametrize(("delay_ticks", "number"), [(3, "double"), (6, "double"), (6, "float")])
def test_in_c_the_residual_stays_within_twice_the_noise_for_a_thousand_cycles(delay_ticks, number):
    files = generate_adaptive(model_of(delay_ticks, number), "c")
    with CompiledProgram(files, driver(number), find_compiler(), CYCLES) as program:
        cycles = program.run(disturbed(1000))
    assert cycles.size == 1000
    check(cycles)


@pytest.mark.parametrize("number", ["double", "float"])
def test_in_structured_text_it_stays_so_for_twenty_cycles(number):
    (file,) = generate_adaptive(model_of(6, number), "st")
    block, robot, scalar = (
        load(file.text).instantiate(),
        FlexibleRobot(LEFT, TICK_S),
        number_type(number).scalar,
    )
    cycles, vibration = np.zeros(20, CYCLES), 0.0
    for row, samples in zip(cycles, np.split(disturbed(20), 20), strict=True):
        learned = 0
        for command, error in samples.tolist():
            measured = vibration + error
            pins = {"Enable": True, "Command": scalar(command), "Vibration": scalar(measured)}
            output = block.step(pins)
            if output["Adapting"]:
                row["measured"], row["vibration"] = (
                    row["measured"] + measured**2,
                    row["vibration"] + vibration**2,
                )
                learned += 1
            row["status"] |= output["Status"]
            vibration = robot.step(float(output["Reference"]))
        row["measured"], row["vibration"] = row["measured"] / learned, row["vibration"] / learned
        row["coefficient"] = [output[f"Coefficient{n}"] for n in range(3)]
    check(cycles)
