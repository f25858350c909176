/*
 * double_pendulum: how to call the command shaper. Build and run:
 *   cc -std=c99 -ffp-contract=off double_pendulum_example.c double_pendulum_shaper.c && ./a.out
 * Prints one jog at full speed, tick by tick: command, reference, stop distance.
 */
#include <stdio.h>

#include "double_pendulum_shaper.h"

static double_pendulum_shaper_t shaper; /* the caller owns the state */

int main(void)
{
    double_pendulum_shaper_input_t input = { 0 };
    double_pendulum_shaper_output_t output;
    unsigned long tick;

    double_pendulum_shaper_init(&shaper);
    input.enable = true;
    input.selector = 1u;
    for (tick = 0u; tick < 1031u; ++tick) {
        input.command = (tick < 377u) ? 0.5f : 0.0f;
        double_pendulum_shaper_step(&shaper, &input, &output);
        (void)printf("%lu %.9g %.9g %.9g\n", tick, (double)input.command, (double)output.reference,
            (double)output.stop_distance);
    }
    return 0;
}
