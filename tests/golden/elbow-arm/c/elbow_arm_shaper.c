/*
 * elbow_arm: command shaper, see elbow_arm_shaper.h.
 * Design SHA-256 605d1038c623bd67b99374e11deaa54eeb52482668a35b29c342969bfe17d438.
 */
#include "elbow_arm_shaper.h"

#if (ELBOW_ARM_SHAPER_DESIGN != 0x605d1038u)
#error "elbow_arm_shaper.h and elbow_arm_shaper.c belong to different designs"
#endif

/* Does not compile when the state is larger than the header says. */
typedef char elbow_arm_ram_check[(sizeof(elbow_arm_shaper_t) <= (unsigned)ELBOW_ARM_SHAPER_RAM) ? 1 : -1];

static const uint32_t elbow_arm_LAST_TICKS = 12u; /* longest delay of any row */
static const elbow_arm_real_t elbow_arm_MAX_COMMAND = 0.5; /* m/s: max_speed */
static const elbow_arm_real_t elbow_arm_RAMP_ANCHOR = 1.0; /* floats next to it are the grid of ramp steps */
static const elbow_arm_real_t elbow_arm_METRES_PER_UNIT_TICK = 0.02; /* m of way per unit and tick */
static const elbow_arm_real_t elbow_arm_TICK_S = 0.02; /* s: tick */
static const elbow_arm_real_t elbow_arm_LOWEST_POSITION = 3.02; /* m: position */
static const elbow_arm_real_t elbow_arm_HIGHEST_POSITION = 3.94; /* m: position */
static const elbow_arm_real_t elbow_arm_POSITION_SPEED = 0.35; /* m/s: position_speed */
static const elbow_arm_real_t elbow_arm_POSITION_JUMP = 0.05; /* m: difference of two readings that is always taken */
static const elbow_arm_real_t elbow_arm_POSITION_WAY_PER_TICK = 0.007; /* m: position_speed times tick */
static const elbow_arm_real_t elbow_arm_POSITION_TICK = 0.02; /* s: tick */
static const elbow_arm_real_t elbow_arm_FROZEN_WAY = 0.05; /* m: a position that stays so long is frozen */
static const uint32_t elbow_arm_MOST_HELD_TICKS = 1048576u; /* by then the axis may be anywhere */
static const uint32_t elbow_arm_PIECES = 3u; /* pieces of the table of the spacing */
static const uint32_t elbow_arm_MOST_SPACING = 6u; /* ticks: widest spacing */

/* first tap of each row, and the end */
static const uint32_t elbow_arm_FIRST_TAP[3] = {
    0u, 1u, 4u
};
/* amplitude of each tap, by row; each row sums to exactly 1 */
static const elbow_arm_real_t elbow_arm_AMPLITUDE[4] = {
    1.0,
    0.257915409415, 0.499876637901, 0.24220795268399997
};
/* longest delay of each row */
static const uint32_t elbow_arm_TAIL_TICKS[2] = {
    0u, 12u
};
/* tolerance of each row */
static const elbow_arm_real_t elbow_arm_RESIDUAL_BOUND[2] = {
    1.0, 0.1
};
/* m of position: where each piece begins */
static const elbow_arm_real_t elbow_arm_PIECE_START[3] = {
    3.02, 3.22321665792, 3.64279686601
};
/* spacing of each piece */
static const uint16_t elbow_arm_PIECE_TICKS[3] = {
    4u, 5u, 6u
};

/* A ramp: its step per tick, rounded up to the grid, and what its closed form needs. */
typedef struct {
    elbow_arm_real_t step;
    elbow_arm_real_t steps_per_unit; /* 1 / step */
} elbow_arm_ramp_t;

/* m/s per tick: acceleration */
static const elbow_arm_ramp_t elbow_arm_ACCELERATION = { 0.020000000000000018, 49.99999999999996 };
/* m/s per tick: deceleration */
static const elbow_arm_ramp_t elbow_arm_DECELERATION = { 0.020000000000000018, 49.99999999999996 };
/* m/s per tick: quick_stop */
static const elbow_arm_ramp_t elbow_arm_QUICK_STOP = { 0.020000000000000018, 49.99999999999996 };

/* What a ramp still has to do: ticks, and the sum of the commands of those ticks. */
typedef struct {
    elbow_arm_real_t total;
    uint32_t ticks;
} elbow_arm_glide_t;

static elbow_arm_real_t elbow_arm_abs(elbow_arm_real_t value)
{
    return (value < 0.0) ? -value : value;
}

static bool elbow_arm_equal(elbow_arm_real_t a, elbow_arm_real_t b)
{
    return (a <= b) && (a >= b);
}

/* Round a command to the grid of ramp steps: from there on a ramp adds exactly. */
static elbow_arm_real_t elbow_arm_on_grid(elbow_arm_real_t command)
{
    const elbow_arm_real_t anchor = (command < 0.0) ? -elbow_arm_RAMP_ANCHOR : elbow_arm_RAMP_ANCHOR;
    return (command + anchor) - anchor;
}

/* Whether commands within reach of the taps may differ. */
static bool elbow_arm_running(const elbow_arm_shaper_t *s)
{
    return s->running;
}

/* Whether a reading is a number: only what is finite and not 0 shrinks when halved. */
static bool elbow_arm_is_number(elbow_arm_real_t value)
{
    const elbow_arm_real_t magnitude = elbow_arm_abs(value);
    return elbow_arm_equal(magnitude, 0.0) || ((magnitude * 0.5) < magnitude);
}

/* Value, but not below low, and not above high. */
static elbow_arm_real_t elbow_arm_within(elbow_arm_real_t value, elbow_arm_real_t low, elbow_arm_real_t high)
{
    elbow_arm_real_t result = value;
    if (result < low) {
        result = low;
    }
    if (result > high) {
        result = high;
    }
    return result;
}

static void elbow_arm_hold_position(elbow_arm_shaper_t *s)
{
    if (s->held_ticks < elbow_arm_MOST_HELD_TICKS) {
        s->held_ticks += 1u;
    }
}

/* Take a position where it can be true; otherwise the last one holds. At rest every position can. */
static void elbow_arm_take_position(elbow_arm_shaper_t *s, elbow_arm_real_t reading)
{
    const elbow_arm_real_t clamped = elbow_arm_within(reading, elbow_arm_LOWEST_POSITION, elbow_arm_HIGHEST_POSITION);
    const elbow_arm_real_t reach = elbow_arm_POSITION_JUMP + ((elbow_arm_real_t)(s->held_ticks + 1u) * elbow_arm_POSITION_WAY_PER_TICK);
    if (!elbow_arm_equal(clamped, reading)) {
        s->status |= ELBOW_ARM_SHAPER_ROPE_OUT_OF_RANGE;
    }
    if (!elbow_arm_running(s) || (elbow_arm_abs(clamped - s->position) <= reach)) {
        s->position = clamped;
        s->held_ticks = 0u;
    } else {
        s->status |= ELBOW_ARM_SHAPER_ROPE_JUMP;
        elbow_arm_hold_position(s);
    }
}

/* Watch for a position that stays, within the range, while the axis says that it moves. */
static void elbow_arm_watch_position(elbow_arm_shaper_t *s, elbow_arm_real_t before)
{
    const bool inside = (elbow_arm_LOWEST_POSITION < s->position) && (s->position < elbow_arm_HIGHEST_POSITION);
    if (!inside || !elbow_arm_equal(s->position, before) || elbow_arm_equal(s->position_speed, 0.0)) {
        s->unmoved = 0.0;
    } else {
        s->unmoved = s->unmoved + ((elbow_arm_real_t)elbow_arm_abs(s->position_speed) * elbow_arm_POSITION_TICK);
        if (s->unmoved >= elbow_arm_FROZEN_WAY) {
            s->unmoved = elbow_arm_FROZEN_WAY;
            s->status |= ELBOW_ARM_SHAPER_ROPE_FROZEN;
        }
    }
}

/* Read the position, and see whether the same reading would change nothing once more. */
static void elbow_arm_read_position(elbow_arm_shaper_t *s, const elbow_arm_shaper_input_t *input)
{
    const elbow_arm_real_t before = s->position;
    if (elbow_arm_is_number(input->position_speed_m_s)) {
        s->position_speed = elbow_arm_within(input->position_speed_m_s, -elbow_arm_POSITION_SPEED, elbow_arm_POSITION_SPEED);
    } else {
        s->position_speed = 0.0;
        s->status |= ELBOW_ARM_SHAPER_HOIST_SPEED_INVALID;
    }
    if (input->position_valid && elbow_arm_is_number(input->position_m)) {
        elbow_arm_take_position(s, input->position_m);
    } else {
        s->status |= ELBOW_ARM_SHAPER_ROPE_INVALID;
        elbow_arm_hold_position(s);
    }
    elbow_arm_watch_position(s, before);
    s->position_still = (s->held_ticks == 0u) && elbow_arm_equal(s->position, before)
        && ((s->unmoved <= 0.0) || (s->unmoved >= elbow_arm_FROZEN_WAY));
}

/* A reference within the maximum. */
static elbow_arm_real_t elbow_arm_reference(elbow_arm_real_t total)
{
    return elbow_arm_within(total, -elbow_arm_MAX_COMMAND, elbow_arm_MAX_COMMAND);
}

/* Whether so many ticks ago was in this run, and not in the rest before it. */
static bool elbow_arm_in_run(const elbow_arm_shaper_t *s, uint32_t delay)
{
    return s->lapped || (delay <= s->head);
}

/* Cell of so many ticks ago. */
static uint32_t elbow_arm_cell(const elbow_arm_shaper_t *s, uint32_t delay)
{
    return (delay <= s->head) ? (s->head - delay) : (s->head + ((elbow_arm_LAST_TICKS + 1u) - delay));
}

/* Spacing of so many ticks ago. */
static uint32_t elbow_arm_spacing_then(const elbow_arm_shaper_t *s, uint32_t delay)
{
    return elbow_arm_in_run(s, delay) ? s->spacings[elbow_arm_cell(s, delay)] : s->start_spacing;
}

/* Begin a run: every tap lags by the spacing of now. */
static void elbow_arm_begin(elbow_arm_shaper_t *s)
{
    const uint32_t taps = elbow_arm_FIRST_TAP[s->row + 1u] - elbow_arm_FIRST_TAP[s->row];
    uint32_t tap;
    s->start_spacing = s->spacing;
    for (tap = 0u; tap < taps; ++tap) {
        s->delays[tap] = tap * s->spacing;
    }
}

/* Delay of a tap for this tick: the median of what it was, and of what the two samples want. */
static uint32_t elbow_arm_followed(const elbow_arm_shaper_t *s, uint32_t tap)
{
    const uint32_t wanted = tap * elbow_arm_spacing_then(s, s->delays[tap]);
    const uint32_t agreed = tap * elbow_arm_spacing_then(s, wanted);
    const uint32_t low = (wanted < agreed) ? wanted : agreed;
    const uint32_t high = (wanted < agreed) ? agreed : wanted;
    uint32_t delay = s->delays[tap];
    if (delay < low) {
        delay = low;
    } else if (delay > high) {
        delay = high;
    } else {
        /* between them: it stays */
    }
    return delay;
}

/* Each tap reads one past command a tick. */
static elbow_arm_real_t elbow_arm_shape(elbow_arm_shaper_t *s, elbow_arm_real_t command)
{
    const uint32_t first = elbow_arm_FIRST_TAP[s->row];
    const uint32_t end = elbow_arm_FIRST_TAP[s->row + 1u];
    elbow_arm_real_t total = 0.0;
    uint32_t i;
    s->ring[s->head] = command;
    s->spacings[s->head] = (uint16_t)s->spacing;
    for (i = first; i < end; ++i) {
        const uint32_t delay = elbow_arm_followed(s, i - first);
        const elbow_arm_real_t past = elbow_arm_in_run(s, delay) ? s->ring[elbow_arm_cell(s, delay)] : s->base;
        s->delays[i - first] = delay;
        total = total + (elbow_arm_AMPLITUDE[i] * past);
    }
    return total;
}

/* Ticks between taps: of the last piece that has begun, by halving. */
static uint32_t elbow_arm_spacing_at(elbow_arm_real_t position)
{
    uint32_t piece = 0u;
    uint32_t end = elbow_arm_PIECES;
    while ((end - piece) > 1u) {
        const uint32_t middle = (piece + end) >> 1;
        if (position < elbow_arm_PIECE_START[middle]) {
            end = middle;
        } else {
            piece = middle;
        }
    }
    return elbow_arm_PIECE_TICKS[piece];
}

/* Take what is measured in this tick: it changes the spacing, and with it the stop that was foretold. */
static void elbow_arm_turn(elbow_arm_shaper_t *s)
{
    const uint32_t spacing = elbow_arm_spacing_at(s->position);
    if (spacing != s->spacing) {
        s->spacing = spacing;
        s->foretold = false;
    }
}

/* Ticks in which what is left of a row's last lag passes; lags are those of the widest spacing. */
static uint32_t elbow_arm_ticks_of(const elbow_arm_shaper_t *s, uint8_t row, uint32_t lag)
{
    const uint32_t spacings = (elbow_arm_FIRST_TAP[row + 1u] - elbow_arm_FIRST_TAP[row]) - 1u;
    const uint32_t saved = spacings * (elbow_arm_MOST_SPACING - s->spacing);
    return (lag > saved) ? (lag - saved) : 0u;
}

/* Rest at a command: within reach of the taps all commands equal it. */
static void elbow_arm_rest(elbow_arm_shaper_t *s, elbow_arm_real_t command)
{
    s->base = command;
    s->running = false;
}

/* Shape one new command. Sums of commands start anew with each lap of the ring, so that they do not drift. */
static elbow_arm_real_t elbow_arm_run(elbow_arm_shaper_t *s, elbow_arm_real_t command)
{
    elbow_arm_real_t before = 0.0;
    if (!s->running) {
        elbow_arm_begin(s);
        s->running = true;
        s->lapped = false;
        s->head = 0u;
    } else if (s->head >= elbow_arm_LAST_TICKS) {
        s->lap_sum = s->sums[s->head];
        s->lapped = true;
        s->head = 0u;
    } else {
        before = s->sums[s->head];
        s->head += 1u;
    }
    s->sums[s->head] = before + command;
    return elbow_arm_reference(elbow_arm_shape(s, command));
}

/* Sum of so many latest commands; those before the run are the command of the rest. */
static elbow_arm_real_t elbow_arm_latest(const elbow_arm_shaper_t *s, uint32_t delay)
{
    elbow_arm_real_t latest = s->sums[s->head];
    if (delay <= s->head) {
        latest = latest - s->sums[s->head - delay];
    } else if (s->lapped) {
        latest = latest + (s->lap_sum - s->sums[s->head + ((elbow_arm_LAST_TICKS + 1u) - delay)]);
    } else {
        latest = latest + ((elbow_arm_real_t)((delay - s->head) - 1u) * s->base);
    }
    return latest;
}

/* Sum of the references still to come if every later command is 0 and the spacing stays. */
static elbow_arm_real_t elbow_arm_pending(const elbow_arm_shaper_t *s, uint8_t row)
{
    const uint32_t first = elbow_arm_FIRST_TAP[row];
    const uint32_t end = elbow_arm_FIRST_TAP[row + 1u];
    elbow_arm_real_t total = 0.0;
    uint32_t i;
    for (i = first; i < end; ++i) {
        elbow_arm_real_t latest = (elbow_arm_real_t)((i - first) * s->spacing) * s->base;
        if (s->running) {
            latest = elbow_arm_latest(s, s->delays[i - first]);
        }
        total = total + (elbow_arm_AMPLITUDE[i] * latest);
    }
    return total;
}

/* Clamp the command to the maximum; a command that is not finite becomes 0, and the result is false. */
static bool elbow_arm_finite(elbow_arm_shaper_t *s, elbow_arm_real_t *command)
{
    const elbow_arm_real_t magnitude = elbow_arm_abs(*command);
    bool valid = true;
    if (!(magnitude <= elbow_arm_MAX_COMMAND)) {
        /* Only what is finite and not 0 shrinks when halved. */
        if ((magnitude * 0.5) < magnitude) {
            *command = (*command > 0.0) ? elbow_arm_MAX_COMMAND : -elbow_arm_MAX_COMMAND;
            s->status |= ELBOW_ARM_SHAPER_COMMAND_CLAMPED;
        } else {
            *command = 0.0;
            valid = false;
        }
    }
    return valid;
}

/* The command as far as it is finite, within the maximum. */
static elbow_arm_real_t elbow_arm_checked(elbow_arm_shaper_t *s, elbow_arm_real_t wanted)
{
    elbow_arm_real_t command = wanted;
    const bool valid = elbow_arm_finite(s, &command);
    s->zero_commanded = valid && elbow_arm_equal(command, 0.0);
    if (!valid) {
        s->invalid = true;
    } else if (s->zero_commanded) {
        s->invalid = false;
    } else {
        /* latched as it is */
    }
    if (s->invalid) {
        s->status |= ELBOW_ARM_SHAPER_COMMAND_INVALID;
    }
    return (s->invalid || s->zero_commanded) ? 0.0 : command;
}

/* The row that the selector and enable ask for; an invalid selector keeps the last valid one. */
static void elbow_arm_want_row(elbow_arm_shaper_t *s, const elbow_arm_shaper_input_t *input)
{
    const uint8_t before = s->wanted_row;
    if (input->selector <= (uint8_t)ELBOW_ARM_SHAPER_ROWS) {
        s->selected_row = input->selector;
    } else {
        s->status |= ELBOW_ARM_SHAPER_SELECTOR_INVALID;
    }
    s->wanted_row = s->selected_row;
    if (!input->enable) {
        s->status |= ELBOW_ARM_SHAPER_DISABLED;
        s->wanted_row = 0u;
    }
    if (s->wanted_row != before) {
        s->foretold = false;
    }
}

/* Stops latch until they are released and the command is 0, a quick stop also until the reference is. */
static void elbow_arm_latch_stops(elbow_arm_shaper_t *s, const elbow_arm_shaper_input_t *input)
{
    if (input->emergency_stop) {
        s->emergency = true;
    } else if (s->zero_commanded) {
        s->emergency = false;
    } else {
        /* latched as it is */
    }
    if (input->quick_stop) {
        s->quick = true;
    } else if (s->zero_commanded && elbow_arm_equal(s->reference, 0.0)) {
        s->quick = false;
    } else {
        /* latched as it is */
    }
}

static bool elbow_arm_settled(const elbow_arm_shaper_t *s)
{
    return s->still_ticks >= elbow_arm_LAST_TICKS;
}

/* One tick further up: grows by the acceleration, shrinks by the deceleration, passes 0 by no more of either. */
static elbow_arm_real_t elbow_arm_raised(elbow_arm_real_t command)
{
    elbow_arm_real_t reach;
    if (command >= 0.0) {
        reach = elbow_arm_on_grid(command) + elbow_arm_ACCELERATION.step;
    } else {
        reach = command + elbow_arm_DECELERATION.step;
        if (reach > elbow_arm_ACCELERATION.step) {
            reach = elbow_arm_ACCELERATION.step;
        }
    }
    return reach;
}

/* One tick further down, likewise. */
static elbow_arm_real_t elbow_arm_lowered(elbow_arm_real_t command)
{
    elbow_arm_real_t reach;
    if (command <= 0.0) {
        reach = elbow_arm_on_grid(command) - elbow_arm_ACCELERATION.step;
    } else {
        reach = command - elbow_arm_DECELERATION.step;
        if (reach < -elbow_arm_ACCELERATION.step) {
            reach = -elbow_arm_ACCELERATION.step;
        }
    }
    return reach;
}

/* The command one tick nearer to its target. */
static elbow_arm_real_t elbow_arm_ramped(elbow_arm_real_t command, elbow_arm_real_t target)
{
    elbow_arm_real_t reach = target;
    if (target > command) {
        reach = elbow_arm_raised(command);
        if (reach > target) {
            reach = target;
        }
    } else if (target < command) {
        reach = elbow_arm_lowered(command);
        if (reach < target) {
            reach = target;
        }
    } else {
        /* there already */
    }
    return reach;
}

/* Take the reference to 0 and what is pending with it: the shaper rests at the reference. */
static void elbow_arm_stop(elbow_arm_shaper_t *s)
{
    const elbow_arm_real_t reach = elbow_arm_abs(s->reference) - elbow_arm_QUICK_STOP.step;
    if (s->emergency || (reach <= 0.0)) {
        s->reference = 0.0;
        s->still_ticks = elbow_arm_LAST_TICKS;
    } else {
        s->reference = (s->reference > 0.0) ? reach : -reach;
        s->still_ticks = 0u;
    }
    s->command = s->reference;
    s->target = s->reference;
    s->foretold = false;
    elbow_arm_rest(s, s->reference);
}

/* The command becomes the target. */
static void elbow_arm_accept(elbow_arm_shaper_t *s, elbow_arm_real_t command)
{
    elbow_arm_real_t wanted = command;
    s->target = wanted;
}

/* Choose the row when settled; ramp, then shape. */
static void elbow_arm_move(elbow_arm_shaper_t *s, elbow_arm_real_t command)
{
    const elbow_arm_real_t before = s->command;
    if (elbow_arm_settled(s)) {
        s->row = s->wanted_row;
    }
    elbow_arm_accept(s, command);
    s->command = elbow_arm_ramped(s->command, s->target);
    if (!elbow_arm_equal(s->command, before)) {
        s->still_ticks = 0u;
        s->foretold = false;
    } else if (!elbow_arm_settled(s)) {
        s->still_ticks += 1u;
    } else {
        /* settled as it is */
    }
    if (s->still_ticks >= elbow_arm_TAIL_TICKS[s->row]) {
        elbow_arm_rest(s, s->command);
        s->reference = s->command;
    } else {
        s->reference = elbow_arm_run(s, s->command);
    }
}

/* A ramp that does not pass 0, in closed form; as exact as the ramp, so never a tick off. */
static elbow_arm_glide_t elbow_arm_glide(elbow_arm_real_t start, elbow_arm_real_t target, const elbow_arm_ramp_t *ramp)
{
    elbow_arm_glide_t glide = { 0.0, 0u };
    if (!elbow_arm_equal(start, target)) {
        const elbow_arm_real_t from = (elbow_arm_abs(target) > elbow_arm_abs(start)) ? elbow_arm_on_grid(start) : start;
        const bool falls = from > target;
        const elbow_arm_real_t step = falls ? -ramp->step : ramp->step;
        const elbow_arm_real_t steps = (elbow_arm_abs(from - target) * ramp->steps_per_unit) + 0.5;
        uint32_t whole = (uint32_t)steps; /* the nearest; one too many if it has landed */
        const elbow_arm_real_t position = from + ((elbow_arm_real_t)whole * step);
        const bool landed = falls ? (position <= target) : (position >= target);
        elbow_arm_real_t count;
        if (landed && (whole > 0u)) {
            whole -= 1u;
        }
        count = (elbow_arm_real_t)whole;
        glide.total = ((count * from) + (step * ((count * (count + 1.0)) * 0.5))) + target;
        glide.ticks = whole + 1u;
    }
    return glide;
}

static elbow_arm_real_t elbow_arm_distance(elbow_arm_real_t total)
{
    return total * elbow_arm_METRES_PER_UNIT_TICK;
}

static elbow_arm_real_t elbow_arm_time_s(uint32_t ticks)
{
    return (elbow_arm_real_t)ticks * elbow_arm_TICK_S;
}

/* The row that takes over if the command becomes 0 when settled. */
static uint8_t elbow_arm_row_at_rest(const elbow_arm_shaper_t *s)
{
    return s->wanted_row;
}

/* A stop at once: the ramp goes down and the taps run out. */
static elbow_arm_glide_t elbow_arm_foretell_release(const elbow_arm_shaper_t *s)
{
    const uint8_t row = elbow_arm_settled(s) ? elbow_arm_row_at_rest(s) : s->row;
    const uint32_t tail = elbow_arm_TAIL_TICKS[row];
    elbow_arm_glide_t stop = elbow_arm_glide(s->command, 0.0, &elbow_arm_DECELERATION);
    stop.total = elbow_arm_pending(s, row) + stop.total;
    if (stop.ticks > 0u) {
        stop.ticks += elbow_arm_ticks_of(s, row, tail);
    } else if (tail > s->still_ticks) {
        stop.ticks = elbow_arm_ticks_of(s, row, tail - s->still_ticks);
    } else {
        /* at rest */
    }
    return stop;
}

/* Sum of the references to come, and ticks until the last, if the command is 0 from the next tick on. */
static elbow_arm_glide_t elbow_arm_foretell(const elbow_arm_shaper_t *s)
{
    elbow_arm_glide_t stop = { 0.0, 0u };
    if (s->emergency) {
        /* stopped */
    } else if (s->quick) {
        stop = elbow_arm_glide(s->reference, 0.0, &elbow_arm_QUICK_STOP);
    } else {
        stop = elbow_arm_foretell_release(s);
    }
    return stop;
}

static bool elbow_arm_stopped(const elbow_arm_shaper_t *s)
{
    return s->emergency || s->quick;
}

static uint32_t elbow_arm_full_status(const elbow_arm_shaper_t *s)
{
    uint32_t status = s->status;
    if (s->row == 0u) {
        status |= ELBOW_ARM_SHAPER_UNSHAPED;
    }
    if ((s->row != s->wanted_row)) {
        status |= ELBOW_ARM_SHAPER_ROW_WAITS;
    }
    if (s->quick) {
        status |= ELBOW_ARM_SHAPER_QUICK_STOP;
    }
    if (s->emergency) {
        status |= ELBOW_ARM_SHAPER_EMERGENCY_STOP;
    }
    return status;
}

/* Whether the last tick began and ended settled and this one has the same inputs: then nothing can change. */
static bool elbow_arm_idles(const elbow_arm_shaper_t *s, const elbow_arm_shaper_input_t *input)
{
    return s->idle && elbow_arm_equal(input->command, s->input.command) && (input->selector == s->input.selector)
        && (input->enable == s->input.enable) && (input->quick_stop == s->input.quick_stop)
        && s->position_still && elbow_arm_equal(input->position_m, s->input.position_m)
        && elbow_arm_equal(input->position_speed_m_s, s->input.position_speed_m_s)
        && (input->position_valid == s->input.position_valid)
        && (input->emergency_stop == s->input.emergency_stop);
}

/* Run one tick into s->output. */
static void elbow_arm_tick(elbow_arm_shaper_t *s, const elbow_arm_shaper_input_t *input)
{
    const bool began_settled = elbow_arm_settled(s);
    elbow_arm_shaper_output_t *const output = &s->output;
    elbow_arm_real_t command;
    uint8_t row;

    s->status = 0u;
    elbow_arm_read_position(s, input);
    elbow_arm_turn(s);
    command = elbow_arm_checked(s, input->command);
    elbow_arm_want_row(s, input);
    elbow_arm_latch_stops(s, input);
    if (elbow_arm_stopped(s)) {
        elbow_arm_stop(s);
    } else {
        elbow_arm_move(s, command);
    }

    if (!s->foretold) {
        const elbow_arm_glide_t stop = elbow_arm_foretell(s);
        output->stop_distance = elbow_arm_distance(stop.total);
        output->stop_time_s = elbow_arm_time_s(stop.ticks);
        output->stop_time_ticks = stop.ticks;
        s->foretold = elbow_arm_settled(s) && !elbow_arm_stopped(s);
    }
    row = elbow_arm_stopped(s) ? 0u : s->row;
    output->reference = s->reference;
    output->residual_bound = elbow_arm_RESIDUAL_BOUND[row];
    output->row = s->row;
    output->settled = elbow_arm_settled(s);
    output->active = (row > 0u);
    output->error = ((s->status & (ELBOW_ARM_SHAPER_COMMAND_INVALID
        | ELBOW_ARM_SHAPER_SELECTOR_INVALID
        | ELBOW_ARM_SHAPER_ROPE_INVALID
        | ELBOW_ARM_SHAPER_ROPE_JUMP
        | ELBOW_ARM_SHAPER_ROPE_FROZEN
        | ELBOW_ARM_SHAPER_HOIST_SPEED_INVALID)) != 0u);
    output->status = elbow_arm_full_status(s);
    s->input = *input;
    s->idle = began_settled && s->foretold;
}

void elbow_arm_shaper_init(elbow_arm_shaper_t *shaper)
{
    elbow_arm_shaper_t *const s = shaper;
    s->lap_sum = 0.0;
    s->spacing = 6u;
    s->start_spacing = 6u;
    s->base = 0.0;
    s->target = 0.0;
    s->command = 0.0;
    s->reference = 0.0;
    s->unmoved = 0.0;
    s->position = 3.94;
    s->position_speed = 0.0;
    s->held_ticks = 0u;
    s->head = 12u;
    s->still_ticks = 12u;
    s->status = 0u;
    s->row = 0u;
    s->selected_row = 0u;
    s->wanted_row = 0u;
    s->running = false;
    s->lapped = false;
    s->foretold = false;
    s->idle = false;
    s->zero_commanded = false;
    s->invalid = false;
    s->quick = false;
    s->emergency = false;
    s->position_still = false;
    /* The ring, the last inputs and the last outputs are not read before they are written. */
}

void elbow_arm_shaper_step(elbow_arm_shaper_t *shaper, const elbow_arm_shaper_input_t *input,
    elbow_arm_shaper_output_t *output)
{
    if (!elbow_arm_idles(shaper, input)) {
        elbow_arm_tick(shaper, input);
    }
    *output = shaper->output;
}
