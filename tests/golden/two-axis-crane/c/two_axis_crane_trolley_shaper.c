/*
 * two_axis_crane_trolley: command shaper, see two_axis_crane_trolley_shaper.h.
 * Design SHA-256 bc1d383a4c91c2daec5ed1c7166766c66c97f37090ade68dddf972600366f392.
 */
#include "two_axis_crane_trolley_shaper.h"

#if (TWO_AXIS_CRANE_TROLLEY_SHAPER_DESIGN != 0xbc1d383au)
#error "two_axis_crane_trolley_shaper.h and two_axis_crane_trolley_shaper.c belong to different designs"
#endif

/* Does not compile when the state is larger than the header says. */
typedef char two_axis_crane_trolley_ram_check[(sizeof(two_axis_crane_trolley_shaper_t) <= (unsigned)TWO_AXIS_CRANE_TROLLEY_SHAPER_RAM) ? 1 : -1];

static const uint32_t two_axis_crane_trolley_LAST_TICKS = 500u; /* longest delay of any row */
static const two_axis_crane_trolley_real_t two_axis_crane_trolley_MAX_COMMAND = 0.5; /* m/s: max_speed */
static const two_axis_crane_trolley_real_t two_axis_crane_trolley_RAMP_ANCHOR = 1.0; /* floats next to it are the grid of ramp steps */
static const two_axis_crane_trolley_real_t two_axis_crane_trolley_METRES_PER_UNIT_TICK = 0.01; /* m of way per unit and tick */
static const two_axis_crane_trolley_real_t two_axis_crane_trolley_TICK_S = 0.01; /* s: tick */
static const two_axis_crane_trolley_real_t two_axis_crane_trolley_SHORTEST_ROPE = 3.0; /* m: rope_length */
static const two_axis_crane_trolley_real_t two_axis_crane_trolley_LONGEST_ROPE = 9.0; /* m: rope_length */
static const two_axis_crane_trolley_real_t two_axis_crane_trolley_HOIST_SPEED = 0.25; /* m/s: hoist_speed */
static const two_axis_crane_trolley_real_t two_axis_crane_trolley_ROPE_JUMP = 0.05; /* m: difference of two readings that is always taken */
static const two_axis_crane_trolley_real_t two_axis_crane_trolley_ROPE_WAY_PER_TICK = 0.0025; /* m: hoist_speed times tick */
static const two_axis_crane_trolley_real_t two_axis_crane_trolley_ROPE_TICK = 0.01; /* s: tick */
static const two_axis_crane_trolley_real_t two_axis_crane_trolley_FROZEN_WAY = 0.05; /* m: a length that stays so long is frozen */
static const uint32_t two_axis_crane_trolley_MOST_HELD_TICKS = 1048576u; /* by then the hoist may be anywhere */

/* first tap of each row, and the end */
static const uint32_t two_axis_crane_trolley_FIRST_TAP[4] = {
    0u, 1u, 7u, 11u
};
/* delay of each tap, by row */
static const uint32_t two_axis_crane_trolley_DELAY_TICKS[11] = {
    0u,
    0u, 200u, 201u, 299u, 300u, 500u,
    0u, 155u, 156u, 311u
};
/* amplitude of each tap, by row; each row sums to exactly 1 */
static const two_axis_crane_trolley_real_t two_axis_crane_trolley_AMPLITUDE[11] = {
    1.0,
    0.236287898951, 0.25701275809400004, 0.006699342955999943, 0.006699342898999983, 0.25701275814900004, 0.236287898951,
    0.269676244649, 0.23032375535100003, 0.23032375535100003, 0.269676244649
};
/* longest delay of each row */
static const uint32_t two_axis_crane_trolley_TAIL_TICKS[3] = {
    0u, 500u, 311u
};
/* sum of amplitude times delay of each row: references to come per unit of a steady command */
static const two_axis_crane_trolley_real_t two_axis_crane_trolley_MOMENT_TICKS[3] = {
    0.0, 249.999999999957, 155.5
};
/* tolerance of each row */
static const two_axis_crane_trolley_real_t two_axis_crane_trolley_RESIDUAL_BOUND[3] = {
    1.0, 0.05, 0.05
};
/* m of rope: below it the next row is wanted */
static const two_axis_crane_trolley_real_t two_axis_crane_trolley_ROW_SHORTEST[3] = {
    0.0, 3.8916315473500003, 3.0
};
/* m of rope: above it the row before is wanted */
static const two_axis_crane_trolley_real_t two_axis_crane_trolley_ROW_LONGEST[3] = {
    0.0, 9.0, 3.99163154735
};

/* A ramp: its step per tick, rounded up to the grid, and what its closed form needs. */
typedef struct {
    two_axis_crane_trolley_real_t step;
    two_axis_crane_trolley_real_t steps_per_unit; /* 1 / step */
} two_axis_crane_trolley_ramp_t;

/* m/s per tick: acceleration */
static const two_axis_crane_trolley_ramp_t two_axis_crane_trolley_ACCELERATION = { 0.0030000000000001137, 333.3333333333207 };
/* m/s per tick: deceleration */
static const two_axis_crane_trolley_ramp_t two_axis_crane_trolley_DECELERATION = { 0.0030000000000001137, 333.3333333333207 };
/* m/s per tick: quick_stop */
static const two_axis_crane_trolley_ramp_t two_axis_crane_trolley_QUICK_STOP = { 0.0030000000000001137, 333.3333333333207 };

/* What a ramp still has to do: ticks, and the sum of the commands of those ticks. */
typedef struct {
    two_axis_crane_trolley_real_t total;
    uint32_t ticks;
} two_axis_crane_trolley_glide_t;

static two_axis_crane_trolley_real_t two_axis_crane_trolley_abs(two_axis_crane_trolley_real_t value)
{
    return (value < 0.0) ? -value : value;
}

static bool two_axis_crane_trolley_equal(two_axis_crane_trolley_real_t a, two_axis_crane_trolley_real_t b)
{
    return (a <= b) && (a >= b);
}

/* Round a command to the grid of ramp steps: from there on a ramp adds exactly. */
static two_axis_crane_trolley_real_t two_axis_crane_trolley_on_grid(two_axis_crane_trolley_real_t command)
{
    const two_axis_crane_trolley_real_t anchor = (command < 0.0) ? -two_axis_crane_trolley_RAMP_ANCHOR : two_axis_crane_trolley_RAMP_ANCHOR;
    return (command + anchor) - anchor;
}

/* Whether commands within reach of the taps may differ. */
static bool two_axis_crane_trolley_running(const two_axis_crane_trolley_shaper_t *s)
{
    return s->lapped || (s->head < two_axis_crane_trolley_LAST_TICKS);
}

/* Rest at a command: within reach of the taps all commands equal it. */
static void two_axis_crane_trolley_rest(two_axis_crane_trolley_shaper_t *s, two_axis_crane_trolley_real_t command)
{
    s->base = command;
    s->head = two_axis_crane_trolley_LAST_TICKS;
    s->lapped = false;
}

/* Sum of the references still to come at rest at a command. */
static two_axis_crane_trolley_real_t two_axis_crane_trolley_rest_sum(two_axis_crane_trolley_real_t command, uint8_t row)
{
    return command * two_axis_crane_trolley_MOMENT_TICKS[row];
}

/* Shape one new command. */
static two_axis_crane_trolley_real_t two_axis_crane_trolley_run(two_axis_crane_trolley_shaper_t *s, two_axis_crane_trolley_real_t command)
{
    const uint32_t first = two_axis_crane_trolley_FIRST_TAP[s->row];
    const uint32_t end = two_axis_crane_trolley_FIRST_TAP[s->row + 1u];
    two_axis_crane_trolley_real_t reference = 0.0;
    two_axis_crane_trolley_real_t lap = 0.0; /* the part of this lap's commands */
    two_axis_crane_trolley_real_t low = -two_axis_crane_trolley_MAX_COMMAND;
    two_axis_crane_trolley_real_t high = two_axis_crane_trolley_MAX_COMMAND;
    uint32_t i;

    if (!two_axis_crane_trolley_running(s)) {
        s->pending = two_axis_crane_trolley_rest_sum(s->base, s->row);
        s->fresh = 0.0;
    }
    s->head = (s->head >= two_axis_crane_trolley_LAST_TICKS) ? 0u : (s->head + 1u);
    s->ring[s->head] = command;
    for (i = first; i < end; ++i) {
        const uint32_t delay = two_axis_crane_trolley_DELAY_TICKS[i];
        if (delay <= s->head) {
            reference = reference + (two_axis_crane_trolley_AMPLITUDE[i] * s->ring[s->head - delay]);
            lap = reference;
        } else if (s->lapped) {
            const uint32_t older = s->head + ((two_axis_crane_trolley_LAST_TICKS + 1u) - delay);
            reference = reference + (two_axis_crane_trolley_AMPLITUDE[i] * s->ring[older]);
        } else {
            reference = reference + (two_axis_crane_trolley_AMPLITUDE[i] * s->base);
        }
    }
    /* Rounding alone could pass these bounds, by the last bit. */
    if (reference < low) {
        reference = low;
    } else if (reference > high) {
        reference = high;
    } else {
        /* in range */
    }
    s->pending = s->pending + (command - reference);
    s->fresh = s->fresh + (command - lap);
    if (s->head >= two_axis_crane_trolley_LAST_TICKS) {
        /* A full lap knows every command within reach: its sum ends the rounding of the older one. */
        s->pending = s->fresh;
        s->fresh = 0.0;
        s->lapped = true;
    }
    return reference;
}

/* Sum of the references still to come if every later command is 0. */
static two_axis_crane_trolley_real_t two_axis_crane_trolley_pending(const two_axis_crane_trolley_shaper_t *s, uint8_t row)
{
    return two_axis_crane_trolley_running(s) ? s->pending : two_axis_crane_trolley_rest_sum(s->base, row);
}

/* Whether a reading is a number: only what is finite and not 0 shrinks when halved. */
static bool two_axis_crane_trolley_is_number(two_axis_crane_trolley_real_t value)
{
    const two_axis_crane_trolley_real_t magnitude = two_axis_crane_trolley_abs(value);
    return two_axis_crane_trolley_equal(magnitude, 0.0) || ((magnitude * 0.5) < magnitude);
}

/* Value, but not below low, and not above high. */
static two_axis_crane_trolley_real_t two_axis_crane_trolley_within(two_axis_crane_trolley_real_t value, two_axis_crane_trolley_real_t low, two_axis_crane_trolley_real_t high)
{
    two_axis_crane_trolley_real_t result = value;
    if (result < low) {
        result = low;
    }
    if (result > high) {
        result = high;
    }
    return result;
}

static void two_axis_crane_trolley_hold_rope(two_axis_crane_trolley_shaper_t *s)
{
    if (s->held_ticks < two_axis_crane_trolley_MOST_HELD_TICKS) {
        s->held_ticks += 1u;
    }
}

/* Take a rope length where it can be true; otherwise the last one holds. At rest every length can. */
static void two_axis_crane_trolley_take_length(two_axis_crane_trolley_shaper_t *s, two_axis_crane_trolley_real_t reading)
{
    const two_axis_crane_trolley_real_t clamped = two_axis_crane_trolley_within(reading, two_axis_crane_trolley_SHORTEST_ROPE, two_axis_crane_trolley_LONGEST_ROPE);
    const two_axis_crane_trolley_real_t reach = two_axis_crane_trolley_ROPE_JUMP + ((two_axis_crane_trolley_real_t)(s->held_ticks + 1u) * two_axis_crane_trolley_ROPE_WAY_PER_TICK);
    if (!two_axis_crane_trolley_equal(clamped, reading)) {
        s->status |= TWO_AXIS_CRANE_TROLLEY_SHAPER_ROPE_OUT_OF_RANGE;
    }
    if (!two_axis_crane_trolley_running(s) || (two_axis_crane_trolley_abs(clamped - s->rope_length) <= reach)) {
        s->rope_length = clamped;
        s->held_ticks = 0u;
    } else {
        s->status |= TWO_AXIS_CRANE_TROLLEY_SHAPER_ROPE_JUMP;
        two_axis_crane_trolley_hold_rope(s);
    }
}

/* Watch for a length that stays, within the range, while the hoist says that it moves. */
static void two_axis_crane_trolley_watch_rope(two_axis_crane_trolley_shaper_t *s, two_axis_crane_trolley_real_t before)
{
    const bool inside = (two_axis_crane_trolley_SHORTEST_ROPE < s->rope_length) && (s->rope_length < two_axis_crane_trolley_LONGEST_ROPE);
    if (!inside || !two_axis_crane_trolley_equal(s->rope_length, before) || two_axis_crane_trolley_equal(s->hoist_speed, 0.0)) {
        s->unmoved = 0.0;
    } else {
        s->unmoved = s->unmoved + ((two_axis_crane_trolley_real_t)two_axis_crane_trolley_abs(s->hoist_speed) * two_axis_crane_trolley_ROPE_TICK);
        if (s->unmoved >= two_axis_crane_trolley_FROZEN_WAY) {
            s->unmoved = two_axis_crane_trolley_FROZEN_WAY;
            s->status |= TWO_AXIS_CRANE_TROLLEY_SHAPER_ROPE_FROZEN;
        }
    }
}

/* Read the rope, and see whether the same reading would change nothing once more. */
static void two_axis_crane_trolley_read_rope(two_axis_crane_trolley_shaper_t *s, const two_axis_crane_trolley_shaper_input_t *input)
{
    const two_axis_crane_trolley_real_t before = s->rope_length;
    if (two_axis_crane_trolley_is_number(input->hoist_speed_m_s)) {
        s->hoist_speed = two_axis_crane_trolley_within(input->hoist_speed_m_s, -two_axis_crane_trolley_HOIST_SPEED, two_axis_crane_trolley_HOIST_SPEED);
    } else {
        s->hoist_speed = 0.0;
        s->status |= TWO_AXIS_CRANE_TROLLEY_SHAPER_HOIST_SPEED_INVALID;
    }
    if (input->rope_length_valid && two_axis_crane_trolley_is_number(input->rope_length_m)) {
        two_axis_crane_trolley_take_length(s, input->rope_length_m);
    } else {
        s->status |= TWO_AXIS_CRANE_TROLLEY_SHAPER_ROPE_INVALID;
        two_axis_crane_trolley_hold_rope(s);
    }
    two_axis_crane_trolley_watch_rope(s, before);
    s->rope_still = (s->held_ticks == 0u) && two_axis_crane_trolley_equal(s->rope_length, before)
        && ((s->unmoved <= 0.0) || (s->unmoved >= two_axis_crane_trolley_FROZEN_WAY));
}

/* The row of the rope: it stays as long as the length is its own. */
static void two_axis_crane_trolley_follow_rope(two_axis_crane_trolley_shaper_t *s)
{
    while ((s->rope_row < (uint8_t)TWO_AXIS_CRANE_TROLLEY_SHAPER_ROWS) && (s->rope_length < two_axis_crane_trolley_ROW_SHORTEST[s->rope_row])) {
        s->rope_row = (uint8_t)(s->rope_row + 1u);
    }
    while ((s->rope_row > 1u) && (s->rope_length > two_axis_crane_trolley_ROW_LONGEST[s->rope_row])) {
        s->rope_row = (uint8_t)(s->rope_row - 1u);
    }
}

/* Clamp the command to the maximum; a command that is not finite becomes 0, and the result is false. */
static bool two_axis_crane_trolley_finite(two_axis_crane_trolley_shaper_t *s, two_axis_crane_trolley_real_t *command)
{
    const two_axis_crane_trolley_real_t magnitude = two_axis_crane_trolley_abs(*command);
    bool valid = true;
    if (!(magnitude <= two_axis_crane_trolley_MAX_COMMAND)) {
        /* Only what is finite and not 0 shrinks when halved. */
        if ((magnitude * 0.5) < magnitude) {
            *command = (*command > 0.0) ? two_axis_crane_trolley_MAX_COMMAND : -two_axis_crane_trolley_MAX_COMMAND;
            s->status |= TWO_AXIS_CRANE_TROLLEY_SHAPER_COMMAND_CLAMPED;
        } else {
            *command = 0.0;
            valid = false;
        }
    }
    return valid;
}

/* The command as far as it is finite, within the maximum. */
static two_axis_crane_trolley_real_t two_axis_crane_trolley_checked(two_axis_crane_trolley_shaper_t *s, two_axis_crane_trolley_real_t wanted)
{
    two_axis_crane_trolley_real_t command = wanted;
    const bool valid = two_axis_crane_trolley_finite(s, &command);
    s->zero_commanded = valid && two_axis_crane_trolley_equal(command, 0.0);
    if (!valid) {
        s->invalid = true;
    } else if (s->zero_commanded) {
        s->invalid = false;
    } else {
        /* latched as it is */
    }
    if (s->invalid) {
        s->status |= TWO_AXIS_CRANE_TROLLEY_SHAPER_COMMAND_INVALID;
    }
    return (s->invalid || s->zero_commanded) ? 0.0 : command;
}

/* The row that the selector and enable ask for; an invalid selector keeps the last valid one. */
static void two_axis_crane_trolley_want_row(two_axis_crane_trolley_shaper_t *s, const two_axis_crane_trolley_shaper_input_t *input)
{
    const uint8_t before = s->wanted_row;
    if (input->selector <= 1u) {
        s->selected_row = input->selector;
    } else {
        s->status |= TWO_AXIS_CRANE_TROLLEY_SHAPER_SELECTOR_INVALID;
    }
    s->wanted_row = s->selected_row;
    two_axis_crane_trolley_follow_rope(s);
    if (s->selected_row > 0u) {
        s->wanted_row = s->rope_row;
    }
    if (!input->enable) {
        s->status |= TWO_AXIS_CRANE_TROLLEY_SHAPER_DISABLED;
        s->wanted_row = 0u;
    }
    if (s->wanted_row != before) {
        s->foretold = false;
    }
}

/* Stops latch until they are released and the command is 0, a quick stop also until the reference is. */
static void two_axis_crane_trolley_latch_stops(two_axis_crane_trolley_shaper_t *s, const two_axis_crane_trolley_shaper_input_t *input)
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
    } else if (s->zero_commanded && two_axis_crane_trolley_equal(s->reference, 0.0)) {
        s->quick = false;
    } else {
        /* latched as it is */
    }
}

static bool two_axis_crane_trolley_settled(const two_axis_crane_trolley_shaper_t *s)
{
    return s->still_ticks >= two_axis_crane_trolley_LAST_TICKS;
}

/* One tick further up: grows by the acceleration, shrinks by the deceleration, passes 0 by no more of either. */
static two_axis_crane_trolley_real_t two_axis_crane_trolley_raised(two_axis_crane_trolley_real_t command)
{
    two_axis_crane_trolley_real_t reach;
    if (command >= 0.0) {
        reach = two_axis_crane_trolley_on_grid(command) + two_axis_crane_trolley_ACCELERATION.step;
    } else {
        reach = command + two_axis_crane_trolley_DECELERATION.step;
        if (reach > two_axis_crane_trolley_ACCELERATION.step) {
            reach = two_axis_crane_trolley_ACCELERATION.step;
        }
    }
    return reach;
}

/* One tick further down, likewise. */
static two_axis_crane_trolley_real_t two_axis_crane_trolley_lowered(two_axis_crane_trolley_real_t command)
{
    two_axis_crane_trolley_real_t reach;
    if (command <= 0.0) {
        reach = two_axis_crane_trolley_on_grid(command) - two_axis_crane_trolley_ACCELERATION.step;
    } else {
        reach = command - two_axis_crane_trolley_DECELERATION.step;
        if (reach < -two_axis_crane_trolley_ACCELERATION.step) {
            reach = -two_axis_crane_trolley_ACCELERATION.step;
        }
    }
    return reach;
}

/* The command one tick nearer to its target. */
static two_axis_crane_trolley_real_t two_axis_crane_trolley_ramped(two_axis_crane_trolley_real_t command, two_axis_crane_trolley_real_t target)
{
    two_axis_crane_trolley_real_t reach = target;
    if (target > command) {
        reach = two_axis_crane_trolley_raised(command);
        if (reach > target) {
            reach = target;
        }
    } else if (target < command) {
        reach = two_axis_crane_trolley_lowered(command);
        if (reach < target) {
            reach = target;
        }
    } else {
        /* there already */
    }
    return reach;
}

/* Take the reference to 0 and what is pending with it: the shaper rests at the reference. */
static void two_axis_crane_trolley_stop(two_axis_crane_trolley_shaper_t *s)
{
    const two_axis_crane_trolley_real_t reach = two_axis_crane_trolley_abs(s->reference) - two_axis_crane_trolley_QUICK_STOP.step;
    if (s->emergency || (reach <= 0.0)) {
        s->reference = 0.0;
        s->still_ticks = two_axis_crane_trolley_LAST_TICKS;
    } else {
        s->reference = (s->reference > 0.0) ? reach : -reach;
        s->still_ticks = 0u;
    }
    s->command = s->reference;
    s->target = s->reference;
    s->foretold = false;
    two_axis_crane_trolley_rest(s, s->reference);
}

/* The command becomes the target. */
static void two_axis_crane_trolley_accept(two_axis_crane_trolley_shaper_t *s, two_axis_crane_trolley_real_t command)
{
    two_axis_crane_trolley_real_t wanted = command;
    s->target = wanted;
}

/* Choose the row when settled; ramp, then shape. */
static void two_axis_crane_trolley_move(two_axis_crane_trolley_shaper_t *s, two_axis_crane_trolley_real_t command)
{
    const two_axis_crane_trolley_real_t before = s->command;
    if (two_axis_crane_trolley_settled(s)) {
        s->row = s->wanted_row;
    }
    two_axis_crane_trolley_accept(s, command);
    s->command = two_axis_crane_trolley_ramped(s->command, s->target);
    if (!two_axis_crane_trolley_equal(s->command, before)) {
        s->still_ticks = 0u;
        s->foretold = false;
    } else if (!two_axis_crane_trolley_settled(s)) {
        s->still_ticks += 1u;
    } else {
        /* settled as it is */
    }
    if (s->still_ticks >= two_axis_crane_trolley_TAIL_TICKS[s->row]) {
        two_axis_crane_trolley_rest(s, s->command);
        s->reference = s->command;
    } else {
        s->reference = two_axis_crane_trolley_run(s, s->command);
    }
}

/* A ramp that does not pass 0, in closed form; as exact as the ramp, so never a tick off. */
static two_axis_crane_trolley_glide_t two_axis_crane_trolley_glide(two_axis_crane_trolley_real_t start, two_axis_crane_trolley_real_t target, const two_axis_crane_trolley_ramp_t *ramp)
{
    two_axis_crane_trolley_glide_t glide = { 0.0, 0u };
    if (!two_axis_crane_trolley_equal(start, target)) {
        const two_axis_crane_trolley_real_t from = (two_axis_crane_trolley_abs(target) > two_axis_crane_trolley_abs(start)) ? two_axis_crane_trolley_on_grid(start) : start;
        const bool falls = from > target;
        const two_axis_crane_trolley_real_t step = falls ? -ramp->step : ramp->step;
        const two_axis_crane_trolley_real_t steps = (two_axis_crane_trolley_abs(from - target) * ramp->steps_per_unit) + 0.5;
        uint32_t whole = (uint32_t)steps; /* the nearest; one too many if it has landed */
        const two_axis_crane_trolley_real_t position = from + ((two_axis_crane_trolley_real_t)whole * step);
        const bool landed = falls ? (position <= target) : (position >= target);
        two_axis_crane_trolley_real_t count;
        if (landed && (whole > 0u)) {
            whole -= 1u;
        }
        count = (two_axis_crane_trolley_real_t)whole;
        glide.total = ((count * from) + (step * ((count * (count + 1.0)) * 0.5))) + target;
        glide.ticks = whole + 1u;
    }
    return glide;
}

static two_axis_crane_trolley_real_t two_axis_crane_trolley_distance(two_axis_crane_trolley_real_t total)
{
    return total * two_axis_crane_trolley_METRES_PER_UNIT_TICK;
}

static two_axis_crane_trolley_real_t two_axis_crane_trolley_time_s(uint32_t ticks)
{
    return (two_axis_crane_trolley_real_t)ticks * two_axis_crane_trolley_TICK_S;
}

/* The row that takes over if the command becomes 0 when settled. */
static uint8_t two_axis_crane_trolley_row_at_rest(const two_axis_crane_trolley_shaper_t *s)
{
    return s->wanted_row;
}

/* A stop at once: the ramp goes down and the taps run out. */
static two_axis_crane_trolley_glide_t two_axis_crane_trolley_foretell_release(const two_axis_crane_trolley_shaper_t *s)
{
    const uint8_t row = two_axis_crane_trolley_settled(s) ? two_axis_crane_trolley_row_at_rest(s) : s->row;
    const uint32_t tail = two_axis_crane_trolley_TAIL_TICKS[row];
    two_axis_crane_trolley_glide_t stop = two_axis_crane_trolley_glide(s->command, 0.0, &two_axis_crane_trolley_DECELERATION);
    stop.total = two_axis_crane_trolley_pending(s, row) + stop.total;
    if (stop.ticks > 0u) {
        stop.ticks += tail;
    } else if (tail > s->still_ticks) {
        stop.ticks = tail - s->still_ticks;
    } else {
        /* at rest */
    }
    return stop;
}

/* Sum of the references to come, and ticks until the last, if the command is 0 from the next tick on. */
static two_axis_crane_trolley_glide_t two_axis_crane_trolley_foretell(const two_axis_crane_trolley_shaper_t *s)
{
    two_axis_crane_trolley_glide_t stop = { 0.0, 0u };
    if (s->emergency) {
        /* stopped */
    } else if (s->quick) {
        stop = two_axis_crane_trolley_glide(s->reference, 0.0, &two_axis_crane_trolley_QUICK_STOP);
    } else {
        stop = two_axis_crane_trolley_foretell_release(s);
    }
    return stop;
}

static bool two_axis_crane_trolley_stopped(const two_axis_crane_trolley_shaper_t *s)
{
    return s->emergency || s->quick;
}

static uint32_t two_axis_crane_trolley_full_status(const two_axis_crane_trolley_shaper_t *s)
{
    uint32_t status = s->status;
    if (s->row == 0u) {
        status |= TWO_AXIS_CRANE_TROLLEY_SHAPER_UNSHAPED;
    }
    if ((s->row != s->wanted_row)) {
        status |= TWO_AXIS_CRANE_TROLLEY_SHAPER_ROW_WAITS;
    }
    if (s->quick) {
        status |= TWO_AXIS_CRANE_TROLLEY_SHAPER_QUICK_STOP;
    }
    if (s->emergency) {
        status |= TWO_AXIS_CRANE_TROLLEY_SHAPER_EMERGENCY_STOP;
    }
    return status;
}

/* Whether the last tick began and ended settled and this one has the same inputs: then nothing can change. */
static bool two_axis_crane_trolley_idles(const two_axis_crane_trolley_shaper_t *s, const two_axis_crane_trolley_shaper_input_t *input)
{
    return s->idle && two_axis_crane_trolley_equal(input->command, s->input.command) && (input->selector == s->input.selector)
        && (input->enable == s->input.enable) && (input->quick_stop == s->input.quick_stop)
        && s->rope_still && two_axis_crane_trolley_equal(input->rope_length_m, s->input.rope_length_m)
        && two_axis_crane_trolley_equal(input->hoist_speed_m_s, s->input.hoist_speed_m_s)
        && (input->rope_length_valid == s->input.rope_length_valid)
        && (input->emergency_stop == s->input.emergency_stop);
}

/* Run one tick into s->output. */
static void two_axis_crane_trolley_tick(two_axis_crane_trolley_shaper_t *s, const two_axis_crane_trolley_shaper_input_t *input)
{
    const bool began_settled = two_axis_crane_trolley_settled(s);
    two_axis_crane_trolley_shaper_output_t *const output = &s->output;
    two_axis_crane_trolley_real_t command;
    uint8_t row;

    s->status = 0u;
    two_axis_crane_trolley_read_rope(s, input);
    command = two_axis_crane_trolley_checked(s, input->command);
    two_axis_crane_trolley_want_row(s, input);
    two_axis_crane_trolley_latch_stops(s, input);
    if (two_axis_crane_trolley_stopped(s)) {
        two_axis_crane_trolley_stop(s);
    } else {
        two_axis_crane_trolley_move(s, command);
    }

    if (!s->foretold) {
        const two_axis_crane_trolley_glide_t stop = two_axis_crane_trolley_foretell(s);
        output->stop_distance = two_axis_crane_trolley_distance(stop.total);
        output->stop_time_s = two_axis_crane_trolley_time_s(stop.ticks);
        output->stop_time_ticks = stop.ticks;
        s->foretold = two_axis_crane_trolley_settled(s) && !two_axis_crane_trolley_stopped(s);
    }
    row = two_axis_crane_trolley_stopped(s) ? 0u : s->row;
    output->reference = s->reference;
    output->residual_bound = two_axis_crane_trolley_RESIDUAL_BOUND[row];
    output->row = s->row;
    output->settled = two_axis_crane_trolley_settled(s);
    output->active = (row > 0u);
    output->error = ((s->status & (TWO_AXIS_CRANE_TROLLEY_SHAPER_COMMAND_INVALID
        | TWO_AXIS_CRANE_TROLLEY_SHAPER_SELECTOR_INVALID
        | TWO_AXIS_CRANE_TROLLEY_SHAPER_ROPE_INVALID
        | TWO_AXIS_CRANE_TROLLEY_SHAPER_ROPE_JUMP
        | TWO_AXIS_CRANE_TROLLEY_SHAPER_ROPE_FROZEN
        | TWO_AXIS_CRANE_TROLLEY_SHAPER_HOIST_SPEED_INVALID)) != 0u);
    output->status = two_axis_crane_trolley_full_status(s);
    s->input = *input;
    s->idle = began_settled && s->foretold;
}

void two_axis_crane_trolley_shaper_init(two_axis_crane_trolley_shaper_t *shaper)
{
    two_axis_crane_trolley_shaper_t *const s = shaper;
    s->pending = 0.0;
    s->fresh = 0.0;
    s->base = 0.0;
    s->target = 0.0;
    s->command = 0.0;
    s->reference = 0.0;
    s->unmoved = 0.0;
    s->rope_length = 9.0;
    s->hoist_speed = 0.0;
    s->held_ticks = 0u;
    s->head = 500u;
    s->still_ticks = 500u;
    s->status = 0u;
    s->row = 0u;
    s->selected_row = 0u;
    s->wanted_row = 0u;
    s->rope_row = 1u;
    s->lapped = false;
    s->foretold = false;
    s->idle = false;
    s->zero_commanded = false;
    s->invalid = false;
    s->quick = false;
    s->emergency = false;
    s->rope_still = false;
    /* The ring, the last inputs and the last outputs are not read before they are written. */
}

void two_axis_crane_trolley_shaper_step(two_axis_crane_trolley_shaper_t *shaper, const two_axis_crane_trolley_shaper_input_t *input,
    two_axis_crane_trolley_shaper_output_t *output)
{
    if (!two_axis_crane_trolley_idles(shaper, input)) {
        two_axis_crane_trolley_tick(shaper, input);
    }
    *output = shaper->output;
}
