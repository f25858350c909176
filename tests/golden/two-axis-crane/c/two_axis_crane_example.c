/*
 * two_axis_crane: one pendant and one task for all axes. Build and run:
 *   cc -std=c99 -ffp-contract=off two_axis_crane_example.c two_axis_crane_bridge_shaper.c two_axis_crane_trolley_shaper.c && ./a.out
 * Prints a jog of all axes at full speed, tick by tick: the references of bridge, trolley.
 */
#include <stdio.h>

#include "two_axis_crane_bridge_shaper.h"
#include "two_axis_crane_trolley_shaper.h"

typedef struct { /* what operator and sensors say in one tick */
    /* one for all axes */
    bool enable; /* false: row 0 is wanted, ramped and unshaped */
    bool emergency_stop; /* reference 0 at once; latched until the command is 0 */
    bool quick_stop; /* unshaped stop on its own ramp; latched until at rest and the command is 0 */
    uint8_t selector; /* 0 unshaped, 1 the row of the rope; anything else keeps the last valid one */
    two_axis_crane_bridge_real_t rope_length_m; /* [m] 3 to 9: clamped; the last one holds if it cannot be true */
    two_axis_crane_bridge_real_t hoist_speed_m_s; /* [m/s] rate of change of the length, positive when the load sinks; clamped */
    bool rope_length_valid; /* false: the rope length is not to be believed */
    /* bridge */
    two_axis_crane_bridge_real_t bridge_command; /* [m/s] wanted speed; clamped to the maximum, and not finite counts as 0 */
    /* trolley */
    two_axis_crane_trolley_real_t trolley_command; /* [m/s] wanted speed; clamped to the maximum, and not finite counts as 0 */
} two_axis_crane_pendant_t;

typedef struct { /* the blocks; the caller owns their state */
    two_axis_crane_bridge_shaper_t bridge;
    two_axis_crane_trolley_shaper_t trolley;
} two_axis_crane_axes_t;

typedef struct { /* what the blocks say, each for its own drive */
    two_axis_crane_bridge_shaper_output_t bridge;
    two_axis_crane_trolley_shaper_output_t trolley;
} two_axis_crane_drives_t;

static void two_axis_crane_init(two_axis_crane_axes_t *axes)
{
    two_axis_crane_bridge_shaper_init(&axes->bridge);
    two_axis_crane_trolley_shaper_init(&axes->trolley);
}

/* Once per tick of 0.01 s, from one task. */
static void two_axis_crane_step(two_axis_crane_axes_t *axes, const two_axis_crane_pendant_t *pendant, two_axis_crane_drives_t *drives)
{
    two_axis_crane_bridge_shaper_input_t bridge = { 0 };
    two_axis_crane_trolley_shaper_input_t trolley = { 0 };

    bridge.enable = pendant->enable;
    bridge.emergency_stop = pendant->emergency_stop;
    bridge.quick_stop = pendant->quick_stop;
    bridge.selector = pendant->selector;
    bridge.rope_length_m = pendant->rope_length_m;
    bridge.hoist_speed_m_s = pendant->hoist_speed_m_s;
    bridge.rope_length_valid = pendant->rope_length_valid;
    bridge.command = pendant->bridge_command;
    two_axis_crane_bridge_shaper_step(&axes->bridge, &bridge, &drives->bridge);

    trolley.enable = pendant->enable;
    trolley.emergency_stop = pendant->emergency_stop;
    trolley.quick_stop = pendant->quick_stop;
    trolley.selector = pendant->selector;
    trolley.rope_length_m = pendant->rope_length_m;
    trolley.hoist_speed_m_s = pendant->hoist_speed_m_s;
    trolley.rope_length_valid = pendant->rope_length_valid;
    trolley.command = pendant->trolley_command;
    two_axis_crane_trolley_shaper_step(&axes->trolley, &trolley, &drives->trolley);
}

int main(void)
{
    static two_axis_crane_axes_t axes;
    two_axis_crane_pendant_t pendant = { 0 };
    two_axis_crane_drives_t drives;
    unsigned long tick;

    two_axis_crane_init(&axes);
    pendant.enable = true;
    pendant.selector = 1u;
    pendant.rope_length_m = 9.0;
    pendant.rope_length_valid = true;
    for (tick = 0u; tick < 2300u; ++tick) {
        pendant.bridge_command = (tick < 900u) ? 1.0 : 0.0;
        pendant.trolley_command = (tick < 667u) ? 0.5 : 0.0;
        two_axis_crane_step(&axes, &pendant, &drives);
        (void)printf("%lu %.9g %.9g\n", tick, drives.bridge.reference, drives.trolley.reference);
    }
    return 0;
}
