/*
 * srtc_gantry_bank: command shaper. The load does not swing when the drive follows the reference.
 *
 * Made by swayless 0.1.0 from srtc-gantry-bank.toml.
 * Design SHA-256 a1fb4bb25aa83870d92ad5a8debdbf85436a73e1770fe7b6b02b026542664ae0.
 * This file is yours: use, change and ship it as you like.
 *
 * Tick 0.01 s, numbers in double, law fixed (tick clock).
 * Commands in m/s, at most 0.5. Settled after 300 ticks without change.
 * Rows of the selector, and the residual vibration that each guarantees on these very taps:
 *   0 unshaped (ramped only)
 *   1 29-25 ft: fd for 0.174584 Hz, damping ratio 0, duration 3 s
 *     at most 5 % from 0.167639 to 0.181816 Hz (rope 7.51441 to 8.8392 m)
 *     overtravel 1.5 m per m/s, peak factor 5
 *     negative amplitudes: a new command waits until the block has settled, short jogs are stretched
 *   2 25-21 ft: fd for 0.189504 Hz, damping ratio 0, duration 3 s
 *     at most 5 % from 0.180552 to 0.198898 Hz (rope 6.27912 to 7.62 m)
 *     overtravel 1.5 m per m/s, peak factor 5
 *     negative amplitudes: a new command waits until the block has settled, short jogs are stretched
 *   3 21-16 ft: fd for 0.212465 Hz, damping ratio 0, duration 3 s
 *     at most 5 % from 0.196999 to 0.229141 Hz (rope 4.73101 to 6.4008 m)
 *     overtravel 1.5 m per m/s, peak factor 5
 *     negative amplitudes: a new command waits until the block has settled, short jogs are stretched
 *   4 16-9 ft: fd for 0.260605 Hz, damping ratio 0, duration 3 s
 *     at most 2.85191 % from 0.22569 to 0.30092 Hz (rope 2.7432 to 4.8768 m)
 *     overtravel 1.5 m per m/s, peak factor 7
 *     negative amplitudes: a new command waits until the block has settled, short jogs are stretched
 *
 * Call srtc_gantry_bank_shaper_init() once, then srtc_gantry_bank_shaper_step() once per tick.
 * State: 2552 bytes at most, owned by the caller; no heap, globals or libm.
 * Work per tick: the taps of the row in use, at most 11; none when settled.
 * Bit equality with the reference needs -ffp-contract=off, and no -ffast-math.
 *
 * NOT A SAFETY FUNCTION: limit switches, emergency stop and brakes must work without this block.
 * Nothing may limit, ramp or filter the reference on its way to the drive: it would undo the shaping.
 * Wind, off-centre pick-up and a slack rope are beyond what a command can prevent.
 */
#ifndef SRTC_GANTRY_BANK_SHAPER_H
#define SRTC_GANTRY_BANK_SHAPER_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Commands, references and lengths: double, IEEE 754.
typedef double srtc_gantry_bank_real_t;

/// Length of a tick, in seconds: call srtc_gantry_bank_shaper_step() once per tick.
#define SRTC_GANTRY_BANK_SHAPER_TICK_S (0.01)
/// Number of rows besides row 0.
#define SRTC_GANTRY_BANK_SHAPER_ROWS (4)
/// Cells of the ring: the longest delay of any row, in ticks, and one.
#define SRTC_GANTRY_BANK_SHAPER_RING (301)
/// Upper bound of sizeof(srtc_gantry_bank_shaper_t), in bytes; checked when compiled.
#define SRTC_GANTRY_BANK_SHAPER_RAM (2552)
/// First and last part of the SHA-256 of the design; the .c file refuses another header's.
#define SRTC_GANTRY_BANK_SHAPER_DESIGN (0xa1fb4bb2u)

/// Status: enable is false: row 0 (ramped, unshaped) is wanted.
#define SRTC_GANTRY_BANK_SHAPER_DISABLED ((uint32_t)1u << 0)
/// Status: row 0 is in use: the command is ramped, not shaped.
#define SRTC_GANTRY_BANK_SHAPER_UNSHAPED ((uint32_t)1u << 1)
/// Status: another row is wanted; it takes over when the block has settled.
#define SRTC_GANTRY_BANK_SHAPER_ROW_WAITS ((uint32_t)1u << 2)
/// Status: a new command waits until the block has settled.
#define SRTC_GANTRY_BANK_SHAPER_COMMAND_WAITS ((uint32_t)1u << 3)
/// Status: the command is beyond the maximum and was clamped to it.
#define SRTC_GANTRY_BANK_SHAPER_COMMAND_CLAMPED ((uint32_t)1u << 4)
/// Status: a command was not finite: counted as 0 until a finite 0 is commanded.
#define SRTC_GANTRY_BANK_SHAPER_COMMAND_INVALID ((uint32_t)1u << 5)
/// Status: the selector names no row: the last valid one is kept.
#define SRTC_GANTRY_BANK_SHAPER_SELECTOR_INVALID ((uint32_t)1u << 6)
/// Status: quick stop is latched until released, at rest, and the command is 0.
#define SRTC_GANTRY_BANK_SHAPER_QUICK_STOP ((uint32_t)1u << 7)
/// Status: emergency stop is latched until released and the command is 0.
#define SRTC_GANTRY_BANK_SHAPER_EMERGENCY_STOP ((uint32_t)1u << 8)
/// Status: the command is below the minimum and counts as 0.
#define SRTC_GANTRY_BANK_SHAPER_BELOW_MINIMUM ((uint32_t)1u << 9)
/// Status: inching: a small command from rest passes unshaped.
#define SRTC_GANTRY_BANK_SHAPER_INCHING ((uint32_t)1u << 10)

/// Inputs of one tick.
typedef struct {
    bool enable; ///< false: row 0 is wanted, ramped and unshaped
    bool emergency_stop; ///< reference 0 at once; latched until the command is 0
    bool quick_stop; ///< unshaped stop on its own ramp; latched until at rest and the command is 0
    srtc_gantry_bank_real_t command; ///< [m/s] wanted speed; clamped to the maximum, and not finite counts as 0
    uint8_t selector; ///< 0 unshaped, 1 to 4 rows; anything else keeps the last valid one
} srtc_gantry_bank_shaper_input_t;

/// Outputs of one tick.
typedef struct {
    srtc_gantry_bank_real_t reference; ///< [m/s] speed for the drive
    srtc_gantry_bank_real_t stop_distance; ///< [m] signed way still to go if the command is 0 from the next tick on
    srtc_gantry_bank_real_t stop_time_s; ///< [s] time until the reference is 0 then
    uint32_t stop_time_ticks; ///< [ticks] the same time
    srtc_gantry_bank_real_t residual_bound; ///< [ratio] residual vibration that the row guarantees; all of it when unshaped
    uint8_t row; ///< row in use
    bool settled; ///< nothing is pending: a row may change
    bool active; ///< the command is being shaped
    bool error; ///< an input cannot be right; the status says which
    uint32_t status; ///< one bit for each reason, see above
} srtc_gantry_bank_shaper_output_t;

/// State of one shaper. The caller owns it; nothing outside the two functions below may write to it.
typedef struct {
    srtc_gantry_bank_real_t pending; ///< sum of the references still to come
    srtc_gantry_bank_real_t fresh; ///< the same from the commands of this lap alone
    srtc_gantry_bank_real_t base; ///< command of the last rest
    srtc_gantry_bank_real_t target; ///< target of the ramp
    srtc_gantry_bank_real_t command; ///< ramped command
    srtc_gantry_bank_real_t reference; ///< last reference
    srtc_gantry_bank_shaper_input_t input; ///< last inputs
    srtc_gantry_bank_shaper_output_t output; ///< last outputs
    srtc_gantry_bank_real_t ring[SRTC_GANTRY_BANK_SHAPER_RING]; ///< last ramped commands
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
} srtc_gantry_bank_shaper_t;

/// Bring a shaper to the state after power-on: at rest at 0, row 0, nothing latched. Cost: O(1).
/// @param shaper not NULL; need not be initialised
void srtc_gantry_bank_shaper_init(srtc_gantry_bank_shaper_t *shaper);

/// Run one tick: read the inputs, write every output. Never blocks, never fails; cost: O(taps of the row).
/// @param shaper not NULL; initialised by srtc_gantry_bank_shaper_init()
/// @param input  not NULL; any value of any field is allowed, see there
/// @param output not NULL; written completely
void srtc_gantry_bank_shaper_step(srtc_gantry_bank_shaper_t *shaper, const srtc_gantry_bank_shaper_input_t *input,
    srtc_gantry_bank_shaper_output_t *output);

#ifdef __cplusplus
}
#endif

#endif
