/*
 * time_optimal_oscillator: how to call the motion profile. Build and run:
 *   cc -std=c99 -ffp-contract=off time_optimal_oscillator_example.c time_optimal_oscillator_profile.c && ./a.out
 * Prints one move, tick by tick: reference, position, busy, done.
 */
#include <stdio.h>

#include "time_optimal_oscillator_profile.h"

static time_optimal_oscillator_profile_t profile; /* the caller owns the state */

int main(void)
{
    time_optimal_oscillator_profile_input_t input = { false, false, 0.0, 1.0 };
    time_optimal_oscillator_profile_output_t output;
    unsigned long tick;

    time_optimal_oscillator_profile_init(&profile);
    for (tick = 0u; tick < 60u; ++tick) {
        input.execute = true; /* its rising edge, here at the first tick, starts the move */
        time_optimal_oscillator_profile_step(&profile, &input, &output);
        (void)printf("%lu %.9g %.9g %d %d\n", tick, (double)output.reference, (double)output.position,
            output.busy ? 1 : 0, output.done ? 1 : 0);
    }
    return 0;
}
