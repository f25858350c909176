/*
 * flexible_arm: how to call the command shaper. Build and run:
 *   cc -std=c99 -ffp-contract=off flexible_arm_example.c flexible_arm_shaper.c && ./a.out
 * Prints one jog at full speed, tick by tick: command, reference, stop distance.
 */
#include <stdio.h>

#include "flexible_arm_shaper.h"

static flexible_arm_shaper_t shaper; /* the caller owns the state */

int main(void)
{
    flexible_arm_shaper_input_t input = { 0 };
    flexible_arm_shaper_output_t output;
    unsigned long tick;

    flexible_arm_shaper_init(&shaper);
    input.enable = true;
    input.selector = 1u;
    for (tick = 0u; tick < 73u; ++tick) {
        input.command = (tick < 28u) ? 120000 : 0;
        flexible_arm_shaper_step(&shaper, &input, &output);
        (void)printf("%lu %ld %ld %ld\n", tick, (long)input.command, (long)output.reference,
            (long)output.stop_distance);
    }
    return 0;
}
