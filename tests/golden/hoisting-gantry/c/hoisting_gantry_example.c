/*
 * hoisting_gantry: how to call the command shaper. Build and run:
 *   cc -std=c99 -ffp-contract=off hoisting_gantry_example.c hoisting_gantry_shaper.c && ./a.out
 * Prints one jog at full speed, tick by tick: command, reference, stop distance.
 */
#include <stdio.h>

#include "hoisting_gantry_shaper.h"

static hoisting_gantry_shaper_t shaper; /* the caller owns the state */

int main(void)
{
    hoisting_gantry_shaper_input_t input = { 0 };
    hoisting_gantry_shaper_output_t output;
    unsigned long tick;

    hoisting_gantry_shaper_init(&shaper);
    input.enable = true;
    input.selector = 1u;
    input.rope_length_m = 9.0;
    input.rope_length_valid = true;
    for (tick = 0u; tick < 2206u; ++tick) {
        input.command = (tick < 802u) ? 0.8 : 0.0;
        hoisting_gantry_shaper_step(&shaper, &input, &output);
        (void)printf("%lu %.9g %.9g %.9g\n", tick, input.command, output.reference,
            output.stop_distance);
    }
    return 0;
}
