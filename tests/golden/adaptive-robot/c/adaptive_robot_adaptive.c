/*
 * adaptive_robot: adaptive command shaper. It learns to leave no vibration from what it measures.
 *
 * Made by swayless 0.1.0 from adaptive-robot.toml.
 * This file is yours: use, change and ship it as you like.
 *
 * Three impulses, 25 ticks of 0.001 s apart. The
 * coefficients sum to exactly 1 and change only while the command has rested for two delays:
 * the reference is the command there.
 * The command passes unshaped for 4000 ticks after it has first moved.
 * Commands up to 1, references to 1 times it.
 * A vibration of 60 counts as 1: about what an unshaped move leaves.
 * Remove offset and hum of the measurement before.
 * After S. Rhim and W. J. Book, Adaptive command shaping, eqs 7-16.
 *
 * NOT A SAFETY FUNCTION: limit switches, emergency stop and brakes must work without this block.
 * Nothing may limit, ramp or filter the reference on its way to the drive: it undoes the shaping.
 */
#include "adaptive_robot_adaptive.h"

typedef double adaptive_robot_number_t;

/* Does not compile when the state is larger than the header says. */
typedef char adaptive_robot_adaptive_ram_check[(sizeof(adaptive_robot_adaptive_t) <= ADAPTIVE_ROBOT_ADAPTIVE_RAM) ? 1 : -1];

static const adaptive_robot_number_t adaptive_robot_MAX_COMMAND = 1.0; /* largest command */
static const adaptive_robot_number_t adaptive_robot_MAX_VIBRATION = 6000.0; /* largest reading */
static const adaptive_robot_number_t adaptive_robot_PER_SCALE = 0.016666666666666666; /* brings a reading to order 1 */
static const adaptive_robot_number_t adaptive_robot_PEAK_FACTOR = 1.0; /* largest absolute sum of coefficients */
static const adaptive_robot_number_t adaptive_robot_DEAD_ZONE = 0.0006; /* sum of squares of a window that teaches nothing */
static const adaptive_robot_number_t adaptive_robot_WHITE_AT_FIRST = 1.0e-07; /* inverse of P(0) */
static const adaptive_robot_number_t adaptive_robot_LEAST_DETERMINANT = 6.103515625e-05; /* below it samples do not tell, relative */
static const adaptive_robot_number_t adaptive_robot_NOISE_FACTOR = 12.0; /* energy of a window that teaches, by its noise */
static const adaptive_robot_number_t adaptive_robot_MISFIT_FACTOR = 4.0; /* what is left by coefficients that misfit, by noise */
static const adaptive_robot_number_t adaptive_robot_MISFIT_RATIO = 0.0001; /* and by energy */
static const adaptive_robot_number_t adaptive_robot_RECENT = 0.875; /* weight of the past in the slower test */
static const adaptive_robot_number_t adaptive_robot_SIGNIFICANCE = 32.0; /* of the slower test */
static const adaptive_robot_number_t adaptive_robot_PAST_WINDOWS = 63.0; /* windows like the present one that the past is worth */
static const adaptive_robot_number_t adaptive_robot_CONVERGED = 0.01; /* largest change of a coefficient that has converged */
static const adaptive_robot_number_t adaptive_robot_ANCHOR = 24.0; /* rounds a coefficient to the lattice */
static const adaptive_robot_number_t adaptive_robot_WINDOW = 200.0; /* samples of a window */
static const adaptive_robot_number_t adaptive_robot_FIRST_OUTER = 0.33333333333333215; /* first and second coefficient at first */
static const adaptive_robot_number_t adaptive_robot_FIRST_LAST = 0.3333333333333357; /* the third, which takes the rest */

static const adaptive_robot_adaptive_sums_t adaptive_robot_NOTHING = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };

static adaptive_robot_number_t adaptive_robot_magnitude_of(adaptive_robot_number_t value)
{
    return (value < 0.0) ? -value : value;
}

/* Add white noise of this power to each of the three samples; a negative power takes it away. */
static adaptive_robot_adaptive_sums_t adaptive_robot_with_white(const adaptive_robot_adaptive_sums_t *sums, adaptive_robot_number_t power)
{
    adaptive_robot_adaptive_sums_t all = *sums;
    const adaptive_robot_number_t twice = power + power;
    all.uu = sums->uu + twice;
    all.uw = sums->uw + power;
    all.ww = sums->ww + twice;
    all.vu = sums->vu - power;
    all.vw = sums->vw - power;
    all.vv = sums->vv + power;
    return all;
}

static void adaptive_robot_add_sample(adaptive_robot_adaptive_sums_t *sums, adaptive_robot_number_t v0, adaptive_robot_number_t v1, adaptive_robot_number_t v2)
{
    const adaptive_robot_number_t u = v0 - v1;
    const adaptive_robot_number_t w = v2 - v1;
    sums->uu = sums->uu + (u * u);
    sums->uw = sums->uw + (u * w);
    sums->ww = sums->ww + (w * w);
    sums->vu = sums->vu + (v1 * u);
    sums->vw = sums->vw + (v1 * w);
    sums->vv = sums->vv + (v1 * v1);
}

/* Sum of v0 v0 + v1 v1 + v2 v2. */
static adaptive_robot_number_t adaptive_robot_energy_of(const adaptive_robot_adaptive_sums_t *s)
{
    return (((3.0 * s->vv) + (2.0 * (s->vu + s->vw))) + s->uu) + s->ww;
}

/* Sum of squares that coefficients leave, eq 12. */
static adaptive_robot_number_t adaptive_robot_left_by(const adaptive_robot_adaptive_sums_t *s, const adaptive_robot_number_t c[3])
{
    const adaptive_robot_number_t squares = ((c[0] * c[0]) * s->uu) + ((c[2] * c[2]) * s->ww);
    const adaptive_robot_number_t mixed = (((c[0] * c[2]) * s->uw) + (c[0] * s->vu)) + (c[2] * s->vw);
    const adaptive_robot_number_t left = (squares + (2.0 * mixed)) + s->vv;
    return (left > 0.0) ? left : 0.0;
}

/* The coefficients of unit sum that leave least, eq 16; false if the samples do not tell. */
static bool adaptive_robot_fit(const adaptive_robot_adaptive_sums_t *s, adaptive_robot_number_t c[3])
{
    const adaptive_robot_number_t product = s->uu * s->ww;
    const adaptive_robot_number_t determinant = product - (s->uw * s->uw);
    const bool tells = (s->uu > 0.0) && (s->ww > 0.0)
        && (determinant > (adaptive_robot_LEAST_DETERMINANT * product));
    if (tells) {
        c[0] = ((s->uw * s->vw) - (s->ww * s->vu)) / determinant;
        c[2] = ((s->uw * s->vu) - (s->uu * s->vw)) / determinant;
        c[1] = 1.0 - (c[0] + c[2]);
    }
    return tells;
}

/* The least eigenvalue of the matrix of the samples: what one vibration cannot explain. */
static adaptive_robot_number_t adaptive_robot_noise_power(const adaptive_robot_adaptive_sums_t *s)
{
    const adaptive_robot_number_t trace = adaptive_robot_energy_of(s);
    const adaptive_robot_number_t first = (s->vv + (s->vu + s->vu)) + s->uu;
    const adaptive_robot_number_t last = (s->vv + (s->vw + s->vw)) + s->ww;
    const adaptive_robot_number_t across = ((s->vv + s->vu) + s->vw) + s->uw;
    const adaptive_robot_number_t middle = ((s->uu * s->vv) - (s->vu * s->vu)) + ((s->ww * s->vv) - (s->vw * s->vw));
    const adaptive_robot_number_t minors = middle + ((first * last) - (across * across));
    const adaptive_robot_number_t determinant = ((s->vv * ((s->uu * s->ww) - (s->uw * s->uw)))
        - (s->vu * ((s->vu * s->ww) - (s->uw * s->vw)))) + (s->vw * ((s->vu * s->uw) - (s->uu * s->vw)));
    adaptive_robot_number_t noise = 0.0;
    uint32_t steps;
    for (steps = 0u; steps < 8u; ++steps) {
        const adaptive_robot_number_t value = ((((noise - trace) * noise) + minors) * noise) - determinant;
        const adaptive_robot_number_t slope = (((3.0 * noise) - (trace + trace)) * noise) + minors;
        if ((slope > 0.0) && (value < 0.0)) {
            noise = noise - (value / slope);
        }
    }
    return noise;
}

static void adaptive_robot_forget_misfit(adaptive_robot_adaptive_t *s)
{
    s->left = 0.0;
    s->noise = 0.0;
    s->samples = 0.0;
}

/* Whether recent windows together leave more than noise, by four standard deviations. */
static bool adaptive_robot_misfits_slowly(adaptive_robot_adaptive_t *s, adaptive_robot_number_t left, adaptive_robot_number_t noise)
{
    adaptive_robot_number_t excess;
    s->left = (adaptive_robot_RECENT * s->left) + left;
    s->noise = (adaptive_robot_RECENT * s->noise) + noise;
    s->samples = (adaptive_robot_RECENT * s->samples) + adaptive_robot_WINDOW;
    excess = s->left - s->noise;
    return (excess > 0.0)
        && (((excess * excess) * s->samples) > (adaptive_robot_SIGNIFICANCE * (s->noise * s->noise)));
}

/* How many windows like this one the past is worth. */
static adaptive_robot_number_t adaptive_robot_windows_that_count(adaptive_robot_adaptive_t *s, adaptive_robot_number_t energy, adaptive_robot_number_t noise)
{
    const adaptive_robot_number_t *c = s->coefficient;
    adaptive_robot_number_t windows = adaptive_robot_PAST_WINDOWS;
    s->again = false;
    if (s->learned) {
        const adaptive_robot_number_t left = adaptive_robot_left_by(&s->window, c);
        const adaptive_robot_number_t size = ((c[0] * c[0]) + (c[1] * c[1])) + (c[2] * c[2]);
        const adaptive_robot_number_t allowed = adaptive_robot_MISFIT_RATIO * energy;
        if (left > (((adaptive_robot_MISFIT_FACTOR * noise) * size) + allowed)) {
            s->again = true;
            adaptive_robot_forget_misfit(s);
            s->past = adaptive_robot_with_white(&adaptive_robot_NOTHING, adaptive_robot_WHITE_AT_FIRST);
        } else {
            s->again = adaptive_robot_misfits_slowly(s, (left - allowed) / size, noise);
        }
        if (s->again) {
            windows = 1.0;
        }
    }
    return windows;
}

/* Round to the lattice on which sums are exact; the last takes the rest. */
static void adaptive_robot_on_lattice(adaptive_robot_number_t c[3])
{
    c[0] = (c[0] + adaptive_robot_ANCHOR) - adaptive_robot_ANCHOR;
    c[1] = (c[1] + adaptive_robot_ANCHOR) - adaptive_robot_ANCHOR;
    c[2] = 1.0 - (c[0] + c[1]);
}

static adaptive_robot_number_t adaptive_robot_absolute_sum(const adaptive_robot_number_t c[3])
{
    return (adaptive_robot_magnitude_of(c[0]) + adaptive_robot_magnitude_of(c[1])) + adaptive_robot_magnitude_of(c[2]);
}

/* Take new coefficients unless they ask too much of the drive. */
static void adaptive_robot_adopt(adaptive_robot_adaptive_t *s)
{
    adaptive_robot_number_t found[3] = { 0.0, 0.0, 0.0 };
    adaptive_robot_number_t change = 0.0;
    uint32_t n;
    s->refused = !(adaptive_robot_fit(&s->past, found) && (adaptive_robot_absolute_sum(found) <= (2.0 * adaptive_robot_PEAK_FACTOR)));
    if (!s->refused) {
        adaptive_robot_on_lattice(found);
        s->refused = adaptive_robot_absolute_sum(found) > adaptive_robot_PEAK_FACTOR;
    }
    if (s->refused) {
        s->converged = false;
    } else {
        for (n = 0u; n < 3u; ++n) {
            const adaptive_robot_number_t moved = adaptive_robot_magnitude_of(found[n] - s->coefficient[n]);
            change = (moved > change) ? moved : change;
            s->coefficient[n] = found[n];
        }
        s->converged = s->learned && (!s->again) && (change <= adaptive_robot_CONVERGED);
        s->learned = true;
    }
}

/* Learn from a complete window, or find that there is nothing to learn from. */
static void adaptive_robot_judge(adaptive_robot_adaptive_t *s)
{
    const adaptive_robot_number_t energy = adaptive_robot_energy_of(&s->window);
    const adaptive_robot_number_t noise = adaptive_robot_noise_power(&s->window);
    s->frozen = !((energy > adaptive_robot_DEAD_ZONE) && (energy > (adaptive_robot_NOISE_FACTOR * noise)));
    if (!s->frozen) {
        const adaptive_robot_number_t windows = adaptive_robot_windows_that_count(s, energy, noise) * energy;
        const adaptive_robot_number_t past = adaptive_robot_energy_of(&s->past);
        const adaptive_robot_number_t weight = (past > windows) ? (windows / past) : 1.0;
        const adaptive_robot_adaptive_sums_t seen = adaptive_robot_with_white(&s->window, -noise);
        s->past.uu = (weight * s->past.uu) + seen.uu;
        s->past.uw = (weight * s->past.uw) + seen.uw;
        s->past.ww = (weight * s->past.ww) + seen.ww;
        s->past.vu = (weight * s->past.vu) + seen.vu;
        s->past.vw = (weight * s->past.vw) + seen.vw;
        s->past.vv = (weight * s->past.vv) + seen.vv;
        adaptive_robot_adopt(s);
    } else if (s->shaping) {
        s->converged = true;
    } else {
        /* as it was */
    }
}

void adaptive_robot_adaptive_init(adaptive_robot_adaptive_t *shaper)
{
    uint32_t n;
    for (n = 0u; n < ADAPTIVE_ROBOT_ADAPTIVE_RING; ++n) {
        shaper->commands[n] = 0.0;
        shaper->vibrations[n] = 0.0;
    }
    shaper->window = adaptive_robot_NOTHING;
    shaper->past = adaptive_robot_with_white(&adaptive_robot_NOTHING, adaptive_robot_WHITE_AT_FIRST);
    shaper->coefficient[0] = adaptive_robot_FIRST_OUTER;
    shaper->coefficient[1] = adaptive_robot_FIRST_OUTER;
    shaper->coefficient[2] = adaptive_robot_FIRST_LAST;
    for (n = 0u; n < 3u; ++n) {
        shaper->used[n] = shaper->coefficient[n];
    }
    shaper->command = 0.0;
    shaper->vibration = 0.0;
    adaptive_robot_forget_misfit(shaper);
    shaper->head = 0u;
    shaper->rest_ticks = 0u;
    shaper->quiet_ticks = 0u;
    shaper->moved_ticks = 0u;
    shaper->window_ticks = 0u;
    shaper->status = 0u;
    shaper->shaping = false;
    shaper->learned = false;
    shaper->converged = false;
    shaper->frozen = false;
    shaper->again = false;
    shaper->refused = false;
}

/* Take a finite command within the maximum, and count how long it has rested. */
static void adaptive_robot_read_command(adaptive_robot_adaptive_t *s, adaptive_robot_number_t wanted)
{
    const adaptive_robot_number_t magnitude = adaptive_robot_magnitude_of(wanted);
    adaptive_robot_number_t command = wanted;
    if (!(magnitude <= adaptive_robot_MAX_COMMAND)) {
        /* Only what is finite and not 0 shrinks when halved. */
        if ((magnitude * 0.5) < magnitude) {
            command = (wanted > 0.0) ? adaptive_robot_MAX_COMMAND : -adaptive_robot_MAX_COMMAND;
            s->status |= ADAPTIVE_ROBOT_ADAPTIVE_COMMAND_CLAMPED;
        } else {
            command = s->command;
            s->status |= ADAPTIVE_ROBOT_ADAPTIVE_COMMAND_INVALID;
        }
    }
    if ((command <= s->command) && (command >= s->command)) {
        s->rest_ticks += (s->rest_ticks < 50u) ? 1u : 0u;
        s->quiet_ticks += (s->quiet_ticks < 101u) ? 1u : 0u;
        s->moved_ticks += ((s->moved_ticks > 0u) && (s->moved_ticks < 4000u)) ? 1u : 0u;
    } else {
        s->rest_ticks = 0u;
        s->quiet_ticks = 0u;
        s->moved_ticks += (s->moved_ticks < 4000u) ? 1u : 0u;
    }
    s->command = command;
}

/* Take a reading in range, scaled to order 1; another holds the last and disturbs two delays. */
static void adaptive_robot_read_vibration(adaptive_robot_adaptive_t *s, adaptive_robot_number_t vibration)
{
    if (adaptive_robot_magnitude_of(vibration) <= adaptive_robot_MAX_VIBRATION) {
        s->vibration = vibration * adaptive_robot_PER_SCALE;
    } else {
        s->quiet_ticks = 0u;
        s->status |= ADAPTIVE_ROBOT_ADAPTIVE_VIBRATION_INVALID;
    }
}

/* The reference; coefficients change where they do not matter. */
static adaptive_robot_number_t adaptive_robot_shape(adaptive_robot_adaptive_t *s, bool enable, uint32_t first, uint32_t second)
{
    const bool settled = s->rest_ticks >= 50u;
    adaptive_robot_number_t reference = s->command;
    uint32_t n;
    if (settled) {
        s->shaping = enable && s->learned && (s->moved_ticks >= 4000u);
        for (n = 0u; n < 3u; ++n) {
            s->used[n] = s->coefficient[n];
        }
    }
    if (!s->shaping) {
        s->status |= ADAPTIVE_ROBOT_ADAPTIVE_UNSHAPED;
    } else if (!settled) {
        reference = ((s->used[0] * s->command) + (s->used[1] * s->commands[first]))
            + (s->used[2] * s->commands[second]);
    } else {
        /* the command itself */
    }
    return reference;
}

/* Learn from this tick if all samples of two delays are free vibration. */
static bool adaptive_robot_learn(adaptive_robot_adaptive_t *s, bool enable, uint32_t first, uint32_t second)
{
    const bool adapting = enable && (s->quiet_ticks >= 101u);
    bool ends = !adapting;
    if (adapting) {
        adaptive_robot_add_sample(&s->window, s->vibration, s->vibrations[first], s->vibrations[second]);
        s->window_ticks += 1u;
        if (s->window_ticks >= 200u) {
            adaptive_robot_judge(s);
            ends = true;
        }
    }
    if (ends) {
        s->window = adaptive_robot_NOTHING;
        s->window_ticks = 0u;
    }
    return adapting;
}

void adaptive_robot_adaptive_step(adaptive_robot_adaptive_t *shaper, const adaptive_robot_adaptive_input_t *input,
    adaptive_robot_adaptive_output_t *output)
{
    adaptive_robot_adaptive_t *const s = shaper;
    uint32_t head;
    uint32_t first;
    uint32_t second;
    uint32_t n;
    s->status = input->enable ? 0u : ADAPTIVE_ROBOT_ADAPTIVE_DISABLED;
    adaptive_robot_read_command(s, input->command);
    adaptive_robot_read_vibration(s, input->vibration);
    head = (s->head >= (ADAPTIVE_ROBOT_ADAPTIVE_RING - 1u)) ? 0u : (s->head + 1u);
    s->commands[head] = s->command;
    s->vibrations[head] = s->vibration;
    s->head = head;
    first = (head >= ADAPTIVE_ROBOT_ADAPTIVE_DELAY) ? (head - ADAPTIVE_ROBOT_ADAPTIVE_DELAY)
        : (head + (ADAPTIVE_ROBOT_ADAPTIVE_RING - ADAPTIVE_ROBOT_ADAPTIVE_DELAY));
    second = (head >= (ADAPTIVE_ROBOT_ADAPTIVE_RING - 1u)) ? 0u : (head + 1u);
    output->reference = adaptive_robot_shape(s, input->enable, first, second);
    output->adapting = adaptive_robot_learn(s, input->enable, first, second);
    s->status |= output->adapting ? ADAPTIVE_ROBOT_ADAPTIVE_ADAPTING : 0u;
    s->status |= s->converged ? ADAPTIVE_ROBOT_ADAPTIVE_CONVERGED : 0u;
    s->status |= s->frozen ? ADAPTIVE_ROBOT_ADAPTIVE_FROZEN : 0u;
    s->status |= s->again ? ADAPTIVE_ROBOT_ADAPTIVE_LEARNING_AGAIN : 0u;
    s->status |= s->refused ? ADAPTIVE_ROBOT_ADAPTIVE_SET_REFUSED : 0u;
    for (n = 0u; n < 3u; ++n) {
        output->coefficient[n] = s->coefficient[n];
    }
    output->converged = s->converged;
    output->frozen = s->frozen;
    output->status = s->status;
}
