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
    uint8_t step_size; /* 1 to 3: a step of 0.05, 0.1 or 0.25 m; else none */
    two_axis_crane_bridge_real_t rope_offset_m; /* [m] added to the measured rope length, 0 to 2: clamped */
    /* bridge */
    two_axis_crane_bridge_real_t bridge_command; /* [m/s] wanted speed; clamped to the maximum, and not finite counts as 0 */
    bool bridge_step_forward; /* an edge is a step; it counts only after the input was seen false */
    bool bridge_step_reverse; /* an edge is a step; it counts only after the input was seen false */
    bool bridge_stop_forward; /* true: the stop switch at that end is made; motion towards it ends, the way back is open */
    bool bridge_stop_reverse; /* true: the stop switch at that end is made; motion towards it ends, the way back is open */
    bool bridge_slow_forward; /* true: the slow-down switch before that end is made; at most 0.1 m/s towards it */
    bool bridge_slow_reverse; /* true: the slow-down switch before that end is made; at most 0.1 m/s towards it */
    two_axis_crane_bridge_real_t bridge_distance_forward_m; /* [m] way left to that end when the tick begins; it stops 0.5 m before */
    two_axis_crane_bridge_real_t bridge_distance_reverse_m; /* [m] way left to that end when the tick begins; it stops 0.5 m before */
    bool bridge_distance_valid; /* false: the distances are not to be believed */
    bool bridge_drive_ready; /* false: the drive does not follow; the reference is 0 */
    two_axis_crane_bridge_real_t bridge_actual_speed; /* [m/s] speed of the drive */
    two_axis_crane_bridge_real_t bridge_speed_limit; /* [m/s] largest command from now on, 0 to 1: clamped */
    /* trolley */
    two_axis_crane_trolley_real_t trolley_command; /* [m/s] wanted speed; clamped to the maximum, and not finite counts as 0 */
    bool trolley_step_forward; /* an edge is a step; it counts only after the input was seen false */
    bool trolley_step_reverse; /* an edge is a step; it counts only after the input was seen false */
    bool trolley_stop_forward; /* true: the stop switch at that end is made; motion towards it ends, the way back is open */
    bool trolley_stop_reverse; /* true: the stop switch at that end is made; motion towards it ends, the way back is open */
    bool trolley_slow_forward; /* true: the slow-down switch before that end is made; at most 0.1 m/s towards it */
    bool trolley_slow_reverse; /* true: the slow-down switch before that end is made; at most 0.1 m/s towards it */
    bool trolley_drive_ready; /* false: the drive does not follow; the reference is 0 */
    two_axis_crane_trolley_real_t trolley_actual_speed; /* [m/s] speed of the drive */
    two_axis_crane_trolley_real_t trolley_speed_limit; /* [m/s] largest command from now on, 0 to 0.5: clamped */
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
    bridge.step_size = pendant->step_size;
    bridge.rope_offset_m = pendant->rope_offset_m;
    bridge.command = pendant->bridge_command;
    bridge.step_forward = pendant->bridge_step_forward;
    bridge.step_reverse = pendant->bridge_step_reverse;
    bridge.stop_forward = pendant->bridge_stop_forward;
    bridge.stop_reverse = pendant->bridge_stop_reverse;
    bridge.slow_forward = pendant->bridge_slow_forward;
    bridge.slow_reverse = pendant->bridge_slow_reverse;
    bridge.distance_forward_m = pendant->bridge_distance_forward_m;
    bridge.distance_reverse_m = pendant->bridge_distance_reverse_m;
    bridge.distance_valid = pendant->bridge_distance_valid;
    bridge.drive_ready = pendant->bridge_drive_ready;
    bridge.actual_speed = pendant->bridge_actual_speed;
    bridge.speed_limit = pendant->bridge_speed_limit;
    two_axis_crane_bridge_shaper_step(&axes->bridge, &bridge, &drives->bridge);

    trolley.enable = pendant->enable;
    trolley.emergency_stop = pendant->emergency_stop;
    trolley.quick_stop = pendant->quick_stop;
    trolley.selector = pendant->selector;
    trolley.rope_length_m = pendant->rope_length_m;
    trolley.hoist_speed_m_s = pendant->hoist_speed_m_s;
    trolley.rope_length_valid = pendant->rope_length_valid;
    trolley.step_size = pendant->step_size;
    trolley.rope_offset_m = pendant->rope_offset_m;
    trolley.command = pendant->trolley_command;
    trolley.step_forward = pendant->trolley_step_forward;
    trolley.step_reverse = pendant->trolley_step_reverse;
    trolley.stop_forward = pendant->trolley_stop_forward;
    trolley.stop_reverse = pendant->trolley_stop_reverse;
    trolley.slow_forward = pendant->trolley_slow_forward;
    trolley.slow_reverse = pendant->trolley_slow_reverse;
    trolley.drive_ready = pendant->trolley_drive_ready;
    trolley.actual_speed = pendant->trolley_actual_speed;
    trolley.speed_limit = pendant->trolley_speed_limit;
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
    pendant.step_size = 1u;
    pendant.bridge_distance_forward_m = 34.5;
    pendant.bridge_distance_reverse_m = 34.5;
    pendant.bridge_distance_valid = true;
    pendant.bridge_drive_ready = true;
    pendant.bridge_speed_limit = 1.0;
    pendant.trolley_drive_ready = true;
    pendant.trolley_speed_limit = 0.5;
    for (tick = 0u; tick < 2301u; ++tick) {
        pendant.bridge_command = ((tick > 0u) && (tick < 901u)) ? 1.0 : 0.0;
        pendant.trolley_command = ((tick > 0u) && (tick < 668u)) ? 0.5 : 0.0;
        two_axis_crane_step(&axes, &pendant, &drives);
        (void)printf("%lu %.9g %.9g\n", tick, drives.bridge.reference, drives.trolley.reference);
    }
    return 0;
}
