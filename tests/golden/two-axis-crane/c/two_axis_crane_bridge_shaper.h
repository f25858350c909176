/*
 * two_axis_crane_bridge: command shaper. The load does not swing when the drive follows the reference.
 *
 * Made by swayless 0.1.0 from two-axis-crane.toml.
 * Design SHA-256 8f806e116b33e31d8e5224fbc2ff931df2d44d459ae074c617006cf0e4d40640.
 * This file is yours: use, change and ship it as you like.
 *
 * Tick 0.01 s, numbers in double, law fixed (tick clock).
 * Commands in m/s, at most 1. Settled after 500 ticks without change.
 * Rows, of which the measured rope chooses one, and the residual vibration that each guarantees on these very taps:
 *   0 unshaped (ramped only)
 *   1 9-3.94 m: fd for 0.204874 Hz, damping ratio 0, duration 5 s
 *     at most 5 % from 0.166134 to 0.252647 Hz (rope 3.89163 to 9 m)
 *     overtravel 2.5 m per m/s, peak factor 1
 *   2 3.94-3 m: si for 0.267925 Hz, damping ratio 0, duration 3.11 s
 *     at most 5 % from 0.249462 to 0.287753 Hz (rope 3 to 3.99163 m)
 *     overtravel 1.555 m per m/s, peak factor 1
 *
 * A rope length that is not valid, not finite or farther from the last one than the hoist could have
 * moved is not taken: the last one holds, shaping goes on and a status bit says so. At rest every length
 * is taken.
 * Rope 3 to 9 m, hoisted with at most 0.25 m/s.
 *
 * Call two_axis_crane_bridge_shaper_init() once, then two_axis_crane_bridge_shaper_step() once per tick.
 * State: 4376 bytes at most, owned by the caller; no heap, globals or libm.
 * Work per tick: the taps of the row in use, at most 6; none when settled.
 * Bit equality with the reference needs -ffp-contract=off, and no -ffast-math.
 *
 * NOT A SAFETY FUNCTION: limit switches, emergency stop and brakes must work without this block.
 * Nothing may limit, ramp or filter the reference on its way to the drive: it would undo the shaping.
 * Wind, off-centre pick-up and a slack rope are beyond what a command can prevent.
 */
#ifndef TWO_AXIS_CRANE_BRIDGE_SHAPER_H
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Commands, references and lengths: double, IEEE 754.
typedef double two_axis_crane_bridge_real_t;

/// Length of a tick, in seconds: call two_axis_crane_bridge_shaper_step() once per tick.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_TICK_S (0.01)
/// Number of rows besides row 0.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_ROWS (2)
/// Cells of the ring: the longest delay of any row, in ticks, and one.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_RING (501)
/// Upper bound of sizeof(two_axis_crane_bridge_shaper_t), in bytes; checked when compiled.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_RAM (4376)
/// First and last part of the SHA-256 of the design; the .c file refuses another header's.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_DESIGN (0x8f806e11u)
/// CRC-32 of the design file, as the output design_id gives it.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_DESIGN_ID ((uint32_t)0xF4B99D10u)

/// Status: enable is false: row 0 (ramped, unshaped) is wanted.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_DISABLED ((uint32_t)1u << 0)
/// Status: row 0 is in use: the command is ramped, not shaped.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_UNSHAPED ((uint32_t)1u << 1)
/// Status: another row is wanted; it takes over when the block has settled.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_ROW_WAITS ((uint32_t)1u << 2)
/// Status: a new command waits until the block has settled.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_COMMAND_WAITS ((uint32_t)1u << 3)
/// Status: the command is beyond the maximum and was clamped to it.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_COMMAND_CLAMPED ((uint32_t)1u << 4)
/// Status: a command was not finite: counted as 0 until a finite 0 is commanded.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_COMMAND_INVALID ((uint32_t)1u << 5)
/// Status: the selector names no row: the last valid one is kept.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_SELECTOR_INVALID ((uint32_t)1u << 6)
/// Status: quick stop is latched until released, at rest, and the command is 0.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_QUICK_STOP ((uint32_t)1u << 7)
/// Status: emergency stop is latched until released and the command is 0.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_EMERGENCY_STOP ((uint32_t)1u << 8)
/// Status: the command is below the minimum and counts as 0.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_BELOW_MINIMUM ((uint32_t)1u << 9)
/// Status: inching: a small command from rest passes unshaped.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_INCHING ((uint32_t)1u << 10)
/// Status: the rope length is not valid or not finite: the last one holds.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_ROPE_INVALID ((uint32_t)1u << 11)
/// Status: the rope length is out of range and was clamped to it.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_ROPE_OUT_OF_RANGE ((uint32_t)1u << 12)
/// Status: the rope length is farther off than the hoist could move: the last one holds.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_ROPE_JUMP ((uint32_t)1u << 13)
/// Status: the hoist moves and the rope length does not: one of them is wrong.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_ROPE_FROZEN ((uint32_t)1u << 14)
/// Status: the hoist speed is not finite and counts as 0.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_HOIST_SPEED_INVALID ((uint32_t)1u << 15)
/// Status: steps run: the row is locked and velocity commands do nothing.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_STEPPING ((uint32_t)1u << 16)
/// Status: a step was pressed and does not count: not at rest, a command, a stop, or too many.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_STEP_REFUSED ((uint32_t)1u << 17)
/// Status: a step was pressed with a size that is not 1 to 3: refused.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_STEP_SIZE_INVALID ((uint32_t)1u << 18)
/// Status: a command does nothing until it has been 0.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_COMMAND_LOCKED ((uint32_t)1u << 19)
/// Status: a stop switch is made: commands and steps towards it count as 0.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_STOP_SWITCH ((uint32_t)1u << 20)
/// Status: a slow switch is made: the command towards it is limited to the slow speed.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_SLOW_SWITCH ((uint32_t)1u << 21)
/// Status: the way left to the end of travel limits the speed.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_WAY_LIMITS ((uint32_t)1u << 22)
/// Status: the way left to the end of travel is too short to stop in by the ramp.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_WAY_TOO_SHORT ((uint32_t)1u << 23)
/// Status: a distance is not valid or not finite: the last one less the way since holds.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_DISTANCE_INVALID ((uint32_t)1u << 24)
/// Status: the drive is not ready: the reference is 0.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_DRIVE_NOT_READY ((uint32_t)1u << 25)
/// Status: the speed limit is not from 0 to the maximum and was clamped.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_SPEED_LIMIT_INVALID ((uint32_t)1u << 26)
/// Status: the rope offset is out of its range and was clamped, or not finite: 0.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_ROPE_OFFSET_INVALID ((uint32_t)1u << 27)
/// Status: the drive does not follow the reference.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_TRACKING ((uint32_t)1u << 28)
/// Status: the tables of the block are not those of its design: the reference stays 0.
#define TWO_AXIS_CRANE_BRIDGE_SHAPER_TABLES_INVALID ((uint32_t)1u << 29)

/// Inputs of one tick.
typedef struct {
    bool enable; ///< false: row 0 is wanted, ramped and unshaped
    bool emergency_stop; ///< reference 0 at once; latched until the command is 0
    bool quick_stop; ///< unshaped stop on its own ramp; latched until at rest and the command is 0
    two_axis_crane_bridge_real_t command; ///< [m/s] wanted speed; clamped to the maximum, and not finite counts as 0
    uint8_t selector; ///< 0 unshaped, 1 the row of the rope; anything else keeps the last valid one
    two_axis_crane_bridge_real_t rope_length_m; ///< [m] 3 to 9: clamped; the last one holds if it cannot be true
    two_axis_crane_bridge_real_t hoist_speed_m_s; ///< [m/s] rate of change of the length, positive when the load sinks; clamped
    bool rope_length_valid; ///< false: the rope length is not to be believed
    bool step_forward; ///< an edge is a step; it counts only after the input was seen false
    bool step_reverse; ///< an edge is a step; it counts only after the input was seen false
    uint8_t step_size; ///< 1 to 3: a step of 0.05, 0.1 or 0.25 m; else none
    bool stop_forward; ///< true: the stop switch at that end is made; motion towards it ends, the way back is open
    bool stop_reverse; ///< true: the stop switch at that end is made; motion towards it ends, the way back is open
    bool slow_forward; ///< true: the slow-down switch before that end is made; at most 0.1 m/s towards it
    bool slow_reverse; ///< true: the slow-down switch before that end is made; at most 0.1 m/s towards it
    two_axis_crane_bridge_real_t distance_forward_m; ///< [m] way left to that end when the tick begins; it stops 0.5 m before
    two_axis_crane_bridge_real_t distance_reverse_m; ///< [m] way left to that end when the tick begins; it stops 0.5 m before
    bool distance_valid; ///< false: the distances are not to be believed
    bool drive_ready; ///< false: the drive does not follow; the reference is 0
    two_axis_crane_bridge_real_t actual_speed; ///< [m/s] speed of the drive
    two_axis_crane_bridge_real_t speed_limit; ///< [m/s] largest command from now on, 0 to 1: clamped
    two_axis_crane_bridge_real_t rope_offset_m; ///< [m] added to the measured rope length, 0 to 2: clamped
} two_axis_crane_bridge_shaper_input_t;

/// Outputs of one tick.
typedef struct {
    two_axis_crane_bridge_real_t reference; ///< [m/s] speed for the drive
    two_axis_crane_bridge_real_t stop_distance; ///< [m] signed way still to go if the command is 0 from the next tick on
    two_axis_crane_bridge_real_t stop_time_s; ///< [s] time until the reference is 0 then
    uint32_t stop_time_ticks; ///< [ticks] the same time
    two_axis_crane_bridge_real_t residual_bound; ///< [ratio] residual vibration that the row leaves at most on this rope; all of it when unshaped
    uint8_t row; ///< row in use
    bool settled; ///< nothing is pending: a row may change
    bool active; ///< the command is being shaped
    bool error; ///< an input cannot be right; the status says which
    uint32_t status; ///< one bit for each reason, see above
    two_axis_crane_bridge_real_t predicted_sway_m; ///< [m] where the linear model has the load, ahead of the trolley; not measured
    uint32_t design_id; ///< CRC-32 of the design file: which design the block runs
} two_axis_crane_bridge_shaper_output_t;

/// State of one shaper. The caller owns it; nothing outside the two functions below may write to it.
typedef struct {
    two_axis_crane_bridge_real_t pending; ///< sum of the references still to come
    two_axis_crane_bridge_real_t fresh; ///< the same from the commands of this lap alone
    two_axis_crane_bridge_real_t base; ///< command of the last rest
    two_axis_crane_bridge_real_t target; ///< target of the ramp
    two_axis_crane_bridge_real_t command; ///< ramped command
    two_axis_crane_bridge_real_t reference; ///< last reference
    two_axis_crane_bridge_real_t unmoved; ///< way of the hoist while the length stayed
    two_axis_crane_bridge_real_t rope_length; ///< length believed
    two_axis_crane_bridge_real_t hoist_speed; ///< hoist speed, clamped
    uint32_t held_ticks; ///< ticks for which no length was taken
    two_axis_crane_bridge_real_t way_forward; ///< sum of references that may come before that end
    two_axis_crane_bridge_real_t way_reverse; ///< the same of the other end
    two_axis_crane_bridge_real_t left; ///< what is left of steps, with its sign
    two_axis_crane_bridge_real_t queued; ///< presses that are not part of it yet
    two_axis_crane_bridge_real_t most_forward; ///< largest command in that direction
    two_axis_crane_bridge_real_t most_reverse; ///< the same of the other direction
    two_axis_crane_bridge_real_t speed_limit; ///< largest command
    two_axis_crane_bridge_real_t rope_offset; ///< added to the rope length
    uint32_t refusal; ///< status bit of a refused press
    two_axis_crane_bridge_real_t sway_pace; ///< speed of the load against the trolley, as a command
    two_axis_crane_bridge_real_t sway_place; ///< its deflection, as a command
    two_axis_crane_bridge_real_t sway_reference; ///< reference of the tick before
    two_axis_crane_bridge_real_t turn_cosine; ///< turn of a tick on the rope of now
    two_axis_crane_bridge_real_t turn_sine; ///< the same
    two_axis_crane_bridge_real_t turn_metres; ///< deflection per unit of place on the rope of now
    two_axis_crane_bridge_real_t sway_inverse; ///< 1 / quanta of a tick on the rope of now
    uint32_t sway_quanta; ///< quanta of a tick on the rope of now
    two_axis_crane_bridge_real_t low; ///< least reference of this window
    two_axis_crane_bridge_real_t high; ///< largest reference of this window
    two_axis_crane_bridge_real_t last_low; ///< the same of the window before
    two_axis_crane_bridge_real_t last_high; ///< the same of the window before
    uint32_t filled_ticks; ///< ticks of this window
    uint32_t outside_ticks; ///< ticks for which the drive has not followed
    bool tables_match; ///< the tables are those of the design
    two_axis_crane_bridge_shaper_output_t output; ///< last outputs
    two_axis_crane_bridge_real_t ring[TWO_AXIS_CRANE_BRIDGE_SHAPER_RING]; ///< last ramped commands
    uint32_t head; ///< cell of the newest command
    uint32_t still_ticks; ///< ticks without change, up to the longest delay
    uint32_t status; ///< status bits of this tick
    uint8_t row; ///< row in use
    uint8_t selected_row; ///< last valid selector
    uint8_t wanted_row; ///< row that takes over when settled
    uint8_t next_row; ///< the one row that may take over in the next tick while the crane moves
    uint8_t rope_row; ///< row of the rope
    bool lapped; ///< the ring is full of commands since the last rest
    bool foretold; ///< settled, and the stop is foretold
    bool zero_commanded; ///< the command is a valid 0
    bool invalid; ///< a command was not finite
    bool quick; ///< quick stop is latched
    bool emergency; ///< emergency stop is latched
    bool rope_still; ///< the last reading of the rope changed nothing
    bool locked; ///< a command does nothing until it has been 0
    bool drive_off; ///< the drive is not ready
    bool shut_forward; ///< the stop switch at that end is made
    bool shut_reverse; ///< the same of the other end
    bool locked_forward; ///< a command towards it does nothing until it was 0
    bool locked_reverse; ///< the same of the other end
    bool armed_forward; ///< the button was seen released
    bool armed_reverse; ///< the same of the other button
    bool row_locked; ///< steps ran when the tick began
    bool stepping; ///< steps run
} two_axis_crane_bridge_shaper_t;

/// Bring a shaper to the state after power-on: at rest at 0, row 0, nothing latched. Cost: O(numbers of the tables).
/// @param shaper not NULL; need not be initialised
void two_axis_crane_bridge_shaper_init(two_axis_crane_bridge_shaper_t *shaper);

/// Run one tick: read the inputs, write every output. Never blocks, never fails; cost: O(taps of the row).
/// @param shaper not NULL; initialised by two_axis_crane_bridge_shaper_init()
/// @param input  not NULL; any value of any field is allowed, see there
/// @param output not NULL; written completely
void two_axis_crane_bridge_shaper_step(two_axis_crane_bridge_shaper_t *shaper, const two_axis_crane_bridge_shaper_input_t *input,
    two_axis_crane_bridge_shaper_output_t *output);

#ifdef __cplusplus
}
#endif

#endif
