/*
 * srtc_gantry_bank: command shaper, see srtc_gantry_bank_shaper.h.
 * Design SHA-256 a1fb4bb25aa83870d92ad5a8debdbf85436a73e1770fe7b6b02b026542664ae0.
 */
#include "srtc_gantry_bank_shaper.h"

#if (SRTC_GANTRY_BANK_SHAPER_DESIGN != 0xa1fb4bb2u)
#error "srtc_gantry_bank_shaper.h and srtc_gantry_bank_shaper.c belong to different designs"
#endif

/* Does not compile when the state is larger than the header says. */
typedef char srtc_gantry_bank_ram_check[(sizeof(srtc_gantry_bank_shaper_t) <= (unsigned)SRTC_GANTRY_BANK_SHAPER_RAM) ? 1 : -1];

static const uint32_t srtc_gantry_bank_LAST_TICKS = 300u; /* longest delay of any row */
static const srtc_gantry_bank_real_t srtc_gantry_bank_MAX_COMMAND = 0.5; /* m/s: max_speed */
static const srtc_gantry_bank_real_t srtc_gantry_bank_RAMP_ANCHOR = 1.0; /* floats next to it are the grid of ramp steps */
static const srtc_gantry_bank_real_t srtc_gantry_bank_METRES_PER_UNIT_TICK = 0.01; /* m of way per unit and tick */
static const srtc_gantry_bank_real_t srtc_gantry_bank_TICK_S = 0.01; /* s: tick */

/* first tap of each row, and the end */
static const uint32_t srtc_gantry_bank_FIRST_TAP[6] = {
    0u, 1u, 8u, 15u, 22u, 33u
};
/* delay of each tap, by row */
static const uint32_t srtc_gantry_bank_DELAY_TICKS[33] = {
    0u,
    0u, 46u, 47u, 150u, 253u, 254u,
    300u,
    0u, 42u, 43u, 150u, 257u, 258u,
    300u,
    0u, 38u, 39u, 150u, 261u, 262u,
    300u,
    0u, 28u, 29u, 115u, 116u, 150u,
    184u, 185u, 271u, 272u, 300u
};
/* amplitude of each tap, by row; each row sums to exactly 1 */
static const srtc_gantry_bank_real_t srtc_gantry_bank_AMPLITUDE[33] = {
    1.0,
    1.0, -0.12399731900900002, -0.876002680991, 1.0, -0.87600268099, -0.12399731901,
    1.0,
    1.0, -0.460592989888, -0.539407010112, 1.0, -0.539407010112, -0.460592989888,
    1.0,
    1.0, -0.21286127367100005, -0.787138726329, 1.0, -0.7871387263279999, -0.21286127367200003,
    0.9999999999999999,
    1.0, -0.97801608151, -0.02198391849000003, 0.294193005105, 0.705806994895, -1.0,
    0.705806994895, 0.294193005105, -0.02198391848999992, -0.97801608151, 0.9999999999999999
};
/* longest delay of each row */
static const uint32_t srtc_gantry_bank_TAIL_TICKS[5] = {
    0u, 300u, 300u, 300u, 300u
};
/* sum of amplitude times delay of each row: references to come per unit of a steady command */
static const srtc_gantry_bank_real_t srtc_gantry_bank_MOMENT_TICKS[5] = {
    0.0, 149.999999999999, 150.0, 149.999999999999, 150.0
};
/* tolerance of each row */
static const srtc_gantry_bank_real_t srtc_gantry_bank_RESIDUAL_BOUND[5] = {
    1.0, 0.05, 0.05, 0.05, 0.0285191381049
};
/* rows with negative amplitudes: commands wait for rest */
static const bool srtc_gantry_bank_WAITS[5] = {
    false, true, true, true, true
};

/* A ramp: its step per tick, rounded up to the grid, and what its closed form needs. */
typedef struct {
    srtc_gantry_bank_real_t step;
    srtc_gantry_bank_real_t steps_per_unit; /* 1 / step */
} srtc_gantry_bank_ramp_t;

/* m/s per tick: acceleration */
static const srtc_gantry_bank_ramp_t srtc_gantry_bank_ACCELERATION = { 0.0050000000000001155, 199.9999999999954 };
/* m/s per tick: deceleration */
static const srtc_gantry_bank_ramp_t srtc_gantry_bank_DECELERATION = { 0.0050000000000001155, 199.9999999999954 };
/* m/s per tick: quick_stop */
static const srtc_gantry_bank_ramp_t srtc_gantry_bank_QUICK_STOP = { 0.0050000000000001155, 199.9999999999954 };

/* What a ramp still has to do: ticks, and the sum of the commands of those ticks. */
typedef struct {
    srtc_gantry_bank_real_t total;
    uint32_t ticks;
} srtc_gantry_bank_glide_t;

static srtc_gantry_bank_real_t srtc_gantry_bank_abs(srtc_gantry_bank_real_t value)
{
    return (value < 0.0) ? -value : value;
}

static bool srtc_gantry_bank_equal(srtc_gantry_bank_real_t a, srtc_gantry_bank_real_t b)
{
    return (a <= b) && (a >= b);
}

/* Round a command to the grid of ramp steps: from there on a ramp adds exactly. */
static srtc_gantry_bank_real_t srtc_gantry_bank_on_grid(srtc_gantry_bank_real_t command)
{
    const srtc_gantry_bank_real_t anchor = (command < 0.0) ? -srtc_gantry_bank_RAMP_ANCHOR : srtc_gantry_bank_RAMP_ANCHOR;
    return (command + anchor) - anchor;
}

/* Whether commands within reach of the taps may differ. */
static bool srtc_gantry_bank_running(const srtc_gantry_bank_shaper_t *s)
{
    return s->lapped || (s->head < srtc_gantry_bank_LAST_TICKS);
}

/* Rest at a command: within reach of the taps all commands equal it. */
static void srtc_gantry_bank_rest(srtc_gantry_bank_shaper_t *s, srtc_gantry_bank_real_t command)
{
    s->base = command;
    s->head = srtc_gantry_bank_LAST_TICKS;
    s->lapped = false;
}

/* Sum of the references still to come at rest at a command. */
static srtc_gantry_bank_real_t srtc_gantry_bank_rest_sum(srtc_gantry_bank_real_t command, uint8_t row)
{
    return command * srtc_gantry_bank_MOMENT_TICKS[row];
}

/* Shape one new command. */
static srtc_gantry_bank_real_t srtc_gantry_bank_run(srtc_gantry_bank_shaper_t *s, srtc_gantry_bank_real_t command)
{
    const uint32_t first = srtc_gantry_bank_FIRST_TAP[s->row];
    const uint32_t end = srtc_gantry_bank_FIRST_TAP[s->row + 1u];
    srtc_gantry_bank_real_t reference = 0.0;
    srtc_gantry_bank_real_t lap = 0.0; /* the part of this lap's commands */
    srtc_gantry_bank_real_t low = -srtc_gantry_bank_MAX_COMMAND;
    srtc_gantry_bank_real_t high = srtc_gantry_bank_MAX_COMMAND;
    uint32_t i;

    if (!srtc_gantry_bank_running(s)) {
        s->pending = srtc_gantry_bank_rest_sum(s->base, s->row);
        s->fresh = 0.0;
    }
    s->head = (s->head >= srtc_gantry_bank_LAST_TICKS) ? 0u : (s->head + 1u);
    s->ring[s->head] = command;
    for (i = first; i < end; ++i) {
        const uint32_t delay = srtc_gantry_bank_DELAY_TICKS[i];
        if (delay <= s->head) {
            reference = reference + (srtc_gantry_bank_AMPLITUDE[i] * s->ring[s->head - delay]);
            lap = reference;
        } else if (s->lapped) {
            const uint32_t older = s->head + ((srtc_gantry_bank_LAST_TICKS + 1u) - delay);
            reference = reference + (srtc_gantry_bank_AMPLITUDE[i] * s->ring[older]);
        } else {
            reference = reference + (srtc_gantry_bank_AMPLITUDE[i] * s->base);
        }
    }
    /* Rounding alone could pass these bounds, by the last bit. */
    if (srtc_gantry_bank_WAITS[s->row]) {
        /* From the last rest a command moves one way, and so does the reference. */
        low = (s->base < command) ? s->base : command;
        high = (s->base < command) ? command : s->base;
    }
    if (reference < low) {
        reference = low;
    } else if (reference > high) {
        reference = high;
    } else {
        /* in range */
    }
    s->pending = s->pending + (command - reference);
    s->fresh = s->fresh + (command - lap);
    if (s->head >= srtc_gantry_bank_LAST_TICKS) {
        /* A full lap knows every command within reach: its sum ends the rounding of the older one. */
        s->pending = s->fresh;
        s->fresh = 0.0;
        s->lapped = true;
    }
    return reference;
}

/* Sum of the references still to come if every later command is 0. */
static srtc_gantry_bank_real_t srtc_gantry_bank_pending(const srtc_gantry_bank_shaper_t *s, uint8_t row)
{
    return srtc_gantry_bank_running(s) ? s->pending : srtc_gantry_bank_rest_sum(s->base, row);
}

/* By how much the pending sum changes if another row takes over at a command. */
static srtc_gantry_bank_real_t srtc_gantry_bank_row_change(const srtc_gantry_bank_shaper_t *s, srtc_gantry_bank_real_t command, uint8_t row)
{
    return srtc_gantry_bank_rest_sum(command, row) - srtc_gantry_bank_rest_sum(command, s->row);
}

/* Clamp the command to the maximum; a command that is not finite becomes 0, and the result is false. */
static bool srtc_gantry_bank_finite(srtc_gantry_bank_shaper_t *s, srtc_gantry_bank_real_t *command)
{
    const srtc_gantry_bank_real_t magnitude = srtc_gantry_bank_abs(*command);
    bool valid = true;
    if (!(magnitude <= srtc_gantry_bank_MAX_COMMAND)) {
        /* Only what is finite and not 0 shrinks when halved. */
        if ((magnitude * 0.5) < magnitude) {
            *command = (*command > 0.0) ? srtc_gantry_bank_MAX_COMMAND : -srtc_gantry_bank_MAX_COMMAND;
            s->status |= SRTC_GANTRY_BANK_SHAPER_COMMAND_CLAMPED;
        } else {
            *command = 0.0;
            valid = false;
        }
    }
    return valid;
}

/* The command as far as it is finite, within the maximum. */
static srtc_gantry_bank_real_t srtc_gantry_bank_checked(srtc_gantry_bank_shaper_t *s, srtc_gantry_bank_real_t wanted)
{
    srtc_gantry_bank_real_t command = wanted;
    const bool valid = srtc_gantry_bank_finite(s, &command);
    s->zero_commanded = valid && srtc_gantry_bank_equal(command, 0.0);
    if (!valid) {
        s->invalid = true;
    } else if (s->zero_commanded) {
        s->invalid = false;
    } else {
        /* latched as it is */
    }
    if (s->invalid) {
        s->status |= SRTC_GANTRY_BANK_SHAPER_COMMAND_INVALID;
    }
    return (s->invalid || s->zero_commanded) ? 0.0 : command;
}

/* The row that the selector and enable ask for; an invalid selector keeps the last valid one. */
static void srtc_gantry_bank_want_row(srtc_gantry_bank_shaper_t *s, const srtc_gantry_bank_shaper_input_t *input)
{
    const uint8_t before = s->wanted_row;
    if (input->selector <= (uint8_t)SRTC_GANTRY_BANK_SHAPER_ROWS) {
        s->selected_row = input->selector;
    } else {
        s->status |= SRTC_GANTRY_BANK_SHAPER_SELECTOR_INVALID;
    }
    s->wanted_row = s->selected_row;
    if (!input->enable) {
        s->status |= SRTC_GANTRY_BANK_SHAPER_DISABLED;
        s->wanted_row = 0u;
    }
    if (s->wanted_row != before) {
        s->foretold = false;
    }
}

/* Stops latch until they are released and the command is 0, a quick stop also until the reference is. */
static void srtc_gantry_bank_latch_stops(srtc_gantry_bank_shaper_t *s, const srtc_gantry_bank_shaper_input_t *input)
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
    } else if (s->zero_commanded && srtc_gantry_bank_equal(s->reference, 0.0)) {
        s->quick = false;
    } else {
        /* latched as it is */
    }
}

static bool srtc_gantry_bank_settled(const srtc_gantry_bank_shaper_t *s)
{
    return s->still_ticks >= srtc_gantry_bank_LAST_TICKS;
}

/* One tick further up: grows by the acceleration, shrinks by the deceleration, passes 0 by no more of either. */
static srtc_gantry_bank_real_t srtc_gantry_bank_raised(srtc_gantry_bank_real_t command)
{
    srtc_gantry_bank_real_t reach;
    if (command >= 0.0) {
        reach = srtc_gantry_bank_on_grid(command) + srtc_gantry_bank_ACCELERATION.step;
    } else {
        reach = command + srtc_gantry_bank_DECELERATION.step;
        if (reach > srtc_gantry_bank_ACCELERATION.step) {
            reach = srtc_gantry_bank_ACCELERATION.step;
        }
    }
    return reach;
}

/* One tick further down, likewise. */
static srtc_gantry_bank_real_t srtc_gantry_bank_lowered(srtc_gantry_bank_real_t command)
{
    srtc_gantry_bank_real_t reach;
    if (command <= 0.0) {
        reach = srtc_gantry_bank_on_grid(command) - srtc_gantry_bank_ACCELERATION.step;
    } else {
        reach = command - srtc_gantry_bank_DECELERATION.step;
        if (reach < -srtc_gantry_bank_ACCELERATION.step) {
            reach = -srtc_gantry_bank_ACCELERATION.step;
        }
    }
    return reach;
}

/* The command one tick nearer to its target. */
static srtc_gantry_bank_real_t srtc_gantry_bank_ramped(srtc_gantry_bank_real_t command, srtc_gantry_bank_real_t target)
{
    srtc_gantry_bank_real_t reach = target;
    if (target > command) {
        reach = srtc_gantry_bank_raised(command);
        if (reach > target) {
            reach = target;
        }
    } else if (target < command) {
        reach = srtc_gantry_bank_lowered(command);
        if (reach < target) {
            reach = target;
        }
    } else {
        /* there already */
    }
    return reach;
}

/* Take the reference to 0 and what is pending with it: the shaper rests at the reference. */
static void srtc_gantry_bank_stop(srtc_gantry_bank_shaper_t *s)
{
    const srtc_gantry_bank_real_t reach = srtc_gantry_bank_abs(s->reference) - srtc_gantry_bank_QUICK_STOP.step;
    if (s->emergency || (reach <= 0.0)) {
        s->reference = 0.0;
        s->still_ticks = srtc_gantry_bank_LAST_TICKS;
    } else {
        s->reference = (s->reference > 0.0) ? reach : -reach;
        s->still_ticks = 0u;
    }
    s->command = s->reference;
    s->target = s->reference;
    s->foretold = false;
    srtc_gantry_bank_rest(s, s->reference);
}

/* The command becomes the target: at once or, where amplitudes are negative, when settled only. */
static void srtc_gantry_bank_accept(srtc_gantry_bank_shaper_t *s, srtc_gantry_bank_real_t command)
{
    srtc_gantry_bank_real_t wanted = command;
    if (!srtc_gantry_bank_WAITS[s->row]) {
        s->target = wanted;
    } else if (srtc_gantry_bank_settled(s)) {
        const bool reverses = ((s->command > 0.0) && (wanted < 0.0))
            || ((s->command < 0.0) && (wanted > 0.0));
        s->target = reverses ? 0.0 : wanted;
    } else {
        /* the accepted target runs to its end */
    }
    if (!srtc_gantry_bank_equal(s->target, command)) {
        s->status |= SRTC_GANTRY_BANK_SHAPER_COMMAND_WAITS;
    }
}

/* Choose the row when settled; ramp, then shape. */
static void srtc_gantry_bank_move(srtc_gantry_bank_shaper_t *s, srtc_gantry_bank_real_t command)
{
    const srtc_gantry_bank_real_t before = s->command;
    if (srtc_gantry_bank_settled(s)) {
        s->row = s->wanted_row;
    }
    srtc_gantry_bank_accept(s, command);
    s->command = srtc_gantry_bank_ramped(s->command, s->target);
    if (!srtc_gantry_bank_equal(s->command, before)) {
        s->still_ticks = 0u;
        s->foretold = false;
    } else if (!srtc_gantry_bank_settled(s)) {
        s->still_ticks += 1u;
    } else {
        /* settled as it is */
    }
    if (s->still_ticks >= srtc_gantry_bank_TAIL_TICKS[s->row]) {
        srtc_gantry_bank_rest(s, s->command);
        s->reference = s->command;
    } else {
        s->reference = srtc_gantry_bank_run(s, s->command);
    }
}

/* A ramp that does not pass 0, in closed form; as exact as the ramp, so never a tick off. */
static srtc_gantry_bank_glide_t srtc_gantry_bank_glide(srtc_gantry_bank_real_t start, srtc_gantry_bank_real_t target, const srtc_gantry_bank_ramp_t *ramp)
{
    srtc_gantry_bank_glide_t glide = { 0.0, 0u };
    if (!srtc_gantry_bank_equal(start, target)) {
        const srtc_gantry_bank_real_t from = (srtc_gantry_bank_abs(target) > srtc_gantry_bank_abs(start)) ? srtc_gantry_bank_on_grid(start) : start;
        const bool falls = from > target;
        const srtc_gantry_bank_real_t step = falls ? -ramp->step : ramp->step;
        const srtc_gantry_bank_real_t steps = (srtc_gantry_bank_abs(from - target) * ramp->steps_per_unit) + 0.5;
        uint32_t whole = (uint32_t)steps; /* the nearest; one too many if it has landed */
        const srtc_gantry_bank_real_t position = from + ((srtc_gantry_bank_real_t)whole * step);
        const bool landed = falls ? (position <= target) : (position >= target);
        srtc_gantry_bank_real_t count;
        if (landed && (whole > 0u)) {
            whole -= 1u;
        }
        count = (srtc_gantry_bank_real_t)whole;
        glide.total = ((count * from) + (step * ((count * (count + 1.0)) * 0.5))) + target;
        glide.ticks = whole + 1u;
    }
    return glide;
}

static srtc_gantry_bank_real_t srtc_gantry_bank_distance(srtc_gantry_bank_real_t total)
{
    return total * srtc_gantry_bank_METRES_PER_UNIT_TICK;
}

static srtc_gantry_bank_real_t srtc_gantry_bank_time_s(uint32_t ticks)
{
    return (srtc_gantry_bank_real_t)ticks * srtc_gantry_bank_TICK_S;
}

/* The row that takes over if the command becomes 0 when settled. */
static uint8_t srtc_gantry_bank_row_at_rest(const srtc_gantry_bank_shaper_t *s)
{
    return s->wanted_row;
}

/* A stop that waits: the ramp completes, the shaper settles, and only then the 0 is accepted. */
static srtc_gantry_bank_glide_t srtc_gantry_bank_foretell_waiting(const srtc_gantry_bank_shaper_t *s)
{
    const srtc_gantry_bank_real_t target = s->target;
    const bool faster = srtc_gantry_bank_abs(target) > srtc_gantry_bank_abs(s->command);
    const srtc_gantry_bank_ramp_t *const ramp = faster ? &srtc_gantry_bank_ACCELERATION : &srtc_gantry_bank_DECELERATION;
    const srtc_gantry_bank_glide_t rise = srtc_gantry_bank_glide(s->command, target, ramp);
    const srtc_gantry_bank_glide_t down = srtc_gantry_bank_glide(target, 0.0, &srtc_gantry_bank_DECELERATION);
    const uint32_t hold = (rise.ticks > 0u) ? srtc_gantry_bank_LAST_TICKS : (srtc_gantry_bank_LAST_TICKS - s->still_ticks);
    const srtc_gantry_bank_real_t settled = (srtc_gantry_bank_pending(s, s->row) + rise.total) + ((srtc_gantry_bank_real_t)hold * target);
    const uint8_t row = srtc_gantry_bank_row_at_rest(s);
    srtc_gantry_bank_glide_t stop;
    stop.total = (settled + srtc_gantry_bank_row_change(s, target, row)) + down.total;
    stop.ticks = rise.ticks + hold + down.ticks + srtc_gantry_bank_TAIL_TICKS[row];
    return stop;
}

/* A stop at once: the ramp goes down and the taps run out. */
static srtc_gantry_bank_glide_t srtc_gantry_bank_foretell_release(const srtc_gantry_bank_shaper_t *s)
{
    const uint8_t row = srtc_gantry_bank_settled(s) ? srtc_gantry_bank_row_at_rest(s) : s->row;
    const uint32_t tail = srtc_gantry_bank_TAIL_TICKS[row];
    srtc_gantry_bank_glide_t stop = srtc_gantry_bank_glide(s->command, 0.0, &srtc_gantry_bank_DECELERATION);
    stop.total = srtc_gantry_bank_pending(s, row) + stop.total;
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
static srtc_gantry_bank_glide_t srtc_gantry_bank_foretell(const srtc_gantry_bank_shaper_t *s)
{
    srtc_gantry_bank_glide_t stop = { 0.0, 0u };
    if (s->emergency) {
        /* stopped */
    } else if (s->quick) {
        stop = srtc_gantry_bank_glide(s->reference, 0.0, &srtc_gantry_bank_QUICK_STOP);
    } else if (srtc_gantry_bank_WAITS[s->row] && !srtc_gantry_bank_settled(s) && !srtc_gantry_bank_equal(s->target, 0.0)) {
        stop = srtc_gantry_bank_foretell_waiting(s);
    } else {
        stop = srtc_gantry_bank_foretell_release(s);
    }
    return stop;
}

static bool srtc_gantry_bank_stopped(const srtc_gantry_bank_shaper_t *s)
{
    return s->emergency || s->quick;
}

static uint32_t srtc_gantry_bank_full_status(const srtc_gantry_bank_shaper_t *s)
{
    uint32_t status = s->status;
    if (s->row == 0u) {
        status |= SRTC_GANTRY_BANK_SHAPER_UNSHAPED;
    }
    if ((s->row != s->wanted_row)) {
        status |= SRTC_GANTRY_BANK_SHAPER_ROW_WAITS;
    }
    if (s->quick) {
        status |= SRTC_GANTRY_BANK_SHAPER_QUICK_STOP;
    }
    if (s->emergency) {
        status |= SRTC_GANTRY_BANK_SHAPER_EMERGENCY_STOP;
    }
    return status;
}

/* Whether the last tick began and ended settled and this one has the same inputs: then nothing can change. */
static bool srtc_gantry_bank_idles(const srtc_gantry_bank_shaper_t *s, const srtc_gantry_bank_shaper_input_t *input)
{
    return s->idle && srtc_gantry_bank_equal(input->command, s->input.command) && (input->selector == s->input.selector)
        && (input->enable == s->input.enable) && (input->quick_stop == s->input.quick_stop)
        && (input->emergency_stop == s->input.emergency_stop);
}

/* Run one tick into s->output. */
static void srtc_gantry_bank_tick(srtc_gantry_bank_shaper_t *s, const srtc_gantry_bank_shaper_input_t *input)
{
    const bool began_settled = srtc_gantry_bank_settled(s);
    srtc_gantry_bank_shaper_output_t *const output = &s->output;
    srtc_gantry_bank_real_t command;
    uint8_t row;

    s->status = 0u;
    command = srtc_gantry_bank_checked(s, input->command);
    srtc_gantry_bank_want_row(s, input);
    srtc_gantry_bank_latch_stops(s, input);
    if (srtc_gantry_bank_stopped(s)) {
        srtc_gantry_bank_stop(s);
    } else {
        srtc_gantry_bank_move(s, command);
    }

    if (!s->foretold) {
        const srtc_gantry_bank_glide_t stop = srtc_gantry_bank_foretell(s);
        output->stop_distance = srtc_gantry_bank_distance(stop.total);
        output->stop_time_s = srtc_gantry_bank_time_s(stop.ticks);
        output->stop_time_ticks = stop.ticks;
        s->foretold = srtc_gantry_bank_settled(s) && !srtc_gantry_bank_stopped(s);
    }
    row = srtc_gantry_bank_stopped(s) ? 0u : s->row;
    output->reference = s->reference;
    output->residual_bound = srtc_gantry_bank_RESIDUAL_BOUND[row];
    output->row = s->row;
    output->settled = srtc_gantry_bank_settled(s);
    output->active = (row > 0u);
    output->error = ((s->status & (SRTC_GANTRY_BANK_SHAPER_COMMAND_INVALID | SRTC_GANTRY_BANK_SHAPER_SELECTOR_INVALID)) != 0u);
    output->status = srtc_gantry_bank_full_status(s);
    s->input = *input;
    s->idle = began_settled && s->foretold;
}

void srtc_gantry_bank_shaper_init(srtc_gantry_bank_shaper_t *shaper)
{
    srtc_gantry_bank_shaper_t *const s = shaper;
    s->pending = 0.0;
    s->fresh = 0.0;
    s->base = 0.0;
    s->target = 0.0;
    s->command = 0.0;
    s->reference = 0.0;
    s->head = 300u;
    s->still_ticks = 300u;
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

void srtc_gantry_bank_shaper_step(srtc_gantry_bank_shaper_t *shaper, const srtc_gantry_bank_shaper_input_t *input,
    srtc_gantry_bank_shaper_output_t *output)
{
    if (!srtc_gantry_bank_idles(shaper, input)) {
        srtc_gantry_bank_tick(shaper, input);
    }
    *output = shaper->output;
}
