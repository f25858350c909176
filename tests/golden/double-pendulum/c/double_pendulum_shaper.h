/*
 * double_pendulum: command shaper. The load does not swing when the drive follows the reference.
 *
 * Made by swayless 0.1.0 from double-pendulum.toml.
 * Design SHA-256 2d68b8f32fb8aeeadf58340bfd79ac62b982e693e1f00149d26e9000aa4c7279.
 * This file is yours: use, change and ship it as you like.
 *
 * Tick 0.02 s, numbers in float, law fixed (tick clock).
 * Commands in m/s, at most 0.5. Settled after 277 ticks without change.
 * Rows of the selector, and the residual vibration that each guarantees on these very taps:
 *   0 unshaped (ramped only)
 *   1 hook low: si for 0.162598 Hz, damping ratio 0.005, duration 4.7 s
 *     at most 5 % from 0.154367 to 0.171267 and from 0.656948 to 0.683724 Hz
 *     overtravel 2.31748 m per m/s, peak factor 1
 *   2 any rope: si for 0.17344 Hz, damping ratio 0.005, duration 5.54 s
 *     at most 5 % from 0.154367 to 0.19487 and from 0.656948 to 0.735961 Hz
 *     overtravel 2.73431 m per m/s, peak factor 1
 *
 * Call double_pendulum_shaper_init() once, then double_pendulum_shaper_step() once per tick.
 * State: 1200 bytes at most, owned by the caller; no heap, globals or libm.
 * Work per tick: the taps of the row in use, at most 8; none when settled.
 * Bit equality with the reference needs -ffp-contract=off, and no -ffast-math.
 *
 * NOT A SAFETY FUNCTION: limit switches, emergency stop and brakes must work without this block.
 * Nothing may limit, ramp or filter the reference on its way to the drive: it would undo the shaping.
 * Wind, off-centre pick-up and a slack rope are beyond what a command can prevent.
 */
#ifndef DOUBLE_PENDULUM_SHAPER_H
#define DOUBLE_PENDULUM_SHAPER_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Commands, references and lengths: float, IEEE 754.
typedef float double_pendulum_real_t;

/// Length of a tick, in seconds: call double_pendulum_shaper_step() once per tick.
#define DOUBLE_PENDULUM_SHAPER_TICK_S (0.02)
/// Number of rows besides row 0.
#define DOUBLE_PENDULUM_SHAPER_ROWS (2)
/// Cells of the ring: the longest delay of any row, in ticks, and one.
#define DOUBLE_PENDULUM_SHAPER_RING (278)
/// Upper bound of sizeof(double_pendulum_shaper_t), in bytes; checked when compiled.
#define DOUBLE_PENDULUM_SHAPER_RAM (1200)
/// First and last part of the SHA-256 of the design; the .c file refuses another header's.
#define DOUBLE_PENDULUM_SHAPER_DESIGN (0x2d68b8f3u)

/// Status: enable is false: row 0 (ramped, unshaped) is wanted.
#define DOUBLE_PENDULUM_SHAPER_DISABLED ((uint32_t)1u << 0)
/// Status: row 0 is in use: the command is ramped, not shaped.
#define DOUBLE_PENDULUM_SHAPER_UNSHAPED ((uint32_t)1u << 1)
/// Status: another row is wanted; it takes over when the block has settled.
#define DOUBLE_PENDULUM_SHAPER_ROW_WAITS ((uint32_t)1u << 2)
/// Status: a new command waits until the block has settled.
#define DOUBLE_PENDULUM_SHAPER_COMMAND_WAITS ((uint32_t)1u << 3)
/// Status: the command is beyond the maximum and was clamped to it.
#define DOUBLE_PENDULUM_SHAPER_COMMAND_CLAMPED ((uint32_t)1u << 4)
/// Status: a command was not finite: counted as 0 until a finite 0 is commanded.
#define DOUBLE_PENDULUM_SHAPER_COMMAND_INVALID ((uint32_t)1u << 5)
/// Status: the selector names no row: the last valid one is kept.
#define DOUBLE_PENDULUM_SHAPER_SELECTOR_INVALID ((uint32_t)1u << 6)
/// Status: quick stop is latched until released, at rest, and the command is 0.
#define DOUBLE_PENDULUM_SHAPER_QUICK_STOP ((uint32_t)1u << 7)
/// Status: emergency stop is latched until released and the command is 0.
#define DOUBLE_PENDULUM_SHAPER_EMERGENCY_STOP ((uint32_t)1u << 8)
/// Status: the command is below the minimum and counts as 0.
#define DOUBLE_PENDULUM_SHAPER_BELOW_MINIMUM ((uint32_t)1u << 9)
/// Status: inching: a small command from rest passes unshaped.
#define DOUBLE_PENDULUM_SHAPER_INCHING ((uint32_t)1u << 10)

/// Inputs of one tick.
typedef struct {
    bool enable; ///< false: row 0 is wanted, ramped and unshaped
    bool emergency_stop; ///< reference 0 at once; latched until the command is 0
    bool quick_stop; ///< unshaped stop on its own ramp; latched until at rest and the command is 0
    double_pendulum_real_t command; ///< [m/s] wanted speed; clamped to the maximum, and not finite counts as 0
    uint8_t selector; ///< 0 unshaped, 1 to 2 rows; anything else keeps the last valid one
} double_pendulum_shaper_input_t;

/// Outputs of one tick.
typedef struct {
    double_pendulum_real_t reference; ///< [m/s] speed for the drive
    double_pendulum_real_t stop_distance; ///< [m] signed way still to go if the command is 0 from the next tick on
    double_pendulum_real_t stop_time_s; ///< [s] time until the reference is 0 then
    uint32_t stop_time_ticks; ///< [ticks] the same time
    double_pendulum_real_t residual_bound; ///< [ratio] residual vibration that the row guarantees; all of it when unshaped
    uint8_t row; ///< row in use
    bool settled; ///< nothing is pending: a row may change
    bool active; ///< the command is being shaped
    bool error; ///< an input cannot be right; the status says which
    uint32_t status; ///< one bit for each reason, see above
} double_pendulum_shaper_output_t;

/// State of one shaper. The caller owns it; nothing outside the two functions below may write to it.
typedef struct {
    double_pendulum_real_t pending; ///< sum of the references still to come
    double_pendulum_real_t fresh; ///< the same from the commands of this lap alone
    double_pendulum_real_t base; ///< command of the last rest
    double_pendulum_real_t target; ///< target of the ramp
    double_pendulum_real_t command; ///< ramped command
    double_pendulum_real_t reference; ///< last reference
    double_pendulum_shaper_input_t input; ///< last inputs
    double_pendulum_shaper_output_t output; ///< last outputs
    double_pendulum_real_t ring[DOUBLE_PENDULUM_SHAPER_RING]; ///< last ramped commands
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
} double_pendulum_shaper_t;

/// Bring a shaper to the state after power-on: at rest at 0, row 0, nothing latched. Cost: O(1).
/// @param shaper not NULL; need not be initialised
void double_pendulum_shaper_init(double_pendulum_shaper_t *shaper);

/// Run one tick: read the inputs, write every output. Never blocks, never fails; cost: O(taps of the row).
/// @param shaper not NULL; initialised by double_pendulum_shaper_init()
/// @param input  not NULL; any value of any field is allowed, see there
/// @param output not NULL; written completely
void double_pendulum_shaper_step(double_pendulum_shaper_t *shaper, const double_pendulum_shaper_input_t *input,
    double_pendulum_shaper_output_t *output);

#ifdef __cplusplus
}
#endif

#endif
