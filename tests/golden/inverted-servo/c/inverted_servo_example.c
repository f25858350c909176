/*
 * inverted_servo: how to call the motion profile. Build and run:
 *   cc -std=c99 -ffp-contract=off inverted_servo_example.c inverted_servo_profile.c && ./a.out
 * Prints one move, tick by tick: reference, position, busy, done.
 */
#include <stdio.h>

#include "inverted_servo_profile.h"

static inverted_servo_profile_t profile; /* the caller owns the state */

int main(void)
{
    inverted_servo_profile_input_t input = { false, false, 0.0, 1.0 };
    inverted_servo_profile_output_t output;
    unsigned long tick;

    inverted_servo_profile_init(&profile);
    for (tick = 0u; tick < 1144u; ++tick) {
        input.execute = true; /* its rising edge, here at the first tick, starts the move */
        inverted_servo_profile_step(&profile, &input, &output);
        (void)printf("%lu %.9g %.9g %d %d\n", tick, (double)output.reference, (double)output.position,
            output.busy ? 1 : 0, output.done ? 1 : 0);
    }
    return 0;
}
