/*
 * adaptive_robot: how to call the adaptive shaper. Build and run:
 *   cc -std=c99 -ffp-contract=off adaptive_robot_example.c adaptive_robot_adaptive.c && ./a.out
 * Prints one step of the command, tick by tick: command, reference. Without vibration nothing is learned.
 */
#include <stdio.h>

#include "adaptive_robot_adaptive.h"

static adaptive_robot_adaptive_t shaper; /* the caller owns the state */

int main(void)
{
    adaptive_robot_adaptive_input_t input = { false, 0.0, 0.0 };
    adaptive_robot_adaptive_output_t output;
    unsigned long tick;

    adaptive_robot_adaptive_init(&shaper);
    input.enable = true;
    for (tick = 0u; tick < 204u; ++tick) {
        input.command = 1.0;
        input.vibration = 0.0; /* the accelerometer's reading goes here */
        adaptive_robot_adaptive_step(&shaper, &input, &output);
        (void)printf("%lu %.9g %.9g\n", tick, (double)input.command, (double)output.reference);
    }
    return 0;
}
