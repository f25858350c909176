/*
 * elbow_arm: command shaper. The load does not swing when the drive follows the reference.
 *
 * Made by swayless 0.1.0 from elbow-arm.toml.
 * Design SHA-256 605d1038c623bd67b99374e11deaa54eeb52482668a35b29c342969bfe17d438.
 * This file is yours: use, change and ship it as you like.
 *
 * Tick 0.02 s, numbers in double, law modified (command shaping by a spacing).
 * Commands in m/s, at most 0.5. Settled after 12 ticks without change at the widest spacing.
 * Rows of the selector, and the residual vibration that each guarantees on these very taps:
 *   0 unshaped (ramped only)
 *   1 any reach: zvd at multiples of 4 to 6 ticks, damping ratio 0.01, duration 0.24 s at the widest spacing
 *     at most 10 % at every position of the range that is held still
 *     overtravel 0.118115 m per m/s at the widest spacing
 *
 * Taps are one spacing apart, half a period cut to whole ticks, looked up by the position on every
 * tick. A tap goes over to a new spacing when the commands that it would read by the old and by the
 * new one both want it: no tick has a gap or a surplus, after Magee and Book. Some commands are read
 * twice or never: a move during which the spacing changes is longer or shorter than commanded.
 * The stop distance is exact once the position has been still for the longest delay.
 * A position that is not valid, not finite or farther from the last one than the axis could have
 * moved is not taken: the last one holds, shaping goes on and a status bit says so. At rest every position
 * is taken.
 * Position 3.02 to 3.94 m, moved with at most 0.35 m/s.
 *
 * Call elbow_arm_shaper_init() once, then elbow_arm_shaper_step() once per tick.
 * State: 448 bytes at most, owned by the caller; no heap, globals or libm.
 * Work per tick: the taps of the row in use, at most 3, and 2 looks into the table of the spacing; none when settled.
 * Bit equality with the reference needs -ffp-contract=off, and no -ffast-math.
 *
 * NOT A SAFETY FUNCTION: limit switches, emergency stop and brakes must work without this block.
 * Nothing may limit, ramp or filter the reference on its way to the drive: it would undo the shaping.
 * Wind, pushes and a load that slips are beyond what a command can prevent.
 */
#ifndef ELBOW_ARM_SHAPER_H
#define ELBOW_ARM_SHAPER_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Commands, references and lengths: double, IEEE 754.
typedef double elbow_arm_real_t;

/// Length of a tick, in seconds: call elbow_arm_shaper_step() once per tick.
#define ELBOW_ARM_SHAPER_TICK_S (0.02)
/// Number of rows besides row 0.
#define ELBOW_ARM_SHAPER_ROWS (1)
/// Cells of the ring: the longest delay of any row at the widest spacing, in ticks, and one.
#define ELBOW_ARM_SHAPER_RING (13)
/// Taps of the longest row.
#define ELBOW_ARM_SHAPER_TAPS (3)
/// Upper bound of sizeof(elbow_arm_shaper_t), in bytes; checked when compiled.
#define ELBOW_ARM_SHAPER_RAM (448)
/// First and last part of the SHA-256 of the design; the .c file refuses another header's.
#define ELBOW_ARM_SHAPER_DESIGN (0x605d1038u)

/// Status: enable is false: row 0 (ramped, unshaped) is wanted.
#define ELBOW_ARM_SHAPER_DISABLED ((uint32_t)1u << 0)
/// Status: row 0 is in use: the command is ramped, not shaped.
#define ELBOW_ARM_SHAPER_UNSHAPED ((uint32_t)1u << 1)
/// Status: another row is wanted; it takes over when the block has settled.
#define ELBOW_ARM_SHAPER_ROW_WAITS ((uint32_t)1u << 2)
/// Status: a new command waits until the block has settled.
#define ELBOW_ARM_SHAPER_COMMAND_WAITS ((uint32_t)1u << 3)
/// Status: the command is beyond the maximum and was clamped to it.
#define ELBOW_ARM_SHAPER_COMMAND_CLAMPED ((uint32_t)1u << 4)
/// Status: a command was not finite: counted as 0 until a finite 0 is commanded.
#define ELBOW_ARM_SHAPER_COMMAND_INVALID ((uint32_t)1u << 5)
/// Status: the selector names no row: the last valid one is kept.
#define ELBOW_ARM_SHAPER_SELECTOR_INVALID ((uint32_t)1u << 6)
/// Status: quick stop is latched until released, at rest, and the command is 0.
#define ELBOW_ARM_SHAPER_QUICK_STOP ((uint32_t)1u << 7)
/// Status: emergency stop is latched until released and the command is 0.
#define ELBOW_ARM_SHAPER_EMERGENCY_STOP ((uint32_t)1u << 8)
/// Status: the command is below the minimum and counts as 0.
#define ELBOW_ARM_SHAPER_BELOW_MINIMUM ((uint32_t)1u << 9)
/// Status: inching: a small command from rest passes unshaped.
#define ELBOW_ARM_SHAPER_INCHING ((uint32_t)1u << 10)
/// Status: the position is not valid or not finite: the last one holds.
#define ELBOW_ARM_SHAPER_ROPE_INVALID ((uint32_t)1u << 11)
/// Status: the position is out of range and was clamped to it.
#define ELBOW_ARM_SHAPER_ROPE_OUT_OF_RANGE ((uint32_t)1u << 12)
/// Status: the position is farther off than the axis could move: the last one holds.
#define ELBOW_ARM_SHAPER_ROPE_JUMP ((uint32_t)1u << 13)
/// Status: the axis moves and the position does not: one of them is wrong.
#define ELBOW_ARM_SHAPER_ROPE_FROZEN ((uint32_t)1u << 14)
/// Status: the position speed is not finite and counts as 0.
#define ELBOW_ARM_SHAPER_HOIST_SPEED_INVALID ((uint32_t)1u << 15)

/// Inputs of one tick.
typedef struct {
    bool enable; ///< false: row 0 is wanted, ramped and unshaped
    bool emergency_stop; ///< reference 0 at once; latched until the command is 0
    bool quick_stop; ///< unshaped stop on its own ramp; latched until at rest and the command is 0
    elbow_arm_real_t command; ///< [m/s] wanted speed; clamped to the maximum, and not finite counts as 0
    uint8_t selector; ///< 0 unshaped, 1 the row; anything else keeps the last valid one
    elbow_arm_real_t position_m; ///< [m] 3.02 to 3.94: clamped; the last one holds if it cannot be true
    elbow_arm_real_t position_speed_m_s; ///< [m/s] rate of change of the position, positive when it grows; clamped
    bool position_valid; ///< false: the position is not to be believed
} elbow_arm_shaper_input_t;

/// Outputs of one tick.
typedef struct {
    elbow_arm_real_t reference; ///< [m/s] speed for the drive
    elbow_arm_real_t stop_distance; ///< [m] signed way still to go if the command is 0 from the next tick on
    elbow_arm_real_t stop_time_s; ///< [s] time until the reference is 0 then
    uint32_t stop_time_ticks; ///< [ticks] the same time
    elbow_arm_real_t residual_bound; ///< [ratio] residual vibration that the row guarantees; all of it when unshaped
    uint8_t row; ///< row in use
    bool settled; ///< nothing is pending: a row may change
    bool active; ///< the command is being shaped
    bool error; ///< an input cannot be right; the status says which
    uint32_t status; ///< one bit for each reason, see above
} elbow_arm_shaper_output_t;

/// State of one shaper. The caller owns it; nothing outside the two functions below may write to it.
typedef struct {
    elbow_arm_real_t lap_sum; ///< sum of the commands of the lap before
    uint32_t spacing; ///< ticks between taps
    uint32_t start_spacing; ///< the same when the last rest ended
    elbow_arm_real_t base; ///< command of the last rest
    elbow_arm_real_t target; ///< target of the ramp
    elbow_arm_real_t command; ///< ramped command
    elbow_arm_real_t reference; ///< last reference
    elbow_arm_real_t unmoved; ///< way of the axis while the position stayed
    elbow_arm_real_t position; ///< position believed
    elbow_arm_real_t position_speed; ///< position speed, clamped
    uint32_t held_ticks; ///< ticks for which no position was taken
    elbow_arm_shaper_input_t input; ///< last inputs
    elbow_arm_shaper_output_t output; ///< last outputs
    elbow_arm_real_t sums[ELBOW_ARM_SHAPER_RING]; ///< sum of the commands of this lap
    elbow_arm_real_t ring[ELBOW_ARM_SHAPER_RING]; ///< last ramped commands
    uint16_t spacings[ELBOW_ARM_SHAPER_RING]; ///< spacing of their ticks
    uint32_t delays[ELBOW_ARM_SHAPER_TAPS]; ///< ticks that each tap lags
    uint32_t head; ///< cell of the newest command
    uint32_t still_ticks; ///< ticks without change, up to the longest delay
    uint32_t status; ///< status bits of this tick
    uint8_t row; ///< row in use
    uint8_t selected_row; ///< last valid selector
    uint8_t wanted_row; ///< row that takes over when settled
    bool running; ///< commands within reach of the taps may differ
    bool lapped; ///< the ring is full of commands since the last rest
    bool foretold; ///< settled, and the stop is foretold
    bool idle; ///< the last tick began and ended settled
    bool zero_commanded; ///< the command is a valid 0
    bool invalid; ///< a command was not finite
    bool quick; ///< quick stop is latched
    bool emergency; ///< emergency stop is latched
    bool position_still; ///< the last reading of the position changed nothing
} elbow_arm_shaper_t;

/// Bring a shaper to the state after power-on: at rest at 0, row 0, nothing latched. Cost: O(1).
/// @param shaper not NULL; need not be initialised
void elbow_arm_shaper_init(elbow_arm_shaper_t *shaper);

/// Run one tick: read the inputs, write every output. Never blocks, never fails; cost: O(taps of the row).
/// @param shaper not NULL; initialised by elbow_arm_shaper_init()
/// @param input  not NULL; any value of any field is allowed, see there
/// @param output not NULL; written completely
void elbow_arm_shaper_step(elbow_arm_shaper_t *shaper, const elbow_arm_shaper_input_t *input,
    elbow_arm_shaper_output_t *output);

#ifdef __cplusplus
}
#endif

#endif
