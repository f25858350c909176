/*
 * hoisting_gantry: command shaper, see hoisting_gantry_shaper.h.
 * Design SHA-256 c43c9deee840c08718116d0afe10c1ad4fd6f10e6d9ad0baa1d7bc82815ed464.
 */
#include "hoisting_gantry_shaper.h"

#if (HOISTING_GANTRY_SHAPER_DESIGN != 0xc43c9deeu)
#error "hoisting_gantry_shaper.h and hoisting_gantry_shaper.c belong to different designs"
#endif

/* Does not compile when the state is larger than the header says. */
typedef char hoisting_gantry_ram_check[(sizeof(hoisting_gantry_shaper_t) <= (unsigned)HOISTING_GANTRY_SHAPER_RAM) ? 1 : -1];

static const uint32_t hoisting_gantry_LAST_QUANTA = 843314857u; /* longest lag of any row */
static const hoisting_gantry_real_t hoisting_gantry_MAX_COMMAND = 0.8; /* m/s: max_speed */
static const hoisting_gantry_real_t hoisting_gantry_RAMP_ANCHOR = 1.0; /* floats next to it are the grid of ramp steps */
static const hoisting_gantry_real_t hoisting_gantry_METRES_PER_UNIT_TICK = 0.01; /* m of way per unit and tick */
static const hoisting_gantry_real_t hoisting_gantry_TICK_S = 0.01; /* s: tick */
static const hoisting_gantry_real_t hoisting_gantry_SHORTEST_ROPE = 3.0; /* m: rope_length */
static const hoisting_gantry_real_t hoisting_gantry_LONGEST_ROPE = 9.0; /* m: rope_length */
static const hoisting_gantry_real_t hoisting_gantry_HOIST_SPEED = 0.4; /* m/s: hoist_speed */
static const hoisting_gantry_real_t hoisting_gantry_ROPE_JUMP = 0.05; /* m: difference of two readings that is always taken */
static const hoisting_gantry_real_t hoisting_gantry_ROPE_WAY_PER_TICK = 0.004; /* m: hoist_speed times tick */
static const hoisting_gantry_real_t hoisting_gantry_ROPE_TICK = 0.01; /* s: tick */
static const hoisting_gantry_real_t hoisting_gantry_FROZEN_WAY = 0.05; /* m: a length that stays so long is frozen */
static const uint32_t hoisting_gantry_MOST_HELD_TICKS = 1048576u; /* by then the hoist may be anywhere */
static const uint32_t hoisting_gantry_LAST_CELL = 603u; /* last cell of the ring */
static const uint32_t hoisting_gantry_LAST_SPAN = 193u; /* last span of the table of quanta */
static const hoisting_gantry_real_t hoisting_gantry_SPANS_PER_METRE = 32.333333333333336; /* spans of the table per m of rope */
static const hoisting_gantry_real_t hoisting_gantry_QUANTUM_RAD = 7.450580596923828e-09; /* rad: phase of a quantum */
static const hoisting_gantry_real_t hoisting_gantry_KICK_PER_QUANTUM = 7.597477830781998e-08; /* QUANTUM_RAD / (9.80665 m/s2 tick) */
static const hoisting_gantry_real_t hoisting_gantry_PER_MOST = 4.1208836493226916e-07; /* 1 / quanta of a tick on the shortest rope */
static const hoisting_gantry_real_t hoisting_gantry_PER_FEWEST = 7.137580431609489e-07; /* 1 / quanta of a tick on the longest rope */
static const hoisting_gantry_real_t hoisting_gantry_LOSS = 0.002; /* twice the damping ratio of the swing */
static const hoisting_gantry_real_t hoisting_gantry_LONGEST_STRETCH = 0.5; /* most change of sqrt(rope length) foreseen */
static const hoisting_gantry_real_t hoisting_gantry_LEAST_MISMATCH = 0.001953125; /* least relative error of a part that is corrected */
static const hoisting_gantry_real_t hoisting_gantry_LEAST_ANSWER = 0.0001953125; /* smaller kicks are collected */
static const hoisting_gantry_real_t hoisting_gantry_LEAST_LACK = 7.62939453125e-07; /* smaller corrections are left out */
static const hoisting_gantry_real_t hoisting_gantry_LEANING_FROM = 0.7875000000000001; /* from here on answers lean away from the maximum */

/* first tap of each row, and the end */
static const uint32_t hoisting_gantry_FIRST_TAP[3] = {
    0u, 1u, 4u
};
/* lag of each tap, by row */
static const uint32_t hoisting_gantry_LAG_QUANTA[4] = {
    0u,
    0u, 421657428u, 843314857u
};
/* amplitude of each tap, by row; each row sums to exactly 1 */
static const hoisting_gantry_real_t hoisting_gantry_AMPLITUDE[4] = {
    1.0,
    0.25, 0.5, 0.25
};
/* longest lag of each row */
static const uint32_t hoisting_gantry_TAIL_QUANTA[2] = {
    0u, 843314857u
};
/* sum of amplitude times lag of each row: references to come per unit of a steady command */
static const hoisting_gantry_real_t hoisting_gantry_MOMENT_QUANTA[2] = {
    0.0, 421657428.25
};
/* tolerance of each row */
static const hoisting_gantry_real_t hoisting_gantry_RESIDUAL_BOUND[2] = {
    1.0, 0.05
};
/* quanta of phase in a tick, at equal steps from 3 to 9 m */
static const uint32_t hoisting_gantry_TICK_QUANTA[195] = {
    2426664u, 2414251u, 2402027u, 2389987u, 2378126u, 2366439u,
    2354924u, 2343575u, 2332388u, 2321360u, 2310487u, 2299766u,
    2289192u, 2278763u, 2268475u, 2258325u, 2248310u, 2238428u,
    2228674u, 2219047u, 2209543u, 2200161u, 2190897u, 2181749u,
    2172715u, 2163792u, 2154978u, 2146271u, 2137669u, 2129169u,
    2120770u, 2112470u, 2104266u, 2096157u, 2088141u, 2080216u,
    2072381u, 2064634u, 2056973u, 2049397u, 2041903u, 2034492u,
    2027160u, 2019907u, 2012732u, 2005632u, 1998607u, 1991655u,
    1984776u, 1977967u, 1971228u, 1964557u, 1957953u, 1951416u,
    1944943u, 1938535u, 1932190u, 1925906u, 1919683u, 1913521u,
    1907417u, 1901371u, 1895383u, 1889450u, 1883573u, 1877751u,
    1871982u, 1866266u, 1860602u, 1854989u, 1849427u, 1843915u,
    1838451u, 1833036u, 1827668u, 1822348u, 1817073u, 1811844u,
    1806660u, 1801520u, 1796424u, 1791371u, 1786360u, 1781391u,
    1776463u, 1771576u, 1766729u, 1761921u, 1757153u, 1752423u,
    1747731u, 1743077u, 1738459u, 1733878u, 1729334u, 1724824u,
    1720350u, 1715910u, 1711505u, 1707133u, 1702795u, 1698489u,
    1694217u, 1689976u, 1685767u, 1681589u, 1677442u, 1673325u,
    1669239u, 1665183u, 1661155u, 1657158u, 1653188u, 1649247u,
    1645335u, 1641450u, 1637592u, 1633761u, 1629957u, 1626180u,
    1622429u, 1618703u, 1615003u, 1611329u, 1607679u, 1604054u,
    1600453u, 1596877u, 1593324u, 1589795u, 1586290u, 1582807u,
    1579348u, 1575910u, 1572496u, 1569103u, 1565732u, 1562383u,
    1559055u, 1555749u, 1552463u, 1549198u, 1545954u, 1542730u,
    1539526u, 1536342u, 1533177u, 1530032u, 1526906u, 1523800u,
    1520712u, 1517643u, 1514592u, 1511560u, 1508546u, 1505550u,
    1502572u, 1499611u, 1496668u, 1493742u, 1490833u, 1487941u,
    1485065u, 1482207u, 1479365u, 1476539u, 1473729u, 1470935u,
    1468157u, 1465395u, 1462648u, 1459917u, 1457201u, 1454500u,
    1451813u, 1449142u, 1446486u, 1443844u, 1441216u, 1438603u,
    1436004u, 1433419u, 1430848u, 1428290u, 1425746u, 1423216u,
    1420700u, 1418196u, 1415706u, 1413229u, 1410764u, 1408313u,
    1405874u, 1403448u, 1401035u
};
/* relative change of sqrt(rope length) until each tap, by row, per m/s and quantum of the tick */
static const hoisting_gantry_real_t hoisting_gantry_STRETCH[4] = {
    0.0,
    0.0, 1.1934090261960613e-07, 2.386818055222404e-07
};
/* (1 + z)^(-1/2) = 1 + z (s0 + z (s1 + z (s2 + z s3))) */
static const hoisting_gantry_real_t hoisting_gantry_SERIES[4] = {
    -0.5, 0.375, -0.3125, 0.2734375
};
/* steps of the taps, by row, that answer a wanted step of 1: in sum 0, and without way */
static const hoisting_gantry_real_t hoisting_gantry_ANSWER[4] = {
    0.0,
    0.25, -0.5, 0.25
};
/* steps of the taps, by row, that excite nothing: with them an answer goes only up or only down */
static const hoisting_gantry_real_t hoisting_gantry_LEAN[4] = {
    0.0,
    0.25, 0.0, -0.25
};

/* A ramp: its step per tick, rounded up to the grid, and what its closed form needs. */
typedef struct {
    hoisting_gantry_real_t step;
    hoisting_gantry_real_t steps_per_unit; /* 1 / step */
} hoisting_gantry_ramp_t;

/* m/s per tick: acceleration */
static const hoisting_gantry_ramp_t hoisting_gantry_ACCELERATION = { 0.0040000000000000036, 249.99999999999977 };
/* m/s per tick: deceleration */
static const hoisting_gantry_ramp_t hoisting_gantry_DECELERATION = { 0.0040000000000000036, 249.99999999999977 };
/* m/s per tick: quick_stop */
static const hoisting_gantry_ramp_t hoisting_gantry_QUICK_STOP = { 0.008000000000000007, 124.99999999999989 };

/* What a ramp still has to do: ticks, and the sum of the commands of those ticks. */
typedef struct {
    hoisting_gantry_real_t total;
    uint32_t ticks;
} hoisting_gantry_glide_t;

static hoisting_gantry_real_t hoisting_gantry_abs(hoisting_gantry_real_t value)
{
    return (value < 0.0) ? -value : value;
}

static bool hoisting_gantry_equal(hoisting_gantry_real_t a, hoisting_gantry_real_t b)
{
    return (a <= b) && (a >= b);
}

/* Round a command to the grid of ramp steps: from there on a ramp adds exactly. */
static hoisting_gantry_real_t hoisting_gantry_on_grid(hoisting_gantry_real_t command)
{
    const hoisting_gantry_real_t anchor = (command < 0.0) ? -hoisting_gantry_RAMP_ANCHOR : hoisting_gantry_RAMP_ANCHOR;
    return (command + anchor) - anchor;
}

/* Whether parts of changes may be under way. */
static bool hoisting_gantry_running(const hoisting_gantry_shaper_t *s)
{
    return s->running;
}

/* What one tick moves: references released, part times phase that is left, and the step that the swing wants
 * after a change of hoist, with how far its answer leans up or down. */
typedef struct {
    hoisting_gantry_real_t release;
    hoisting_gantry_real_t wanted;
    hoisting_gantry_real_t lean;
    hoisting_gantry_real_t passed;
    hoisting_gantry_real_t fresh_passed;
} hoisting_gantry_flow_t;

/* Whether a reading is a number: only what is finite and not 0 shrinks when halved. */
static bool hoisting_gantry_is_number(hoisting_gantry_real_t value)
{
    const hoisting_gantry_real_t magnitude = hoisting_gantry_abs(value);
    return hoisting_gantry_equal(magnitude, 0.0) || ((magnitude * 0.5) < magnitude);
}

/* Value, but not below low, and not above high. */
static hoisting_gantry_real_t hoisting_gantry_within(hoisting_gantry_real_t value, hoisting_gantry_real_t low, hoisting_gantry_real_t high)
{
    hoisting_gantry_real_t result = value;
    if (result < low) {
        result = low;
    }
    if (result > high) {
        result = high;
    }
    return result;
}

static void hoisting_gantry_hold_rope(hoisting_gantry_shaper_t *s)
{
    if (s->held_ticks < hoisting_gantry_MOST_HELD_TICKS) {
        s->held_ticks += 1u;
    }
}

/* Take a rope length where it can be true; otherwise the last one holds. At rest every length can. */
static void hoisting_gantry_take_length(hoisting_gantry_shaper_t *s, hoisting_gantry_real_t reading)
{
    const hoisting_gantry_real_t clamped = hoisting_gantry_within(reading, hoisting_gantry_SHORTEST_ROPE, hoisting_gantry_LONGEST_ROPE);
    const hoisting_gantry_real_t reach = hoisting_gantry_ROPE_JUMP + ((hoisting_gantry_real_t)(s->held_ticks + 1u) * hoisting_gantry_ROPE_WAY_PER_TICK);
    if (!hoisting_gantry_equal(clamped, reading)) {
        s->status |= HOISTING_GANTRY_SHAPER_ROPE_OUT_OF_RANGE;
    }
    if (!hoisting_gantry_running(s) || (hoisting_gantry_abs(clamped - s->rope_length) <= reach)) {
        s->rope_length = clamped;
        s->held_ticks = 0u;
    } else {
        s->status |= HOISTING_GANTRY_SHAPER_ROPE_JUMP;
        hoisting_gantry_hold_rope(s);
    }
}

/* Watch for a length that stays, within the range, while the hoist says that it moves. */
static void hoisting_gantry_watch_rope(hoisting_gantry_shaper_t *s, hoisting_gantry_real_t before)
{
    const bool inside = (hoisting_gantry_SHORTEST_ROPE < s->rope_length) && (s->rope_length < hoisting_gantry_LONGEST_ROPE);
    if (!inside || !hoisting_gantry_equal(s->rope_length, before) || hoisting_gantry_equal(s->hoist_speed, 0.0)) {
        s->unmoved = 0.0;
    } else {
        s->unmoved = s->unmoved + ((hoisting_gantry_real_t)hoisting_gantry_abs(s->hoist_speed) * hoisting_gantry_ROPE_TICK);
        if (s->unmoved >= hoisting_gantry_FROZEN_WAY) {
            s->unmoved = hoisting_gantry_FROZEN_WAY;
            s->status |= HOISTING_GANTRY_SHAPER_ROPE_FROZEN;
        }
    }
}

/* Read the rope, and see whether the same reading would change nothing once more. */
static void hoisting_gantry_read_rope(hoisting_gantry_shaper_t *s, const hoisting_gantry_shaper_input_t *input)
{
    const hoisting_gantry_real_t before = s->rope_length;
    if (hoisting_gantry_is_number(input->hoist_speed_m_s)) {
        s->hoist_speed = hoisting_gantry_within(input->hoist_speed_m_s, -hoisting_gantry_HOIST_SPEED, hoisting_gantry_HOIST_SPEED);
    } else {
        s->hoist_speed = 0.0;
        s->status |= HOISTING_GANTRY_SHAPER_HOIST_SPEED_INVALID;
    }
    if (input->rope_length_valid && hoisting_gantry_is_number(input->rope_length_m)) {
        hoisting_gantry_take_length(s, input->rope_length_m);
    } else {
        s->status |= HOISTING_GANTRY_SHAPER_ROPE_INVALID;
        hoisting_gantry_hold_rope(s);
    }
    hoisting_gantry_watch_rope(s, before);
    s->rope_still = (s->held_ticks == 0u) && hoisting_gantry_equal(s->rope_length, before)
        && ((s->unmoved <= 0.0) || (s->unmoved >= hoisting_gantry_FROZEN_WAY));
}

/* The quanta of a tick change, and with them what the place of the swing is worth. */
static void hoisting_gantry_rescale(hoisting_gantry_shaper_t *s, uint32_t quanta)
{
    const hoisting_gantry_real_t count = (hoisting_gantry_real_t)quanta;
    s->place = s->place * (count * s->inverse);
    s->inverse = 1.0 / count;
}

/* Step of the trolley's speed that undoes the kick of a change of hoist speed; small ones are collected. */
static hoisting_gantry_real_t hoisting_gantry_kick(hoisting_gantry_shaper_t *s)
{
    const hoisting_gantry_real_t change = s->hoist_speed - s->answered;
    const hoisting_gantry_real_t kick = (change * ((hoisting_gantry_real_t)s->quanta * hoisting_gantry_KICK_PER_QUANTUM)) * s->place;
    hoisting_gantry_real_t step = hoisting_gantry_on_grid(kick);
    if (hoisting_gantry_abs(step) < hoisting_gantry_LEAST_ANSWER) {
        step = 0.0;
    } else {
        s->answered = s->hoist_speed;
    }
    return step;
}

/* Let the load swing for a tick, after a step of the trolley's speed: half of its way before, half after. */
static void hoisting_gantry_swing(hoisting_gantry_shaper_t *s, hoisting_gantry_real_t step)
{
    const hoisting_gantry_real_t angle = (hoisting_gantry_real_t)s->quanta * hoisting_gantry_QUANTUM_RAD;
    const hoisting_gantry_real_t half = angle * 0.5;
    const hoisting_gantry_real_t pace = s->pace - step;
    const hoisting_gantry_real_t place = s->place + (half * pace);
    s->pace = (pace - (angle * place)) * (1.0 - (angle * hoisting_gantry_LOSS));
    s->place = place + (half * s->pace);
}

/* Weights of the later taps for a change now: (1 + z)^(-1/2) as a series, z the change of sqrt(rope length)
 * until the tap, within the range of the rope. The first tap releases on the rope as it is;
 * found once for a rate. */
static void hoisting_gantry_weigh(hoisting_gantry_shaper_t *s)
{
    const uint32_t first = hoisting_gantry_FIRST_TAP[s->row] + 1u;
    const uint32_t end = hoisting_gantry_FIRST_TAP[s->row + 1u];
    const hoisting_gantry_real_t quanta = (hoisting_gantry_real_t)s->quanta;
    hoisting_gantry_real_t low = (quanta * hoisting_gantry_PER_MOST) - 1.0;
    hoisting_gantry_real_t high = (quanta * hoisting_gantry_PER_FEWEST) - 1.0;
    hoisting_gantry_real_t total = hoisting_gantry_AMPLITUDE[first - 1u];
    hoisting_gantry_real_t share;
    uint32_t tap;
    if (low < -hoisting_gantry_LONGEST_STRETCH) {
        low = -hoisting_gantry_LONGEST_STRETCH;
    }
    if (high > hoisting_gantry_LONGEST_STRETCH) {
        high = hoisting_gantry_LONGEST_STRETCH;
    }
    for (tap = first; tap < end; ++tap) {
        const hoisting_gantry_real_t z = hoisting_gantry_within(s->rate * hoisting_gantry_STRETCH[tap], low, high);
        const hoisting_gantry_real_t tail = hoisting_gantry_SERIES[1] + (z * (hoisting_gantry_SERIES[2] + (z * hoisting_gantry_SERIES[3])));
        s->foreseen[tap - first] = s->inverse * (1.0 + z);
        s->weight[tap - first] = hoisting_gantry_AMPLITUDE[tap] * (1.0 + (z * (hoisting_gantry_SERIES[0] + (z * tail))));
        total = total + s->weight[tap - first];
    }
    share = 1.0 / total;
    for (tap = first; tap < end; ++tap) {
        s->weight[tap - first] = s->weight[tap - first] * share;
    }
}

/* Part of a change, and of the answer to a wanted step, that a tap releases later. */
static hoisting_gantry_real_t hoisting_gantry_part(const hoisting_gantry_flow_t *flow, hoisting_gantry_real_t change, hoisting_gantry_real_t weight, uint32_t tap)
{
    const hoisting_gantry_real_t answer = (flow->wanted * hoisting_gantry_ANSWER[tap]) + (flow->lean * hoisting_gantry_LEAN[tap]);
    return hoisting_gantry_on_grid((change * weight) + answer);
}

/* Step that a part lacks on the rope as it is: this is shorter than foreseen. */
static hoisting_gantry_real_t hoisting_gantry_lack(const hoisting_gantry_shaper_t *s, hoisting_gantry_real_t part, hoisting_gantry_real_t foreseen)
{
    const hoisting_gantry_real_t excess = (((hoisting_gantry_real_t)s->quanta * foreseen) - 1.0) * 0.5;
    hoisting_gantry_real_t lack = 0.0;
    if (hoisting_gantry_abs(excess) >= hoisting_gantry_LEAST_MISMATCH) {
        lack = hoisting_gantry_on_grid(part * hoisting_gantry_within(excess, -0.5, 0.5));
        if (hoisting_gantry_abs(lack) < hoisting_gantry_LEAST_LACK) {
            lack = 0.0;
        }
    }
    return lack;
}

/* Quanta of phase in a tick, off the table; the rope length is within its range. */
static uint32_t hoisting_gantry_tick_quanta(hoisting_gantry_real_t length)
{
    const hoisting_gantry_real_t place = (length - hoisting_gantry_SHORTEST_ROPE) * hoisting_gantry_SPANS_PER_METRE;
    const uint32_t whole = (uint32_t)place;
    const uint32_t span = (whole < hoisting_gantry_LAST_SPAN) ? whole : hoisting_gantry_LAST_SPAN;
    const hoisting_gantry_real_t share = place - (hoisting_gantry_real_t)span;
    const hoisting_gantry_real_t here = (hoisting_gantry_real_t)hoisting_gantry_TICK_QUANTA[span];
    const hoisting_gantry_real_t there = (hoisting_gantry_real_t)hoisting_gantry_TICK_QUANTA[span + 1u];
    return (uint32_t)((here - ((here - there) * share)) + 0.5);
}

/* Ticks in which a lag passes while the rope is still. */
static uint32_t hoisting_gantry_ticks_of(const hoisting_gantry_shaper_t *s, uint32_t lag)
{
    return (lag + (s->quanta - 1u)) / s->quanta;
}

/* One tick more without change: what has elapsed since the last. */
static void hoisting_gantry_count_still(hoisting_gantry_shaper_t *s)
{
    const uint32_t still = s->still_quanta + s->elapsed_quanta;
    s->still_quanta = (still < hoisting_gantry_LAST_QUANTA) ? still : hoisting_gantry_LAST_QUANTA;
}

/* Take the rope of a tick: the tick before had the quanta that have elapsed. */
static void hoisting_gantry_turn(hoisting_gantry_shaper_t *s)
{
    const uint32_t quanta = hoisting_gantry_tick_quanta(s->rope_length);
    const hoisting_gantry_real_t rate = s->hoist_speed * (hoisting_gantry_real_t)quanta;
    s->elapsed_quanta = s->quanta;
    if ((quanta != s->quanta) || (rate < s->rate) || (rate > s->rate)) {
        s->weighed = false;
    }
    s->rate = rate;
    if (quanta != s->quanta) {
        hoisting_gantry_rescale(s, quanta);
        s->quanta = quanta;
        s->foretold = false;
    }
}

static bool hoisting_gantry_is_zero(hoisting_gantry_real_t value)
{
    return hoisting_gantry_equal(value, 0.0);
}

/* Nothing is under way: all sums are exactly 0. */
static void hoisting_gantry_start_sums(hoisting_gantry_shaper_t *s)
{
    s->level = s->base;
    s->moment = 0.0;
    s->fresh = 0.0;
    s->fresh_mass = 0.0;
}

/* By how much the command has changed. */
static hoisting_gantry_real_t hoisting_gantry_arrived(hoisting_gantry_shaper_t *s, hoisting_gantry_real_t command)
{
    const hoisting_gantry_real_t change = command - s->base;
    s->base = command;
    return change;
}

/* Share of a part that belongs to the next tick, because its phase is reached late in this one. */
static hoisting_gantry_real_t hoisting_gantry_later(const hoisting_gantry_shaper_t *s, hoisting_gantry_real_t part, uint32_t ahead)
{
    return hoisting_gantry_on_grid(part * ((hoisting_gantry_real_t)ahead * s->inverse));
}

/* A part leaves the sums. */
static void hoisting_gantry_leave(hoisting_gantry_shaper_t *s, hoisting_gantry_flow_t *flow, hoisting_gantry_real_t part, uint32_t ahead, bool in_lap)
{
    const hoisting_gantry_real_t moment = part * (hoisting_gantry_real_t)ahead;
    s->mass = s->mass - part;
    flow->passed = flow->passed + moment;
    if (in_lap) {
        s->fresh_mass = s->fresh_mass - part;
        flow->fresh_passed = flow->fresh_passed + moment;
    }
}

/* Parts enter the sums, and everything under way moves on by a tick. */
static void hoisting_gantry_enter(hoisting_gantry_shaper_t *s, const hoisting_gantry_flow_t *flow, hoisting_gantry_real_t later, hoisting_gantry_real_t moment)
{
    const hoisting_gantry_real_t quanta = (hoisting_gantry_real_t)s->quanta;
    s->mass = s->mass + later;
    s->fresh_mass = s->fresh_mass + later;
    s->moment = (s->moment + (moment - flow->passed)) - (s->mass * quanta);
    s->fresh = (s->fresh + (moment - flow->fresh_passed)) - (s->fresh_mass * quanta);
    if (s->head >= hoisting_gantry_LAST_CELL) {
        /* A full lap knows everything under way: its sum ends the rounding of the older one. */
        s->moment = s->fresh;
        s->fresh = 0.0;
        s->fresh_mass = 0.0;
    }
}

/* The level of the references, within the maximum. */
static hoisting_gantry_real_t hoisting_gantry_reference(const hoisting_gantry_shaper_t *s)
{
    return hoisting_gantry_within(s->level, -hoisting_gantry_MAX_COMMAND, hoisting_gantry_MAX_COMMAND);
}

/* Sum of the references still to come if every later command is 0 and the rope is still. */
static hoisting_gantry_real_t hoisting_gantry_pending(const hoisting_gantry_shaper_t *s, uint8_t row)
{
    const hoisting_gantry_real_t reach = s->base * hoisting_gantry_MOMENT_QUANTA[row];
    return s->running ? ((reach - s->moment) * s->inverse) : (reach * s->inverse);
}

/* Rest at a command: nothing is under way, and the reference equals it. */
static void hoisting_gantry_rest(hoisting_gantry_shaper_t *s, hoisting_gantry_real_t command)
{
    s->base = command;
    s->running = false;
}

/* Every pointer lags by its phase behind the first cell, and nothing is under way. */
static void hoisting_gantry_leave_rest(hoisting_gantry_shaper_t *s)
{
    const uint32_t first = hoisting_gantry_FIRST_TAP[s->row] + 1u;
    const uint32_t end = hoisting_gantry_FIRST_TAP[s->row + 1u];
    uint32_t tap;
    s->running = true;
    s->head = hoisting_gantry_LAST_CELL;
    for (tap = first; tap < end; ++tap) {
        s->next[tap - first] = 0u;
        s->ahead[tap - first] = hoisting_gantry_LAG_QUANTA[tap];
    }
    s->late = 0.0;
    s->mass = 0.0;
    hoisting_gantry_start_sums(s);
    s->place = 0.0;
    s->pace = 0.0;
    s->answered = s->hoist_speed;
    s->weighed = false;
}

/* Release a part that a pointer has reached, split between this tick and the next. */
static void hoisting_gantry_release(hoisting_gantry_shaper_t *s, hoisting_gantry_flow_t *flow, uint32_t later, uint32_t ahead)
{
    const hoisting_gantry_shaper_cell_t *const cell = &s->ring[s->next[later]];
    const hoisting_gantry_real_t part = cell->part[later];
    const hoisting_gantry_real_t late = hoisting_gantry_later(s, part, ahead);
    flow->release = flow->release + (part - late);
    s->late = s->late + late;
    flow->wanted = flow->wanted + hoisting_gantry_lack(s, part, cell->foreseen[later]);
    hoisting_gantry_leave(s, flow, part, ahead, s->next[later] <= s->head);
}

/* Move the pointers of the later taps by a tick; each passes 2 cells at most. */
static void hoisting_gantry_pass(hoisting_gantry_shaper_t *s, hoisting_gantry_flow_t *flow)
{
    const uint32_t first = hoisting_gantry_FIRST_TAP[s->row] + 1u;
    const uint32_t end = hoisting_gantry_FIRST_TAP[s->row + 1u];
    uint32_t tap;
    for (tap = first; tap < end; ++tap) {
        const uint32_t later = tap - first;
        uint32_t ahead = s->ahead[later];
        while (ahead < s->quanta) {
            const hoisting_gantry_shaper_cell_t *const cell = &s->ring[s->next[later]];
            if (!hoisting_gantry_is_zero(cell->part[later])) {
                hoisting_gantry_release(s, flow, later, ahead);
            }
            ahead += cell->gap;
            s->next[later] = (s->next[later] >= hoisting_gantry_LAST_CELL) ? 0u : (s->next[later] + 1u);
        }
        s->ahead[later] = ahead - s->quanta;
    }
}

/* Lean away from the largest command where the command is next to it and does not shrink: only down, not up. */
static hoisting_gantry_real_t hoisting_gantry_lean(const hoisting_gantry_shaper_t *s, hoisting_gantry_real_t change, hoisting_gantry_real_t wanted)
{
    const hoisting_gantry_real_t size = (wanted < 0.0) ? -wanted : wanted;
    hoisting_gantry_real_t lean = 0.0;
    if ((s->base > hoisting_gantry_LEANING_FROM) && (change >= 0.0)) {
        lean = -size;
    } else if ((s->base < -hoisting_gantry_LEANING_FROM) && (change <= 0.0)) {
        lean = size;
    } else {
        /* there is room up and down */
    }
    return lean;
}

/* Write a cell; returns the part of the first tap, which is what the others leave. */
static hoisting_gantry_real_t hoisting_gantry_push(hoisting_gantry_shaper_t *s, const hoisting_gantry_flow_t *flow, hoisting_gantry_real_t change)
{
    const uint32_t first = hoisting_gantry_FIRST_TAP[s->row] + 1u;
    const uint32_t end = hoisting_gantry_FIRST_TAP[s->row + 1u];
    const bool changes = !(hoisting_gantry_is_zero(change) && hoisting_gantry_is_zero(flow->wanted));
    hoisting_gantry_shaper_cell_t *const cell = &s->ring[s->head];
    hoisting_gantry_real_t direct = change;
    hoisting_gantry_real_t moment = 0.0;
    uint32_t tap;
    cell->gap = s->quanta;
    if (changes) {
        s->still_quanta = 0u;
        if (!s->weighed) {
            hoisting_gantry_weigh(s);
            s->weighed = true;
        }
    }
    for (tap = first; tap < end; ++tap) {
        const uint32_t later = tap - first;
        const hoisting_gantry_real_t part = changes ? hoisting_gantry_part(flow, change, s->weight[later], tap) : 0.0;
        cell->part[later] = part;
        cell->foreseen[later] = s->foreseen[later];
        direct = direct - part;
        moment = moment + (part * (hoisting_gantry_real_t)hoisting_gantry_LAG_QUANTA[tap]);
    }
    hoisting_gantry_enter(s, flow, change - direct, moment);
    return direct;
}

/* Shape one new command. */
static hoisting_gantry_real_t hoisting_gantry_run(hoisting_gantry_shaper_t *s, hoisting_gantry_real_t command)
{
    hoisting_gantry_flow_t flow;
    hoisting_gantry_real_t kick;
    hoisting_gantry_real_t change;
    if (!s->running) {
        hoisting_gantry_leave_rest(s);
    }
    s->head = (s->head >= hoisting_gantry_LAST_CELL) ? 0u : (s->head + 1u);
    flow.release = s->late;
    flow.wanted = 0.0;
    flow.passed = 0.0;
    flow.fresh_passed = 0.0;
    s->late = 0.0;
    hoisting_gantry_pass(s, &flow);
    change = hoisting_gantry_arrived(s, command);
    kick = hoisting_gantry_kick(s);
    flow.wanted = kick + flow.wanted;
    flow.lean = hoisting_gantry_lean(s, change, flow.wanted);
    flow.release = flow.release + hoisting_gantry_push(s, &flow, change);
    /* The swing beside the reference knows nothing of the kick, so it is not shown what undoes it. */
    hoisting_gantry_swing(s, flow.release - kick);
    s->level = s->level + flow.release;
    return hoisting_gantry_reference(s);
}

/* Clamp the command to the maximum; a command that is not finite becomes 0, and the result is false. */
static bool hoisting_gantry_finite(hoisting_gantry_shaper_t *s, hoisting_gantry_real_t *command)
{
    const hoisting_gantry_real_t magnitude = hoisting_gantry_abs(*command);
    bool valid = true;
    if (!(magnitude <= hoisting_gantry_MAX_COMMAND)) {
        /* Only what is finite and not 0 shrinks when halved. */
        if ((magnitude * 0.5) < magnitude) {
            *command = (*command > 0.0) ? hoisting_gantry_MAX_COMMAND : -hoisting_gantry_MAX_COMMAND;
            s->status |= HOISTING_GANTRY_SHAPER_COMMAND_CLAMPED;
        } else {
            *command = 0.0;
            valid = false;
        }
    }
    return valid;
}

/* The command as far as it is finite, within the maximum. */
static hoisting_gantry_real_t hoisting_gantry_checked(hoisting_gantry_shaper_t *s, hoisting_gantry_real_t wanted)
{
    hoisting_gantry_real_t command = wanted;
    const bool valid = hoisting_gantry_finite(s, &command);
    s->zero_commanded = valid && hoisting_gantry_equal(command, 0.0);
    if (!valid) {
        s->invalid = true;
    } else if (s->zero_commanded) {
        s->invalid = false;
    } else {
        /* latched as it is */
    }
    if (s->invalid) {
        s->status |= HOISTING_GANTRY_SHAPER_COMMAND_INVALID;
    }
    return (s->invalid || s->zero_commanded) ? 0.0 : hoisting_gantry_on_grid(command);
}

/* The row that the selector and enable ask for; an invalid selector keeps the last valid one. */
static void hoisting_gantry_want_row(hoisting_gantry_shaper_t *s, const hoisting_gantry_shaper_input_t *input)
{
    const uint8_t before = s->wanted_row;
    if (input->selector <= (uint8_t)HOISTING_GANTRY_SHAPER_ROWS) {
        s->selected_row = input->selector;
    } else {
        s->status |= HOISTING_GANTRY_SHAPER_SELECTOR_INVALID;
    }
    s->wanted_row = s->selected_row;
    if (!input->enable) {
        s->status |= HOISTING_GANTRY_SHAPER_DISABLED;
        s->wanted_row = 0u;
    }
    if (s->wanted_row != before) {
        s->foretold = false;
    }
}

/* Stops latch until they are released and the command is 0, a quick stop also until the reference is. */
static void hoisting_gantry_latch_stops(hoisting_gantry_shaper_t *s, const hoisting_gantry_shaper_input_t *input)
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
    } else if (s->zero_commanded && hoisting_gantry_equal(s->reference, 0.0)) {
        s->quick = false;
    } else {
        /* latched as it is */
    }
}

static bool hoisting_gantry_settled(const hoisting_gantry_shaper_t *s)
{
    return s->still_quanta >= hoisting_gantry_LAST_QUANTA;
}

/* One tick further up: grows by the acceleration, shrinks by the deceleration, passes 0 by no more of either. */
static hoisting_gantry_real_t hoisting_gantry_raised(hoisting_gantry_real_t command)
{
    hoisting_gantry_real_t reach;
    if (command >= 0.0) {
        reach = hoisting_gantry_on_grid(command) + hoisting_gantry_ACCELERATION.step;
    } else {
        reach = command + hoisting_gantry_DECELERATION.step;
        if (reach > hoisting_gantry_ACCELERATION.step) {
            reach = hoisting_gantry_ACCELERATION.step;
        }
    }
    return reach;
}

/* One tick further down, likewise. */
static hoisting_gantry_real_t hoisting_gantry_lowered(hoisting_gantry_real_t command)
{
    hoisting_gantry_real_t reach;
    if (command <= 0.0) {
        reach = hoisting_gantry_on_grid(command) - hoisting_gantry_ACCELERATION.step;
    } else {
        reach = command - hoisting_gantry_DECELERATION.step;
        if (reach < -hoisting_gantry_ACCELERATION.step) {
            reach = -hoisting_gantry_ACCELERATION.step;
        }
    }
    return reach;
}

/* The command one tick nearer to its target. */
static hoisting_gantry_real_t hoisting_gantry_ramped(hoisting_gantry_real_t command, hoisting_gantry_real_t target)
{
    hoisting_gantry_real_t reach = target;
    if (target > command) {
        reach = hoisting_gantry_raised(command);
        if (reach > target) {
            reach = target;
        }
    } else if (target < command) {
        reach = hoisting_gantry_lowered(command);
        if (reach < target) {
            reach = target;
        }
    } else {
        /* there already */
    }
    return reach;
}

/* Take the reference to 0 and what is pending with it: the shaper rests at the reference. */
static void hoisting_gantry_stop(hoisting_gantry_shaper_t *s)
{
    const hoisting_gantry_real_t reach = hoisting_gantry_abs(s->reference) - hoisting_gantry_QUICK_STOP.step;
    if (s->emergency || (reach <= 0.0)) {
        s->reference = 0.0;
        s->still_quanta = hoisting_gantry_LAST_QUANTA;
    } else {
        s->reference = (s->reference > 0.0) ? reach : -reach;
        s->still_quanta = 0u;
    }
    s->command = s->reference;
    s->target = s->reference;
    s->foretold = false;
    hoisting_gantry_rest(s, s->reference);
}

/* The command becomes the target. */
static void hoisting_gantry_accept(hoisting_gantry_shaper_t *s, hoisting_gantry_real_t command)
{
    hoisting_gantry_real_t wanted = command;
    s->target = wanted;
}

/* Choose the row when settled; ramp, then shape. */
static void hoisting_gantry_move(hoisting_gantry_shaper_t *s, hoisting_gantry_real_t command)
{
    const hoisting_gantry_real_t before = s->command;
    if (hoisting_gantry_settled(s)) {
        s->row = s->wanted_row;
    }
    hoisting_gantry_accept(s, command);
    s->command = hoisting_gantry_ramped(s->command, s->target);
    if (!hoisting_gantry_equal(s->command, before)) {
        s->still_quanta = 0u;
        s->foretold = false;
    } else if (!hoisting_gantry_settled(s)) {
        hoisting_gantry_count_still(s);
    } else {
        /* settled as it is */
    }
    if (s->still_quanta >= hoisting_gantry_TAIL_QUANTA[s->row]) {
        hoisting_gantry_rest(s, s->command);
        s->reference = s->command;
    } else {
        s->reference = hoisting_gantry_run(s, s->command);
    }
}

/* A ramp that does not pass 0, in closed form; as exact as the ramp, so never a tick off. */
static hoisting_gantry_glide_t hoisting_gantry_glide(hoisting_gantry_real_t start, hoisting_gantry_real_t target, const hoisting_gantry_ramp_t *ramp)
{
    hoisting_gantry_glide_t glide = { 0.0, 0u };
    if (!hoisting_gantry_equal(start, target)) {
        const hoisting_gantry_real_t from = (hoisting_gantry_abs(target) > hoisting_gantry_abs(start)) ? hoisting_gantry_on_grid(start) : start;
        const bool falls = from > target;
        const hoisting_gantry_real_t step = falls ? -ramp->step : ramp->step;
        const hoisting_gantry_real_t steps = (hoisting_gantry_abs(from - target) * ramp->steps_per_unit) + 0.5;
        uint32_t whole = (uint32_t)steps; /* the nearest; one too many if it has landed */
        const hoisting_gantry_real_t position = from + ((hoisting_gantry_real_t)whole * step);
        const bool landed = falls ? (position <= target) : (position >= target);
        hoisting_gantry_real_t count;
        if (landed && (whole > 0u)) {
            whole -= 1u;
        }
        count = (hoisting_gantry_real_t)whole;
        glide.total = ((count * from) + (step * ((count * (count + 1.0)) * 0.5))) + target;
        glide.ticks = whole + 1u;
    }
    return glide;
}

static hoisting_gantry_real_t hoisting_gantry_distance(hoisting_gantry_real_t total)
{
    return total * hoisting_gantry_METRES_PER_UNIT_TICK;
}

static hoisting_gantry_real_t hoisting_gantry_time_s(uint32_t ticks)
{
    return (hoisting_gantry_real_t)ticks * hoisting_gantry_TICK_S;
}

/* The row that takes over if the command becomes 0 when settled. */
static uint8_t hoisting_gantry_row_at_rest(const hoisting_gantry_shaper_t *s)
{
    return s->wanted_row;
}

/* A stop at once: the ramp goes down and the taps run out. */
static hoisting_gantry_glide_t hoisting_gantry_foretell_release(const hoisting_gantry_shaper_t *s)
{
    const uint8_t row = hoisting_gantry_settled(s) ? hoisting_gantry_row_at_rest(s) : s->row;
    const uint32_t tail = hoisting_gantry_TAIL_QUANTA[row];
    hoisting_gantry_glide_t stop = hoisting_gantry_glide(s->command, 0.0, &hoisting_gantry_DECELERATION);
    stop.total = hoisting_gantry_pending(s, row) + stop.total;
    if (stop.ticks > 0u) {
        stop.ticks += hoisting_gantry_ticks_of(s, tail);
    } else if (tail > s->still_quanta) {
        stop.ticks = hoisting_gantry_ticks_of(s, tail - s->still_quanta);
    } else {
        /* at rest */
    }
    return stop;
}

/* Sum of the references to come, and ticks until the last, if the command is 0 from the next tick on. */
static hoisting_gantry_glide_t hoisting_gantry_foretell(const hoisting_gantry_shaper_t *s)
{
    hoisting_gantry_glide_t stop = { 0.0, 0u };
    if (s->emergency) {
        /* stopped */
    } else if (s->quick) {
        stop = hoisting_gantry_glide(s->reference, 0.0, &hoisting_gantry_QUICK_STOP);
    } else {
        stop = hoisting_gantry_foretell_release(s);
    }
    return stop;
}

static bool hoisting_gantry_stopped(const hoisting_gantry_shaper_t *s)
{
    return s->emergency || s->quick;
}

static uint32_t hoisting_gantry_full_status(const hoisting_gantry_shaper_t *s)
{
    uint32_t status = s->status;
    if (s->row == 0u) {
        status |= HOISTING_GANTRY_SHAPER_UNSHAPED;
    }
    if ((s->row != s->wanted_row)) {
        status |= HOISTING_GANTRY_SHAPER_ROW_WAITS;
    }
    if (s->quick) {
        status |= HOISTING_GANTRY_SHAPER_QUICK_STOP;
    }
    if (s->emergency) {
        status |= HOISTING_GANTRY_SHAPER_EMERGENCY_STOP;
    }
    return status;
}

/* Whether the last tick began and ended settled and this one has the same inputs: then nothing can change. */
static bool hoisting_gantry_idles(const hoisting_gantry_shaper_t *s, const hoisting_gantry_shaper_input_t *input)
{
    return s->idle && hoisting_gantry_equal(input->command, s->input.command) && (input->selector == s->input.selector)
        && (input->enable == s->input.enable) && (input->quick_stop == s->input.quick_stop)
        && s->rope_still && hoisting_gantry_equal(input->rope_length_m, s->input.rope_length_m)
        && hoisting_gantry_equal(input->hoist_speed_m_s, s->input.hoist_speed_m_s)
        && (input->rope_length_valid == s->input.rope_length_valid)
        && (input->emergency_stop == s->input.emergency_stop);
}

/* Run one tick into s->output. */
static void hoisting_gantry_tick(hoisting_gantry_shaper_t *s, const hoisting_gantry_shaper_input_t *input)
{
    const bool began_settled = hoisting_gantry_settled(s);
    hoisting_gantry_shaper_output_t *const output = &s->output;
    hoisting_gantry_real_t command;
    uint8_t row;

    s->status = 0u;
    hoisting_gantry_read_rope(s, input);
    hoisting_gantry_turn(s);
    command = hoisting_gantry_checked(s, input->command);
    hoisting_gantry_want_row(s, input);
    hoisting_gantry_latch_stops(s, input);
    if (hoisting_gantry_stopped(s)) {
        hoisting_gantry_stop(s);
    } else {
        hoisting_gantry_move(s, command);
    }

    if (!s->foretold) {
        const hoisting_gantry_glide_t stop = hoisting_gantry_foretell(s);
        output->stop_distance = hoisting_gantry_distance(stop.total);
        output->stop_time_s = hoisting_gantry_time_s(stop.ticks);
        output->stop_time_ticks = stop.ticks;
        s->foretold = hoisting_gantry_settled(s) && !hoisting_gantry_stopped(s);
    }
    row = hoisting_gantry_stopped(s) ? 0u : s->row;
    output->reference = s->reference;
    output->residual_bound = hoisting_gantry_RESIDUAL_BOUND[row];
    output->row = s->row;
    output->settled = hoisting_gantry_settled(s);
    output->active = (row > 0u);
    output->error = ((s->status & (HOISTING_GANTRY_SHAPER_COMMAND_INVALID
        | HOISTING_GANTRY_SHAPER_SELECTOR_INVALID
        | HOISTING_GANTRY_SHAPER_ROPE_INVALID
        | HOISTING_GANTRY_SHAPER_ROPE_JUMP
        | HOISTING_GANTRY_SHAPER_ROPE_FROZEN
        | HOISTING_GANTRY_SHAPER_HOIST_SPEED_INVALID)) != 0u);
    output->status = hoisting_gantry_full_status(s);
    s->input = *input;
    s->idle = began_settled && s->foretold;
}

void hoisting_gantry_shaper_init(hoisting_gantry_shaper_t *shaper)
{
    hoisting_gantry_shaper_t *const s = shaper;
    s->level = 0.0;
    s->late = 0.0;
    s->mass = 0.0;
    s->moment = 0.0;
    s->place = 0.0;
    s->pace = 0.0;
    s->rate = 0.0;
    s->fresh = 0.0;
    s->fresh_mass = 0.0;
    s->inverse = 7.137580431609489e-07;
    s->answered = 0.0;
    s->quanta = 1401035u;
    s->weighed = false;
    s->elapsed_quanta = 1401035u;
    s->base = 0.0;
    s->target = 0.0;
    s->command = 0.0;
    s->reference = 0.0;
    s->unmoved = 0.0;
    s->rope_length = 9.0;
    s->hoist_speed = 0.0;
    s->held_ticks = 0u;
    s->head = 603u;
    s->still_quanta = 843314857u;
    s->status = 0u;
    s->row = 0u;
    s->selected_row = 0u;
    s->wanted_row = 0u;
    s->running = false;
    s->foretold = false;
    s->idle = false;
    s->zero_commanded = false;
    s->invalid = false;
    s->quick = false;
    s->emergency = false;
    s->rope_still = false;
    /* The ring, the last inputs and the last outputs are not read before they are written. */
}

void hoisting_gantry_shaper_step(hoisting_gantry_shaper_t *shaper, const hoisting_gantry_shaper_input_t *input,
    hoisting_gantry_shaper_output_t *output)
{
    if (!hoisting_gantry_idles(shaper, input)) {
        hoisting_gantry_tick(shaper, input);
    }
    *output = shaper->output;
}
