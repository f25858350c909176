/*
 * flexible_arm: command shaper, see flexible_arm_shaper.h.
 * Design SHA-256 2881e9e0d002280fa2a9ce46864d431aa46c5ce5453f1a73e4328811ecb2973b.
 */
#include "flexible_arm_shaper.h"

#if (FLEXIBLE_ARM_SHAPER_DESIGN != 0x2881e9e0u)
#error "flexible_arm_shaper.h and flexible_arm_shaper.c belong to different designs"
#endif

/* Does not compile when the state is larger than the header says. */
typedef char flexible_arm_ram_check[(sizeof(flexible_arm_shaper_t) <= (unsigned)FLEXIBLE_ARM_SHAPER_RAM) ? 1 : -1];

static const uint32_t flexible_arm_LAST_TICKS = 17u; /* longest delay of any row */
static const flexible_arm_real_t flexible_arm_MAX_COMMAND = 120000; /* counts: max_speed */
static const int64_t flexible_arm_ONE = INT64_C(1073741824); /* amplitude 1, over 2^30 */
static const int64_t flexible_arm_ROUNDING = INT64_C(4611686018964258816); /* 2^62 makes positive, 2^29 rounds */
static const int64_t flexible_arm_ROUNDING_WHOLE = INT64_C(4294967296); /* 2^62 over 2^30 */
static const uint64_t flexible_arm_DISTANCE_SCALE = UINT64_C(225179981369); /* mm of way per count and tick, scaled */
static const uint64_t flexible_arm_DISTANCE_HALF = UINT64_C(562949953421312); /* rounds to the nearest */
static const uint32_t flexible_arm_DISTANCE_SHIFT = 50u; /* the scale is 2 to this power */
static const uint64_t flexible_arm_TIME_SCALE = UINT64_C(85899345); /* s per tick, over 2^32 */

/* first tap of each row, and the end */
static const uint32_t flexible_arm_FIRST_TAP[5] = {
    0u, 1u, 4u, 9u, 16u
};
/* delay of each tap, by row */
static const uint32_t flexible_arm_DELAY_TICKS[16] = {
    0u,
    0u, 5u, 6u,
    0u, 5u, 6u, 11u, 12u,
    0u, 5u, 6u, 11u, 12u, 16u,
    17u
};
/* amplitude of each tap, by row; each row sums to exactly 1 over 2^30 */
static const flexible_arm_real_t flexible_arm_AMPLITUDE[16] = {
    1073741824,
    534560137, 241036700, 298144987,
    269532128, 226551414, 317637450, 213526746, 46494086,
    175798563, 150416450, 223609516, 293141818, 64620573, 49626702,
    116528202
};
/* longest delay of each row */
static const uint32_t flexible_arm_TAIL_TICKS[4] = {
    0u, 6u, 12u, 17u
};
/* sum of amplitude times delay of each row: references to come per unit of a steady command, whole ticks */
static const int32_t flexible_arm_MOMENT_TICKS[4] = {
    0, 2, 5, 8
};
/* what is left of each, over 2^30 */
static const int32_t flexible_arm_MOMENT_Q30[4] = {
    0, 846569774, 576595888, 278818294
};
/* tolerance of each row, in millionths */
static const flexible_arm_real_t flexible_arm_RESIDUAL_BOUND[4] = {
    1000000, 50000, 50000, 50000
};

/* A ramp: its step per tick, rounded down to whole counts, and what its closed form needs. */
typedef struct {
    flexible_arm_real_t step;
    uint32_t shift; /* the reciprocal is 2 to this power too large */
    uint64_t reciprocal; /* steps per count, scaled */
} flexible_arm_ramp_t;

/* counts per tick: acceleration */
static const flexible_arm_ramp_t flexible_arm_ACCELERATION = { 12000, 44u, UINT64_C(1466015504) };
/* counts per tick: deceleration */
static const flexible_arm_ramp_t flexible_arm_DECELERATION = { 12000, 44u, UINT64_C(1466015504) };
/* counts per tick: quick_stop */
static const flexible_arm_ramp_t flexible_arm_QUICK_STOP = { 12000, 44u, UINT64_C(1466015504) };

/* What a ramp still has to do: ticks, and the sum of the commands of those ticks. */
typedef struct {
    int64_t total;
    uint32_t ticks;
} flexible_arm_glide_t;

static flexible_arm_real_t flexible_arm_abs(flexible_arm_real_t value)
{
    return (value < 0) ? -value : value;
}

static bool flexible_arm_equal(flexible_arm_real_t a, flexible_arm_real_t b)
{
    return (a <= b) && (a >= b);
}

/* Divide by 2^30, rounding to the nearest; |value| < 2^62. Shifts no negative number. */
static int64_t flexible_arm_nearest(int64_t value)
{
    const int64_t raised = value + flexible_arm_ROUNDING;
    return (int64_t)((uint64_t)raised >> 30) - flexible_arm_ROUNDING_WHOLE;
}

/* Whether commands within reach of the taps may differ. */
static bool flexible_arm_running(const flexible_arm_shaper_t *s)
{
    return s->lapped || (s->head < flexible_arm_LAST_TICKS);
}

/* Rest at a command: within reach of the taps all commands equal it. */
static void flexible_arm_rest(flexible_arm_shaper_t *s, int32_t command)
{
    s->base = command;
    s->head = flexible_arm_LAST_TICKS;
    s->lapped = false;
    if (command == 0) {
        s->carry = 0;
    }
}

/* Sum of the references still to come at rest at a command. */
static int64_t flexible_arm_rest_sum(const flexible_arm_shaper_t *s, int32_t command, uint8_t row)
{
    const int64_t whole = (int64_t)command * flexible_arm_MOMENT_TICKS[row];
    const int64_t fraction = (int64_t)command * flexible_arm_MOMENT_Q30[row];
    return whole + flexible_arm_nearest(fraction + s->carry);
}

/* Shape one new command. */
static int32_t flexible_arm_run(flexible_arm_shaper_t *s, int32_t command)
{
    const uint32_t first = flexible_arm_FIRST_TAP[s->row];
    const uint32_t end = flexible_arm_FIRST_TAP[s->row + 1u];
    int64_t total = s->carry;
    int64_t reference;
    uint32_t i;

    if (!flexible_arm_running(s)) {
        s->pending = flexible_arm_rest_sum(s, s->base, s->row);
    }
    s->head = (s->head >= flexible_arm_LAST_TICKS) ? 0u : (s->head + 1u);
    s->ring[s->head] = command;
    for (i = first; i < end; ++i) {
        const uint32_t delay = flexible_arm_DELAY_TICKS[i];
        int32_t past = s->base;
        if (delay <= s->head) {
            past = s->ring[s->head - delay];
        } else if (s->lapped) {
            past = s->ring[s->head + ((flexible_arm_LAST_TICKS + 1u) - delay)];
        } else {
            /* before the first lap: the command of the rest */
        }
        total += (int64_t)flexible_arm_AMPLITUDE[i] * past;
    }
    /* What rounding takes from this reference, the carry gives to the next. */
    reference = flexible_arm_nearest(total);
    s->carry = total - (reference * flexible_arm_ONE);
    s->pending += (int64_t)command - reference;
    if (s->head >= flexible_arm_LAST_TICKS) {
        s->lapped = true;
    }
    return (int32_t)reference;
}

/* Sum of the references still to come if every later command is 0. */
static int64_t flexible_arm_pending(const flexible_arm_shaper_t *s, uint8_t row)
{
    return flexible_arm_running(s) ? s->pending : flexible_arm_rest_sum(s, s->base, row);
}

/* Clamp the command to the maximum. A whole number is always valid. */
static bool flexible_arm_finite(flexible_arm_shaper_t *s, flexible_arm_real_t *command)
{
    if (*command > flexible_arm_MAX_COMMAND) {
        *command = flexible_arm_MAX_COMMAND;
        s->status |= FLEXIBLE_ARM_SHAPER_COMMAND_CLAMPED;
    } else if (*command < -flexible_arm_MAX_COMMAND) {
        *command = -flexible_arm_MAX_COMMAND;
        s->status |= FLEXIBLE_ARM_SHAPER_COMMAND_CLAMPED;
    } else {
        /* in range */
    }
    return true;
}

/* The command as far as it is finite, within the maximum. */
static flexible_arm_real_t flexible_arm_checked(flexible_arm_shaper_t *s, flexible_arm_real_t wanted)
{
    flexible_arm_real_t command = wanted;
    const bool valid = flexible_arm_finite(s, &command);
    s->zero_commanded = valid && flexible_arm_equal(command, 0);
    if (!valid) {
        s->invalid = true;
    } else if (s->zero_commanded) {
        s->invalid = false;
    } else {
        /* latched as it is */
    }
    if (s->invalid) {
        s->status |= FLEXIBLE_ARM_SHAPER_COMMAND_INVALID;
    }
    return (s->invalid || s->zero_commanded) ? 0 : command;
}

/* The row that the selector and enable ask for; an invalid selector keeps the last valid one. */
static void flexible_arm_want_row(flexible_arm_shaper_t *s, const flexible_arm_shaper_input_t *input)
{
    const uint8_t before = s->wanted_row;
    if (input->selector <= (uint8_t)FLEXIBLE_ARM_SHAPER_ROWS) {
        s->selected_row = input->selector;
    } else {
        s->status |= FLEXIBLE_ARM_SHAPER_SELECTOR_INVALID;
    }
    s->wanted_row = s->selected_row;
    if (!input->enable) {
        s->status |= FLEXIBLE_ARM_SHAPER_DISABLED;
        s->wanted_row = 0u;
    }
    if (s->wanted_row != before) {
        s->foretold = false;
    }
}

/* Stops latch until they are released and the command is 0, a quick stop also until the reference is. */
static void flexible_arm_latch_stops(flexible_arm_shaper_t *s, const flexible_arm_shaper_input_t *input)
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
    } else if (s->zero_commanded && flexible_arm_equal(s->reference, 0)) {
        s->quick = false;
    } else {
        /* latched as it is */
    }
}

static bool flexible_arm_settled(const flexible_arm_shaper_t *s)
{
    return s->still_ticks >= flexible_arm_LAST_TICKS;
}

/* One tick further up: grows by the acceleration, shrinks by the deceleration, passes 0 by no more of either. */
static flexible_arm_real_t flexible_arm_raised(flexible_arm_real_t command)
{
    flexible_arm_real_t reach;
    if (command >= 0) {
        reach = command + flexible_arm_ACCELERATION.step;
    } else {
        reach = command + flexible_arm_DECELERATION.step;
        if (reach > flexible_arm_ACCELERATION.step) {
            reach = flexible_arm_ACCELERATION.step;
        }
    }
    return reach;
}

/* One tick further down, likewise. */
static flexible_arm_real_t flexible_arm_lowered(flexible_arm_real_t command)
{
    flexible_arm_real_t reach;
    if (command <= 0) {
        reach = command - flexible_arm_ACCELERATION.step;
    } else {
        reach = command - flexible_arm_DECELERATION.step;
        if (reach < -flexible_arm_ACCELERATION.step) {
            reach = -flexible_arm_ACCELERATION.step;
        }
    }
    return reach;
}

/* The command one tick nearer to its target. */
static flexible_arm_real_t flexible_arm_ramped(flexible_arm_real_t command, flexible_arm_real_t target)
{
    flexible_arm_real_t reach = target;
    if (target > command) {
        reach = flexible_arm_raised(command);
        if (reach > target) {
            reach = target;
        }
    } else if (target < command) {
        reach = flexible_arm_lowered(command);
        if (reach < target) {
            reach = target;
        }
    } else {
        /* there already */
    }
    return reach;
}

/* Take the reference to 0 and what is pending with it: the shaper rests at the reference. */
static void flexible_arm_stop(flexible_arm_shaper_t *s)
{
    const flexible_arm_real_t reach = flexible_arm_abs(s->reference) - flexible_arm_QUICK_STOP.step;
    if (s->emergency || (reach <= 0)) {
        s->reference = 0;
        s->still_ticks = flexible_arm_LAST_TICKS;
    } else {
        s->reference = (s->reference > 0) ? reach : -reach;
        s->still_ticks = 0u;
    }
    s->command = s->reference;
    s->target = s->reference;
    s->foretold = false;
    flexible_arm_rest(s, s->reference);
}

/* The command becomes the target. */
static void flexible_arm_accept(flexible_arm_shaper_t *s, flexible_arm_real_t command)
{
    flexible_arm_real_t wanted = command;
    s->target = wanted;
}

/* Choose the row when settled; ramp, then shape. */
static void flexible_arm_move(flexible_arm_shaper_t *s, flexible_arm_real_t command)
{
    const flexible_arm_real_t before = s->command;
    if (flexible_arm_settled(s)) {
        s->row = s->wanted_row;
    }
    flexible_arm_accept(s, command);
    s->command = flexible_arm_ramped(s->command, s->target);
    if (!flexible_arm_equal(s->command, before)) {
        s->still_ticks = 0u;
        s->foretold = false;
    } else if (!flexible_arm_settled(s)) {
        s->still_ticks += 1u;
    } else {
        /* settled as it is */
    }
    if (s->still_ticks >= flexible_arm_TAIL_TICKS[s->row]) {
        flexible_arm_rest(s, s->command);
        s->reference = s->command;
    } else {
        s->reference = flexible_arm_run(s, s->command);
    }
}

/* A ramp that does not pass 0, in closed form. The reciprocal is exact for every gap below 2^30. */
static flexible_arm_glide_t flexible_arm_glide(int32_t start, int32_t target, const flexible_arm_ramp_t *ramp)
{
    flexible_arm_glide_t glide = { 0, 0u };
    if (start != target) {
        const int32_t step = (start > target) ? -ramp->step : ramp->step;
        const uint64_t gap = (uint64_t)(uint32_t)flexible_arm_abs(start - target);
        const uint64_t whole = ((gap - 1u) * ramp->reciprocal) >> ramp->shift;
        const uint64_t pairs = (whole * (whole + 1u)) >> 1;
        glide.total = (((int64_t)whole * start) + ((int64_t)pairs * step)) + target;
        glide.ticks = (uint32_t)whole + 1u;
    }
    return glide;
}

/* Millimetres, to the nearest. */
static int32_t flexible_arm_distance(int64_t total)
{
    const uint64_t magnitude = (uint64_t)((total < 0) ? -total : total);
    const uint64_t scaled = (magnitude * flexible_arm_DISTANCE_SCALE) + flexible_arm_DISTANCE_HALF;
    const uint64_t distance = scaled >> flexible_arm_DISTANCE_SHIFT;
    return (total < 0) ? -(int32_t)distance : (int32_t)distance;
}

/* Whole seconds, rounded up. */
static int32_t flexible_arm_time_s(uint32_t ticks)
{
    const uint64_t seconds = (((uint64_t)ticks * flexible_arm_TIME_SCALE) + 0xFFFFFFFFu) >> 32;
    return (int32_t)seconds;
}

/* The row that takes over if the command becomes 0 when settled. */
static uint8_t flexible_arm_row_at_rest(const flexible_arm_shaper_t *s)
{
    return s->wanted_row;
}

/* A stop at once: the ramp goes down and the taps run out. */
static flexible_arm_glide_t flexible_arm_foretell_release(const flexible_arm_shaper_t *s)
{
    const uint8_t row = flexible_arm_settled(s) ? flexible_arm_row_at_rest(s) : s->row;
    const uint32_t tail = flexible_arm_TAIL_TICKS[row];
    flexible_arm_glide_t stop = flexible_arm_glide(s->command, 0, &flexible_arm_DECELERATION);
    stop.total = flexible_arm_pending(s, row) + stop.total;
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
static flexible_arm_glide_t flexible_arm_foretell(const flexible_arm_shaper_t *s)
{
    flexible_arm_glide_t stop = { 0, 0u };
    if (s->emergency) {
        /* stopped */
    } else if (s->quick) {
        stop = flexible_arm_glide(s->reference, 0, &flexible_arm_QUICK_STOP);
    } else {
        stop = flexible_arm_foretell_release(s);
    }
    return stop;
}

static bool flexible_arm_stopped(const flexible_arm_shaper_t *s)
{
    return s->emergency || s->quick;
}

static uint32_t flexible_arm_full_status(const flexible_arm_shaper_t *s)
{
    uint32_t status = s->status;
    if (s->row == 0u) {
        status |= FLEXIBLE_ARM_SHAPER_UNSHAPED;
    }
    if ((s->row != s->wanted_row)) {
        status |= FLEXIBLE_ARM_SHAPER_ROW_WAITS;
    }
    if (s->quick) {
        status |= FLEXIBLE_ARM_SHAPER_QUICK_STOP;
    }
    if (s->emergency) {
        status |= FLEXIBLE_ARM_SHAPER_EMERGENCY_STOP;
    }
    return status;
}

/* Whether the last tick began and ended settled and this one has the same inputs: then nothing can change. */
static bool flexible_arm_idles(const flexible_arm_shaper_t *s, const flexible_arm_shaper_input_t *input)
{
    return s->idle && flexible_arm_equal(input->command, s->input.command) && (input->selector == s->input.selector)
        && (input->enable == s->input.enable) && (input->quick_stop == s->input.quick_stop)
        && (input->emergency_stop == s->input.emergency_stop);
}

/* Run one tick into s->output. */
static void flexible_arm_tick(flexible_arm_shaper_t *s, const flexible_arm_shaper_input_t *input)
{
    const bool began_settled = flexible_arm_settled(s);
    flexible_arm_shaper_output_t *const output = &s->output;
    flexible_arm_real_t command;
    uint8_t row;

    s->status = 0u;
    command = flexible_arm_checked(s, input->command);
    flexible_arm_want_row(s, input);
    flexible_arm_latch_stops(s, input);
    if (flexible_arm_stopped(s)) {
        flexible_arm_stop(s);
    } else {
        flexible_arm_move(s, command);
    }

    if (!s->foretold) {
        const flexible_arm_glide_t stop = flexible_arm_foretell(s);
        output->stop_distance = flexible_arm_distance(stop.total);
        output->stop_time_s = flexible_arm_time_s(stop.ticks);
        output->stop_time_ticks = stop.ticks;
        s->foretold = flexible_arm_settled(s) && !flexible_arm_stopped(s);
    }
    row = flexible_arm_stopped(s) ? 0u : s->row;
    output->reference = s->reference;
    output->residual_bound = flexible_arm_RESIDUAL_BOUND[row];
    output->row = s->row;
    output->settled = flexible_arm_settled(s);
    output->active = (row > 0u);
    output->error = ((s->status & (FLEXIBLE_ARM_SHAPER_COMMAND_INVALID | FLEXIBLE_ARM_SHAPER_SELECTOR_INVALID)) != 0u);
    output->status = flexible_arm_full_status(s);
    s->input = *input;
    s->idle = began_settled && s->foretold;
}

void flexible_arm_shaper_init(flexible_arm_shaper_t *shaper)
{
    flexible_arm_shaper_t *const s = shaper;
    s->pending = 0;
    s->carry = 0;
    s->base = 0;
    s->target = 0;
    s->command = 0;
    s->reference = 0;
    s->head = 17u;
    s->still_ticks = 17u;
    s->status = 0u;
    s->row = 0u;
    s->selected_row = 0u;
    s->wanted_row = 0u;
    s->lapped = false;
    s->foretold = false;
    s->idle = false;
    s->zero_commanded = false;
    s->invalid = false;
    s->quick = false;
    s->emergency = false;
    /* The ring, the last inputs and the last outputs are not read before they are written. */
}

void flexible_arm_shaper_step(flexible_arm_shaper_t *shaper, const flexible_arm_shaper_input_t *input,
    flexible_arm_shaper_output_t *output)
{
    if (!flexible_arm_idles(shaper, input)) {
        flexible_arm_tick(shaper, input);
    }
    *output = shaper->output;
}
