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
 * A constant offset of the measurement does no harm; remove hum before.
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
static const adaptive_robot_number_t adaptive_robot_MOST_NEGATIVE = 0.0; /* largest sum of negative coefficients; positive ones sum to 1 more */
static const adaptive_robot_number_t adaptive_robot_DEAD_ZONE = 0.0006; /* sum of squares of a window that teaches nothing */
static const adaptive_robot_number_t adaptive_robot_WHITE_AT_FIRST = 1.0e-07; /* inverse of P(0) */
static const adaptive_robot_number_t adaptive_robot_LEAST_DETERMINANT = 6.103515625e-05; /* below it samples do not tell, relative */
static const adaptive_robot_number_t adaptive_robot_NOISE_FACTOR = 12.0; /* energy of a window that teaches, by its noise */
static const adaptive_robot_number_t adaptive_robot_MISFIT_FACTOR = 4.0; /* what is left by coefficients that misfit, by noise */
static const adaptive_robot_number_t adaptive_robot_MISFIT_RATIO = 0.0001; /* and by energy */
static const adaptive_robot_number_t adaptive_robot_RECENT = 0.875; /* weight of the past in the slower test */
static const adaptive_robot_number_t adaptive_robot_SIGNIFICANCE = 32.0; /* of the slower test */
static const adaptive_robot_number_t adaptive_robot_PAST_WINDOWS = 63.0; /* windows like the present one that the past is worth */
static const adaptive_robot_number_t adaptive_robot_ROUGHNESS = 1.0e-11; /* power of rounding by energy around coefficients that misfit */
static const adaptive_robot_number_t adaptive_robot_CONVERGED = 0.01; /* largest change of a coefficient that has converged */
static const adaptive_robot_number_t adaptive_robot_ANCHOR = 1.0; /* rounds a coefficient to the lattice */
static const adaptive_robot_number_t adaptive_robot_WINDOW = 200.0; /* samples of a window */
static const adaptive_robot_number_t adaptive_robot_FIRST_OUTER = 0.33333333333333326; /* first and last coefficient at first */
static const adaptive_robot_number_t adaptive_robot_FIRST_MIDDLE = 0.3333333333333335; /* the middle one, which takes the rest */

static const adaptive_robot_adaptive_sums_t adaptive_robot_NOTHING = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };

static adaptive_robot_number_t adaptive_robot_magnitude_of(adaptive_robot_number_t value)
{
    return (value < 0.0) ? -value : value;
}

/* Sum of squares: what white noise of power 1 is made by these coefficients. */
static adaptive_robot_number_t adaptive_robot_squared_size(const adaptive_robot_number_t c[3])
{
    return ((c[0] * c[0]) + (c[1] * c[1])) + (c[2] * c[2]);
}

/* Add white noise of this power to each of the three samples; a negative power takes it away. */
static adaptive_robot_adaptive_sums_t adaptive_robot_with_white(const adaptive_robot_adaptive_sums_t *sums, const adaptive_robot_number_t c[3],
    adaptive_robot_number_t power)
{
    adaptive_robot_adaptive_sums_t all = *sums;
    const adaptive_robot_number_t twice = power + power;
    all.ee = sums->ee + (adaptive_robot_squared_size(c) * power);
    all.eu = sums->eu + ((c[0] - c[1]) * power);
    all.ew = sums->ew + ((c[2] - c[1]) * power);
    all.uu = sums->uu + twice;
    all.uw = sums->uw + power;
    all.ww = sums->ww + twice;
    return all;
}

/* Add what coefficients leave of one sample and those of one and two delays ago. */
static void adaptive_robot_add_sample(adaptive_robot_adaptive_t *s, adaptive_robot_number_t v0, adaptive_robot_number_t v1, adaptive_robot_number_t v2)
{
    const adaptive_robot_number_t *const c = s->coefficient;
    adaptive_robot_adaptive_sums_t *const sums = &s->window;
    const adaptive_robot_number_t u = v0 - v1;
    const adaptive_robot_number_t w = v2 - v1;
    const adaptive_robot_number_t e = v1 + ((c[0] * u) + (c[2] * w));
    sums->ee = sums->ee + (e * e);
    sums->eu = sums->eu + (e * u);
    sums->ew = sums->ew + (e * w);
    sums->uu = sums->uu + (u * u);
    sums->uw = sums->uw + (u * w);
    sums->ww = sums->ww + (w * w);
    s->sum_e = s->sum_e + e;
    s->sum_u = s->sum_u + u;
    s->sum_w = s->sum_w + w;
}

/* Take the means out of the window: a constant offset of the measurement leaves nothing. */
static void adaptive_robot_take_means(adaptive_robot_adaptive_t *s)
{
    adaptive_robot_adaptive_sums_t *const sums = &s->window;
    const adaptive_robot_number_t e = s->sum_e / adaptive_robot_WINDOW;
    const adaptive_robot_number_t u = s->sum_u / adaptive_robot_WINDOW;
    const adaptive_robot_number_t w = s->sum_w / adaptive_robot_WINDOW;
    sums->ee = sums->ee - (e * s->sum_e);
    sums->eu = sums->eu - (e * s->sum_u);
    sums->ew = sums->ew - (e * s->sum_w);
    sums->uu = sums->uu - (u * s->sum_u);
    sums->uw = sums->uw - (u * s->sum_w);
    sums->ww = sums->ww - (w * s->sum_w);
}

/* Sums around other coefficients: d0 more of the first, d2 more of the last. */
static adaptive_robot_adaptive_sums_t adaptive_robot_moved(const adaptive_robot_adaptive_sums_t *s, adaptive_robot_number_t d0, adaptive_robot_number_t d2)
{
    adaptive_robot_adaptive_sums_t all = *s;
    all.eu = (s->eu + (d0 * s->uu)) + (d2 * s->uw);
    all.ew = (s->ew + (d0 * s->uw)) + (d2 * s->ww);
    all.ee = ((s->ee + (d0 * s->eu)) + (d2 * s->ew)) + ((d0 * all.eu) + (d2 * all.ew));
    return all;
}

/* Sums of products of v1 itself in the place of what the coefficients leave. */
static adaptive_robot_adaptive_sums_t adaptive_robot_plain(const adaptive_robot_adaptive_sums_t *s, const adaptive_robot_number_t c[3])
{
    return adaptive_robot_moved(s, -c[0], -c[2]);
}

/* Sum of v0 v0 + v1 v1 + v2 v2 of plain sums. */
static adaptive_robot_number_t adaptive_robot_energy_of(const adaptive_robot_adaptive_sums_t *s)
{
    return (((3.0 * s->ee) + (2.0 * (s->eu + s->ew))) + s->uu) + s->ww;
}

/* What to add to the first and last coefficient to leave least, eq 16; false if the samples do not tell. */
static bool adaptive_robot_correction(const adaptive_robot_adaptive_sums_t *s, adaptive_robot_number_t *d0, adaptive_robot_number_t *d2)
{
    const adaptive_robot_number_t product = s->uu * s->ww;
    const adaptive_robot_number_t determinant = product - (s->uw * s->uw);
    const bool tells = (s->uu > 0.0) && (s->ww > 0.0)
        && (determinant > (adaptive_robot_LEAST_DETERMINANT * product));
    if (tells) {
        *d0 = ((s->uw * s->ew) - (s->ww * s->eu)) / determinant;
        *d2 = ((s->uw * s->eu) - (s->uu * s->ew)) / determinant;
    }
    return tells;
}

/* Sum of the principal minors of the matrix of the samples, from plain sums. */
static adaptive_robot_number_t adaptive_robot_principal_minors(const adaptive_robot_adaptive_sums_t *s)
{
    const adaptive_robot_number_t first = (s->ee + (s->eu + s->eu)) + s->uu;
    const adaptive_robot_number_t last = (s->ee + (s->ew + s->ew)) + s->ww;
    const adaptive_robot_number_t across = ((s->ee + s->eu) + s->ew) + s->uw;
    const adaptive_robot_number_t middle = ((s->uu * s->ee) - (s->eu * s->eu)) + ((s->ww * s->ee) - (s->ew * s->ew));
    return middle + ((first * last) - (across * across));
}

/* The determinant of that matrix: the same around any coefficients. */
static adaptive_robot_number_t adaptive_robot_determinant(const adaptive_robot_adaptive_sums_t *s)
{
    return ((s->ee * ((s->uu * s->ww) - (s->uw * s->uw))) - (s->eu * ((s->eu * s->ww) - (s->uw * s->ew))))
        + (s->ew * ((s->eu * s->uw) - (s->uu * s->ew)));
}

/* The least eigenvalue of that matrix, by Newton's method from below: what one vibration cannot explain. */
static adaptive_robot_number_t adaptive_robot_noise_power(const adaptive_robot_adaptive_sums_t *around, const adaptive_robot_adaptive_sums_t *plain)
{
    const adaptive_robot_number_t trace = adaptive_robot_energy_of(plain);
    const adaptive_robot_number_t minors = adaptive_robot_principal_minors(plain);
    const adaptive_robot_number_t determinant = adaptive_robot_determinant(around);
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

/* Drop the window: samples are missing, or what shapes the moves is another. */
static void adaptive_robot_interrupt(adaptive_robot_adaptive_t *s)
{
    s->window = adaptive_robot_NOTHING;
    s->sum_e = 0.0;
    s->sum_u = 0.0;
    s->sum_w = 0.0;
    s->window_ticks = 0u;
    s->fresh = false;
}

/* Know nothing of the past: P(0). */
static void adaptive_robot_forget_past(adaptive_robot_adaptive_t *s)
{
    s->past = adaptive_robot_with_white(&adaptive_robot_NOTHING, s->coefficient, adaptive_robot_WHITE_AT_FIRST);
}

static void adaptive_robot_forget_misfit(adaptive_robot_adaptive_t *s)
{
    s->left = 0.0;
    s->noise = 0.0;
    s->samples = 0.0;
}

/* Whether coefficients that were learned leave far more of the window than its noise. */
static bool adaptive_robot_misfits(const adaptive_robot_adaptive_t *s, adaptive_robot_number_t energy, adaptive_robot_number_t noise)
{
    const adaptive_robot_number_t allowed = adaptive_robot_MISFIT_RATIO * energy;
    const adaptive_robot_number_t most = ((adaptive_robot_MISFIT_FACTOR * noise) * adaptive_robot_squared_size(s->coefficient)) + allowed;
    return s->learned && (s->window.ee > most);
}

/* Whether recent windows together leave more than noise, by four standard deviations. */
static bool adaptive_robot_misfits_slowly(adaptive_robot_adaptive_t *s, adaptive_robot_number_t energy, adaptive_robot_number_t noise)
{
    bool slowly = false;
    if (s->learned) {
        const adaptive_robot_number_t left = s->window.ee - (adaptive_robot_MISFIT_RATIO * energy);
        adaptive_robot_number_t excess;
        s->left = (adaptive_robot_RECENT * s->left) + (left / adaptive_robot_squared_size(s->coefficient));
        s->noise = (adaptive_robot_RECENT * s->noise) + noise;
        s->samples = (adaptive_robot_RECENT * s->samples) + adaptive_robot_WINDOW;
        excess = s->left - s->noise;
        slowly = (excess > 0.0)
            && (((excess * excess) * s->samples) > (adaptive_robot_SIGNIFICANCE * (s->noise * s->noise)));
    }
    return slowly;
}

/* How much the past still counts beside a window: less if the coefficients do not fit, nothing if they misfit. */
static adaptive_robot_number_t adaptive_robot_past_weight(adaptive_robot_adaptive_t *s, adaptive_robot_number_t energy, adaptive_robot_number_t noise,
    bool misfits)
{
    const bool was_rough = s->rough;
    const adaptive_robot_number_t rough = noise / adaptive_robot_ROUGHNESS;
    adaptive_robot_number_t windows = s->again ? energy : (adaptive_robot_PAST_WINDOWS * energy);
    adaptive_robot_adaptive_sums_t plain;
    adaptive_robot_number_t past;
    s->rough = misfits || (!s->learned);
    if (misfits) {
        adaptive_robot_forget_misfit(s);
        adaptive_robot_forget_past(s);
    }
    if (was_rough && (rough < windows)) {
        windows = rough;
    }
    plain = adaptive_robot_plain(&s->past, s->coefficient);
    past = adaptive_robot_energy_of(&plain);
    return (past > windows) ? (windows / past) : 1.0;
}

/* Round a value below the anchor to a multiple of the step there; others are such multiples. */
static adaptive_robot_number_t adaptive_robot_rounded(adaptive_robot_number_t value)
{
    adaptive_robot_number_t size = adaptive_robot_magnitude_of(value);
    if (size < adaptive_robot_ANCHOR) {
        size = (size + adaptive_robot_ANCHOR) - adaptive_robot_ANCHOR;
    }
    return (value < 0.0) ? -size : size;
}

static adaptive_robot_number_t adaptive_robot_below(adaptive_robot_number_t value)
{
    return (value < 0.0) ? -value : 0.0;
}

/* Correct the coefficients, unless that asks too much of the drive; the middle one takes the rest to exactly 1. */
static void adaptive_robot_adopt(adaptive_robot_adaptive_t *s)
{
    adaptive_robot_number_t d0 = 0.0;
    adaptive_robot_number_t d2 = 0.0;
    const bool tells = adaptive_robot_correction(&s->past, &d0, &d2);
    const adaptive_robot_number_t c0 = adaptive_robot_rounded(s->coefficient[0] + d0);
    const adaptive_robot_number_t c2 = adaptive_robot_rounded(s->coefficient[2] + d2);
    const adaptive_robot_number_t c1 = 1.0 - (c0 + c2);
    s->refused = !(tells && (((adaptive_robot_below(c0) + adaptive_robot_below(c1)) + adaptive_robot_below(c2)) <= adaptive_robot_MOST_NEGATIVE));
    if (s->refused) {
        s->converged = false;
    } else {
        const adaptive_robot_number_t d1 = c1 - s->coefficient[1];
        d0 = c0 - s->coefficient[0];
        d2 = c2 - s->coefficient[2];
        s->converged = s->learned && (!s->again) && (adaptive_robot_magnitude_of(d0) <= adaptive_robot_CONVERGED)
            && (adaptive_robot_magnitude_of(d1) <= adaptive_robot_CONVERGED) && (adaptive_robot_magnitude_of(d2) <= adaptive_robot_CONVERGED);
        s->past = adaptive_robot_moved(&s->past, d0, d2);
        s->coefficient[0] = c0;
        s->coefficient[1] = c1;
        s->coefficient[2] = c2;
        s->learned = true;
    }
}

/* Add the window, its noise taken out, to the past, and take new coefficients from both. */
static void adaptive_robot_teach(adaptive_robot_adaptive_t *s, adaptive_robot_number_t energy, adaptive_robot_number_t noise, bool misfits)
{
    const adaptive_robot_number_t weight = adaptive_robot_past_weight(s, energy, noise, misfits);
    const adaptive_robot_adaptive_sums_t seen = adaptive_robot_with_white(&s->window, s->coefficient, -noise);
    s->past.ee = (weight * s->past.ee) + seen.ee;
    s->past.eu = (weight * s->past.eu) + seen.eu;
    s->past.ew = (weight * s->past.ew) + seen.ew;
    s->past.uu = (weight * s->past.uu) + seen.uu;
    s->past.uw = (weight * s->past.uw) + seen.uw;
    s->past.ww = (weight * s->past.ww) + seen.ww;
    adaptive_robot_adopt(s);
}

/* Learn from a complete window, or find that there is nothing to learn from. */
static void adaptive_robot_judge(adaptive_robot_adaptive_t *s)
{
    const adaptive_robot_adaptive_sums_t plain = adaptive_robot_plain(&s->window, s->coefficient);
    const adaptive_robot_number_t energy = adaptive_robot_energy_of(&plain);
    const adaptive_robot_number_t noise = adaptive_robot_noise_power(&s->window, &plain);
    s->frozen = !((energy > adaptive_robot_DEAD_ZONE) && (energy > (adaptive_robot_NOISE_FACTOR * noise)));
    if (!s->frozen) {
        const bool misfits = adaptive_robot_misfits(s, energy, noise);
        s->again = misfits ? true : adaptive_robot_misfits_slowly(s, energy, noise);
        if (s->again && s->trusted) {
            s->converged = false; /* one rest's word against a set that had converged: the next one decides */
        } else {
            adaptive_robot_teach(s, energy, noise, misfits);
        }
    } else if (s->shaping && s->fresh) {
        s->converged = true;
        s->again = false;
        s->refused = false;
    } else {
        /* as it was: what is left had time to sink into noise, or was not shaped */
    }
}

/* Learn from this tick if all samples of two delays are free vibration. */
static bool adaptive_robot_learn(adaptive_robot_adaptive_t *s, bool enable, uint32_t first, uint32_t second)
{
    const bool adapting = enable && (s->quiet_ticks >= 101u);
    if (adapting) {
        adaptive_robot_add_sample(s, s->vibration, s->vibrations[first], s->vibrations[second]);
        s->window_ticks += 1u;
        if (s->window_ticks >= 200u) {
            adaptive_robot_take_means(s);
            adaptive_robot_judge(s);
            adaptive_robot_interrupt(s);
        }
    } else if (!enable) {
        adaptive_robot_interrupt(s);
    } else {
        /* wait until it is quiet */
    }
    return adapting;
}

void adaptive_robot_adaptive_init(adaptive_robot_adaptive_t *shaper)
{
    uint32_t n;
    for (n = 0u; n < ADAPTIVE_ROBOT_ADAPTIVE_RING; ++n) {
        shaper->commands[n] = 0.0;
        shaper->vibrations[n] = 0.0;
    }
    shaper->coefficient[0] = adaptive_robot_FIRST_OUTER;
    shaper->coefficient[1] = adaptive_robot_FIRST_MIDDLE;
    shaper->coefficient[2] = adaptive_robot_FIRST_OUTER;
    adaptive_robot_forget_past(shaper);
    adaptive_robot_interrupt(shaper);
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
    shaper->status = 0u;
    shaper->shaping = false;
    shaper->learned = false;
    shaper->converged = false;
    shaper->frozen = false;
    shaper->again = false;
    shaper->rough = false;
    shaper->refused = false;
    shaper->trusted = false;
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
        s->moved_ticks += ((s->moved_ticks > 0u) && (s->moved_ticks != 4000u)) ? 1u : 0u;
    } else {
        s->rest_ticks = 0u;
        s->quiet_ticks = 0u;
        /* A window may go on from rest to rest, as long as it holds beginnings of rests and nothing else. */
        if (!s->fresh) {
            adaptive_robot_interrupt(s);
        }
        s->fresh = true;
        s->trusted = s->converged;
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
        adaptive_robot_interrupt(s);
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
        const bool shaping = enable && s->learned && (s->moved_ticks >= 4000u);
        if (shaping != s->shaping) {
            adaptive_robot_interrupt(s);
        }
        s->shaping = shaping;
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
    output->adapting = adaptive_robot_learn(s, input->enable, first, second);
    output->reference = adaptive_robot_shape(s, input->enable, first, second);
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
