/*
 * srtc_gantry_bank: how to call the command shaper. Build and run:
 *   cc -std=c99 -ffp-contract=off srtc_gantry_bank_example.c srtc_gantry_bank_shaper.c && ./a.out
 * Prints one jog at full speed, tick by tick: command, reference, stop distance.
 */
#include <stdio.h>

#include "srtc_gantry_bank_shaper.h"

static srtc_gantry_bank_shaper_t shaper; /* the caller owns the state */

int main(void)
{
    srtc_gantry_bank_shaper_input_t input = { 0 };
    srtc_gantry_bank_shaper_output_t output;
    unsigned long tick;

    srtc_gantry_bank_shaper_init(&shaper);
    input.enable = true;
    input.selector = 1u;
    for (tick = 0u; tick < 1100u; ++tick) {
        input.command = (tick < 400u) ? 0.5 : 0.0;
        srtc_gantry_bank_shaper_step(&shaper, &input, &output);
        (void)printf("%lu %.9g %.9g %.9g\n", tick, input.command, output.reference,
            output.stop_distance);
    }
    return 0;
}
