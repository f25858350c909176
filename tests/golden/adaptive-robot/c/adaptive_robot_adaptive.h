/*
 * adaptive_robot: adaptive command shaper. It learns to leave no vibration from what it measures.
 *
 * Made by swayless 0.1.0 from adaptive-robot.toml.
 * This file is yours: use, change and ship it as you like.
 *
 * Three impulses, 25 ticks of 0.001 s apart. The
 * coefficients sum to exactly 1 and change only while the command has rested for two delays:
 * the reference is the command there.
 * The command passes unshaped for 4000 ticks after it has first moved.
 * Commands up to 1, references to 1 times it.
 * A vibration of 60 counts as 1: about what an unshaped move leaves.
 * A constant offset of the measurement does no harm; remove hum before.
 * After S. Rhim and W. J. Book, Adaptive command shaping, eqs 7-16.
 *
 * NOT A SAFETY FUNCTION: limit switches, emergency stop and brakes must work without this block.
 * Nothing may limit, ramp or filter the reference on its way to the drive: it undoes the shaping.
 *
 * Bit equality with the reference needs -ffp-contract=off. No heap, no library, no globals.
 */
#ifndef ADAPTIVE_ROBOT_ADAPTIVE_H
#define ADAPTIVE_ROBOT_ADAPTIVE_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Length of a tick, in seconds: call adaptive_robot_adaptive_step() once per tick.
#define ADAPTIVE_ROBOT_ADAPTIVE_TICK_S (0.001)
/// Ticks from one impulse to the next.
#define ADAPTIVE_ROBOT_ADAPTIVE_DELAY (25u)
/// Cells of each ring: two delays and the present sample.
#define ADAPTIVE_ROBOT_ADAPTIVE_RING (51u)
/// Upper bound of sizeof(adaptive_robot_adaptive_t), in bytes; checked when compiled.
#define ADAPTIVE_ROBOT_ADAPTIVE_RAM (1068u)

/// Status: enable is false: nothing is learned; from rest on the command is not shaped.
#define ADAPTIVE_ROBOT_ADAPTIVE_DISABLED ((uint32_t)1u << 0)
/// Status: the reference is the command: nothing learned yet, or in the first cycle.
#define ADAPTIVE_ROBOT_ADAPTIVE_UNSHAPED ((uint32_t)1u << 1)
/// Status: the command rests, and the vibration that is left is being learned from.
#define ADAPTIVE_ROBOT_ADAPTIVE_ADAPTING ((uint32_t)1u << 2)
/// Status: the coefficients fit what was last measured, or left nothing but noise.
#define ADAPTIVE_ROBOT_ADAPTIVE_CONVERGED ((uint32_t)1u << 3)
/// Status: the command is beyond the maximum and was clamped to it.
#define ADAPTIVE_ROBOT_ADAPTIVE_COMMAND_CLAMPED ((uint32_t)1u << 4)
/// Status: the command is not finite: the last one holds.
#define ADAPTIVE_ROBOT_ADAPTIVE_COMMAND_INVALID ((uint32_t)1u << 5)
/// Status: the vibration has sunk into noise or the dead zone: the coefficients stay.
#define ADAPTIVE_ROBOT_ADAPTIVE_FROZEN ((uint32_t)1u << 6)
/// Status: the coefficients did not fit the vibration: the past counts less now.
#define ADAPTIVE_ROBOT_ADAPTIVE_LEARNING_AGAIN ((uint32_t)1u << 7)
/// Status: the coefficients found would exceed the drive's limit: the old ones stay.
#define ADAPTIVE_ROBOT_ADAPTIVE_SET_REFUSED ((uint32_t)1u << 8)
/// Status: the vibration is not finite or too large: nothing is learned from it.
#define ADAPTIVE_ROBOT_ADAPTIVE_VIBRATION_INVALID ((uint32_t)1u << 9)

/// Inputs of one tick.
typedef struct {
    bool enable; ///< false: nothing is learned; from rest on the command is not shaped
    double command; ///< what the reference shall be; clamped to the maximum, and not finite holds the last
    double vibration; ///< measured vibration; not finite or too large is not learned from
} adaptive_robot_adaptive_input_t;

/// Outputs of one tick.
typedef struct {
    double reference; ///< for the drive, in the unit of the command
    double coefficient[3]; ///< amplitudes after 0, 1 and 2 delays; they sum to exactly 1
    bool adapting; ///< the command rests, and this tick is learned from
    bool converged; ///< the coefficients fit, or left nothing but noise
    bool frozen; ///< there is little but noise: the coefficients stay
    uint32_t status; ///< sum of the status bits
} adaptive_robot_adaptive_output_t;

/// Sums over samples v0, v1, v2 of the vibration, a delay apart: u = v0 - v1, w = v2 - v1, and e is what is
/// left of them by the coefficients learned.
typedef struct {
    double ee; ///< of e e
    double eu; ///< of e u
    double ew; ///< of e w
    double uu; ///< of u u
    double uw; ///< of u w
    double ww; ///< of w w
} adaptive_robot_adaptive_sums_t;

/// State of one shaper. The caller owns it; nothing outside the two functions below may write to it.
typedef struct {
    double commands[ADAPTIVE_ROBOT_ADAPTIVE_RING]; ///< ring
    double vibrations[ADAPTIVE_ROBOT_ADAPTIVE_RING]; ///< ring
    adaptive_robot_adaptive_sums_t window; ///< the present window
    adaptive_robot_adaptive_sums_t past; ///< all that has been learned
    double sum_e; ///< of e itself over the window
    double sum_u; ///< of u
    double sum_w; ///< of w
    double coefficient[3]; ///< learned
    double used[3]; ///< in use
    double command; ///< last valid
    double vibration; ///< last valid, scaled
    double left; ///< by the coefficients, over recent windows
    double noise; ///< over recent windows
    double samples; ///< of recent windows
    uint32_t head; ///< cell of the present sample
    uint32_t rest_ticks; ///< since the command has changed
    uint32_t quiet_ticks; ///< since it has changed or a reading was bad
    uint32_t moved_ticks; ///< since the command has first moved
    uint32_t window_ticks; ///< samples in the window
    uint32_t status; ///< bits
    bool shaping; ///< the coefficients are in use
    bool learned; ///< at least one window has taught
    bool converged; ///< as the output
    bool frozen; ///< as the output
    bool again; ///< learning again
    bool refused; ///< the last set was refused
    bool rough; ///< the last window was summed up around coefficients that did not fit
    bool fresh; ///< the window holds beginnings of rests and nothing else
    bool trusted; ///< the coefficients had converged when the command last moved
} adaptive_robot_adaptive_t;

/// Bring a shaper to the state after power-on: coefficients of 1/3, not in use. Cost: both rings.
/// @param shaper not NULL; need not be initialised
void adaptive_robot_adaptive_init(adaptive_robot_adaptive_t *shaper);

/// Run one tick: read the inputs, write every output. Never blocks, never fails; cost: bounded, independent of the delay.
/// @param shaper not NULL; initialised by adaptive_robot_adaptive_init()
/// @param input  not NULL; any value of any field is allowed, see there
/// @param output not NULL; written completely
void adaptive_robot_adaptive_step(adaptive_robot_adaptive_t *shaper, const adaptive_robot_adaptive_input_t *input,
    adaptive_robot_adaptive_output_t *output);

#ifdef __cplusplus
}
#endif

#endif
