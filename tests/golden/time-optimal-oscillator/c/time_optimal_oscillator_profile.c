/*
 * time_optimal_oscillator: motion profile. It plays a move computed ahead, from any start to any target.
 *
 * Made by swayless 0.1.0 from time-optimal-oscillator.toml.
 * This file is yours: use, change and ship it as you like.
 *
 * Tick 0.005 s. A move takes 58 of them, 0.29 s, however far it goes; a stop 101.
 * References from -5 to 5; a move that could need more is refused.
 * Design: 0 to 1, robust of order 1, zero-order hold; SHA-256:
 * 4c47292d03d7cc91023042fb1cd3b3e6ed89dc1f61e19278e0ae72f5e763daaa
 * Proved with these numbers: a move leaves at most 1e-12 of each state's largest,
 * a stop from any tick 1e-12; both keep the limits.
 * Each move is that of the design, to scale: reference = hold_ratio * start + travel * shape,
 * position = start + travel * position of a model of the plant, with travel = target - start.
 * Memory: 216 bytes of state at most, 2770 of tables.
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
#define TIME_OPTIMAL_OSCILLATOR_STOP_PIECES (6u)
#define TIME_OPTIMAL_OSCILLATOR_STOP_TERMS (10u)

/* Does not compile when the state is larger than the header says. */
typedef char time_optimal_oscillator_profile_ram_check[(sizeof(time_optimal_oscillator_profile_t) <= TIME_OPTIMAL_OSCILLATOR_PROFILE_RAM) ? 1 : -1];

static const time_optimal_oscillator_number_t time_optimal_oscillator_HOLD_RATIO = 1.0; /* reference that holds the plant, per unit of position: 1 / G(0) */
static const time_optimal_oscillator_number_t time_optimal_oscillator_LOWEST = -5.0; /* limit of the design */
static const time_optimal_oscillator_number_t time_optimal_oscillator_HIGHEST = 5.0; /* limit of the design */
static const time_optimal_oscillator_number_t time_optimal_oscillator_MAX_TRAVEL = 1125899906842624.0; /* longest travel: no rate is limited */
static const time_optimal_oscillator_number_t time_optimal_oscillator_LARGEST_POSITION = 1125899906842624.0; /* beyond it sums lose their meaning */
static const time_optimal_oscillator_number_t time_optimal_oscillator_SHAPE_LOW = -4.68262935681; /* least of the table and of every stop of it */
static const time_optimal_oscillator_number_t time_optimal_oscillator_SHAPE_HIGH = 4.976764620786577; /* largest of the same */
static const time_optimal_oscillator_number_t time_optimal_oscillator_REST_LOW = 0.0; /* least share of the travel at which a stop rests */
static const time_optimal_oscillator_number_t time_optimal_oscillator_REST_HIGH = 1.4766993989737138; /* largest of the same */
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
static const time_optimal_oscillator_number_t time_optimal_oscillator_STOP_GAINS[300] = {
    /* ticks 0 to 19, 0 s, power 9 */
    4.54095085816568e-08, 1.1618821839083027e-08, 1.4872086720252373e-08, 3.9390313182777466e-09, 0.0,
    /* ticks 0 to 19, 0 s, power 8 */
    4.4497057240345265e-07, 1.4045492248050348e-07, 1.7978226547839963e-07, 9.799980073379158e-08, 0.0,
    /* ticks 0 to 19, 0 s, power 7 */
    -1.208393007787181e-05, -3.0678917728523825e-06, -3.926901471906222e-06, -1.046796920849977e-06, 0.0,
    /* ticks 0 to 19, 0 s, power 6 */
    -7.213528705066556e-05, -2.428592802972603e-05, -3.108598779871036e-05, -1.7486196057570222e-05, 0.0,
    /* ticks 0 to 19, 0 s, power 5 */
    0.001784339556659074, 0.0004475988755211233, 0.0005729265606806183, 0.00015425169021320007, 0.0,
    /* ticks 0 to 19, 0 s, power 4 */
    0.0043775716181344805, 0.001786268003310608, 0.002286423044181674, 0.0013906772288290405, 0.0,
    /* ticks 0 to 19, 0 s, power 3 */
    -0.11693827480053144, -0.028728904391956647, -0.03677299762171156, -0.010073189535191781, 0.0,
    /* ticks 0 to 19, 0 s, power 2 */
    0.04449823888755428, -0.018256366117563125, -0.02336814863046672, -0.02426511628932765, 0.0,
    /* ticks 0 to 19, 0 s, power 1 */
    2.0132858424853204, 0.47285854749069683, 0.6052589407880896, 0.17213779130267506, 0.0,
    /* ticks 0 to 19, 0 s, power 0 */
    -2.5909346944874456, 1.0595882853067145, -0.6437269948074046, 0.3364752135972595, 0.0,
    /* ticks 20 to 38, 0.1 s, power 9 */
    -1.7335167180662431e-09, -1.2507830334456537e-09, -1.601003523088104e-09, -2.07335324318258e-09, 0.0,
    /* ticks 20 to 38, 0.1 s, power 8 */
    5.696561978162518e-07, 1.5446082298323594e-07, 1.977098584799644e-07, 6.724909587993064e-08, 0.0,
    /* ticks 20 to 38, 0.1 s, power 7 */
    7.388949768268239e-08, 2.851763780187335e-07, 3.650257695878861e-07, 5.55154780601648e-07, 0.0,
    /* ticks 20 to 38, 0.1 s, power 6 */
    -0.00012065296226402649, -3.274950403245476e-05, -4.1919365178506686e-05, -1.3949166603850204e-05, 0.0,
    /* ticks 20 to 38, 0.1 s, power 5 */
    9.836762543259558e-05, -2.544861869404917e-05, -3.257423193284691e-05, -7.646617238839143e-05, 0.0,
    /* ticks 20 to 38, 0.1 s, power 4 */
    0.012253616555172736, 0.003332866327409746, 0.004266068899099423, 0.0013591686068406797, 0.0,
    /* ticks 20 to 38, 0.1 s, power 3 */
    -0.02094456198963596, -0.0008150199850289411, -0.0010432255808364797, 0.0037320189608356894, 0.0,
    /* ticks 20 to 38, 0.1 s, power 2 */
    -0.39302197966500013, -0.10748597198685658, -0.13758204414318015, -0.038621470521888794, 0.0,
    /* ticks 20 to 38, 0.1 s, power 1 */
    0.9532978843053854, 0.12276989952818612, 0.15714547139607776, 0.0026126550316349323, 0.0,
    /* ticks 20 to 38, 0.1 s, power 0 */
    0.8534069453457912, 1.7505989066989118, 0.24076660057460472, 0.5293305056010188, 0.0,
    /* ticks 39 to 59, 0.195 s, power 9 */
    -7.47295412593022e-08, -2.1296877611139674e-08, -2.726000385603484e-08, -1.1149388417945697e-08, 0.0,
    /* ticks 39 to 59, 0.195 s, power 8 */
    5.23813101457651e-07, 1.1196385750004253e-07, 1.4331354971045552e-07, -9.713188691086634e-09, 0.0,
    /* ticks 39 to 59, 0.195 s, power 7 */
    1.6770225460560337e-05, 4.835218282042056e-06, 6.189079399455704e-06, 2.484098396943913e-06, 0.0,
    /* ticks 39 to 59, 0.195 s, power 6 */
    -9.322026483451226e-05, -1.887007734763215e-05, -2.4153698543619586e-05, 2.4501690847339197e-06, 0.0,
    /* ticks 39 to 59, 0.195 s, power 5 */
    -0.001992492913226902, -0.0005866829847352005, -0.0007509542204615083, -0.0002912192218023426, 0.0,
    /* ticks 39 to 59, 0.195 s, power 4 */
    0.008177844266482832, 0.0014938137085745713, 0.0019120815465925875, -0.00032540261750244216, 0.0,
    /* ticks 39 to 59, 0.195 s, power 3 */
    0.09340000474103341, 0.028881954278347683, 0.03696890147628632, 0.013207738801500295, 0.0,
    /* ticks 39 to 59, 0.195 s, power 2 */
    -0.2481035889865579, -0.03470988606433694, -0.044428654162234515, 0.017125397665262138, 0.0,
    /* ticks 39 to 59, 0.195 s, power 1 */
    -0.6576134209183877, -0.25990235770976605, -0.33267501786849907, -0.07483049463618065, 0.0,
    /* ticks 39 to 59, 0.195 s, power 0 */
    1.0911306623796146, 1.5598017809658702, -0.0034537203636957974, 0.41287521295598756, 0.0,
    /* ticks 60 to 79, 0.3 s, power 9 */
    -3.8189912128037016e-08, -9.740808566963084e-09, -1.2468232876674007e-08, -2.6717769859736013e-09, 0.0,
    /* ticks 60 to 79, 0.3 s, power 8 */
    -5.818186838945315e-07, -1.7811178243657362e-07, -2.2798314175891372e-07, -1.1248113747106216e-07, 0.0,
    /* ticks 60 to 79, 0.3 s, power 7 */
    9.418892847948968e-06, 2.3685806989616536e-06, 3.031783283169727e-06, 5.754433228411368e-07, 0.0,
    /* ticks 60 to 79, 0.3 s, power 6 */
    0.00011186243107626584, 3.5168521415469265e-05, 4.501570753362924e-05, 2.1623200058284557e-05, 0.0,
    /* ticks 60 to 79, 0.3 s, power 5 */
    -0.0012229887543201844, -0.00029931125453868063, -0.00038311840579766825, -5.4387320741576954e-05, 0.0,
    /* ticks 60 to 79, 0.3 s, power 4 */
    -0.010403048236346446, -0.0034311808869348748, -0.004391911535346306, -0.0020104399509117007, 0.0,
    /* ticks 60 to 79, 0.3 s, power 3 */
    0.061394774293527424, 0.013979008185646442, 0.01789313047762391, 0.00014650188125279998, 0.0,
    /* ticks 60 to 79, 0.3 s, power 2 */
    0.31549358720096243, 0.11626738239980972, 0.148822249471766, 0.060933633491797985, 0.0,
    /* ticks 60 to 79, 0.3 s, power 1 */
    -0.382419441749695, -0.037928471780613725, -0.048548443879185776, 0.12041308291299664, 0.0,
    /* ticks 60 to 79, 0.3 s, power 0 */
    -0.4269413985176063, 1.1344529151337566, -0.547900268628791, 0.42948766724251053, 0.0,
    /* ticks 80 to 98, 0.4 s, power 9 */
    7.675983709581787e-09, 2.8535632672087643e-09, 3.652576505810595e-09, 2.9036095641604473e-09, 0.0,
    /* ticks 80 to 98, 0.4 s, power 8 */
    -5.500255416538513e-07, -1.501082921448737e-07, -1.9213859716425924e-07, -5.982952711500875e-08, 0.0,
    /* ticks 80 to 98, 0.4 s, power 7 */
    -2.544753251309932e-06, -9.519283801541826e-07, -1.2184683437309917e-06, -8.967157888171892e-07, 0.0,
    /* ticks 80 to 98, 0.4 s, power 6 */
    0.00011437536627558755, 3.128654243144309e-05, 4.004677427341056e-05, 1.1526515724255117e-05, 0.0,
    /* ticks 80 to 98, 0.4 s, power 5 */
    0.00048664588688520087, 0.00018336938137654554, 0.00023471280815973373, 0.00015668109839658855, 0.0,
    /* ticks 80 to 98, 0.4 s, power 4 */
    -0.011201571378655763, -0.0030784880111269976, -0.0039404646542126566, -0.0009466834081479188, 0.0,
    /* ticks 80 to 98, 0.4 s, power 3 */
    -0.04399837688673473, -0.01672088714348682, -0.02140273554365798, -0.012580113548066861, 0.0,
    /* ticks 80 to 98, 0.4 s, power 2 */
    0.323447771900652, 0.09018112962539557, 0.11543184592049581, 0.011003395140825897, 0.0,
    /* ticks 80 to 98, 0.4 s, power 1 */
    1.183198845983628, 0.4542582985789511, 0.5814506221810537, 0.286979263109632, 0.0,
    /* ticks 80 to 98, 0.4 s, power 0 */
    0.42869272873086023, 1.5984797950475487, 0.04605413766086096, 0.8986476979605909, 0.0,
    /* ticks 99 to 100, 0.495 s, power 9 */
    0.0, 0.0, 0.0, 0.0, 0.0,
    /* ticks 99 to 100, 0.495 s, power 8 */
    0.0, 0.0, 0.0, 0.0, 0.0,
    /* ticks 99 to 100, 0.495 s, power 7 */
    0.0, 0.0, 0.0, 0.0, 0.0,
    /* ticks 99 to 100, 0.495 s, power 6 */
    0.0, 0.0, 0.0, 0.0, 0.0,
    /* ticks 99 to 100, 0.495 s, power 5 */
    0.0, 0.0, 0.0, 0.0, 0.0,
    /* ticks 99 to 100, 0.495 s, power 4 */
    0.0, 0.0, 0.0, 0.0, 0.0,
    /* ticks 99 to 100, 0.495 s, power 3 */
    0.0, 0.0, 0.0, 0.0, 0.0,
    /* ticks 99 to 100, 0.495 s, power 2 */
    0.0, 0.0, 0.0, 0.0, 0.0,
    /* ticks 99 to 100, 0.495 s, power 1 */
    0.09404260411687457, 0.03215825120386556, 0.04116256154094763, 0.014267255716402548, 0.0,
    /* ticks 99 to 100, 0.495 s, power 0 */
    2.1603243425034533, 2.21944244742954, 0.8408863327098054, 1.2269506971958575, 0.0
};

/* Ticks of each piece. */
static const uint16_t time_optimal_oscillator_STOP_LENGTHS[6] = {
    20u, /* ticks 0 to 19, 0 s */
    19u, /* ticks 20 to 38, 0.1 s */
    21u, /* ticks 39 to 59, 0.195 s */
    20u, /* ticks 60 to 79, 0.3 s */
    19u, /* ticks 80 to 98, 0.4 s */
    2u /* ticks 99 to 100, 0.495 s */
};

/* Step of a piece's own variable, which goes from -1 to 1: 2 over one tick less than it has. */
static const time_optimal_oscillator_number_t time_optimal_oscillator_STOP_STEPS[6] = {
    0.10526315789473684, /* ticks 0 to 19, 0 s */
    0.1111111111111111, /* ticks 20 to 38, 0.1 s */
    0.1, /* ticks 39 to 59, 0.195 s */
    0.10526315789473684, /* ticks 60 to 79, 0.3 s */
    0.1111111111111111, /* ticks 80 to 98, 0.4 s */
    2.0 /* ticks 99 to 100, 0.495 s */
};

/* Where a stop comes to rest, of the same. */
static const time_optimal_oscillator_number_t time_optimal_oscillator_STOP_REST[5] = {
    0.26176590563373003, 1.5780681715982727, 0.019927259645787933, 0.561926964136467, 0.0 /* share of the travel */
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

/* End what is over, and begin a stop where it is asked for. */
static void time_optimal_oscillator_go_on(time_optimal_oscillator_profile_t *p, bool stop)
{
    uint32_t column;
    if (p->stopping) {
        if (p->piece >= TIME_OPTIMAL_OSCILLATOR_STOP_PIECES) {
            p->busy = false;
            p->stopping = false;
            p->aborted = true;
            p->position = p->start + (p->travel * time_optimal_oscillator_row_by(time_optimal_oscillator_STOP_REST, p->stop_from));
        }
    } else if (p->busy && (p->piece >= TIME_OPTIMAL_OSCILLATOR_MOVE_PIECES)) {
        p->busy = false;
        p->done = true;
        p->position = p->target;
    } else if (p->busy && stop) {
        p->stopping = true;
        p->piece = 0u;
        p->piece_tick = 0u;
        for (column = 0u; column < TIME_OPTIMAL_OSCILLATOR_COLUMNS; ++column) {
            p->stop_from[column] = p->plant[column];
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
    profile->refused = 0u;
    profile->executed = false;
    profile->placed = false;
    profile->busy = false;
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
    output->status = (status | p->refused) | (p->stopping ? TIME_OPTIMAL_OSCILLATOR_PROFILE_STOPPING : 0u);
}
