/*
 * hoisting_gantry: command shaper. The load does not swing when the drive follows the reference.
 *
 * Made by swayless 0.1.0 from hoisting-gantry.toml.
 * Design SHA-256 c43c9deee840c08718116d0afe10c1ad4fd6f10e6d9ad0baa1d7bc82815ed464.
 * This file is yours: use, change and ship it as you like.
 *
 * Tick 0.01 s, numbers in double, law phase (hoisting while travelling).
 * Commands in m/s, at most 0.8. Settled after 602 ticks without change on the longest rope.
 * Rows of the selector, and the residual vibration that each guarantees on these very taps:
 *   0 unshaped (ramped only)
 *   1 any rope: zvd over the phase, damping ratio 0, duration 6.01923 s on the longest rope
 *     at most 5 % on every rope of the range that is held still
 *     overtravel 3.00961 m per m/s on the longest rope
 *
 * Delays are phases of the pendulum: a tap releases its part of a change of the command when the load
 * has swung on by the phase designed, however the rope was hoisted meanwhile. Give the rope length and
 * its rate of change, positive when the load sinks, on every tick. A hoist that starts or stops under a
 * swinging load kicks it: the reference answers with a step, and may pass the present command by that,
 * but never the maximum. The stop distance is exact on a rope that is held still from now on; the stop
 * time does not know the answers to come, which end by one run more and go as far back as forth.
 * A rope length that is not valid, not finite or farther from the last one than the hoist could have
 * moved is not taken: the last one holds, shaping goes on and a status bit says so. At rest every length
 * is taken.
 * Rope 3 to 9 m, hoisted with at most 0.4 m/s.
 *
 * Call hoisting_gantry_shaper_init() once, then hoisting_gantry_shaper_step() once per tick.
 * State: 24496 bytes at most, owned by the caller; no heap, globals or libm.
 * Work per tick: the taps of the row in use, at most 3, and at most 2 cells of each; none settled on a still rope.
 * Bit equality with the reference needs -ffp-contract=off, and no -ffast-math.
 *
 * NOT A SAFETY FUNCTION: limit switches, emergency stop and brakes must work without this block.
 * Nothing may limit, ramp or filter the reference on its way to the drive: it would undo the shaping.
 * Wind, off-centre pick-up and a slack rope are beyond what a command can prevent.
 */
#ifndef HOISTING_GANTRY_SHAPER_H
#define HOISTING_GANTRY_SHAPER_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Commands, references and lengths: double, IEEE 754.
typedef double hoisting_gantry_real_t;

/// Length of a tick, in seconds: call hoisting_gantry_shaper_step() once per tick.
#define HOISTING_GANTRY_SHAPER_TICK_S (0.01)
/// Number of rows besides row 0.
#define HOISTING_GANTRY_SHAPER_ROWS (1)
/// Cells of the ring: the longest delay of any row on the longest rope, in ticks, and two.
#define HOISTING_GANTRY_SHAPER_RING (604)
/// Taps of the longest row, but for the first.
#define HOISTING_GANTRY_SHAPER_LATER_TAPS (2)
/// Upper bound of sizeof(hoisting_gantry_shaper_t), in bytes; checked when compiled.
#define HOISTING_GANTRY_SHAPER_RAM (24496)
/// First and last part of the SHA-256 of the design; the .c file refuses another header's.
#define HOISTING_GANTRY_SHAPER_DESIGN (0xc43c9deeu)

/// Status: enable is false: row 0 (ramped, unshaped) is wanted.
#define HOISTING_GANTRY_SHAPER_DISABLED ((uint32_t)1u << 0)
/// Status: row 0 is in use: the command is ramped, not shaped.
#define HOISTING_GANTRY_SHAPER_UNSHAPED ((uint32_t)1u << 1)
/// Status: another row is wanted; it takes over when the block has settled.
#define HOISTING_GANTRY_SHAPER_ROW_WAITS ((uint32_t)1u << 2)
/// Status: a new command waits until the block has settled.
#define HOISTING_GANTRY_SHAPER_COMMAND_WAITS ((uint32_t)1u << 3)
/// Status: the command is beyond the maximum and was clamped to it.
#define HOISTING_GANTRY_SHAPER_COMMAND_CLAMPED ((uint32_t)1u << 4)
/// Status: a command was not finite: counted as 0 until a finite 0 is commanded.
#define HOISTING_GANTRY_SHAPER_COMMAND_INVALID ((uint32_t)1u << 5)
/// Status: the selector names no row: the last valid one is kept.
#define HOISTING_GANTRY_SHAPER_SELECTOR_INVALID ((uint32_t)1u << 6)
/// Status: quick stop is latched until released, at rest, and the command is 0.
#define HOISTING_GANTRY_SHAPER_QUICK_STOP ((uint32_t)1u << 7)
/// Status: emergency stop is latched until released and the command is 0.
#define HOISTING_GANTRY_SHAPER_EMERGENCY_STOP ((uint32_t)1u << 8)
/// Status: the command is below the minimum and counts as 0.
#define HOISTING_GANTRY_SHAPER_BELOW_MINIMUM ((uint32_t)1u << 9)
/// Status: inching: a small command from rest passes unshaped.
#define HOISTING_GANTRY_SHAPER_INCHING ((uint32_t)1u << 10)
/// Status: the rope length is not valid or not finite: the last one holds.
#define HOISTING_GANTRY_SHAPER_ROPE_INVALID ((uint32_t)1u << 11)
/// Status: the rope length is out of range and was clamped to it.
#define HOISTING_GANTRY_SHAPER_ROPE_OUT_OF_RANGE ((uint32_t)1u << 12)
/// Status: the rope length is farther off than the hoist could move: the last one holds.
#define HOISTING_GANTRY_SHAPER_ROPE_JUMP ((uint32_t)1u << 13)
/// Status: the hoist moves and the rope length does not: one of them is wrong.
#define HOISTING_GANTRY_SHAPER_ROPE_FROZEN ((uint32_t)1u << 14)
/// Status: the hoist speed is not finite and counts as 0.
#define HOISTING_GANTRY_SHAPER_HOIST_SPEED_INVALID ((uint32_t)1u << 15)

/// Inputs of one tick.
typedef struct {
    bool enable; ///< false: row 0 is wanted, ramped and unshaped
    bool emergency_stop; ///< reference 0 at once; latched until the command is 0
    bool quick_stop; ///< unshaped stop on its own ramp; latched until at rest and the command is 0
    hoisting_gantry_real_t command; ///< [m/s] wanted speed; clamped to the maximum, and not finite counts as 0
    uint8_t selector; ///< 0 unshaped, 1 the row; anything else keeps the last valid one
    hoisting_gantry_real_t rope_length_m; ///< [m] 3 to 9: clamped; the last one holds if it cannot be true
    hoisting_gantry_real_t hoist_speed_m_s; ///< [m/s] rate of change of the length, positive when the load sinks; clamped
    bool rope_length_valid; ///< false: the rope length is not to be believed
} hoisting_gantry_shaper_input_t;

/// Outputs of one tick.
typedef struct {
    hoisting_gantry_real_t reference; ///< [m/s] speed for the drive
    hoisting_gantry_real_t stop_distance; ///< [m] signed way still to go if the command is 0 from the next tick on
    hoisting_gantry_real_t stop_time_s; ///< [s] time until the reference is 0 then
    uint32_t stop_time_ticks; ///< [ticks] the same time
    hoisting_gantry_real_t residual_bound; ///< [ratio] residual vibration that the row guarantees; all of it when unshaped
    uint8_t row; ///< row in use
    bool settled; ///< nothing is pending: a row may change
    bool active; ///< the command is being shaped
    bool error; ///< an input cannot be right; the status says which
    uint32_t status; ///< one bit for each reason, see above
} hoisting_gantry_shaper_output_t;

/// One change of the command, on its way to the later taps; what the first tap has is released at once.
typedef struct {
    hoisting_gantry_real_t part[HOISTING_GANTRY_SHAPER_LATER_TAPS]; ///< part of each later tap
    hoisting_gantry_real_t foreseen[HOISTING_GANTRY_SHAPER_LATER_TAPS]; ///< 1 / quanta of the tick that is to release each part
    uint32_t gap; ///< quanta until the next cell
} hoisting_gantry_shaper_cell_t;

/// State of one shaper. The caller owns it; nothing outside the two functions below may write to it.
typedef struct {
    hoisting_gantry_real_t level; ///< sum of everything released
    hoisting_gantry_real_t late; ///< what this tick leaves to the next
    hoisting_gantry_real_t mass; ///< sum of the parts under way
    hoisting_gantry_real_t moment; ///< sum of part times quanta still to go
    hoisting_gantry_real_t place; ///< place of the swing, as a change of speed
    hoisting_gantry_real_t pace; ///< pace of the swing
    hoisting_gantry_real_t rate; ///< hoist speed times quanta of this tick
    hoisting_gantry_real_t fresh; ///< moment of the cells of this lap alone
    hoisting_gantry_real_t fresh_mass; ///< mass of the cells of this lap alone
    hoisting_gantry_real_t inverse; ///< 1 / quanta of this tick
    hoisting_gantry_real_t answered; ///< hoist speed answered last
    uint32_t quanta; ///< quanta of phase in this tick
    hoisting_gantry_real_t weight[HOISTING_GANTRY_SHAPER_LATER_TAPS]; ///< weight of each later tap for a change now
    hoisting_gantry_real_t foreseen[HOISTING_GANTRY_SHAPER_LATER_TAPS]; ///< the same of a change now
    bool weighed; ///< both are for the rate and row of this tick
    uint32_t elapsed_quanta; ///< quanta of the tick before
    hoisting_gantry_real_t base; ///< command shaped last
    hoisting_gantry_real_t target; ///< target of the ramp
    hoisting_gantry_real_t command; ///< ramped command
    hoisting_gantry_real_t reference; ///< last reference
    hoisting_gantry_real_t unmoved; ///< way of the hoist while the length stayed
    hoisting_gantry_real_t rope_length; ///< length believed
    hoisting_gantry_real_t hoist_speed; ///< hoist speed, clamped
    uint32_t held_ticks; ///< ticks for which no length was taken
    hoisting_gantry_shaper_input_t input; ///< last inputs
    hoisting_gantry_shaper_output_t output; ///< last outputs
    hoisting_gantry_shaper_cell_t ring[HOISTING_GANTRY_SHAPER_RING]; ///< changes of the command under way
    uint32_t next[HOISTING_GANTRY_SHAPER_LATER_TAPS]; ///< cell that each later tap reaches next
    uint32_t ahead[HOISTING_GANTRY_SHAPER_LATER_TAPS]; ///< quanta until it does
    uint32_t head; ///< cell of the newest command
    uint32_t still_quanta; ///< quanta without change, up to the longest lag
    uint32_t status; ///< status bits of this tick
    uint8_t row; ///< row in use
    uint8_t selected_row; ///< last valid selector
    uint8_t wanted_row; ///< row that takes over when settled
    bool running; ///< parts of changes may be under way
    bool foretold; ///< settled, and the stop is foretold
    bool idle; ///< the last tick began and ended settled
    bool zero_commanded; ///< the command is a valid 0
    bool invalid; ///< a command was not finite
    bool quick; ///< quick stop is latched
    bool emergency; ///< emergency stop is latched
    bool rope_still; ///< the last reading of the rope changed nothing
} hoisting_gantry_shaper_t;

/// Bring a shaper to the state after power-on: at rest at 0, row 0, nothing latched. Cost: O(1).
/// @param shaper not NULL; need not be initialised
void hoisting_gantry_shaper_init(hoisting_gantry_shaper_t *shaper);

/// Run one tick: read the inputs, write every output. Never blocks, never fails; cost: O(taps of the row).
/// @param shaper not NULL; initialised by hoisting_gantry_shaper_init()
/// @param input  not NULL; any value of any field is allowed, see there
/// @param output not NULL; written completely
void hoisting_gantry_shaper_step(hoisting_gantry_shaper_t *shaper, const hoisting_gantry_shaper_input_t *input,
    hoisting_gantry_shaper_output_t *output);

#ifdef __cplusplus
}
#endif

#endif
