/*
 * time_optimal_oscillator: motion profile. It plays a move computed ahead, from any start to any target.
 *
 * Made by swayless 0.1.0 from time-optimal-oscillator.toml.
 * This file is yours: use, change and ship it as you like.
 *
 * Tick 0.005 s. A move takes 58 ticks, 0.29 s, however far it goes.
 * At most 51 ticks after an abort the plant rests: by a stop, or by the end of the move where that is sooner.
 * References from -5 to 5; a move that could need more is refused.
 * Design: 0 to 1, robust of order 1, zero-order hold; SHA-256:
 * eca898c3ac4f7daedf2814ab554507868d843acaab0b832fcc57d06180e6d57c
 * Proved with these numbers: the move of the design leaves at most
 * 1e-12 of each state's largest, an abort at any tick of it 1e-12.
 * Another start or travel T adds at most 1.4e-15 R / |T|, R its largest reference.
 * Limits are kept. A stop rests at 0 to 0.377 of the travel.
 * Each move is that of the design, to scale: reference = hold_ratio * start + travel * shape,
 * position = start + travel * position of a model of the plant, with travel = target - start.
 * Memory: 216 bytes of state at most, 1540 of tables.
 *
 * Call it once per tick. The plant rests when a move starts: what swings then swings on.
 * NOT A SAFETY FUNCTION: limit switches, emergency stop and brakes must work without this block.
 * Nothing may limit, ramp or filter the reference on its way to the drive: the move is exact.
 */
#include "time_optimal_oscillator_profile.h"

typedef double time_optimal_oscillator_number_t;

#define TIME_OPTIMAL_OSCILLATOR_COLUMNS (TIME_OPTIMAL_OSCILLATOR_PROFILE_STATES + 1u)
#define TIME_OPTIMAL_OSCILLATOR_MOVE_PIECES (7u)
#define TIME_OPTIMAL_OSCILLATOR_MOVE_TERMS (1u)
#define TIME_OPTIMAL_OSCILLATOR_STOP_PIECES (3u)
#define TIME_OPTIMAL_OSCILLATOR_STOP_TERMS (10u)

/* Does not compile when the state is larger than the header says. */
typedef char time_optimal_oscillator_profile_ram_check[(sizeof(time_optimal_oscillator_profile_t) <= TIME_OPTIMAL_OSCILLATOR_PROFILE_RAM) ? 1 : -1];

static const time_optimal_oscillator_number_t time_optimal_oscillator_HOLD_RATIO = 1.0; /* reference that holds the plant, per unit of position: 1 / G(0) */
static const time_optimal_oscillator_number_t time_optimal_oscillator_LOWEST = -5.0; /* limit of the design */
static const time_optimal_oscillator_number_t time_optimal_oscillator_HIGHEST = 5.0; /* limit of the design */
static const time_optimal_oscillator_number_t time_optimal_oscillator_MAX_TRAVEL = 1125899906842624.0; /* longest travel: no rate is limited */
static const time_optimal_oscillator_number_t time_optimal_oscillator_LARGEST_POSITION = 1125899906842624.0; /* beyond it sums lose their meaning */
static const time_optimal_oscillator_number_t time_optimal_oscillator_SHAPE_LOW = -4.68262935681; /* least of the table and of every stop of it */
static const time_optimal_oscillator_number_t time_optimal_oscillator_SHAPE_HIGH = 4.68262935681; /* largest of the same */
static const time_optimal_oscillator_number_t time_optimal_oscillator_REST_LOW = 0.0; /* least share of the travel at which a stop rests */
static const time_optimal_oscillator_number_t time_optimal_oscillator_REST_HIGH = 0.37608336920934665; /* largest of the same */
static const time_optimal_oscillator_number_t time_optimal_oscillator_FIRST_POSITION = 0.0; /* held before any start was good */

/* Shape of a move by 1: input less what held the plant, from switch to switch. */
static const time_optimal_oscillator_number_t time_optimal_oscillator_MOVE_SHAPES[7] = {
    4.68262935681, /* ticks 0 to 9, 0 s */
    2.23220275509, /* tick 10, 0.05 s */
    -4.68262935681, /* ticks 11 to 27, 0.055 s */
    3.57512160339, /* tick 28, 0.14 s */
    4.68262935681, /* ticks 29 to 48, 0.145 s */
    -0.475168191241, /* tick 49, 0.245 s */
    -4.68262935681 /* ticks 50 to 57, 0.25 s */
};

/* Ticks of each piece. */
static const uint16_t time_optimal_oscillator_MOVE_LENGTHS[7] = {
    10u, /* ticks 0 to 9, 0 s */
    1u, /* tick 10, 0.05 s */
    17u, /* ticks 11 to 27, 0.055 s */
    1u, /* tick 28, 0.14 s */
    20u, /* ticks 29 to 48, 0.145 s */
    1u, /* tick 49, 0.245 s */
    8u /* ticks 50 to 57, 0.25 s */
};

/* Plant of the design, sampled: what a tick adds to each state, and the position; of states and shape. */
static const time_optimal_oscillator_number_t time_optimal_oscillator_PLANT[25] = {
    /* change of state 0 */
    -0.0012497396050337173, -0.031236980794173953, 0.0, 0.0, 0.01999166770827133,
    /* change of state 1 */
    0.07996667083308534, -0.0012497396050337173, 0.0, 0.0, 0.0007998333472216023,
    /* change of state 2 */
    0.06242189127468542, -0.001952311299635873, -0.0012497396050337173, -0.04997916927067833, 0.0006246094292500818,
    /* change of state 3 */
    0.003123698079417397, 0.03901368204667838, 0.04997916927067834, -0.0012497396050337173, 2.0828125465008243e-05,
    /* position */
    0.0, 1.5625, 0.0, 0.0, 0.0
};

/* Shape of a stop, of the states and the last shape before it, in polynomials of degree 9, highest power first. */
static const time_optimal_oscillator_number_t time_optimal_oscillator_STOP_GAINS[150] = {
    /* ticks 0 to 18, 0 s, power 9 */
    6.608225200985536e-08, 3.452793870216483e-08, 4.419565636272261e-08, 1.1429838578096428e-08, 0.0,
    /* ticks 0 to 18, 0 s, power 8 */
    1.0197819462758675e-06, 5.487422884171591e-07, 7.023902421181657e-07, 4.019375153203604e-07, 0.0,
    /* ticks 0 to 18, 0 s, power 7 */
    -1.9284887045761897e-05, -9.988829997517543e-06, -1.278570216682933e-05, -3.3369114144357183e-06, 0.0,
    /* ticks 0 to 18, 0 s, power 6 */
    -0.00020334986708271926, -0.0001129395217234374, -0.00014456258803033633, -8.236753788343346e-05, 0.0,
    /* ticks 0 to 18, 0 s, power 5 */
    0.0030987664058323553, 0.0015827119319276992, 0.0020258712727021823, 0.0005365280196792582, 0.0,
    /* ticks 0 to 18, 0 s, power 4 */
    0.018180810868037668, 0.010828087426758002, 0.013859951906391594, 0.007825100039811891, 0.0,
    /* ticks 0 to 18, 0 s, power 3 */
    -0.2170500302406765, -0.10801266436149448, -0.13825621038266644, -0.0376240316410481, 0.0,
    /* ticks 0 to 18, 0 s, power 2 */
    -0.36947173818976287, -0.29178838080131947, -0.3734891274257209, -0.20428210440631253, 0.0,
    /* ticks 0 to 18, 0 s, power 1 */
    3.7940457321357832, 1.7691286969976412, 2.264484732156978, 0.6594856051957004, 0.0,
    /* ticks 0 to 18, 0 s, power 0 */
    -2.953873527903017, 0.719873529814342, -1.0785618818376417, 0.5673785067021542, 0.0,
    /* ticks 19 to 36, 0.095 s, power 9 */
    -9.157819475054771e-09, -5.052989014337448e-09, -6.4678674372510585e-09, -8.113587154119535e-09, 0.0,
    /* ticks 19 to 36, 0.095 s, power 8 */
    9.704582255764712e-07, 5.146665054840084e-07, 6.587729341967148e-07, 2.407242848246986e-07, 0.0,
    /* ticks 19 to 36, 0.095 s, power 7 */
    2.648310364510271e-06, 1.6044588234472208e-06, 2.053707375799898e-06, 2.5368166933072094e-06, 0.0,
    /* ticks 19 to 36, 0.095 s, power 6 */
    -0.00022993503210243252, -0.00012270634519691493, -0.00015706412141443246, -5.585142929463196e-05, 0.0,
    /* ticks 19 to 36, 0.095 s, power 5 */
    -0.00037814303439724514, -0.00027538522631216763, -0.0003524930897339842, -0.0004238026875147712, 0.0,
    /* ticks 19 to 36, 0.095 s, power 4 */
    0.02610859323014528, 0.01410069431931592, 0.018048888728392987, 0.006081889474646889, 0.0,
    /* ticks 19 to 36, 0.095 s, power 3 */
    0.015554249895210502, 0.019674625851302377, 0.02518352108968205, 0.02853652588666638, 0.0,
    /* ticks 19 to 36, 0.095 s, power 2 */
    -0.9318633080725232, -0.5195741233975714, -0.6650548779487983, -0.19181502968891564, 0.0,
    /* ticks 19 to 36, 0.095 s, power 1 */
    0.35749241658809805, -0.2942040849354287, -0.3765812287173522, -0.33705636149121015, 0.0,
    /* ticks 19 to 36, 0.095 s, power 0 */
    1.8190508631334203, 2.4269183840893866, 1.1064555316344051, 0.8858516344093076, 0.0,
    /* ticks 37 to 50, 0.185 s, power 9 */
    -4.085054496355516e-09, -2.1797715460986815e-09, -2.7899543373556845e-09, -1.3587720032668897e-09, 0.0,
    /* ticks 37 to 50, 0.185 s, power 8 */
    5.5626012648029176e-08, 2.917391549596788e-08, 3.734265406671815e-08, 3.50169458720756e-09, 0.0,
    /* ticks 37 to 50, 0.185 s, power 7 */
    2.1992026328552753e-06, 1.1935098251361144e-06, 1.5276922329123044e-06, 7.247411908886581e-07, 0.0,
    /* ticks 37 to 50, 0.185 s, power 6 */
    -2.1873222414650908e-05, -1.1246022103226181e-05, -1.4394908394991308e-05, -8.720828249394415e-07, 0.0,
    /* ticks 37 to 50, 0.185 s, power 5 */
    -0.0006385294033301315, -0.0003566463254548648, -0.0004565072963192069, -0.0002069849476799034, 0.0,
    /* ticks 37 to 50, 0.185 s, power 4 */
    0.004019935191173103, 0.0019799188257907732, 0.0025342960970903897, -3.411629972685784e-05, 0.0,
    /* ticks 37 to 50, 0.185 s, power 3 */
    0.07622796239228563, 0.04519979591884656, 0.05785573877604535, 0.02381772548266148, 0.0,
    /* ticks 37 to 50, 0.185 s, power 2 */
    -0.207600219246437, -0.08698830799529038, -0.11134503423399002, 0.035892420241806146, 0.0,
    /* ticks 37 to 50, 0.185 s, power 1 */
    -1.7922432170564764, -1.2990632677215264, -1.6628009826835455, -0.4796043310847863, 0.0,
    /* ticks 37 to 50, 0.185 s, power 0 */
    -0.39711740410298163, 0.32863930035470573, -1.579341695545981, -0.1738239978959645, 0.0
};

/* Ticks of each piece. */
static const uint16_t time_optimal_oscillator_STOP_LENGTHS[3] = {
    19u, /* ticks 0 to 18, 0 s */
    18u, /* ticks 19 to 36, 0.095 s */
    14u /* ticks 37 to 50, 0.185 s */
};

/* Step of a piece's own variable, which goes from -1 to 1: 2 over one tick less than it has. */
static const time_optimal_oscillator_number_t time_optimal_oscillator_STOP_STEPS[3] = {
    0.1111111111111111, /* ticks 0 to 18, 0 s */
    0.11764705882352941, /* ticks 19 to 36, 0.095 s */
    0.15384615384615385 /* ticks 37 to 50, 0.185 s */
};

/* Where a stop comes to rest, of the same. */
static const time_optimal_oscillator_number_t time_optimal_oscillator_STOP_REST[5] = {
    0.38872426652052533, 1.2935796138262345, -0.3442180943024236, 1.1120251147261107, 0.0 /* share of the travel */
};

/* Sum of the products of a table's row with the states and the shape. */
static time_optimal_oscillator_number_t time_optimal_oscillator_row_by(const time_optimal_oscillator_number_t *row, const time_optimal_oscillator_number_t *values)
{
    time_optimal_oscillator_number_t sum = row[0] * values[0];
    uint32_t column;
    for (column = 1u; column < TIME_OPTIMAL_OSCILLATOR_COLUMNS; ++column) {
        sum = sum + (row[column] * values[column]);
    }
    return sum;
}

/* Value of a polynomial, its highest power first, at a tick of its piece. */
static time_optimal_oscillator_number_t time_optimal_oscillator_polynomial(const time_optimal_oscillator_number_t *term, uint32_t terms, uint32_t tick, time_optimal_oscillator_number_t step)
{
    const time_optimal_oscillator_number_t local = ((time_optimal_oscillator_number_t)tick * step) - 1.0;
    time_optimal_oscillator_number_t value = term[0];
    uint32_t power;
    for (power = 1u; power < terms; ++power) {
        value = (value * local) + term[power];
    }
    return value;
}

/* Go on to the next tick, and behind the last of a piece to the next piece. */
static void time_optimal_oscillator_pass(time_optimal_oscillator_profile_t *p, uint32_t length)
{
    p->piece_tick += 1u;
    if (p->piece_tick >= length) {
        p->piece_tick = 0u;
        p->piece += 1u;
    }
}

/* Shape of this tick of the move. */
static time_optimal_oscillator_number_t time_optimal_oscillator_next_of_move(time_optimal_oscillator_profile_t *p)
{
    const time_optimal_oscillator_number_t *term = &time_optimal_oscillator_MOVE_SHAPES[p->piece * TIME_OPTIMAL_OSCILLATOR_MOVE_TERMS];
    const time_optimal_oscillator_number_t shape = *term;
    time_optimal_oscillator_pass(p, time_optimal_oscillator_MOVE_LENGTHS[p->piece]);
    p->left -= 1u;
    return shape;
}

/* Shape of this tick of the stop. */
static time_optimal_oscillator_number_t time_optimal_oscillator_next_of_stop(time_optimal_oscillator_profile_t *p)
{
    time_optimal_oscillator_number_t shape;
    uint32_t term;
    if (p->piece_tick == 0u) {
        const time_optimal_oscillator_number_t *gains = &time_optimal_oscillator_STOP_GAINS[(p->piece * TIME_OPTIMAL_OSCILLATOR_STOP_TERMS) * TIME_OPTIMAL_OSCILLATOR_COLUMNS];
        for (term = 0u; term < TIME_OPTIMAL_OSCILLATOR_STOP_TERMS; ++term) {
            p->stop_terms[term] = time_optimal_oscillator_row_by(&gains[term * TIME_OPTIMAL_OSCILLATOR_COLUMNS], p->stop_from);
        }
    }
    shape = time_optimal_oscillator_polynomial(p->stop_terms, TIME_OPTIMAL_OSCILLATOR_STOP_TERMS, p->piece_tick, time_optimal_oscillator_STOP_STEPS[p->piece]);
    time_optimal_oscillator_pass(p, time_optimal_oscillator_STOP_LENGTHS[p->piece]);
    return shape;
}

/* Let the plant's model run for a tick; give its position when the tick begins. */
static time_optimal_oscillator_number_t time_optimal_oscillator_advance(time_optimal_oscillator_profile_t *p, time_optimal_oscillator_number_t shape)
{
    time_optimal_oscillator_number_t results[TIME_OPTIMAL_OSCILLATOR_COLUMNS];
    uint32_t row;
    p->plant[TIME_OPTIMAL_OSCILLATOR_PROFILE_STATES] = shape;
    for (row = 0u; row < TIME_OPTIMAL_OSCILLATOR_COLUMNS; ++row) {
        results[row] = time_optimal_oscillator_row_by(&time_optimal_oscillator_PLANT[row * TIME_OPTIMAL_OSCILLATOR_COLUMNS], p->plant);
    }
    for (row = 0u; row < TIME_OPTIMAL_OSCILLATOR_PROFILE_STATES; ++row) {
        p->plant[row] = p->plant[row] + results[row];
    }
    return results[TIME_OPTIMAL_OSCILLATOR_PROFILE_STATES];
}

/* End what is over; an abort begins a stop, unless the move is over sooner. */
static void time_optimal_oscillator_go_on(time_optimal_oscillator_profile_t *p, bool stop)
{
    uint32_t column;
    if (p->stopping) {
        if (p->piece >= TIME_OPTIMAL_OSCILLATOR_STOP_PIECES) {
            p->busy = false;
            p->aborting = false;
            p->stopping = false;
            p->aborted = true;
            p->position = p->start + (p->travel * time_optimal_oscillator_row_by(time_optimal_oscillator_STOP_REST, p->stop_from));
        }
    } else if (p->busy && (p->piece >= TIME_OPTIMAL_OSCILLATOR_MOVE_PIECES)) {
        p->busy = false;
        p->done = !p->aborting;
        p->aborted = p->aborting;
        p->aborting = false;
        p->position = p->target;
    } else if (p->busy && stop && (!p->aborting)) {
        p->aborting = true;
        p->stopping = p->left > TIME_OPTIMAL_OSCILLATOR_PROFILE_STOP_TICKS;
        if (p->stopping) {
            p->piece = 0u;
            p->piece_tick = 0u;
            for (column = 0u; column < TIME_OPTIMAL_OSCILLATOR_COLUMNS; ++column) {
                p->stop_from[column] = p->plant[column];
            }
        }
    } else {
        /* it rests, or goes on */
    }
}

/* Finite, and small enough that no sum loses its meaning; false for NaN. */
static bool time_optimal_oscillator_is_position(time_optimal_oscillator_number_t value)
{
    return (value >= -time_optimal_oscillator_LARGEST_POSITION) && (value <= time_optimal_oscillator_LARGEST_POSITION);
}

static bool time_optimal_oscillator_is_allowed(time_optimal_oscillator_number_t reference)
{
    return (reference >= time_optimal_oscillator_LOWEST) && (reference <= time_optimal_oscillator_HIGHEST);
}

/* Whether all that can be played keeps the limits: rounding is monotone, so that the extremes tell. */
static bool time_optimal_oscillator_keeps_limits(time_optimal_oscillator_number_t start, time_optimal_oscillator_number_t target, time_optimal_oscillator_number_t travel)
{
    const time_optimal_oscillator_number_t held = time_optimal_oscillator_HOLD_RATIO * start;
    return time_optimal_oscillator_is_allowed(held + (travel * time_optimal_oscillator_SHAPE_LOW)) && time_optimal_oscillator_is_allowed(held + (travel * time_optimal_oscillator_SHAPE_HIGH))
        && time_optimal_oscillator_is_allowed(time_optimal_oscillator_HOLD_RATIO * target)
        && time_optimal_oscillator_is_allowed(time_optimal_oscillator_HOLD_RATIO * (start + (travel * time_optimal_oscillator_REST_LOW)))
        && time_optimal_oscillator_is_allowed(time_optimal_oscillator_HOLD_RATIO * (start + (travel * time_optimal_oscillator_REST_HIGH)));
}

/* Every reason why a move cannot start; 0 if it can. */
static uint32_t time_optimal_oscillator_reasons(const time_optimal_oscillator_profile_t *p, const time_optimal_oscillator_profile_input_t *input)
{
    uint32_t reasons = input->abort ? TIME_OPTIMAL_OSCILLATOR_PROFILE_ABORT_HELD : 0u;
    if (!(time_optimal_oscillator_is_position(input->start) && time_optimal_oscillator_is_position(input->target))) {
        reasons |= TIME_OPTIMAL_OSCILLATOR_PROFILE_INPUT_NOT_FINITE;
    } else {
        const time_optimal_oscillator_number_t travel = input->target - input->start;
        if (!((travel >= -time_optimal_oscillator_MAX_TRAVEL) && (travel <= time_optimal_oscillator_MAX_TRAVEL))) {
            reasons |= TIME_OPTIMAL_OSCILLATOR_PROFILE_TRAVEL_TOO_LONG;
        }
        if ((input->start < p->position) || (input->start > p->position)) {
            reasons |= TIME_OPTIMAL_OSCILLATOR_PROFILE_START_ELSEWHERE;
        }
        if (!time_optimal_oscillator_keeps_limits(input->start, input->target, travel)) {
            reasons |= TIME_OPTIMAL_OSCILLATOR_PROFILE_LIMIT_EXCEEDED;
        }
    }
    return reasons;
}

/* Hold where start says, if it can: before the first move nobody else knows where the plant is. */
static uint32_t time_optimal_oscillator_follow(time_optimal_oscillator_profile_t *p, time_optimal_oscillator_number_t start)
{
    const bool good = time_optimal_oscillator_is_position(start) && time_optimal_oscillator_is_allowed(time_optimal_oscillator_HOLD_RATIO * start);
    if (good) {
        p->position = start;
    }
    return good ? 0u : TIME_OPTIMAL_OSCILLATOR_PROFILE_START_INVALID;
}

/* Start a move at rest. */
static void time_optimal_oscillator_begin(time_optimal_oscillator_profile_t *p, const time_optimal_oscillator_profile_input_t *input)
{
    uint32_t column;
    for (column = 0u; column < TIME_OPTIMAL_OSCILLATOR_COLUMNS; ++column) {
        p->plant[column] = 0.0;
    }
    p->start = input->start;
    p->target = input->target;
    p->travel = input->target - input->start;
    p->piece = 0u;
    p->piece_tick = 0u;
    p->left = TIME_OPTIMAL_OSCILLATOR_PROFILE_TICKS;
    p->placed = true;
    p->busy = true;
    p->done = false;
    p->aborted = false;
}

void time_optimal_oscillator_profile_init(time_optimal_oscillator_profile_t *profile)
{
    uint32_t column;
    for (column = 0u; column < TIME_OPTIMAL_OSCILLATOR_COLUMNS; ++column) {
        profile->plant[column] = 0.0;
        profile->stop_from[column] = 0.0;
    }
    for (column = 0u; column < TIME_OPTIMAL_OSCILLATOR_STOP_TERMS; ++column) {
        profile->stop_terms[column] = 0.0;
    }
    profile->position = time_optimal_oscillator_FIRST_POSITION;
    profile->start = 0.0;
    profile->target = 0.0;
    profile->travel = 0.0;
    profile->piece = 0u;
    profile->piece_tick = 0u;
    profile->left = 0u;
    profile->refused = 0u;
    profile->executed = false;
    profile->placed = false;
    profile->busy = false;
    profile->aborting = false;
    profile->stopping = false;
    profile->done = false;
    profile->aborted = false;
}

void time_optimal_oscillator_profile_step(time_optimal_oscillator_profile_t *profile, const time_optimal_oscillator_profile_input_t *input,
    time_optimal_oscillator_profile_output_t *output)
{
    time_optimal_oscillator_profile_t *const p = profile;
    const bool rises = input->execute && (!p->executed);
    const bool was_busy = p->busy;
    uint32_t status;
    p->executed = input->execute;
    if (!input->execute) {
        p->refused = 0u;
        p->done = false;
        p->aborted = false;
    }
    time_optimal_oscillator_go_on(p, input->abort);
    status = p->placed ? 0u : time_optimal_oscillator_follow(p, input->start);
    if (rises) {
        p->refused = was_busy ? TIME_OPTIMAL_OSCILLATOR_PROFILE_EXECUTE_IGNORED : time_optimal_oscillator_reasons(p, input);
        if (p->refused == 0u) {
            time_optimal_oscillator_begin(p, input);
        }
    }
    if (p->busy) {
        const time_optimal_oscillator_number_t shape = p->stopping ? time_optimal_oscillator_next_of_stop(p) : time_optimal_oscillator_next_of_move(p);
        output->reference = (time_optimal_oscillator_HOLD_RATIO * p->start) + (p->travel * shape);
        output->position = p->start + (p->travel * time_optimal_oscillator_advance(p, shape));
    } else {
        output->reference = time_optimal_oscillator_HOLD_RATIO * p->position;
        output->position = p->position;
    }
    output->busy = p->busy;
    output->done = p->done;
    output->aborted = p->aborted;
    output->status = (status | p->refused) | (p->aborting ? TIME_OPTIMAL_OSCILLATOR_PROFILE_STOPPING : 0u);
}
