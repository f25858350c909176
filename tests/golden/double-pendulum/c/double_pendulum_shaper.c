/*
 * double_pendulum: command shaper, see double_pendulum_shaper.h.
 * Design SHA-256 2d68b8f32fb8aeeadf58340bfd79ac62b982e693e1f00149d26e9000aa4c7279.
 */
#include "double_pendulum_shaper.h"

#if (DOUBLE_PENDULUM_SHAPER_DESIGN != 0x2d68b8f3u)
#error "double_pendulum_shaper.h and double_pendulum_shaper.c belong to different designs"
#endif

/* Does not compile when the state is larger than the header says. */
typedef char double_pendulum_ram_check[(sizeof(double_pendulum_shaper_t) <= (unsigned)DOUBLE_PENDULUM_SHAPER_RAM) ? 1 : -1];

static const uint32_t double_pendulum_LAST_TICKS = 277u; /* longest delay of any row */
static const double_pendulum_real_t double_pendulum_MAX_COMMAND = 0.5f; /* m/s: max_speed */
static const double_pendulum_real_t double_pendulum_RAMP_ANCHOR = 1.0f; /* floats next to it are the grid of ramp steps */
static const double_pendulum_real_t double_pendulum_METRES_PER_UNIT_TICK = 0.02f; /* m of way per unit and tick */
static const double_pendulum_real_t double_pendulum_TICK_S = 0.02f; /* s: tick */

/* first tap of each row, and the end */
static const uint32_t double_pendulum_FIRST_TAP[4] = {
    0u, 1u, 7u, 15u
};
/* delay of each tap, by row */
static const uint32_t double_pendulum_DELAY_TICKS[15] = {
    0u,
    0u, 36u, 117u, 118u, 200u, 235u,
    0u, 39u, 114u, 115u, 162u, 163u,
    236u, 277u
};
/* amplitude of each tap, by row; each row sums to exactly 1 */
static const double_pendulum_real_t double_pendulum_AMPLITUDE[15] = {
    1.0f,
    0.27700967f, 0.028630078f, 0.30671388f, 0.091531634f, 0.040858626f, 0.25525612f,
    0.21704537f, 0.029108584f, 0.21454316f, 0.06270313f, 0.16465265f, 0.056553364f,
    0.066456676f, 0.18893707f
};
/* longest delay of each row */
static const uint32_t double_pendulum_TAIL_TICKS[3] = {
    0u, 235u, 277u
};
/* sum of amplitude times delay of each row: references to come per unit of a steady command */
static const double_pendulum_real_t double_pendulum_MOMENT_TICKS[3] = {
    0.0f, 115.873856f, 136.71529f
};
/* tolerance of each row */
static const double_pendulum_real_t double_pendulum_RESIDUAL_BOUND[3] = {
    1.0f, 0.05f, 0.05f
};

/* A ramp: its step per tick, rounded up to the grid, and what its closed form needs. */
typedef struct {
    double_pendulum_real_t step;
    double_pendulum_real_t steps_per_unit; /* 1 / step */
} double_pendulum_ramp_t;

/* m/s per tick: acceleration */
static const double_pendulum_ramp_t double_pendulum_ACCELERATION = { 0.0050001144f, 199.99542f };
/* m/s per tick: deceleration */
static const double_pendulum_ramp_t double_pendulum_DECELERATION = { 0.0050001144f, 199.99542f };
/* m/s per tick: quick_stop */
static const double_pendulum_ramp_t double_pendulum_QUICK_STOP = { 0.0050001144f, 199.99542f };

/* What a ramp still has to do: ticks, and the sum of the commands of those ticks. */
typedef struct {
    double_pendulum_real_t total;
    uint32_t ticks;
} double_pendulum_glide_t;

static double_pendulum_real_t double_pendulum_abs(double_pendulum_real_t value)
{
    return (value < 0.0f) ? -value : value;
}

static bool double_pendulum_equal(double_pendulum_real_t a, double_pendulum_real_t b)
{
    return (a <= b) && (a >= b);
}

/* Round a command to the grid of ramp steps: from there on a ramp adds exactly. */
static double_pendulum_real_t double_pendulum_on_grid(double_pendulum_real_t command)
{
    const double_pendulum_real_t anchor = (command < 0.0f) ? -double_pendulum_RAMP_ANCHOR : double_pendulum_RAMP_ANCHOR;
    return (command + anchor) - anchor;
}

/* Whether commands within reach of the taps may differ. */
static bool double_pendulum_running(const double_pendulum_shaper_t *s)
{
    return s->lapped || (s->head < double_pendulum_LAST_TICKS);
}

/* Rest at a command: within reach of the taps all commands equal it. */
static void double_pendulum_rest(double_pendulum_shaper_t *s, double_pendulum_real_t command)
{
    s->base = command;
    s->head = double_pendulum_LAST_TICKS;
    s->lapped = false;
}

/* Sum of the references still to come at rest at a command. */
static double_pendulum_real_t double_pendulum_rest_sum(double_pendulum_real_t command, uint8_t row)
{
    return command * double_pendulum_MOMENT_TICKS[row];
}

/* Shape one new command. */
static double_pendulum_real_t double_pendulum_run(double_pendulum_shaper_t *s, double_pendulum_real_t command)
{
    const uint32_t first = double_pendulum_FIRST_TAP[s->row];
    const uint32_t end = double_pendulum_FIRST_TAP[s->row + 1u];
    double_pendulum_real_t reference = 0.0f;
    double_pendulum_real_t lap = 0.0f; /* the part of this lap's commands */
    double_pendulum_real_t low = -double_pendulum_MAX_COMMAND;
    double_pendulum_real_t high = double_pendulum_MAX_COMMAND;
    uint32_t i;

    if (!double_pendulum_running(s)) {
        s->pending = double_pendulum_rest_sum(s->base, s->row);
        s->fresh = 0.0f;
    }
    s->head = (s->head >= double_pendulum_LAST_TICKS) ? 0u : (s->head + 1u);
    s->ring[s->head] = command;
    for (i = first; i < end; ++i) {
        const uint32_t delay = double_pendulum_DELAY_TICKS[i];
        if (delay <= s->head) {
            reference = reference + (double_pendulum_AMPLITUDE[i] * s->ring[s->head - delay]);
            lap = reference;
        } else if (s->lapped) {
            const uint32_t older = s->head + ((double_pendulum_LAST_TICKS + 1u) - delay);
            reference = reference + (double_pendulum_AMPLITUDE[i] * s->ring[older]);
        } else {
            reference = reference + (double_pendulum_AMPLITUDE[i] * s->base);
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
    if (s->head >= double_pendulum_LAST_TICKS) {
        /* A full lap knows every command within reach: its sum ends the rounding of the older one. */
        s->pending = s->fresh;
        s->fresh = 0.0f;
        s->lapped = true;
    }
    return reference;
}

/* Sum of the references still to come if every later command is 0. */
static double_pendulum_real_t double_pendulum_pending(const double_pendulum_shaper_t *s, uint8_t row)
{
    return double_pendulum_running(s) ? s->pending : double_pendulum_rest_sum(s->base, row);
}

/* Clamp the command to the maximum; a command that is not finite becomes 0, and the result is false. */
static bool double_pendulum_finite(double_pendulum_shaper_t *s, double_pendulum_real_t *command)
{
    const double_pendulum_real_t magnitude = double_pendulum_abs(*command);
    bool valid = true;
    if (!(magnitude <= double_pendulum_MAX_COMMAND)) {
        /* Only what is finite and not 0 shrinks when halved. */
        if ((magnitude * 0.5f) < magnitude) {
            *command = (*command > 0.0f) ? double_pendulum_MAX_COMMAND : -double_pendulum_MAX_COMMAND;
            s->status |= DOUBLE_PENDULUM_SHAPER_COMMAND_CLAMPED;
        } else {
            *command = 0.0f;
            valid = false;
        }
    }
    return valid;
}

/* The command as far as it is finite, within the maximum. */
static double_pendulum_real_t double_pendulum_checked(double_pendulum_shaper_t *s, double_pendulum_real_t wanted)
{
    double_pendulum_real_t command = wanted;
    const bool valid = double_pendulum_finite(s, &command);
    s->zero_commanded = valid && double_pendulum_equal(command, 0.0f);
    if (!valid) {
        s->invalid = true;
    } else if (s->zero_commanded) {
        s->invalid = false;
    } else {
        /* latched as it is */
    }
    if (s->invalid) {
        s->status |= DOUBLE_PENDULUM_SHAPER_COMMAND_INVALID;
    }
    return (s->invalid || s->zero_commanded) ? 0.0f : command;
}

/* The row that the selector and enable ask for; an invalid selector keeps the last valid one. */
static void double_pendulum_want_row(double_pendulum_shaper_t *s, const double_pendulum_shaper_input_t *input)
{
    const uint8_t before = s->wanted_row;
    if (input->selector <= (uint8_t)DOUBLE_PENDULUM_SHAPER_ROWS) {
        s->selected_row = input->selector;
    } else {
        s->status |= DOUBLE_PENDULUM_SHAPER_SELECTOR_INVALID;
    }
    s->wanted_row = s->selected_row;
    if (!input->enable) {
        s->status |= DOUBLE_PENDULUM_SHAPER_DISABLED;
        s->wanted_row = 0u;
    }
    if (s->wanted_row != before) {
        s->foretold = false;
    }
}

/* Stops latch until they are released and the command is 0, a quick stop also until the reference is. */
static void double_pendulum_latch_stops(double_pendulum_shaper_t *s, const double_pendulum_shaper_input_t *input)
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
    } else if (s->zero_commanded && double_pendulum_equal(s->reference, 0.0f)) {
        s->quick = false;
    } else {
        /* latched as it is */
    }
}

static bool double_pendulum_settled(const double_pendulum_shaper_t *s)
{
    return s->still_ticks >= double_pendulum_LAST_TICKS;
}

/* One tick further up: grows by the acceleration, shrinks by the deceleration, passes 0 by no more of either. */
static double_pendulum_real_t double_pendulum_raised(double_pendulum_real_t command)
{
    double_pendulum_real_t reach;
    if (command >= 0.0f) {
        reach = double_pendulum_on_grid(command) + double_pendulum_ACCELERATION.step;
    } else {
        reach = command + double_pendulum_DECELERATION.step;
        if (reach > double_pendulum_ACCELERATION.step) {
            reach = double_pendulum_ACCELERATION.step;
        }
    }
    return reach;
}

/* One tick further down, likewise. */
static double_pendulum_real_t double_pendulum_lowered(double_pendulum_real_t command)
{
    double_pendulum_real_t reach;
    if (command <= 0.0f) {
        reach = double_pendulum_on_grid(command) - double_pendulum_ACCELERATION.step;
    } else {
        reach = command - double_pendulum_DECELERATION.step;
        if (reach < -double_pendulum_ACCELERATION.step) {
            reach = -double_pendulum_ACCELERATION.step;
        }
    }
    return reach;
}

/* The command one tick nearer to its target. */
static double_pendulum_real_t double_pendulum_ramped(double_pendulum_real_t command, double_pendulum_real_t target)
{
    double_pendulum_real_t reach = target;
    if (target > command) {
        reach = double_pendulum_raised(command);
        if (reach > target) {
            reach = target;
        }
    } else if (target < command) {
        reach = double_pendulum_lowered(command);
        if (reach < target) {
            reach = target;
        }
    } else {
        /* there already */
    }
    return reach;
}

/* Take the reference to 0 and what is pending with it: the shaper rests at the reference. */
static void double_pendulum_stop(double_pendulum_shaper_t *s)
{
    const double_pendulum_real_t reach = double_pendulum_abs(s->reference) - double_pendulum_QUICK_STOP.step;
    if (s->emergency || (reach <= 0.0f)) {
        s->reference = 0.0f;
        s->still_ticks = double_pendulum_LAST_TICKS;
    } else {
        s->reference = (s->reference > 0.0f) ? reach : -reach;
        s->still_ticks = 0u;
    }
    s->command = s->reference;
    s->target = s->reference;
    s->foretold = false;
    double_pendulum_rest(s, s->reference);
}

/* The command becomes the target. */
static void double_pendulum_accept(double_pendulum_shaper_t *s, double_pendulum_real_t command)
{
    double_pendulum_real_t wanted = command;
    s->target = wanted;
}

/* Choose the row when settled; ramp, then shape. */
static void double_pendulum_move(double_pendulum_shaper_t *s, double_pendulum_real_t command)
{
    const double_pendulum_real_t before = s->command;
    if (double_pendulum_settled(s)) {
        s->row = s->wanted_row;
    }
    double_pendulum_accept(s, command);
    s->command = double_pendulum_ramped(s->command, s->target);
    if (!double_pendulum_equal(s->command, before)) {
        s->still_ticks = 0u;
        s->foretold = false;
    } else if (!double_pendulum_settled(s)) {
        s->still_ticks += 1u;
    } else {
        /* settled as it is */
    }
    if (s->still_ticks >= double_pendulum_TAIL_TICKS[s->row]) {
        double_pendulum_rest(s, s->command);
        s->reference = s->command;
    } else {
        s->reference = double_pendulum_run(s, s->command);
    }
}

/* A ramp that does not pass 0, in closed form; as exact as the ramp, so never a tick off. */
static double_pendulum_glide_t double_pendulum_glide(double_pendulum_real_t start, double_pendulum_real_t target, const double_pendulum_ramp_t *ramp)
{
    double_pendulum_glide_t glide = { 0.0f, 0u };
    if (!double_pendulum_equal(start, target)) {
        const double_pendulum_real_t from = (double_pendulum_abs(target) > double_pendulum_abs(start)) ? double_pendulum_on_grid(start) : start;
        const bool falls = from > target;
        const double_pendulum_real_t step = falls ? -ramp->step : ramp->step;
        const double_pendulum_real_t steps = (double_pendulum_abs(from - target) * ramp->steps_per_unit) + 0.5f;
        uint32_t whole = (uint32_t)steps; /* the nearest; one too many if it has landed */
        const double_pendulum_real_t position = from + ((double_pendulum_real_t)whole * step);
        const bool landed = falls ? (position <= target) : (position >= target);
        double_pendulum_real_t count;
        if (landed && (whole > 0u)) {
            whole -= 1u;
        }
        count = (double_pendulum_real_t)whole;
        glide.total = ((count * from) + (step * ((count * (count + 1.0f)) * 0.5f))) + target;
        glide.ticks = whole + 1u;
    }
    return glide;
}

static double_pendulum_real_t double_pendulum_distance(double_pendulum_real_t total)
{
    return total * double_pendulum_METRES_PER_UNIT_TICK;
}

static double_pendulum_real_t double_pendulum_time_s(uint32_t ticks)
{
    return (double_pendulum_real_t)ticks * double_pendulum_TICK_S;
}

/* The row that takes over if the command becomes 0 when settled. */
static uint8_t double_pendulum_row_at_rest(const double_pendulum_shaper_t *s)
{
    return s->wanted_row;
}

/* A stop at once: the ramp goes down and the taps run out. */
static double_pendulum_glide_t double_pendulum_foretell_release(const double_pendulum_shaper_t *s)
{
    const uint8_t row = double_pendulum_settled(s) ? double_pendulum_row_at_rest(s) : s->row;
    const uint32_t tail = double_pendulum_TAIL_TICKS[row];
    double_pendulum_glide_t stop = double_pendulum_glide(s->command, 0.0f, &double_pendulum_DECELERATION);
    stop.total = double_pendulum_pending(s, row) + stop.total;
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
static double_pendulum_glide_t double_pendulum_foretell(const double_pendulum_shaper_t *s)
{
    double_pendulum_glide_t stop = { 0.0f, 0u };
    if (s->emergency) {
        /* stopped */
    } else if (s->quick) {
        stop = double_pendulum_glide(s->reference, 0.0f, &double_pendulum_QUICK_STOP);
    } else {
        stop = double_pendulum_foretell_release(s);
    }
    return stop;
}

static bool double_pendulum_stopped(const double_pendulum_shaper_t *s)
{
    return s->emergency || s->quick;
}

static uint32_t double_pendulum_full_status(const double_pendulum_shaper_t *s)
{
    uint32_t status = s->status;
    if (s->row == 0u) {
        status |= DOUBLE_PENDULUM_SHAPER_UNSHAPED;
    }
    if ((s->row != s->wanted_row)) {
        status |= DOUBLE_PENDULUM_SHAPER_ROW_WAITS;
    }
    if (s->quick) {
        status |= DOUBLE_PENDULUM_SHAPER_QUICK_STOP;
    }
    if (s->emergency) {
        status |= DOUBLE_PENDULUM_SHAPER_EMERGENCY_STOP;
    }
    return status;
}

/* Whether the last tick began and ended settled and this one has the same inputs: then nothing can change. */
static bool double_pendulum_idles(const double_pendulum_shaper_t *s, const double_pendulum_shaper_input_t *input)
{
    return s->idle && double_pendulum_equal(input->command, s->input.command) && (input->selector == s->input.selector)
        && (input->enable == s->input.enable) && (input->quick_stop == s->input.quick_stop)
        && (input->emergency_stop == s->input.emergency_stop);
}

/* Run one tick into s->output. */
static void double_pendulum_tick(double_pendulum_shaper_t *s, const double_pendulum_shaper_input_t *input)
{
    const bool began_settled = double_pendulum_settled(s);
    double_pendulum_shaper_output_t *const output = &s->output;
    double_pendulum_real_t command;
    uint8_t row;

    s->status = 0u;
    command = double_pendulum_checked(s, input->command);
    double_pendulum_want_row(s, input);
    double_pendulum_latch_stops(s, input);
    if (double_pendulum_stopped(s)) {
        double_pendulum_stop(s);
    } else {
        double_pendulum_move(s, command);
    }

    if (!s->foretold) {
        const double_pendulum_glide_t stop = double_pendulum_foretell(s);
        output->stop_distance = double_pendulum_distance(stop.total);
        output->stop_time_s = double_pendulum_time_s(stop.ticks);
        output->stop_time_ticks = stop.ticks;
        s->foretold = double_pendulum_settled(s) && !double_pendulum_stopped(s);
    }
    row = double_pendulum_stopped(s) ? 0u : s->row;
    output->reference = s->reference;
    output->residual_bound = double_pendulum_RESIDUAL_BOUND[row];
    output->row = s->row;
    output->settled = double_pendulum_settled(s);
    output->active = (row > 0u);
    output->error = ((s->status & (DOUBLE_PENDULUM_SHAPER_COMMAND_INVALID | DOUBLE_PENDULUM_SHAPER_SELECTOR_INVALID)) != 0u);
    output->status = double_pendulum_full_status(s);
    s->input = *input;
    s->idle = began_settled && s->foretold;
}

void double_pendulum_shaper_init(double_pendulum_shaper_t *shaper)
{
    double_pendulum_shaper_t *const s = shaper;
    s->pending = 0.0f;
    s->fresh = 0.0f;
    s->base = 0.0f;
    s->target = 0.0f;
    s->command = 0.0f;
    s->reference = 0.0f;
    s->head = 277u;
    s->still_ticks = 277u;
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

void double_pendulum_shaper_step(double_pendulum_shaper_t *shaper, const double_pendulum_shaper_input_t *input,
    double_pendulum_shaper_output_t *output)
{
    if (!double_pendulum_idles(shaper, input)) {
        double_pendulum_tick(shaper, input);
    }
    *output = shaper->output;
}
