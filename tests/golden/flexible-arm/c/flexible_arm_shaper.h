/*
 * flexible_arm: command shaper. The load does not swing when the drive follows the reference.
 *
 * Made by swayless 0.1.0 from flexible-arm.toml.
 * Design SHA-256 2881e9e0d002280fa2a9ce46864d431aa46c5ce5453f1a73e4328811ecb2973b.
 * This file is yours: use, change and ship it as you like.
 *
 * Tick 0.02 s, numbers in int32, law fixed (tick clock).
 * Commands in counts, at most 120000. Settled after 17 ticks without change.
 * Rows of the selector, and the residual vibration that each guarantees on these very taps:
 *   0 unshaped (ramped only)
 *   1 fast: zv for 4.5 Hz, damping ratio 0.01, duration 0.12 s
 *     at most 5 % from 4.35153 to 4.64904 Hz
 *     overtravel 0.0557686 m per m/s, peak factor 1
 *   2 robust: zvd for 4.5 Hz, damping ratio 0.01, duration 0.24 s
 *     at most 5 % from 3.83839 to 5.16978 Hz
 *     overtravel 0.11074 m per m/s, peak factor 1
 *   3 any part: ei2 for 4.5 Hz, damping ratio 0.01, duration 0.34 s
 *     at most 5 % from 2.85002 to 6.16936 Hz
 *     overtravel 0.165193 m per m/s, peak factor 1
 *
 * Call flexible_arm_shaper_init() once, then flexible_arm_shaper_step() once per tick.
 * State: 168 bytes at most, owned by the caller; no heap, globals or libm.
 * Work per tick: the taps of the row in use, at most 7; none when settled.
 *
 * NOT A SAFETY FUNCTION: limit switches, emergency stop and brakes must work without this block.
 * Nothing may limit, ramp or filter the reference on its way to the drive: it would undo the shaping.
 * Wind, pushes and a load that slips are beyond what a command can prevent.
 */
#ifndef FLEXIBLE_ARM_SHAPER_H
#define FLEXIBLE_ARM_SHAPER_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Commands, references and lengths: whole counts; lengths in mm, times in whole seconds, ratios in millionths.
typedef int32_t flexible_arm_real_t;

/// Length of a tick, in seconds: call flexible_arm_shaper_step() once per tick.
#define FLEXIBLE_ARM_SHAPER_TICK_S (0.02)
/// Number of rows besides row 0.
#define FLEXIBLE_ARM_SHAPER_ROWS (3)
/// Cells of the ring: the longest delay of any row, in ticks, and one.
#define FLEXIBLE_ARM_SHAPER_RING (18)
/// Upper bound of sizeof(flexible_arm_shaper_t), in bytes; checked when compiled.
#define FLEXIBLE_ARM_SHAPER_RAM (168)
/// First and last part of the SHA-256 of the design; the .c file refuses another header's.
#define FLEXIBLE_ARM_SHAPER_DESIGN (0x2881e9e0u)

/// Status: enable is false: row 0 (ramped, unshaped) is wanted.
#define FLEXIBLE_ARM_SHAPER_DISABLED ((uint32_t)1u << 0)
/// Status: row 0 is in use: the command is ramped, not shaped.
#define FLEXIBLE_ARM_SHAPER_UNSHAPED ((uint32_t)1u << 1)
/// Status: another row is wanted; it takes over when the block has settled.
#define FLEXIBLE_ARM_SHAPER_ROW_WAITS ((uint32_t)1u << 2)
/// Status: a new command waits until the block has settled.
#define FLEXIBLE_ARM_SHAPER_COMMAND_WAITS ((uint32_t)1u << 3)
/// Status: the command is beyond the maximum and was clamped to it.
#define FLEXIBLE_ARM_SHAPER_COMMAND_CLAMPED ((uint32_t)1u << 4)
/// Status: a command was not finite: counted as 0 until a finite 0 is commanded.
#define FLEXIBLE_ARM_SHAPER_COMMAND_INVALID ((uint32_t)1u << 5)
/// Status: the selector names no row: the last valid one is kept.
#define FLEXIBLE_ARM_SHAPER_SELECTOR_INVALID ((uint32_t)1u << 6)
/// Status: quick stop is latched until released, at rest, and the command is 0.
#define FLEXIBLE_ARM_SHAPER_QUICK_STOP ((uint32_t)1u << 7)
/// Status: emergency stop is latched until released and the command is 0.
#define FLEXIBLE_ARM_SHAPER_EMERGENCY_STOP ((uint32_t)1u << 8)
/// Status: the command is below the minimum and counts as 0.
#define FLEXIBLE_ARM_SHAPER_BELOW_MINIMUM ((uint32_t)1u << 9)
/// Status: inching: a small command from rest passes unshaped.
#define FLEXIBLE_ARM_SHAPER_INCHING ((uint32_t)1u << 10)

/// Inputs of one tick.
typedef struct {
    bool enable; ///< false: row 0 is wanted, ramped and unshaped
    bool emergency_stop; ///< reference 0 at once; latched until the command is 0
    bool quick_stop; ///< unshaped stop on its own ramp; latched until at rest and the command is 0
    flexible_arm_real_t command; ///< [counts] wanted speed; clamped to the maximum, and not finite counts as 0
    uint8_t selector; ///< 0 unshaped, 1 to 3 rows; anything else keeps the last valid one
} flexible_arm_shaper_input_t;

/// Outputs of one tick.
typedef struct {
    flexible_arm_real_t reference; ///< [counts] speed for the drive
    flexible_arm_real_t stop_distance; ///< [mm] signed way still to go if the command is 0 from the next tick on
    flexible_arm_real_t stop_time_s; ///< [s, rounded up] time until the reference is 0 then
    uint32_t stop_time_ticks; ///< [ticks] the same time
    flexible_arm_real_t residual_bound; ///< [millionths] residual vibration that the row guarantees; all of it when unshaped
    uint8_t row; ///< row in use
    bool settled; ///< nothing is pending: a row may change
    bool active; ///< the command is being shaped
    bool error; ///< an input cannot be right; the status says which
    uint32_t status; ///< one bit for each reason, see above
} flexible_arm_shaper_output_t;

/// State of one shaper. The caller owns it; nothing outside the two functions below may write to it.
typedef struct {
    int64_t pending; ///< sum of the references still to come
    int64_t carry; ///< what rounding owes the next reference, over 2^30
    flexible_arm_real_t base; ///< command of the last rest
    flexible_arm_real_t target; ///< target of the ramp
    flexible_arm_real_t command; ///< ramped command
    flexible_arm_real_t reference; ///< last reference
    flexible_arm_shaper_input_t input; ///< last inputs
    flexible_arm_shaper_output_t output; ///< last outputs
    flexible_arm_real_t ring[FLEXIBLE_ARM_SHAPER_RING]; ///< last ramped commands
    uint32_t head; ///< cell of the newest command
    uint32_t still_ticks; ///< ticks without change, up to the longest delay
    uint32_t status; ///< status bits of this tick
    uint8_t row; ///< row in use
    uint8_t selected_row; ///< last valid selector
    uint8_t wanted_row; ///< row that takes over when settled
    bool lapped; ///< the ring is full of commands since the last rest
    bool foretold; ///< settled, and the stop is foretold
    bool idle; ///< the last tick began and ended settled
    bool zero_commanded; ///< the command is a valid 0
    bool invalid; ///< a command was not finite
    bool quick; ///< quick stop is latched
    bool emergency; ///< emergency stop is latched
} flexible_arm_shaper_t;

/// Bring a shaper to the state after power-on: at rest at 0, row 0, nothing latched. Cost: O(1).
/// @param shaper not NULL; need not be initialised
void flexible_arm_shaper_init(flexible_arm_shaper_t *shaper);

/// Run one tick: read the inputs, write every output. Never blocks, never fails; cost: O(taps of the row).
/// @param shaper not NULL; initialised by flexible_arm_shaper_init()
/// @param input  not NULL; any value of any field is allowed, see there
/// @param output not NULL; written completely
void flexible_arm_shaper_step(flexible_arm_shaper_t *shaper, const flexible_arm_shaper_input_t *input,
    flexible_arm_shaper_output_t *output);

#ifdef __cplusplus
}
#endif

#endif
