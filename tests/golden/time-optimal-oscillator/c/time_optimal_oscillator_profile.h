/*
 * time_optimal_oscillator: motion profile. It plays a move computed ahead, from any start to any target.
 *
 * Made by swayless 0.1.0 from time-optimal-oscillator.toml.
 * This file is yours: use, change and ship it as you like.
 *
 * Tick 0.005 s. A move takes 58 ticks, 0.29 s, however far it goes.
 * At most 51 ticks, 0.255 s, after an abort the plant rests:
 * by a stop from the next tick that allows one, or the end of the move.
 * References from -5 to 5; a move that could need more is refused.
 * Design: 0 to 1, robust of order 1, zero-order hold; SHA-256:
 * 505f0487a6836cb95cce4f6a5441406d3cfabea9d7ee6d54c57cf9f86db7e20e
 * Proved with these numbers: the move of the design leaves at most
 * 1e-12 of each state's largest, an abort at any tick of it 1e-12.
 * Another start or travel T adds at most 1.4e-15 R / |T|, R its largest reference.
 * Limits are kept. A stop rests at 0 to 0.307 of the travel.
 * Each move is that of the design, to scale: reference = hold_ratio * start + travel * shape,
 * position = start + travel * position of a model of the plant, with travel = target - start.
 * Memory: 224 bytes of state at most, 1544 of tables.
 *
 * Call it once per tick. The plant rests when a move starts: what swings then swings on.
 * NOT A SAFETY FUNCTION: limit switches, emergency stop and brakes must work without this block.
 * Nothing may limit, ramp or filter the reference on its way to the drive: the move is exact.
 *
 * Bit equality with the reference needs -ffp-contract=off. No heap, no library, no globals.
 */
#ifndef TIME_OPTIMAL_OSCILLATOR_PROFILE_H
#define TIME_OPTIMAL_OSCILLATOR_PROFILE_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Length of a tick, in seconds: call time_optimal_oscillator_profile_step() once per tick.
#define TIME_OPTIMAL_OSCILLATOR_PROFILE_TICK_S (0.005)
/// Ticks of a move: busy for so long, done at the next.
#define TIME_OPTIMAL_OSCILLATOR_PROFILE_TICKS (58u)
/// At most so many ticks after an abort the plant rests: by a stop from the next tick that allows one, or the end of the move.
#define TIME_OPTIMAL_OSCILLATOR_PROFILE_STOP_TICKS (51u)
/// States of the plant's model.
#define TIME_OPTIMAL_OSCILLATOR_PROFILE_STATES (4u)
/// Upper bound of sizeof(time_optimal_oscillator_profile_t), in bytes; checked when compiled.
#define TIME_OPTIMAL_OSCILLATOR_PROFILE_RAM (224u)

/// Status: execute rose while a move or a stop played, which goes on.
#define TIME_OPTIMAL_OSCILLATOR_PROFILE_EXECUTE_IGNORED ((uint32_t)1u << 0)
/// Status: refused: abort was true when execute rose.
#define TIME_OPTIMAL_OSCILLATOR_PROFILE_ABORT_HELD ((uint32_t)1u << 1)
/// Status: refused: start or target is not finite, or beyond 2**50.
#define TIME_OPTIMAL_OSCILLATOR_PROFILE_INPUT_NOT_FINITE ((uint32_t)1u << 2)
/// Status: refused: the move, or a stop of it, would exceed the limits.
#define TIME_OPTIMAL_OSCILLATOR_PROFILE_LIMIT_EXCEEDED ((uint32_t)1u << 3)
/// Status: refused: target less start is beyond the longest travel.
#define TIME_OPTIMAL_OSCILLATOR_PROFILE_TRAVEL_TOO_LONG ((uint32_t)1u << 4)
/// Status: refused: start is not where the block rests, the reference would jump.
#define TIME_OPTIMAL_OSCILLATOR_PROFILE_START_ELSEWHERE ((uint32_t)1u << 5)
/// Status: start is not finite or beyond the limits: the last good one holds.
#define TIME_OPTIMAL_OSCILLATOR_PROFILE_START_INVALID ((uint32_t)1u << 6)
/// Status: abort was true: a stop, or the end of the move, plays.
#define TIME_OPTIMAL_OSCILLATOR_PROFILE_STOPPING ((uint32_t)1u << 7)

/// Inputs of one tick.
typedef struct {
    bool execute; ///< its rising edge starts a move; ignored while one runs
    bool abort; ///< true in any tick of a move: it is brought to rest; while true none starts
    double start; ///< where the move starts; before the first move the block holds there
    double target; ///< where it ends; read, as start is, when execute rises
} time_optimal_oscillator_profile_input_t;

/// Outputs of one tick.
typedef struct {
    double reference; ///< for the drive, in units of the plant's input
    double position; ///< where the plant is now, by its model: the reference of a feedback
    bool busy; ///< a move or a stop plays
    bool done; ///< the target is reached; true while execute is, and for one tick at least
    bool aborted; ///< it rests after an abort; true as long as done would be
    uint32_t status; ///< sum of the status bits
} time_optimal_oscillator_profile_output_t;

/// State of one profile. The caller owns it; nothing outside the two functions below may write to it.
typedef struct {
    double plant[TIME_OPTIMAL_OSCILLATOR_PROFILE_STATES + 1u]; ///< states in a move by 1, and the last shape
    double stop_from[TIME_OPTIMAL_OSCILLATOR_PROFILE_STATES + 1u]; ///< the same when the stop began
    double stop_terms[10]; ///< coefficients of the piece of the stop that plays
    double position; ///< where the plant rests, or where the last move began
    double start; ///< of the move
    double target; ///< of the move
    double travel; ///< of the move
    uint32_t piece; ///< of the move or the stop, that plays next
    uint32_t piece_tick; ///< ticks of it that have played
    uint32_t tick; ///< ticks of the move that have played
    uint32_t range; ///< of its ticks in which a stop may begin, that is not over
    uint32_t refused; ///< status bits of the last refusal
    bool executed; ///< execute of the tick before
    bool placed; ///< a move was accepted: start no longer matters at rest
    bool busy; ///< as the output
    bool aborting; ///< abort was true: what plays ends as aborted
    bool stopping; ///< a stop plays
    bool done; ///< as the output
    bool aborted; ///< as the output
} time_optimal_oscillator_profile_t;

/// Bring a profile to the state after power-on: at rest, waiting for a start. Cost: the states of the plant.
/// @param profile not NULL; need not be initialised
void time_optimal_oscillator_profile_init(time_optimal_oscillator_profile_t *profile);

/// Run one tick: read the inputs, write every output. Never blocks, never fails; no division, nothing is searched.
/// @param profile not NULL; initialised by time_optimal_oscillator_profile_init()
/// @param input   not NULL; any value of any field is allowed, see there
/// @param output  not NULL; written completely
void time_optimal_oscillator_profile_step(time_optimal_oscillator_profile_t *profile, const time_optimal_oscillator_profile_input_t *input,
    time_optimal_oscillator_profile_output_t *output);

#ifdef __cplusplus
}
#endif

#endif
