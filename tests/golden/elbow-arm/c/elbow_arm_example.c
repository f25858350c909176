/*
 * elbow_arm: how to call the command shaper. Build and run:
 *   cc -std=c99 -ffp-contract=off elbow_arm_example.c elbow_arm_shaper.c && ./a.out
 * Prints one jog at full speed, tick by tick: command, reference, stop distance.
 */
#include <stdio.h>

#include "elbow_arm_shaper.h"

static elbow_arm_shaper_t shaper; /* the caller owns the state */

int main(void)
{
    elbow_arm_shaper_input_t input = { 0 };
    elbow_arm_shaper_output_t output;
    unsigned long tick;

    elbow_arm_shaper_init(&shaper);
    input.enable = true;
    input.selector = 1u;
    input.position_m = 3.94;
    input.position_valid = true;
    for (tick = 0u; tick < 86u; ++tick) {
        input.command = (tick < 37u) ? 0.5 : 0.0;
        elbow_arm_shaper_step(&shaper, &input, &output);
        (void)printf("%lu %.9g %.9g %.9g\n", tick, input.command, output.reference,
            output.stop_distance);
    }
    return 0;
}
