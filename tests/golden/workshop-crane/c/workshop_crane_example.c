/*
 * workshop_crane: how to call the command shaper. Build and run:
 *   cc -std=c99 -ffp-contract=off workshop_crane_example.c workshop_crane_shaper.c && ./a.out
 * Prints one jog at full speed, tick by tick: command, reference, stop distance.
 */
#include <stdio.h>

#include "workshop_crane_shaper.h"

static workshop_crane_shaper_t shaper; /* the caller owns the state */

int main(void)
{
    workshop_crane_shaper_input_t input = { 0 };
    workshop_crane_shaper_output_t output;
    unsigned long tick;

    workshop_crane_shaper_init(&shaper);
    input.enable = true;
    input.selector = 1u;
    for (tick = 0u; tick < 2859u; ++tick) {
        input.command = (tick < 1046u) ? 0.6666667f : 0.0f;
        workshop_crane_shaper_step(&shaper, &input, &output);
        (void)printf("%lu %.9g %.9g %.9g\n", tick, (double)input.command, (double)output.reference,
            (double)output.stop_distance);
    }
    return 0;
}
