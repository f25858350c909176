/*
 * workshop_crane: command shaper, see workshop_crane_shaper.h.
 * Design SHA-256 dec569420ed405b1d65f0d54757086185d2deb32756919dc6d9fd32619de2b60.
 */
#include "workshop_crane_shaper.h"

#if (WORKSHOP_CRANE_SHAPER_DESIGN != 0xdec56942u)
#error "workshop_crane_shaper.h and workshop_crane_shaper.c belong to different designs"
#endif

/* Does not compile when the state is larger than the header says. */
typedef char workshop_crane_ram_check[(sizeof(workshop_crane_shaper_t) <= (unsigned)WORKSHOP_CRANE_SHAPER_RAM) ? 1 : -1];

static const uint32_t workshop_crane_LAST_TICKS = 823u; /* longest delay of any row */
static const workshop_crane_real_t workshop_crane_MAX_COMMAND = 0.6666667f; /* m/s: max_speed */
static const workshop_crane_real_t workshop_crane_MINIMUM_COMMAND = 0.016666668f; /* m/s: minimum_speed */
static const workshop_crane_real_t workshop_crane_COMMAND_RESOLUTION = 0.0033333334f; /* m/s: command_resolution */
static const workshop_crane_real_t workshop_crane_RAMP_ANCHOR = 1.0f; /* floats next to it are the grid of ramp steps */
static const workshop_crane_real_t workshop_crane_METRES_PER_UNIT_TICK = 0.01f; /* m of way per unit and tick */
static const workshop_crane_real_t workshop_crane_TICK_S = 0.01f; /* s: tick */

/* first tap of each row, and the end */
static const uint32_t workshop_crane_FIRST_TAP[6] = {
    0u, 1u, 6u, 11u, 16u, 25u
};
/* delay of each tap, by row */
static const uint32_t workshop_crane_DELAY_TICKS[25] = {
    0u,
    0u, 158u, 159u, 317u, 318u,
    0u, 215u, 216u, 430u, 431u,
    0u, 265u, 266u, 530u, 531u,
    0u, 205u, 206u, 411u, 412u, 616u,
    617u, 822u, 823u
};
/* amplitude of each tap, by row; each row sums to exactly 1 */
static const workshop_crane_real_t workshop_crane_AMPLITUDE[25] = {
    1.0f,
    0.25156522f, 0.18910676f, 0.31089532f, 0.18791425f, 0.060518444f,
    0.26422f, 0.38912535f, 0.08571309f, 0.18211961f, 0.07882196f,
    0.26422048f, 0.26430762f, 0.21053267f, 0.047999382f, 0.21293986f,
    0.11407316f, 0.056950152f, 0.1816799f, 0.21089637f, 0.088928044f, 0.0584386f,
    0.17761236f, 0.09847176f, 0.0129496455f
};
/* longest delay of each row */
static const uint32_t workshop_crane_TAIL_TICKS[5] = {
    0u, 318u, 431u, 531u, 823u
};
/* sum of amplitude times delay of each row: references to come per unit of a steady command */
static const workshop_crane_real_t workshop_crane_MOMENT_TICKS[5] = {
    0.0f, 158.12491f, 214.45967f, 264.55396f, 409.60394f
};
/* tolerance of each row */
static const workshop_crane_real_t workshop_crane_RESIDUAL_BOUND[5] = {
    1.0f, 0.05f, 0.05f, 0.05f, 0.05f
};

/* A ramp: its step per tick, rounded up to the grid, and what its closed form needs. */
typedef struct {
    workshop_crane_real_t step;
    workshop_crane_real_t steps_per_unit; /* 1 / step */
} workshop_crane_ramp_t;

/* m/s per tick: acceleration */
static const workshop_crane_ramp_t workshop_crane_ACCELERATION = { 0.003000021f, 333.331f };
/* m/s per tick: deceleration */
static const workshop_crane_ramp_t workshop_crane_DECELERATION = { 0.0040000677f, 249.99577f };
/* m/s per tick: quick_stop */
static const workshop_crane_ramp_t workshop_crane_QUICK_STOP = { 0.01000011f, 99.9989f };

/* What a ramp still has to do: ticks, and the sum of the commands of those ticks. */
typedef struct {
    workshop_crane_real_t total;
    uint32_t ticks;
} workshop_crane_glide_t;

static workshop_crane_real_t workshop_crane_abs(workshop_crane_real_t value)
{
    return (value < 0.0f) ? -value : value;
}

static bool workshop_crane_equal(workshop_crane_real_t a, workshop_crane_real_t b)
{
    return (a <= b) && (a >= b);
}

/* Round a command to the grid of ramp steps: from there on a ramp adds exactly. */
static workshop_crane_real_t workshop_crane_on_grid(workshop_crane_real_t command)
{
    const workshop_crane_real_t anchor = (command < 0.0f) ? -workshop_crane_RAMP_ANCHOR : workshop_crane_RAMP_ANCHOR;
    return (command + anchor) - anchor;
}

/* Whether commands within reach of the taps may differ. */
static bool workshop_crane_running(const workshop_crane_shaper_t *s)
{
    return s->lapped || (s->head < workshop_crane_LAST_TICKS);
}

/* Rest at a command: within reach of the taps all commands equal it. */
static void workshop_crane_rest(workshop_crane_shaper_t *s, workshop_crane_real_t command)
{
    s->base = command;
    s->head = workshop_crane_LAST_TICKS;
    s->lapped = false;
}

/* Sum of the references still to come at rest at a command. */
static workshop_crane_real_t workshop_crane_rest_sum(workshop_crane_real_t command, uint8_t row)
{
    return command * workshop_crane_MOMENT_TICKS[row];
}

/* Shape one new command. */
static workshop_crane_real_t workshop_crane_run(workshop_crane_shaper_t *s, workshop_crane_real_t command)
{
    const uint32_t first = workshop_crane_FIRST_TAP[s->row];
    const uint32_t end = workshop_crane_FIRST_TAP[s->row + 1u];
    workshop_crane_real_t reference = 0.0f;
    workshop_crane_real_t lap = 0.0f; /* the part of this lap's commands */
    workshop_crane_real_t low = -workshop_crane_MAX_COMMAND;
    workshop_crane_real_t high = workshop_crane_MAX_COMMAND;
    uint32_t i;

    if (!workshop_crane_running(s)) {
        s->pending = workshop_crane_rest_sum(s->base, s->row);
        s->fresh = 0.0f;
    }
    s->head = (s->head >= workshop_crane_LAST_TICKS) ? 0u : (s->head + 1u);
    s->ring[s->head] = command;
    for (i = first; i < end; ++i) {
        const uint32_t delay = workshop_crane_DELAY_TICKS[i];
        if (delay <= s->head) {
            reference = reference + (workshop_crane_AMPLITUDE[i] * s->ring[s->head - delay]);
            lap = reference;
        } else if (s->lapped) {
            const uint32_t older = s->head + ((workshop_crane_LAST_TICKS + 1u) - delay);
            reference = reference + (workshop_crane_AMPLITUDE[i] * s->ring[older]);
        } else {
            reference = reference + (workshop_crane_AMPLITUDE[i] * s->base);
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
    if (s->head >= workshop_crane_LAST_TICKS) {
        /* A full lap knows every command within reach: its sum ends the rounding of the older one. */
        s->pending = s->fresh;
        s->fresh = 0.0f;
        s->lapped = true;
    }
    return reference;
}

/* Sum of the references still to come if every later command is 0. */
static workshop_crane_real_t workshop_crane_pending(const workshop_crane_shaper_t *s, uint8_t row)
{
    return workshop_crane_running(s) ? s->pending : workshop_crane_rest_sum(s->base, row);
}

/* Clamp the command to the maximum; a command that is not finite becomes 0, and the result is false. */
static bool workshop_crane_finite(workshop_crane_shaper_t *s, workshop_crane_real_t *command)
{
    const workshop_crane_real_t magnitude = workshop_crane_abs(*command);
    bool valid = true;
    if (!(magnitude <= workshop_crane_MAX_COMMAND)) {
        /* Only what is finite and not 0 shrinks when halved. */
        if ((magnitude * 0.5f) < magnitude) {
            *command = (*command > 0.0f) ? workshop_crane_MAX_COMMAND : -workshop_crane_MAX_COMMAND;
            s->status |= WORKSHOP_CRANE_SHAPER_COMMAND_CLAMPED;
        } else {
            *command = 0.0f;
            valid = false;
        }
    }
    return valid;
}

/* The command as far as it is finite, within the maximum, above the minimum, and new. */
static workshop_crane_real_t workshop_crane_checked(workshop_crane_shaper_t *s, workshop_crane_real_t wanted)
{
    workshop_crane_real_t command = wanted;
    const bool valid = workshop_crane_finite(s, &command);
    if (workshop_crane_abs(command) < workshop_crane_MINIMUM_COMMAND) {
        if (workshop_crane_abs(command) > 0.0f) {
            s->status |= WORKSHOP_CRANE_SHAPER_BELOW_MINIMUM;
        }
        command = 0.0f;
    }
    /* The last command is held until it changes by the resolution; the maximum and 0 always arrive. */
    if ((workshop_crane_abs(command) + workshop_crane_abs(command)) < workshop_crane_COMMAND_RESOLUTION) {
        s->held = 0.0f;
    } else if ((workshop_crane_abs(command) >= workshop_crane_MAX_COMMAND)
        || (workshop_crane_abs(command - s->held) >= workshop_crane_COMMAND_RESOLUTION)) {
        s->held = command;
    } else {
        /* held as it is */
    }
    command = s->held;
    s->zero_commanded = valid && workshop_crane_equal(command, 0.0f);
    if (!valid) {
        s->invalid = true;
    } else if (s->zero_commanded) {
        s->invalid = false;
    } else {
        /* latched as it is */
    }
    if (s->invalid) {
        s->status |= WORKSHOP_CRANE_SHAPER_COMMAND_INVALID;
    }
    return (s->invalid || s->zero_commanded) ? 0.0f : command;
}

/* The row that the selector and enable ask for; an invalid selector keeps the last valid one. */
static void workshop_crane_want_row(workshop_crane_shaper_t *s, const workshop_crane_shaper_input_t *input)
{
    const uint8_t before = s->wanted_row;
    if (input->selector <= (uint8_t)WORKSHOP_CRANE_SHAPER_ROWS) {
        s->selected_row = input->selector;
    } else {
        s->status |= WORKSHOP_CRANE_SHAPER_SELECTOR_INVALID;
    }
    s->wanted_row = s->selected_row;
    if (!input->enable) {
        s->status |= WORKSHOP_CRANE_SHAPER_DISABLED;
        s->wanted_row = 0u;
    }
    if (s->wanted_row != before) {
        s->foretold = false;
    }
}

/* Stops latch until they are released and the command is 0, a quick stop also until the reference is. */
static void workshop_crane_latch_stops(workshop_crane_shaper_t *s, const workshop_crane_shaper_input_t *input)
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
    } else if (s->zero_commanded && workshop_crane_equal(s->reference, 0.0f)) {
        s->quick = false;
    } else {
        /* latched as it is */
    }
}

static bool workshop_crane_settled(const workshop_crane_shaper_t *s)
{
    return s->still_ticks >= workshop_crane_LAST_TICKS;
}

/* One tick further up: grows by the acceleration, shrinks by the deceleration, passes 0 by no more of either. */
static workshop_crane_real_t workshop_crane_raised(workshop_crane_real_t command)
{
    workshop_crane_real_t reach;
    if (command >= 0.0f) {
        reach = workshop_crane_on_grid(command) + workshop_crane_ACCELERATION.step;
    } else {
        reach = command + workshop_crane_DECELERATION.step;
        if (reach > workshop_crane_ACCELERATION.step) {
            reach = workshop_crane_ACCELERATION.step;
        }
    }
    return reach;
}

/* One tick further down, likewise. */
static workshop_crane_real_t workshop_crane_lowered(workshop_crane_real_t command)
{
    workshop_crane_real_t reach;
    if (command <= 0.0f) {
        reach = workshop_crane_on_grid(command) - workshop_crane_ACCELERATION.step;
    } else {
        reach = command - workshop_crane_DECELERATION.step;
        if (reach < -workshop_crane_ACCELERATION.step) {
            reach = -workshop_crane_ACCELERATION.step;
        }
    }
    return reach;
}

/* The command one tick nearer to its target. */
static workshop_crane_real_t workshop_crane_ramped(workshop_crane_real_t command, workshop_crane_real_t target)
{
    workshop_crane_real_t reach = target;
    if (target > command) {
        reach = workshop_crane_raised(command);
        if (reach > target) {
            reach = target;
        }
    } else if (target < command) {
        reach = workshop_crane_lowered(command);
        if (reach < target) {
            reach = target;
        }
    } else {
        /* there already */
    }
    return reach;
}

/* Take the reference to 0 and what is pending with it: the shaper rests at the reference. */
static void workshop_crane_stop(workshop_crane_shaper_t *s)
{
    const workshop_crane_real_t reach = workshop_crane_abs(s->reference) - workshop_crane_QUICK_STOP.step;
    if (s->emergency || (reach <= 0.0f)) {
        s->reference = 0.0f;
        s->still_ticks = workshop_crane_LAST_TICKS;
    } else {
        s->reference = (s->reference > 0.0f) ? reach : -reach;
        s->still_ticks = 0u;
    }
    s->command = s->reference;
    s->target = s->reference;
    s->foretold = false;
    workshop_crane_rest(s, s->reference);
}

/* The command becomes the target. */
static void workshop_crane_accept(workshop_crane_shaper_t *s, workshop_crane_real_t command)
{
    workshop_crane_real_t wanted = command;
    s->target = wanted;
}

/* Choose the row when settled; ramp, then shape. */
static void workshop_crane_move(workshop_crane_shaper_t *s, workshop_crane_real_t command)
{
    const workshop_crane_real_t before = s->command;
    if (workshop_crane_settled(s)) {
        s->row = s->wanted_row;
    }
    workshop_crane_accept(s, command);
    s->command = workshop_crane_ramped(s->command, s->target);
    if (!workshop_crane_equal(s->command, before)) {
        s->still_ticks = 0u;
        s->foretold = false;
    } else if (!workshop_crane_settled(s)) {
        s->still_ticks += 1u;
    } else {
        /* settled as it is */
    }
    if (s->still_ticks >= workshop_crane_TAIL_TICKS[s->row]) {
        workshop_crane_rest(s, s->command);
        s->reference = s->command;
    } else {
        s->reference = workshop_crane_run(s, s->command);
    }
}

/* A ramp that does not pass 0, in closed form; as exact as the ramp, so never a tick off. */
static workshop_crane_glide_t workshop_crane_glide(workshop_crane_real_t start, workshop_crane_real_t target, const workshop_crane_ramp_t *ramp)
{
    workshop_crane_glide_t glide = { 0.0f, 0u };
    if (!workshop_crane_equal(start, target)) {
        const workshop_crane_real_t from = (workshop_crane_abs(target) > workshop_crane_abs(start)) ? workshop_crane_on_grid(start) : start;
        const bool falls = from > target;
        const workshop_crane_real_t step = falls ? -ramp->step : ramp->step;
        const workshop_crane_real_t steps = (workshop_crane_abs(from - target) * ramp->steps_per_unit) + 0.5f;
        uint32_t whole = (uint32_t)steps; /* the nearest; one too many if it has landed */
        const workshop_crane_real_t position = from + ((workshop_crane_real_t)whole * step);
        const bool landed = falls ? (position <= target) : (position >= target);
        workshop_crane_real_t count;
        if (landed && (whole > 0u)) {
            whole -= 1u;
        }
        count = (workshop_crane_real_t)whole;
        glide.total = ((count * from) + (step * ((count * (count + 1.0f)) * 0.5f))) + target;
        glide.ticks = whole + 1u;
    }
    return glide;
}

static workshop_crane_real_t workshop_crane_distance(workshop_crane_real_t total)
{
    return total * workshop_crane_METRES_PER_UNIT_TICK;
}

static workshop_crane_real_t workshop_crane_time_s(uint32_t ticks)
{
    return (workshop_crane_real_t)ticks * workshop_crane_TICK_S;
}

/* The row that takes over if the command becomes 0 when settled. */
static uint8_t workshop_crane_row_at_rest(const workshop_crane_shaper_t *s)
{
    return s->wanted_row;
}

/* A stop at once: the ramp goes down and the taps run out. */
static workshop_crane_glide_t workshop_crane_foretell_release(const workshop_crane_shaper_t *s)
{
    const uint8_t row = workshop_crane_settled(s) ? workshop_crane_row_at_rest(s) : s->row;
    const uint32_t tail = workshop_crane_TAIL_TICKS[row];
    workshop_crane_glide_t stop = workshop_crane_glide(s->command, 0.0f, &workshop_crane_DECELERATION);
    stop.total = workshop_crane_pending(s, row) + stop.total;
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
static workshop_crane_glide_t workshop_crane_foretell(const workshop_crane_shaper_t *s)
{
    workshop_crane_glide_t stop = { 0.0f, 0u };
    if (s->emergency) {
        /* stopped */
    } else if (s->quick) {
        stop = workshop_crane_glide(s->reference, 0.0f, &workshop_crane_QUICK_STOP);
    } else {
        stop = workshop_crane_foretell_release(s);
    }
    return stop;
}

static bool workshop_crane_stopped(const workshop_crane_shaper_t *s)
{
    return s->emergency || s->quick;
}

static uint32_t workshop_crane_full_status(const workshop_crane_shaper_t *s)
{
    uint32_t status = s->status;
    if (s->row == 0u) {
        status |= WORKSHOP_CRANE_SHAPER_UNSHAPED;
    }
    if ((s->row != s->wanted_row)) {
        status |= WORKSHOP_CRANE_SHAPER_ROW_WAITS;
    }
    if (s->quick) {
        status |= WORKSHOP_CRANE_SHAPER_QUICK_STOP;
    }
    if (s->emergency) {
        status |= WORKSHOP_CRANE_SHAPER_EMERGENCY_STOP;
    }
    return status;
}

/* Whether the last tick began and ended settled and this one has the same inputs: then nothing can change. */
static bool workshop_crane_idles(const workshop_crane_shaper_t *s, const workshop_crane_shaper_input_t *input)
{
    return s->idle && workshop_crane_equal(input->command, s->input.command) && (input->selector == s->input.selector)
        && (input->enable == s->input.enable) && (input->quick_stop == s->input.quick_stop)
        && (input->emergency_stop == s->input.emergency_stop);
}

/* Run one tick into s->output. */
static void workshop_crane_tick(workshop_crane_shaper_t *s, const workshop_crane_shaper_input_t *input)
{
    const bool began_settled = workshop_crane_settled(s);
    workshop_crane_shaper_output_t *const output = &s->output;
    workshop_crane_real_t command;
    uint8_t row;

    s->status = 0u;
    command = workshop_crane_checked(s, input->command);
    workshop_crane_want_row(s, input);
    workshop_crane_latch_stops(s, input);
    if (workshop_crane_stopped(s)) {
        workshop_crane_stop(s);
    } else {
        workshop_crane_move(s, command);
    }

    if (!s->foretold) {
        const workshop_crane_glide_t stop = workshop_crane_foretell(s);
        output->stop_distance = workshop_crane_distance(stop.total);
        output->stop_time_s = workshop_crane_time_s(stop.ticks);
        output->stop_time_ticks = stop.ticks;
        s->foretold = workshop_crane_settled(s) && !workshop_crane_stopped(s);
    }
    row = workshop_crane_stopped(s) ? 0u : s->row;
    output->reference = s->reference;
    output->residual_bound = workshop_crane_RESIDUAL_BOUND[row];
    output->row = s->row;
    output->settled = workshop_crane_settled(s);
    output->active = (row > 0u);
    output->error = ((s->status & (WORKSHOP_CRANE_SHAPER_COMMAND_INVALID | WORKSHOP_CRANE_SHAPER_SELECTOR_INVALID)) != 0u);
    output->status = workshop_crane_full_status(s);
    s->input = *input;
    s->idle = began_settled && s->foretold;
}

void workshop_crane_shaper_init(workshop_crane_shaper_t *shaper)
{
    workshop_crane_shaper_t *const s = shaper;
    s->pending = 0.0f;
    s->fresh = 0.0f;
    s->base = 0.0f;
    s->target = 0.0f;
    s->command = 0.0f;
    s->reference = 0.0f;
    s->held = 0.0f;
    s->head = 823u;
    s->still_ticks = 823u;
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

void workshop_crane_shaper_step(workshop_crane_shaper_t *shaper, const workshop_crane_shaper_input_t *input,
    workshop_crane_shaper_output_t *output)
{
    if (!workshop_crane_idles(shaper, input)) {
        workshop_crane_tick(shaper, input);
    }
    *output = shaper->output;
}
