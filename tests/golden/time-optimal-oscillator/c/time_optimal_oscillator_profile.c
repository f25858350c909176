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
 */
#include "time_optimal_oscillator_profile.h"

typedef double time_optimal_oscillator_number_t;

#define TIME_OPTIMAL_OSCILLATOR_COLUMNS (TIME_OPTIMAL_OSCILLATOR_PROFILE_STATES + 1u)
#define TIME_OPTIMAL_OSCILLATOR_MOVE_PIECES (7u)
#define TIME_OPTIMAL_OSCILLATOR_MOVE_TERMS (1u)
#define TIME_OPTIMAL_OSCILLATOR_STOP_PIECES (3u)
#define TIME_OPTIMAL_OSCILLATOR_STOP_TERMS (10u)
#define TIME_OPTIMAL_OSCILLATOR_STOP_RANGES (1u)

/* Does not compile when the state is larger than the header says. */
typedef char time_optimal_oscillator_profile_ram_check[(sizeof(time_optimal_oscillator_profile_t) <= TIME_OPTIMAL_OSCILLATOR_PROFILE_RAM) ? 1 : -1];

static const time_optimal_oscillator_number_t time_optimal_oscillator_HOLD_RATIO = 1.0; /* reference that holds the plant, per unit of position: 1 / G(0) */
static const time_optimal_oscillator_number_t time_optimal_oscillator_LOWEST = -5.0; /* limit of the design */
static const time_optimal_oscillator_number_t time_optimal_oscillator_HIGHEST = 5.0; /* limit of the design */
static const time_optimal_oscillator_number_t time_optimal_oscillator_MAX_TRAVEL = 1125899906842624.0; /* longest travel: no rate is limited */
static const time_optimal_oscillator_number_t time_optimal_oscillator_LARGEST_POSITION = 1125899906842624.0; /* beyond it sums lose their meaning */
static const time_optimal_oscillator_number_t time_optimal_oscillator_SHAPE_LOW = -4.962852872306347; /* least of the table and of every stop of it */
static const time_optimal_oscillator_number_t time_optimal_oscillator_SHAPE_HIGH = 4.68262935681; /* largest of the same */
static const time_optimal_oscillator_number_t time_optimal_oscillator_REST_LOW = 0.0; /* least share of the travel at which a stop rests */
static const time_optimal_oscillator_number_t time_optimal_oscillator_REST_HIGH = 0.3064175190558011; /* largest of the same */
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
    /* ticks 0 to 17, 0 s, power 9 */
    4.868118988348579e-08, 2.8384363535947913e-08, 3.6331998510413124e-08, 1.3031776902705523e-08, 0.0,
    /* ticks 0 to 17, 0 s, power 8 */
    8.439031738684486e-07, 5.300508260356273e-07, 6.784648224777957e-07, 4.0733007746546625e-07, 0.0,
    /* ticks 0 to 17, 0 s, power 7 */
    -1.5863066515492506e-05, -9.182509788595253e-06, -1.1753612618646856e-05, -4.230047160480591e-06, 0.0,
    /* ticks 0 to 17, 0 s, power 6 */
    -0.00019033265714253, -0.00012276920594675176, -0.0001571445830936292, -9.421915822083793e-05, 0.0,
    /* ticks 0 to 17, 0 s, power 5 */
    0.0028421563483388194, 0.001626084460409583, 0.00208138810944538, 0.0007531778454159308, 0.0,
    /* ticks 0 to 17, 0 s, power 4 */
    0.019501521075111064, 0.01332178431861075, 0.017051883927450127, 0.010195566768867468, 0.0,
    /* ticks 0 to 17, 0 s, power 3 */
    -0.2209754745584459, -0.12367788487838603, -0.1583076926443904, -0.05788187196100125, 0.0,
    /* ticks 0 to 17, 0 s, power 2 */
    -0.49096066068995464, -0.41538383862752026, -0.5316913134431334, -0.3150351833619886, 0.0,
    /* ticks 0 to 17, 0 s, power 1 */
    4.226939988289549, 2.2357333466211475, 2.861738683675079, 1.07516300625625, 0.0,
    /* ticks 0 to 17, 0 s, power 0 */
    -3.171434597248543, 0.6161552454894601, -1.211321285773496, 0.5272805244671482, 0.0,
    /* ticks 18 to 35, 0.09 s, power 9 */
    -1.1608623259116683e-08, -8.238663794215584e-09, -1.0545487354427382e-08, -1.1193343031091916e-08, 0.0,
    /* ticks 18 to 35, 0.09 s, power 8 */
    1.2275136889169985e-06, 7.388916602404999e-07, 9.457811579099283e-07, 4.262096007348851e-07, 0.0,
    /* ticks 18 to 35, 0.09 s, power 7 */
    3.4471174544701486e-06, 2.6376733594799037e-06, 3.376221891250696e-06, 3.5393351142620155e-06, 0.0,
    /* ticks 18 to 35, 0.09 s, power 6 */
    -0.0002905588690152567, -0.00017574533184362814, -0.00022495402437454286, -9.974147228340572e-05, 0.0,
    /* ticks 18 to 35, 0.09 s, power 5 */
    -0.000521312910843051, -0.0004591100185933509, -0.0005876608237861385, -0.0006031208078746488, 0.0,
    /* ticks 18 to 35, 0.09 s, power 4 */
    0.03293051945617875, 0.02010390139669232, 0.02573299378746699, 0.011052807430284086, 0.0,
    /* ticks 18 to 35, 0.09 s, power 3 */
    0.026692646585305214, 0.033758709727935904, 0.04321114845175093, 0.04243507780656409, 0.0,
    /* ticks 18 to 35, 0.09 s, power 2 */
    -1.169347292551141, -0.7319690047633446, -0.9369203260969962, -0.36800239968858794, 0.0,
    /* ticks 18 to 35, 0.09 s, power 1 */
    0.14409760525107143, -0.5541328041534829, -0.7092899893164594, -0.6008673372792156, 0.0,
    /* ticks 18 to 35, 0.09 s, power 0 */
    1.9729747983374655, 2.6379537109077575, 1.3765807499619225, 1.0696506519067248, 0.0,
    /* ticks 36 to 46, 0.18 s, power 9 */
    -4.6420839219572985e-10, -2.8693190586547573e-10, -3.6735455351794965e-10, -2.0471402938939248e-10, 0.0,
    /* ticks 36 to 46, 0.18 s, power 8 */
    9.91167645942639e-09, 5.7203576187043246e-09, 7.322145570826683e-09, 2.0063370933003625e-09, 0.0,
    /* ticks 36 to 46, 0.18 s, power 7 */
    4.2324969528965916e-07, 2.654720728778428e-07, 3.398044253263914e-07, 1.865020623051355e-07, 0.0,
    /* ticks 36 to 46, 0.18 s, power 6 */
    -6.580845844410882e-06, -3.738794672123863e-06, -4.785657344840491e-06, -1.1997116216546174e-06, 0.0,
    /* ticks 36 to 46, 0.18 s, power 5 */
    -0.00020879503154788159, -0.00013419616893231134, -0.0001717710963636508, -9.185011332780273e-05, 0.0,
    /* ticks 36 to 46, 0.18 s, power 4 */
    0.002046793098549906, 0.0011243943027173537, 0.0014392247075728135, 0.0002871303187442783, 0.0,
    /* ticks 36 to 46, 0.18 s, power 3 */
    0.04261302086836284, 0.028798285357743997, 0.036861805257953704, 0.018678573538685333, 0.0,
    /* ticks 36 to 46, 0.18 s, power 2 */
    -0.17947657547064705, -0.08719939458023615, -0.11161522506271977, 0.00030763901389568453, 0.0,
    /* ticks 36 to 46, 0.18 s, power 1 */
    -1.767516627463873, -1.406764468714281, -1.8006585199542837, -0.7646506325336371, 0.0,
    /* ticks 36 to 46, 0.18 s, power 0 */
    -0.7871399730462518, -0.11035714896731251, -2.141257150678162, -0.7329969968931819, 0.0
};

/* Ticks of each piece. */
static const uint16_t time_optimal_oscillator_STOP_LENGTHS[3] = {
    18u, /* ticks 0 to 17, 0 s */
    18u, /* ticks 18 to 35, 0.09 s */
    11u /* ticks 36 to 46, 0.18 s */
};

/* Step of a piece's own variable, which goes from -1 to 1: 2 over one tick less than it has. */
static const time_optimal_oscillator_number_t time_optimal_oscillator_STOP_STEPS[3] = {
    0.11764705882352941, /* ticks 0 to 17, 0 s */
    0.11764705882352941, /* ticks 18 to 35, 0.09 s */
    0.2 /* ticks 36 to 46, 0.18 s */
};

/* Where a stop comes to rest, of the same. */
static const time_optimal_oscillator_number_t time_optimal_oscillator_STOP_REST[5] = {
    0.30185601663788775, 1.2171602063495353, -0.4420349358725983, 1.0508205830004704, 0.0 /* share of the travel */
};

/* First tick of the move in each range in which a stop may begin. */
static const uint16_t time_optimal_oscillator_STOP_FIRST[1] = {
    1u /* 0.005 s */
};

/* Last tick of the move in each range in which a stop may begin. */
static const uint16_t time_optimal_oscillator_STOP_LAST[1] = {
    6u /* 0.03 s */
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
    p->tick += 1u;
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

/* End what is over; after an abort begin a stop in the first tick that allows one. */
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
    } else if (p->busy) {
        p->aborting = p->aborting || stop;
        if ((p->range < TIME_OPTIMAL_OSCILLATOR_STOP_RANGES) && (p->tick > time_optimal_oscillator_STOP_LAST[p->range])) {
            p->range += 1u;
        }
        p->stopping = p->aborting && (p->range < TIME_OPTIMAL_OSCILLATOR_STOP_RANGES) && (p->tick >= time_optimal_oscillator_STOP_FIRST[p->range]);
        if (p->stopping) {
            p->piece = 0u;
            p->piece_tick = 0u;
            for (column = 0u; column < TIME_OPTIMAL_OSCILLATOR_COLUMNS; ++column) {
                p->stop_from[column] = p->plant[column];
            }
        }
    } else {
        /* it rests */
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
    p->tick = 0u;
    p->range = 0u;
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
    profile->tick = 0u;
    profile->range = 0u;
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
