/*
 * two_axis_crane_trolley: how to call the command shaper. Build and run:
 *   cc -std=c99 -ffp-contract=off two_axis_crane_trolley_example.c two_axis_crane_trolley_shaper.c && ./a.out
 * Prints one jog at full speed, tick by tick: command, reference, stop distance.
 */
#include <stdio.h>

#include "two_axis_crane_trolley_shaper.h"

static two_axis_crane_trolley_shaper_t shaper; /* the caller owns the state */

int main(void)
{
    two_axis_crane_trolley_shaper_input_t input = { 0 };
    two_axis_crane_trolley_shaper_output_t output;
    unsigned long tick;

    two_axis_crane_trolley_shaper_init(&shaper);
    input.enable = true;
    input.selector = 1u;
    input.rope_length_m = 9.0;
    input.rope_length_valid = true;
    input.step_size = 1u;
    input.drive_ready = true;
    input.speed_limit = 0.5;
    for (tick = 0u; tick < 1835u; ++tick) {
        input.command = ((tick > 0u) && (tick < 668u)) ? 0.5 : 0.0;
        two_axis_crane_trolley_shaper_step(&shaper, &input, &output);
        (void)printf("%lu %.9g %.9g %.9g\n", tick, input.command, output.reference,
            output.stop_distance);
    }
    return 0;
}
