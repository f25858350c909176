/*
 * two_axis_crane_bridge: command shaper, see two_axis_crane_bridge_shaper.h.
 * Design SHA-256 8f806e116b33e31d8e5224fbc2ff931df2d44d459ae074c617006cf0e4d40640.
 */
#include "two_axis_crane_bridge_shaper.h"

#if (TWO_AXIS_CRANE_BRIDGE_SHAPER_DESIGN != 0x8f806e11u)
#error "two_axis_crane_bridge_shaper.h and two_axis_crane_bridge_shaper.c belong to different designs"
#endif

/* Does not compile when the state is larger than the header says. */
typedef char two_axis_crane_bridge_ram_check[(sizeof(two_axis_crane_bridge_shaper_t) <= (unsigned)TWO_AXIS_CRANE_BRIDGE_SHAPER_RAM) ? 1 : -1];

static const uint32_t two_axis_crane_bridge_LAST_TICKS = 500u; /* longest delay of any row */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_MAX_COMMAND = 1.0; /* m/s: max_speed */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_RAMP_ANCHOR = 2.0; /* floats next to it are the grid of ramp steps */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_METRES_PER_UNIT_TICK = 0.01; /* m of way per unit and tick */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_TICK_S = 0.01; /* s: tick */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_SHORTEST_ROPE = 3.0; /* m: rope_length */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_LONGEST_ROPE = 9.0; /* m: rope_length */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_HOIST_SPEED = 0.25; /* m/s: hoist_speed */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_ROPE_JUMP = 0.05; /* m: difference of two readings that is always taken */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_ROPE_WAY_PER_TICK = 0.0025; /* m: hoist_speed times tick */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_ROPE_TICK = 0.01; /* s: tick */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_FROZEN_WAY = 0.05; /* m: a length that stays so long is frozen */
static const uint32_t two_axis_crane_bridge_MOST_HELD_TICKS = 1048576u; /* by then the hoist may be anywhere */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_SLOW_COMMAND = 0.09999999999999964; /* m/s: slow_speed */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_LEAST_OFFSET = 0.0; /* m: rope_offset */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_MOST_OFFSET = 2.0; /* m: rope_offset */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_GENTLE_STEP = 0.002500000000000391; /* m/s per tick: a step up that a deceleration can undo */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_WAY_MARGIN = 0.5; /* m: kept free before each end */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_FARTHEST_WAY = 34.0; /* m: longer than any stop, and counts for all longer ones */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_WAY_SCALE = 100.0; /* units times ticks per m */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_MOST_WAY = 3400.0; /* units times ticks: the farthest way */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_LEAST_WAY = 1.0; /* units times ticks: least way worth leaving rest for */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_STEP_SIZE_1 = 5.0; /* units times ticks: way of a step */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_STEP_SIZE_2 = 10.0; /* units times ticks: way of a step */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_STEP_SIZE_3 = 25.0; /* units times ticks: way of a step */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_STEP_CAPACITY = 400.0; /* units times ticks: most pressed, not yet travelled */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_STEP_ROUNDING = 2.2453150450015597e-13; /* units times ticks: more than a ramp to rest misses by rounding */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_STEP_COMMAND = 0.19999999999999973; /* m/s: largest command of a step */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_TRACKING_TOLERANCE = 0.0666666666667; /* m/s: tracking_tolerance */
static const uint32_t two_axis_crane_bridge_TRACKING_TICKS = 50u; /* how long the drive may be outside */
static const uint32_t two_axis_crane_bridge_WINDOW_TICKS = 21u; /* references that count as followed */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_LARGEST_SWAY = 8.0; /* where the linear model ends */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_FORGOTTEN_SWAY = 5.960464477539063e-08; /* a smaller swing counts as none */
static const uint32_t two_axis_crane_bridge_LAST_SPAN = 193u; /* last span of the table of quanta */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_SPANS_PER_METRE = 32.333333333333336; /* spans of the table per m of rope */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_SWAY_QUANTUM = 7.450580596923828e-09; /* rad: turn of a quantum */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_SWAY_LOSS = 0.0; /* shrinking per rad of the turn */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_SWAY_HELD = 0.9999999999999982; /* kept of a turn without damping */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_SWAY_METRES = 1342177.28; /* m per unit of place, times quanta */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_SIXTH = 0.16666666666666666; /* 1 / 6, of the series of the sine */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_TWELFTH = 0.08333333333333333; /* 1 / 12, of the series of the cosine */

/* first tap of each row, and the end */
static const uint32_t two_axis_crane_bridge_FIRST_TAP[4] = {
    0u, 1u, 7u, 11u
};
/* delay of each tap, by row */
static const uint32_t two_axis_crane_bridge_DELAY_TICKS[11] = {
    0u,
    0u, 200u, 201u, 299u, 300u, 500u,
    0u, 155u, 156u, 311u
};
/* amplitude of each tap, by row; each row sums to exactly 1 */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_AMPLITUDE[11] = {
    1.0,
    0.236287898951, 0.25701275809400004, 0.006699342955999943, 0.006699342898999983, 0.25701275814900004, 0.236287898951,
    0.269676244649, 0.23032375535100003, 0.23032375535100003, 0.269676244649
};
/* longest delay of each row */
static const uint32_t two_axis_crane_bridge_TAIL_TICKS[3] = {
    0u, 500u, 311u
};
/* sum of amplitude times delay of each row: references to come per unit of a steady command */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_MOMENT_TICKS[3] = {
    0.0, 249.999999999957, 155.5
};
/* tolerance of each row */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_RESIDUAL_BOUND[3] = {
    1.0, 0.05, 0.05
};
/* m of rope: below it the next row is wanted */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_ROW_SHORTEST[3] = {
    0.0, 3.8916315473500003, 3.0
};
/* m of rope: above it the row before is wanted */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_ROW_LONGEST[3] = {
    0.0, 9.0, 3.99163154735
};
/* first piece of each row, and the end */
static const uint32_t two_axis_crane_bridge_FIRST_BOUND[3] = {
    0u, 33u, 66u
};
/* m of rope: where pieces begin */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_BOUND_START[66] = {
    3.0, 3.1388295412185654, 3.280799112035933, 3.4259087124521033,
    3.5741583424670758, 3.7255480020808505, 3.8800776912934265, 3.8916315473495198,
    4.037747410104805, 4.198557158514987, 4.36250693652397, 4.529596744131755,
    4.6998265813383435, 4.873196448143733, 5.049706344547925, 5.2293562705509204,
    5.412146226152717, 5.598076211353314, 5.787146226152717, 5.97935627055092,
    6.174706344547925, 6.373196448143734, 6.574826581338343, 6.779596744131754,
    6.98750693652397, 7.198557158514986, 7.412747410104804, 7.630077691293427,
    7.850548002080852, 8.074158342467074, 8.300908712452104, 8.530799112035934,
    8.763829541218565, 3.0, 3.1388295412185654, 3.280799112035933,
    3.4259087124521033, 3.5741583424670758, 3.7255480020808505, 3.8800776912934265,
    3.9916315473816177, 4.037747410104805, 4.198557158514987, 4.36250693652397,
    4.529596744131755, 4.6998265813383435, 4.873196448143733, 5.049706344547925,
    5.2293562705509204, 5.412146226152717, 5.598076211353314, 5.787146226152717,
    5.97935627055092, 6.174706344547925, 6.373196448143734, 6.574826581338343,
    6.779596744131754, 6.98750693652397, 7.198557158514986, 7.412747410104804,
    7.630077691293427, 7.850548002080852, 8.074158342467074, 8.300908712452104,
    8.530799112035934, 8.763829541218565
};
/* residual vibration that the row leaves at most on each */
static const two_axis_crane_bridge_real_t two_axis_crane_bridge_ROPE_BOUND[66] = {
    0.23603342805019487, 0.1979881251535525, 0.16277879219200278, 0.1305238327027875,
    0.10126463971583909, 0.0749829769316517, 0.051615374441057064, 0.05000090112600484,
    0.03106721199534042, 0.013217316311747307, 0.014939950548070315, 0.02554160420267185,
    0.03402825075240718, 0.0405508265840713, 0.04525697136984571, 0.04828952229324361,
    0.04978545587157449, 0.0500008529445949, 0.04987519748316828, 0.04868206680053513,
    0.04632243207754061, 0.04290518237165609, 0.03853201932425272, 0.03329787297201711,
    0.02729066915591565, 0.02059182629680183, 0.013276845864090886, 0.0054150279668050486,
    0.011699789102562542, 0.02083834538826743, 0.030297616512801034, 0.040032175161120065,
    0.05000078893593963, 0.04959727821128963, 0.03760136448484595, 0.024287761580510926,
    0.009901872179903909, 0.021264492165231325, 0.037699234506339996, 0.049597179436134044,
    0.05451153254058716, 0.0715842930613437, 0.08881570494740877, 0.1061197887931814,
    0.12342343536968561, 0.14066452567077292, 0.1577906909200157, 0.17475830657865585,
    0.19153083998848558, 0.2080781052565205, 0.22437572809360454, 0.24040368931376266,
    0.25614648827071657, 0.27159173484497634, 0.2867304053902549, 0.3015560786575432,
    0.3160642426506945, 0.3302527373508367, 0.3441205573553415, 0.357668434570566,
    0.37089826151592287, 0.3838125304705337, 0.39641493008059214, 0.4087096929616552,
    0.42070173129279986, 0.4323960196335089
};
/* quanta of phase in a tick, at equal steps from 3 to 9 m */
static const uint32_t two_axis_crane_bridge_TICK_QUANTA[195] = {
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

/* A ramp: its step per tick, rounded up to the grid, and what its closed form needs. */
typedef struct {
    two_axis_crane_bridge_real_t step;
    two_axis_crane_bridge_real_t steps_per_unit; /* 1 / step */
} two_axis_crane_bridge_ramp_t;

/* m/s per tick: acceleration */
static const two_axis_crane_bridge_ramp_t two_axis_crane_bridge_ACCELERATION = { 0.002500000000000391, 399.9999999999375 };
/* m/s per tick: deceleration */
static const two_axis_crane_bridge_ramp_t two_axis_crane_bridge_DECELERATION = { 0.002500000000000391, 399.9999999999375 };
/* m/s per tick: quick_stop */
static const two_axis_crane_bridge_ramp_t two_axis_crane_bridge_QUICK_STOP = { 0.0050000000000003375, 199.9999999999865 };

/* What a ramp still has to do: ticks, and the sum of the commands of those ticks. */
typedef struct {
    two_axis_crane_bridge_real_t total;
    uint32_t ticks;
} two_axis_crane_bridge_glide_t;

static two_axis_crane_bridge_real_t two_axis_crane_bridge_abs(two_axis_crane_bridge_real_t value)
{
    return (value < 0.0) ? -value : value;
}

static bool two_axis_crane_bridge_equal(two_axis_crane_bridge_real_t a, two_axis_crane_bridge_real_t b)
{
    return (a <= b) && (a >= b);
}

/* Round a command to the grid of ramp steps: from there on a ramp adds exactly. */
static two_axis_crane_bridge_real_t two_axis_crane_bridge_on_grid(two_axis_crane_bridge_real_t command)
{
    const two_axis_crane_bridge_real_t anchor = (command < 0.0) ? -two_axis_crane_bridge_RAMP_ANCHOR : two_axis_crane_bridge_RAMP_ANCHOR;
    return (command + anchor) - anchor;
}

/* Whether commands within reach of the taps may differ. */
static bool two_axis_crane_bridge_running(const two_axis_crane_bridge_shaper_t *s)
{
    return s->lapped || (s->head < two_axis_crane_bridge_LAST_TICKS);
}

/* Rest at a command: within reach of the taps all commands equal it. */
static void two_axis_crane_bridge_rest(two_axis_crane_bridge_shaper_t *s, two_axis_crane_bridge_real_t command)
{
    s->base = command;
    s->head = two_axis_crane_bridge_LAST_TICKS;
    s->lapped = false;
}

/* Sum of the references still to come at rest at a command. */
static two_axis_crane_bridge_real_t two_axis_crane_bridge_rest_sum(two_axis_crane_bridge_real_t command, uint8_t row)
{
    return command * two_axis_crane_bridge_MOMENT_TICKS[row];
}

/* Shape one new command. */
static two_axis_crane_bridge_real_t two_axis_crane_bridge_run(two_axis_crane_bridge_shaper_t *s, two_axis_crane_bridge_real_t command)
{
    const uint32_t first = two_axis_crane_bridge_FIRST_TAP[s->row];
    const uint32_t end = two_axis_crane_bridge_FIRST_TAP[s->row + 1u];
    two_axis_crane_bridge_real_t reference = 0.0;
    two_axis_crane_bridge_real_t lap = 0.0; /* the part of this lap's commands */
    two_axis_crane_bridge_real_t low = -two_axis_crane_bridge_MAX_COMMAND;
    two_axis_crane_bridge_real_t high = two_axis_crane_bridge_MAX_COMMAND;
    uint32_t i;

    if (!two_axis_crane_bridge_running(s)) {
        s->pending = two_axis_crane_bridge_rest_sum(s->base, s->row);
        s->fresh = 0.0;
    }
    s->head = (s->head >= two_axis_crane_bridge_LAST_TICKS) ? 0u : (s->head + 1u);
    s->ring[s->head] = command;
    for (i = first; i < end; ++i) {
        const uint32_t delay = two_axis_crane_bridge_DELAY_TICKS[i];
        if (delay <= s->head) {
            reference = reference + (two_axis_crane_bridge_AMPLITUDE[i] * s->ring[s->head - delay]);
            lap = reference;
        } else if (s->lapped) {
            const uint32_t older = s->head + ((two_axis_crane_bridge_LAST_TICKS + 1u) - delay);
            reference = reference + (two_axis_crane_bridge_AMPLITUDE[i] * s->ring[older]);
        } else {
            reference = reference + (two_axis_crane_bridge_AMPLITUDE[i] * s->base);
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
    if (s->head >= two_axis_crane_bridge_LAST_TICKS) {
        /* A full lap knows every command within reach: its sum ends the rounding of the older one. */
        s->pending = s->fresh;
        s->fresh = 0.0;
        s->lapped = true;
    }
    return reference;
}

/* Sum of the references still to come if every later command is 0. */
static two_axis_crane_bridge_real_t two_axis_crane_bridge_pending(const two_axis_crane_bridge_shaper_t *s, uint8_t row)
{
    return two_axis_crane_bridge_running(s) ? s->pending : two_axis_crane_bridge_rest_sum(s->base, row);
}

/* Whether a reading is a number: only what is finite and not 0 shrinks when halved. */
static bool two_axis_crane_bridge_is_number(two_axis_crane_bridge_real_t value)
{
    const two_axis_crane_bridge_real_t magnitude = two_axis_crane_bridge_abs(value);
    return two_axis_crane_bridge_equal(magnitude, 0.0) || ((magnitude * 0.5) < magnitude);
}

/* Value, but not below low, and not above high. */
static two_axis_crane_bridge_real_t two_axis_crane_bridge_within(two_axis_crane_bridge_real_t value, two_axis_crane_bridge_real_t low, two_axis_crane_bridge_real_t high)
{
    two_axis_crane_bridge_real_t result = value;
    if (result < low) {
        result = low;
    }
    if (result > high) {
        result = high;
    }
    return result;
}

/* A rope length with its offset. */
static two_axis_crane_bridge_real_t two_axis_crane_bridge_with_offset(const two_axis_crane_bridge_shaper_t *s, two_axis_crane_bridge_real_t reading)
{
    return reading + s->rope_offset;
}

static void two_axis_crane_bridge_hold_rope(two_axis_crane_bridge_shaper_t *s)
{
    if (s->held_ticks < two_axis_crane_bridge_MOST_HELD_TICKS) {
        s->held_ticks += 1u;
    }
}

/* Take a rope length where it can be true; otherwise the last one holds. At rest every length can. */
static void two_axis_crane_bridge_take_length(two_axis_crane_bridge_shaper_t *s, two_axis_crane_bridge_real_t reading)
{
    const two_axis_crane_bridge_real_t clamped = two_axis_crane_bridge_within(reading, two_axis_crane_bridge_SHORTEST_ROPE, two_axis_crane_bridge_LONGEST_ROPE);
    const two_axis_crane_bridge_real_t reach = two_axis_crane_bridge_ROPE_JUMP + ((two_axis_crane_bridge_real_t)(s->held_ticks + 1u) * two_axis_crane_bridge_ROPE_WAY_PER_TICK);
    if (!two_axis_crane_bridge_equal(clamped, reading)) {
        s->status |= TWO_AXIS_CRANE_BRIDGE_SHAPER_ROPE_OUT_OF_RANGE;
    }
    if (!two_axis_crane_bridge_running(s) || (two_axis_crane_bridge_abs(clamped - s->rope_length) <= reach)) {
        s->rope_length = clamped;
        s->held_ticks = 0u;
    } else {
        s->status |= TWO_AXIS_CRANE_BRIDGE_SHAPER_ROPE_JUMP;
        two_axis_crane_bridge_hold_rope(s);
    }
}

/* Watch for a length that stays, within the range, while the hoist says that it moves. */
static void two_axis_crane_bridge_watch_rope(two_axis_crane_bridge_shaper_t *s, two_axis_crane_bridge_real_t before)
{
    const bool inside = (two_axis_crane_bridge_SHORTEST_ROPE < s->rope_length) && (s->rope_length < two_axis_crane_bridge_LONGEST_ROPE);
    if (!inside || !two_axis_crane_bridge_equal(s->rope_length, before) || two_axis_crane_bridge_equal(s->hoist_speed, 0.0)) {
        s->unmoved = 0.0;
    } else {
        s->unmoved = s->unmoved + ((two_axis_crane_bridge_real_t)two_axis_crane_bridge_abs(s->hoist_speed) * two_axis_crane_bridge_ROPE_TICK);
        if (s->unmoved >= two_axis_crane_bridge_FROZEN_WAY) {
            s->unmoved = two_axis_crane_bridge_FROZEN_WAY;
            s->status |= TWO_AXIS_CRANE_BRIDGE_SHAPER_ROPE_FROZEN;
        }
    }
}

/* Read the rope, and see whether the same reading would change nothing once more. */
static void two_axis_crane_bridge_read_rope(two_axis_crane_bridge_shaper_t *s, const two_axis_crane_bridge_shaper_input_t *input)
{
    const two_axis_crane_bridge_real_t before = s->rope_length;
    const two_axis_crane_bridge_real_t reading = two_axis_crane_bridge_with_offset(s, input->rope_length_m);
    if (two_axis_crane_bridge_is_number(input->hoist_speed_m_s)) {
        s->hoist_speed = two_axis_crane_bridge_within(input->hoist_speed_m_s, -two_axis_crane_bridge_HOIST_SPEED, two_axis_crane_bridge_HOIST_SPEED);
    } else {
        s->hoist_speed = 0.0;
        s->status |= TWO_AXIS_CRANE_BRIDGE_SHAPER_HOIST_SPEED_INVALID;
    }
    if (input->rope_length_valid && two_axis_crane_bridge_is_number(reading)) {
        two_axis_crane_bridge_take_length(s, reading);
    } else {
        s->status |= TWO_AXIS_CRANE_BRIDGE_SHAPER_ROPE_INVALID;
        two_axis_crane_bridge_hold_rope(s);
    }
    two_axis_crane_bridge_watch_rope(s, before);
    s->rope_still = (s->held_ticks == 0u) && two_axis_crane_bridge_equal(s->rope_length, before)
        && ((s->unmoved <= 0.0) || (s->unmoved >= two_axis_crane_bridge_FROZEN_WAY));
}

/* The row of the rope: it stays as long as the length is its own. */
static void two_axis_crane_bridge_follow_rope(two_axis_crane_bridge_shaper_t *s)
{
    while ((s->rope_row < (uint8_t)TWO_AXIS_CRANE_BRIDGE_SHAPER_ROWS) && (s->rope_length < two_axis_crane_bridge_ROW_SHORTEST[s->rope_row])) {
        s->rope_row = (uint8_t)(s->rope_row + 1u);
    }
    while ((s->rope_row > 1u) && (s->rope_length > two_axis_crane_bridge_ROW_LONGEST[s->rope_row])) {
        s->rope_row = (uint8_t)(s->rope_row - 1u);
    }
}

/* A reading brought into a range; one that is not a number counts as 0. */
static two_axis_crane_bridge_real_t two_axis_crane_bridge_clamped_reading(two_axis_crane_bridge_real_t reading, two_axis_crane_bridge_real_t low, two_axis_crane_bridge_real_t high)
{
    two_axis_crane_bridge_real_t result = 0.0;
    if (two_axis_crane_bridge_is_number(reading)) {
        /* A lower end of 0 is never -0. */
        result = (reading <= low) ? low : two_axis_crane_bridge_within(reading, low, high);
    }
    return result;
}

/* Take the largest command from now on. */
static void two_axis_crane_bridge_read_speed_limit(two_axis_crane_bridge_shaper_t *s, const two_axis_crane_bridge_shaper_input_t *input)
{
    const two_axis_crane_bridge_real_t limit = two_axis_crane_bridge_clamped_reading(input->speed_limit, 0.0, two_axis_crane_bridge_MAX_COMMAND);
    if (!two_axis_crane_bridge_equal(limit, input->speed_limit)) {
        s->status |= TWO_AXIS_CRANE_BRIDGE_SHAPER_SPEED_LIMIT_INVALID;
    }
    s->speed_limit = limit;
}

/* A command within the speed limit. */
static two_axis_crane_bridge_real_t two_axis_crane_bridge_limited(const two_axis_crane_bridge_shaper_t *s, two_axis_crane_bridge_real_t command)
{
    return two_axis_crane_bridge_within(command, 0.0 - s->speed_limit, s->speed_limit);
}

/* Take what is added to the measured rope length. */
static void two_axis_crane_bridge_read_rope_offset(two_axis_crane_bridge_shaper_t *s, const two_axis_crane_bridge_shaper_input_t *input)
{
    const two_axis_crane_bridge_real_t wanted = input->rope_offset_m;
    s->rope_offset = two_axis_crane_bridge_clamped_reading(wanted, two_axis_crane_bridge_LEAST_OFFSET, two_axis_crane_bridge_MOST_OFFSET);
    if (!two_axis_crane_bridge_equal(s->rope_offset, wanted)) {
        s->status |= TWO_AXIS_CRANE_BRIDGE_SHAPER_ROPE_OFFSET_INVALID;
    }
}

/* A drive that is not ready holds the reference at 0; ready again, it goes on from its speed, by a quick stop. */
static void two_axis_crane_bridge_watch_drive(two_axis_crane_bridge_shaper_t *s, const two_axis_crane_bridge_shaper_input_t *input)
{
    const bool returns = s->drive_off && input->drive_ready;
    s->drive_off = !input->drive_ready;
    if (returns) {
        s->quick = true;
        s->reference = two_axis_crane_bridge_clamped_reading(input->actual_speed, -two_axis_crane_bridge_MAX_COMMAND, two_axis_crane_bridge_MAX_COMMAND);
    }
}

/* Whether a reference, or a sum of them, leads towards a made stop switch. */
static bool two_axis_crane_bridge_shut(const two_axis_crane_bridge_shaper_t *s, two_axis_crane_bridge_real_t value)
{
    return (s->shut_forward && (value > 0.0)) || (s->shut_reverse && (value < 0.0));
}

/* Whether the motion, or what is pending at a reference of 0, leads towards a made stop switch. */
static bool two_axis_crane_bridge_hit(const two_axis_crane_bridge_shaper_t *s)
{
    two_axis_crane_bridge_real_t motion = s->reference;
    if ((s->shut_forward || s->shut_reverse) && two_axis_crane_bridge_equal(s->reference, 0.0)) {
        motion = two_axis_crane_bridge_pending(s, s->row);
    }
    return two_axis_crane_bridge_shut(s, motion);
}

/* Take the switches of a tick, and leave of a command what they allow. */
static two_axis_crane_bridge_real_t two_axis_crane_bridge_switched(two_axis_crane_bridge_shaper_t *s, const two_axis_crane_bridge_shaper_input_t *input, two_axis_crane_bridge_real_t command)
{
    two_axis_crane_bridge_real_t allowed = command;
    s->most_forward = input->slow_forward ? two_axis_crane_bridge_SLOW_COMMAND : two_axis_crane_bridge_MAX_COMMAND;
    s->most_reverse = input->slow_reverse ? two_axis_crane_bridge_SLOW_COMMAND : two_axis_crane_bridge_MAX_COMMAND;
    if (command > s->most_forward) {
        allowed = s->most_forward;
    } else if (command < -s->most_reverse) {
        allowed = -s->most_reverse;
    } else {
        /* slow enough */
    }
    s->shut_forward = input->stop_forward;
    s->shut_reverse = input->stop_reverse;
    if (s->shut_forward || s->shut_reverse) {
        s->status |= TWO_AXIS_CRANE_BRIDGE_SHAPER_STOP_SWITCH;
    }
    /* A command towards a made switch does nothing until it was 0 or pointed away, even if the switch opens. */
    s->locked_forward = (command > 0.0) && (s->locked_forward || s->shut_forward);
    s->locked_reverse = (command < 0.0) && (s->locked_reverse || s->shut_reverse);
    if (s->locked_forward || s->locked_reverse) {
        s->status |= TWO_AXIS_CRANE_BRIDGE_SHAPER_COMMAND_LOCKED;
        allowed = 0.0;
    } else if (!two_axis_crane_bridge_equal(allowed, command)) {
        s->status |= TWO_AXIS_CRANE_BRIDGE_SHAPER_SLOW_SWITCH;
    } else {
        /* as it is */
    }
    return allowed;
}

/* Clamp the command to the maximum; a command that is not finite becomes 0, and the result is false. */
static bool two_axis_crane_bridge_finite(two_axis_crane_bridge_shaper_t *s, two_axis_crane_bridge_real_t *command)
{
    const two_axis_crane_bridge_real_t magnitude = two_axis_crane_bridge_abs(*command);
    bool valid = true;
    if (!(magnitude <= two_axis_crane_bridge_MAX_COMMAND)) {
        /* Only what is finite and not 0 shrinks when halved. */
        if ((magnitude * 0.5) < magnitude) {
            *command = (*command > 0.0) ? two_axis_crane_bridge_MAX_COMMAND : -two_axis_crane_bridge_MAX_COMMAND;
            s->status |= TWO_AXIS_CRANE_BRIDGE_SHAPER_COMMAND_CLAMPED;
        } else {
            *command = 0.0;
            valid = false;
        }
    }
    return valid;
}

/* The command as far as it is finite, within the maximum. */
static two_axis_crane_bridge_real_t two_axis_crane_bridge_checked(two_axis_crane_bridge_shaper_t *s, two_axis_crane_bridge_real_t wanted)
{
    two_axis_crane_bridge_real_t command = wanted;
    const bool valid = two_axis_crane_bridge_finite(s, &command);
    s->zero_commanded = valid && two_axis_crane_bridge_equal(command, 0.0);
    if (!valid) {
        s->invalid = true;
    } else if (s->zero_commanded) {
        s->invalid = false;
    } else {
        /* latched as it is */
    }
    if (s->zero_commanded) {
        s->locked = false;
    }
    if (s->stepping && !s->zero_commanded) {
        s->locked = true;
    }
    if (s->locked) {
        s->status |= TWO_AXIS_CRANE_BRIDGE_SHAPER_COMMAND_LOCKED;
    }
    if (s->invalid) {
        s->status |= TWO_AXIS_CRANE_BRIDGE_SHAPER_COMMAND_INVALID;
    }
    return (s->invalid || s->locked || s->zero_commanded) ? 0.0 : command;
}

/* The row that the selector and enable ask for; an invalid selector keeps the last valid one. */
static void two_axis_crane_bridge_want_row(two_axis_crane_bridge_shaper_t *s, const two_axis_crane_bridge_shaper_input_t *input)
{
    const uint8_t before = s->wanted_row;
    if (input->selector <= 1u) {
        s->selected_row = input->selector;
    } else {
        s->status |= TWO_AXIS_CRANE_BRIDGE_SHAPER_SELECTOR_INVALID;
    }
    s->wanted_row = s->selected_row;
    two_axis_crane_bridge_follow_rope(s);
    if (s->selected_row > 0u) {
        s->wanted_row = s->rope_row;
    }
    if (!input->enable) {
        s->status |= TWO_AXIS_CRANE_BRIDGE_SHAPER_DISABLED;
        s->wanted_row = 0u;
    }
    if (s->wanted_row != before) {
        s->foretold = false;
    }
}

/* Stops latch until they are released and the command is 0, a quick stop also until the reference is. */
static void two_axis_crane_bridge_latch_stops(two_axis_crane_bridge_shaper_t *s, const two_axis_crane_bridge_shaper_input_t *input)
{
    if (input->emergency_stop) {
        s->emergency = true;
    } else if (s->zero_commanded) {
        s->emergency = false;
    } else {
        /* latched as it is */
    }
    if (input->quick_stop || two_axis_crane_bridge_hit(s)) {
        s->quick = true;
    } else if (s->zero_commanded && two_axis_crane_bridge_equal(s->reference, 0.0)) {
        s->quick = false;
    } else {
        /* latched as it is */
    }
}

static bool two_axis_crane_bridge_settled(const two_axis_crane_bridge_shaper_t *s)
{
    return s->still_ticks >= two_axis_crane_bridge_LAST_TICKS;
}

/* One tick further up: grows by the acceleration, shrinks by the deceleration, passes 0 by no more of either. */
static two_axis_crane_bridge_real_t two_axis_crane_bridge_raised(two_axis_crane_bridge_real_t command)
{
    two_axis_crane_bridge_real_t reach;
    if (command >= 0.0) {
        reach = two_axis_crane_bridge_on_grid(command) + two_axis_crane_bridge_ACCELERATION.step;
    } else {
        reach = command + two_axis_crane_bridge_DECELERATION.step;
        if (reach > two_axis_crane_bridge_ACCELERATION.step) {
            reach = two_axis_crane_bridge_ACCELERATION.step;
        }
    }
    return reach;
}

/* One tick further down, likewise. */
static two_axis_crane_bridge_real_t two_axis_crane_bridge_lowered(two_axis_crane_bridge_real_t command)
{
    two_axis_crane_bridge_real_t reach;
    if (command <= 0.0) {
        reach = two_axis_crane_bridge_on_grid(command) - two_axis_crane_bridge_ACCELERATION.step;
    } else {
        reach = command - two_axis_crane_bridge_DECELERATION.step;
        if (reach < -two_axis_crane_bridge_ACCELERATION.step) {
            reach = -two_axis_crane_bridge_ACCELERATION.step;
        }
    }
    return reach;
}

/* The command one tick nearer to its target. */
static two_axis_crane_bridge_real_t two_axis_crane_bridge_ramped(two_axis_crane_bridge_real_t command, two_axis_crane_bridge_real_t target)
{
    two_axis_crane_bridge_real_t reach = target;
    if (target > command) {
        reach = two_axis_crane_bridge_raised(command);
        if (reach > target) {
            reach = target;
        }
    } else if (target < command) {
        reach = two_axis_crane_bridge_lowered(command);
        if (reach < target) {
            reach = target;
        }
    } else {
        /* there already */
    }
    return reach;
}

/* A ramp that does not pass 0, in closed form; as exact as the ramp, so never a tick off. */
static two_axis_crane_bridge_glide_t two_axis_crane_bridge_glide(two_axis_crane_bridge_real_t start, two_axis_crane_bridge_real_t target, const two_axis_crane_bridge_ramp_t *ramp)
{
    two_axis_crane_bridge_glide_t glide = { 0.0, 0u };
    if (!two_axis_crane_bridge_equal(start, target)) {
        const two_axis_crane_bridge_real_t from = (two_axis_crane_bridge_abs(target) > two_axis_crane_bridge_abs(start)) ? two_axis_crane_bridge_on_grid(start) : start;
        const bool falls = from > target;
        const two_axis_crane_bridge_real_t step = falls ? -ramp->step : ramp->step;
        const two_axis_crane_bridge_real_t steps = (two_axis_crane_bridge_abs(from - target) * ramp->steps_per_unit) + 0.5;
        uint32_t whole = (uint32_t)steps; /* the nearest; one too many if it has landed */
        const two_axis_crane_bridge_real_t position = from + ((two_axis_crane_bridge_real_t)whole * step);
        const bool landed = falls ? (position <= target) : (position >= target);
        two_axis_crane_bridge_real_t count;
        if (landed && (whole > 0u)) {
            whole -= 1u;
        }
        count = (two_axis_crane_bridge_real_t)whole;
        glide.total = ((count * from) + (step * ((count * (count + 1.0)) * 0.5))) + target;
        glide.ticks = whole + 1u;
    }
    return glide;
}

static two_axis_crane_bridge_real_t two_axis_crane_bridge_distance(two_axis_crane_bridge_real_t total)
{
    return total * two_axis_crane_bridge_METRES_PER_UNIT_TICK;
}

static two_axis_crane_bridge_real_t two_axis_crane_bridge_time_s(uint32_t ticks)
{
    return (two_axis_crane_bridge_real_t)ticks * two_axis_crane_bridge_TICK_S;
}

/* Coming to rest within a way: the next command and its ramp to 0, in sum, must not exceed what the way leaves. */

/* Sum of the commands that follow a command on its ramp to 0. */
static two_axis_crane_bridge_real_t two_axis_crane_bridge_way_down(two_axis_crane_bridge_real_t command)
{
    return two_axis_crane_bridge_glide(command, 0.0, &two_axis_crane_bridge_DECELERATION).total;
}

static bool two_axis_crane_bridge_fits(two_axis_crane_bridge_real_t command, two_axis_crane_bridge_real_t way)
{
    return (command + two_axis_crane_bridge_way_down(command)) <= way;
}

/* Next command towards a target that keeps within a way, as far as the ramp can; both commands are >= 0. */
static two_axis_crane_bridge_real_t two_axis_crane_bridge_approach(two_axis_crane_bridge_real_t command, two_axis_crane_bridge_real_t target, two_axis_crane_bridge_real_t way)
{
    const two_axis_crane_bridge_real_t up = two_axis_crane_bridge_ramped(command, target);
    two_axis_crane_bridge_real_t gentle = up; /* a step that a deceleration can undo */
    two_axis_crane_bridge_real_t after;
    if ((command + two_axis_crane_bridge_GENTLE_STEP) < up) {
        gentle = command + two_axis_crane_bridge_GENTLE_STEP;
    }
    if (two_axis_crane_bridge_fits(up, way)) {
        after = up;
    } else if (two_axis_crane_bridge_fits(gentle, way)) {
        after = gentle;
    } else {
        /* What deceleration leaves over is one tick more of the ramp down: the way is used to its end. */
        const two_axis_crane_bridge_real_t most = (command > 0.0) ? command : gentle;
        const two_axis_crane_bridge_real_t over = way - two_axis_crane_bridge_way_down(command);
        after = command - two_axis_crane_bridge_DECELERATION.step;
        if (after < 0.0) {
            after = 0.0;
        }
        if (over > most) {
            after = (most > after) ? most : after;
        } else if (over > after) {
            after = over;
        } else {
            /* decelerated */
        }
    }
    return after;
}

/* A command as it is seen in the direction of motion, and back. */
static two_axis_crane_bridge_real_t two_axis_crane_bridge_turned(two_axis_crane_bridge_real_t command, bool forward)
{
    return forward ? command : (0.0 - command);
}

/* Sum of the references that may still come before an end that is so far away. */
static two_axis_crane_bridge_real_t two_axis_crane_bridge_budget(two_axis_crane_bridge_real_t distance)
{
    const two_axis_crane_bridge_real_t beyond = (two_axis_crane_bridge_real_t)distance - two_axis_crane_bridge_WAY_MARGIN;
    return (two_axis_crane_bridge_within(beyond, 0.0, two_axis_crane_bridge_FARTHEST_WAY) * two_axis_crane_bridge_WAY_SCALE);
}

/* What is left of a way that is counted down. */
static two_axis_crane_bridge_real_t two_axis_crane_bridge_counted(two_axis_crane_bridge_real_t way)
{
    return two_axis_crane_bridge_within(way, 0.0, two_axis_crane_bridge_MOST_WAY);
}

/* Take the distances to both ends; of one that is not valid, what is left of the last after the last reference. */
static void two_axis_crane_bridge_read_distances(two_axis_crane_bridge_shaper_t *s, const two_axis_crane_bridge_shaper_input_t *input)
{
    const bool forward = input->distance_valid && two_axis_crane_bridge_is_number(input->distance_forward_m);
    const bool reverse = input->distance_valid && two_axis_crane_bridge_is_number(input->distance_reverse_m);
    if (forward) {
        s->way_forward = two_axis_crane_bridge_budget(input->distance_forward_m);
    } else {
        s->way_forward = two_axis_crane_bridge_counted(s->way_forward - s->reference);
    }
    if (reverse) {
        s->way_reverse = two_axis_crane_bridge_budget(input->distance_reverse_m);
    } else {
        s->way_reverse = two_axis_crane_bridge_counted(s->way_reverse + s->reference);
    }
    if (!(forward && reverse)) {
        s->status |= TWO_AXIS_CRANE_BRIDGE_SHAPER_DISTANCE_INVALID;
    }
}

/* Take the ways of a tick, and say whether one is too short to stop in by the ramp. */
static void two_axis_crane_bridge_read_ways(two_axis_crane_bridge_shaper_t *s, const two_axis_crane_bridge_shaper_input_t *input)
{
    const two_axis_crane_bridge_real_t down = two_axis_crane_bridge_way_down(two_axis_crane_bridge_abs(s->command));
    const two_axis_crane_bridge_real_t pending = two_axis_crane_bridge_pending(s, s->row);
    const two_axis_crane_bridge_real_t total = pending + ((s->command > 0.0) ? down : (0.0 - down));
    two_axis_crane_bridge_read_distances(s, input);
    if ((total > (s->way_forward + two_axis_crane_bridge_MAX_COMMAND)) || ((0.0 - total) > (s->way_reverse + two_axis_crane_bridge_MAX_COMMAND))) {
        s->status |= TWO_AXIS_CRANE_BRIDGE_SHAPER_WAY_TOO_SHORT;
    }
}

/* Sum of the commands that may still come towards an end; from rest none where it is not worth leaving. */
static two_axis_crane_bridge_real_t two_axis_crane_bridge_left(const two_axis_crane_bridge_shaper_t *s, bool forward)
{
    const two_axis_crane_bridge_real_t pending = two_axis_crane_bridge_pending(s, s->row);
    two_axis_crane_bridge_real_t left = forward ? (s->way_forward - pending) : (s->way_reverse + pending);
    if (two_axis_crane_bridge_equal(s->command, 0.0) && (left < two_axis_crane_bridge_LEAST_WAY)) {
        left = 0.0;
    }
    return left;
}

/* The row that may shape from the next tick on: the wanted one if its stop keeps within the ways. */
static void two_axis_crane_bridge_look_ahead(two_axis_crane_bridge_shaper_t *s)
{
    const uint8_t before = s->next_row;
    s->next_row = s->row;
    if (two_axis_crane_bridge_settled(s)) {
        const two_axis_crane_bridge_real_t down = two_axis_crane_bridge_way_down(two_axis_crane_bridge_abs(s->command));
        const two_axis_crane_bridge_real_t pending = two_axis_crane_bridge_pending(s, s->wanted_row);
        const two_axis_crane_bridge_real_t total = pending + ((s->command > 0.0) ? down : (0.0 - down));
        if ((total <= (s->way_forward - s->reference)) && ((0.0 - total) <= (s->way_reverse + s->reference))) {
            s->next_row = s->wanted_row;
        }
    }
    if (s->next_row != before) {
        s->foretold = false;
    }
}

/* Take over the wanted row when settled; while the crane moves, only one that was found to keep within the ways. */
static void two_axis_crane_bridge_choose_row(two_axis_crane_bridge_shaper_t *s)
{
    if (two_axis_crane_bridge_equal(s->command, 0.0) || (s->wanted_row == s->next_row)) {
        s->row = s->wanted_row;
    }
}

/* A command seen in the direction of motion; what points the other way is 0 first. */
static two_axis_crane_bridge_real_t two_axis_crane_bridge_ahead(two_axis_crane_bridge_real_t command, bool forward)
{
    const two_axis_crane_bridge_real_t turned = two_axis_crane_bridge_turned(command, forward);
    return (turned < 0.0) ? 0.0 : turned;
}

/* The command one tick nearer to its target, within the way to the end ahead. */
static two_axis_crane_bridge_real_t two_axis_crane_bridge_before_end(two_axis_crane_bridge_shaper_t *s)
{
    const bool forward = (s->command > 0.0) || (two_axis_crane_bridge_equal(s->command, 0.0) && (s->target > 0.0));
    const two_axis_crane_bridge_real_t now = two_axis_crane_bridge_turned(s->command, forward);
    const two_axis_crane_bridge_real_t target = two_axis_crane_bridge_ahead(s->target, forward);
    two_axis_crane_bridge_real_t after = two_axis_crane_bridge_approach(now, target, two_axis_crane_bridge_left(s, forward));
    if (!two_axis_crane_bridge_equal(after, two_axis_crane_bridge_ramped(now, target))) {
        s->status |= TWO_AXIS_CRANE_BRIDGE_SHAPER_WAY_LIMITS;
        after = two_axis_crane_bridge_on_grid(after);
    }
    return two_axis_crane_bridge_turned(after, forward);
}

/* The way of a step, with its sign. */
static two_axis_crane_bridge_real_t two_axis_crane_bridge_step_way(uint8_t size, bool forward)
{
    two_axis_crane_bridge_real_t way = two_axis_crane_bridge_STEP_SIZE_1;
    if (size == 2u) {
        way = two_axis_crane_bridge_STEP_SIZE_2;
    }
    if (size == 3u) {
        way = two_axis_crane_bridge_STEP_SIZE_3;
    }
    return forward ? way : (0.0 - way);
}

/* Count one press; returns the status bit that says why not. */
static uint32_t two_axis_crane_bridge_press(two_axis_crane_bridge_shaper_t *s, uint8_t size, bool forward)
{
    const two_axis_crane_bridge_real_t way = two_axis_crane_bridge_step_way(size, forward);
    uint32_t refusal = 0u;
    if ((size < 1u) || (size > 3u)) {
        refusal = TWO_AXIS_CRANE_BRIDGE_SHAPER_STEP_SIZE_INVALID;
    } else if (two_axis_crane_bridge_shut(s, way)) {
        refusal = TWO_AXIS_CRANE_BRIDGE_SHAPER_STEP_REFUSED;
    } else if (two_axis_crane_bridge_abs((s->left + s->queued) + way) > two_axis_crane_bridge_STEP_CAPACITY) {
        refusal = TWO_AXIS_CRANE_BRIDGE_SHAPER_STEP_REFUSED;
    } else {
        s->queued = s->queued + way;
        s->stepping = true;
    }
    return refusal;
}

/* Take the buttons: a press counts once, only after the button was seen released, and while steps run or at rest. */
static void two_axis_crane_bridge_read_steps(two_axis_crane_bridge_shaper_t *s, const two_axis_crane_bridge_shaper_input_t *input)
{
    const bool forward = input->step_forward && s->armed_forward;
    const bool reverse = input->step_reverse && s->armed_reverse;
    const bool rests = two_axis_crane_bridge_settled(s) && two_axis_crane_bridge_equal(s->command, 0.0) && s->zero_commanded;
    const bool starts = (s->stepping || rests) && !(s->emergency || s->quick || s->drive_off) && (s->speed_limit > 0.0);
    s->armed_forward = !input->step_forward;
    s->armed_reverse = !input->step_reverse;
    s->row_locked = s->stepping;
    if (forward || reverse) {
        s->refusal = TWO_AXIS_CRANE_BRIDGE_SHAPER_STEP_REFUSED;
        if (starts && (forward != reverse)) {
            s->refusal = two_axis_crane_bridge_press(s, input->step_size, forward);
        }
    } else if (!(input->step_forward || input->step_reverse)) {
        s->refusal = 0u;
    } else {
        /* a refusal shows until the button is released */
    }
    s->status |= s->refusal;
}

/* Cut what is left of steps down to the way to the end, but not below what stopping takes. */
static two_axis_crane_bridge_real_t two_axis_crane_bridge_cut(two_axis_crane_bridge_shaper_t *s, two_axis_crane_bridge_real_t way, bool forward)
{
    const two_axis_crane_bridge_real_t down = two_axis_crane_bridge_way_down(two_axis_crane_bridge_abs(s->command));
    two_axis_crane_bridge_real_t left = two_axis_crane_bridge_left(s, forward);
    if (down > left) {
        left = down;
    }
    if (left < way) {
        s->status |= TWO_AXIS_CRANE_BRIDGE_SHAPER_WAY_LIMITS;
    } else {
        left = way;
    }
    return left;
}

/* Largest command of a step in this tick. */
static two_axis_crane_bridge_real_t two_axis_crane_bridge_most_step(const two_axis_crane_bridge_shaper_t *s, bool forward)
{
    two_axis_crane_bridge_real_t most = two_axis_crane_bridge_STEP_COMMAND;
    if (s->speed_limit < most) {
        most = s->speed_limit;
    }
    if ((forward ? s->most_forward : s->most_reverse) < most) {
        most = forward ? s->most_forward : s->most_reverse;
    }
    return most;
}

/* What is left of steps, as far as they may go on. */
static two_axis_crane_bridge_real_t two_axis_crane_bridge_step_limit(two_axis_crane_bridge_shaper_t *s, two_axis_crane_bridge_real_t command, two_axis_crane_bridge_real_t left, two_axis_crane_bridge_real_t most, bool forward)
{
    const two_axis_crane_bridge_real_t down = two_axis_crane_bridge_way_down(command);
    two_axis_crane_bridge_real_t way = left;
    if (two_axis_crane_bridge_equal(most, 0.0) && (down < way)) {
        way = down;
    }
    way = two_axis_crane_bridge_cut(s, way, forward);
    return way;
}

/* The next command of steps: taken from what is left of them, and the last takes the rest. */
static two_axis_crane_bridge_real_t two_axis_crane_bridge_next_step(two_axis_crane_bridge_shaper_t *s)
{
    two_axis_crane_bridge_real_t command;
    two_axis_crane_bridge_real_t after;
    two_axis_crane_bridge_real_t most;
    two_axis_crane_bridge_real_t way;
    bool forward;
    s->left = s->left + s->queued;
    s->queued = 0.0;
    forward = (s->command > 0.0) || (two_axis_crane_bridge_equal(s->command, 0.0) && (s->left > 0.0));
    command = two_axis_crane_bridge_turned(s->command, forward);
    way = forward ? s->left : (0.0 - s->left);
    most = two_axis_crane_bridge_most_step(s, forward);
    way = two_axis_crane_bridge_step_limit(s, command, way, most, forward);
    after = two_axis_crane_bridge_approach(command, most, way);
    way = way - after;
    if (two_axis_crane_bridge_equal(after, 0.0) && (two_axis_crane_bridge_equal(command, 0.0) || (two_axis_crane_bridge_abs(way) <= two_axis_crane_bridge_STEP_ROUNDING))) {
        way = 0.0;
    }
    s->left = forward ? way : (0.0 - way);
    return two_axis_crane_bridge_turned(after, forward);
}

/* Take the reference to 0 and what is pending with it: the shaper rests at the reference. */
static void two_axis_crane_bridge_stop(two_axis_crane_bridge_shaper_t *s, bool at_once)
{
    const two_axis_crane_bridge_real_t reach = two_axis_crane_bridge_abs(s->reference) - two_axis_crane_bridge_QUICK_STOP.step;
    if (at_once || (reach <= 0.0)) {
        s->reference = 0.0;
        s->still_ticks = two_axis_crane_bridge_LAST_TICKS;
    } else {
        s->reference = (s->reference > 0.0) ? reach : -reach;
        s->still_ticks = 0u;
    }
    s->command = s->reference;
    s->target = s->reference;
    s->left = 0.0;
    s->queued = 0.0;
    s->stepping = false;
    s->foretold = false;
    two_axis_crane_bridge_rest(s, s->reference);
}

/* The command becomes the target. */
static void two_axis_crane_bridge_accept(two_axis_crane_bridge_shaper_t *s, two_axis_crane_bridge_real_t command)
{
    two_axis_crane_bridge_real_t wanted = command;
    s->target = wanted;
}

/* The next command: of steps that run, or one tick nearer to what is accepted. */
static two_axis_crane_bridge_real_t two_axis_crane_bridge_next(two_axis_crane_bridge_shaper_t *s, two_axis_crane_bridge_real_t command)
{
    two_axis_crane_bridge_real_t next;
    if (s->stepping) {
        next = two_axis_crane_bridge_next_step(s);
        s->target = next;
    } else {
        two_axis_crane_bridge_accept(s, command);
        next = two_axis_crane_bridge_before_end(s);
    }
    return next;
}

/* Choose the row when settled; ramp, then shape. */
static void two_axis_crane_bridge_move(two_axis_crane_bridge_shaper_t *s, two_axis_crane_bridge_real_t command)
{
    const two_axis_crane_bridge_real_t before = s->command;
    if (!s->row_locked && two_axis_crane_bridge_settled(s)) {
        two_axis_crane_bridge_choose_row(s);
    }
    s->command = two_axis_crane_bridge_next(s, command);
    if (!two_axis_crane_bridge_equal(s->command, before)) {
        s->still_ticks = 0u;
        s->foretold = false;
    } else if (!two_axis_crane_bridge_settled(s)) {
        s->still_ticks += 1u;
    } else {
        /* settled as it is */
    }
    if (s->still_ticks >= two_axis_crane_bridge_TAIL_TICKS[s->row]) {
        two_axis_crane_bridge_rest(s, s->command);
        s->reference = s->command;
    } else {
        s->reference = two_axis_crane_bridge_run(s, s->command);
    }
    if (s->stepping && two_axis_crane_bridge_settled(s) && two_axis_crane_bridge_equal(s->command, 0.0)) {
        s->stepping = !(two_axis_crane_bridge_equal(s->left, 0.0) && two_axis_crane_bridge_equal(s->queued, 0.0));
    }
    if (two_axis_crane_bridge_shut(s, s->reference)) {
        /* What is pending turns towards a made stop switch: the reference stays 0 from here on. */
        s->quick = true;
        two_axis_crane_bridge_stop(s, true);
    }
}

/* The row that takes over if the command becomes 0 when settled. */
static uint8_t two_axis_crane_bridge_row_at_rest(const two_axis_crane_bridge_shaper_t *s)
{
    return s->next_row;
}

/* A stop at once: the ramp goes down and the taps run out. */
static two_axis_crane_bridge_glide_t two_axis_crane_bridge_foretell_release(const two_axis_crane_bridge_shaper_t *s)
{
    const uint8_t row = two_axis_crane_bridge_settled(s) ? two_axis_crane_bridge_row_at_rest(s) : s->row;
    const uint32_t tail = two_axis_crane_bridge_TAIL_TICKS[row];
    two_axis_crane_bridge_glide_t stop = two_axis_crane_bridge_glide(s->command, 0.0, &two_axis_crane_bridge_DECELERATION);
    stop.total = two_axis_crane_bridge_pending(s, row) + stop.total;
    if (stop.ticks > 0u) {
        stop.ticks += tail;
    } else if (tail > s->still_ticks) {
        stop.ticks = tail - s->still_ticks;
    } else {
        /* at rest */
    }
    return stop;
}

/* Steps that run: every command to come is part of what is left of them; the ticks are those of a release. */
static two_axis_crane_bridge_glide_t two_axis_crane_bridge_foretell_steps(const two_axis_crane_bridge_shaper_t *s)
{
    const uint8_t row = s->row;
    const uint32_t tail = two_axis_crane_bridge_TAIL_TICKS[row];
    two_axis_crane_bridge_glide_t stop = two_axis_crane_bridge_glide(s->command, 0.0, &two_axis_crane_bridge_DECELERATION);
    stop.total = two_axis_crane_bridge_pending(s, row) + (s->left + s->queued);
    stop.ticks += tail + 1u;
    return stop;
}

/* Sum of the references to come, and ticks until the last, if the command is 0 from the next tick on. */
static two_axis_crane_bridge_glide_t two_axis_crane_bridge_foretell(const two_axis_crane_bridge_shaper_t *s)
{
    two_axis_crane_bridge_glide_t stop = { 0.0, 0u };
    if (s->emergency || s->drive_off) {
        /* stopped */
    } else if (s->quick) {
        stop = two_axis_crane_bridge_glide(s->reference, 0.0, &two_axis_crane_bridge_QUICK_STOP);
    } else if (s->stepping) {
        stop = two_axis_crane_bridge_foretell_steps(s);
    } else {
        stop = two_axis_crane_bridge_foretell_release(s);
    }
    return stop;
}

/* Watch whether the drive follows: its speed, against the range of the references of this window and the last. */
static void two_axis_crane_bridge_watch_speed(two_axis_crane_bridge_shaper_t *s, two_axis_crane_bridge_real_t actual)
{
    two_axis_crane_bridge_real_t low;
    two_axis_crane_bridge_real_t high;
    if (s->filled_ticks >= two_axis_crane_bridge_WINDOW_TICKS) {
        s->last_low = s->low;
        s->last_high = s->high;
        s->low = s->reference;
        s->high = s->reference;
        s->filled_ticks = 0u;
    }
    s->filled_ticks += 1u;
    if (s->reference < s->low) {
        s->low = s->reference;
    }
    if (s->reference > s->high) {
        s->high = s->reference;
    }
    low = ((s->last_low < s->low) ? s->last_low : s->low) - two_axis_crane_bridge_TRACKING_TOLERANCE;
    high = ((s->last_high > s->high) ? s->last_high : s->high) + two_axis_crane_bridge_TRACKING_TOLERANCE;
    if (s->emergency || s->drive_off || ((low <= actual) && (actual <= high))) {
        s->outside_ticks = 0u;
    } else if (s->outside_ticks <= two_axis_crane_bridge_TRACKING_TICKS) {
        s->outside_ticks += 1u;
    } else {
        /* counted far enough */
    }
    if (s->outside_ticks > two_axis_crane_bridge_TRACKING_TICKS) {
        s->status |= TWO_AXIS_CRANE_BRIDGE_SHAPER_TRACKING;
    }
}

/* Quanta of phase in a tick, off the table; the rope length is within its range. */
static uint32_t two_axis_crane_bridge_tick_quanta(two_axis_crane_bridge_real_t length)
{
    const two_axis_crane_bridge_real_t place = (length - two_axis_crane_bridge_SHORTEST_ROPE) * two_axis_crane_bridge_SPANS_PER_METRE;
    const uint32_t whole = (uint32_t)place;
    const uint32_t span = (whole < two_axis_crane_bridge_LAST_SPAN) ? whole : two_axis_crane_bridge_LAST_SPAN;
    const two_axis_crane_bridge_real_t share = place - (two_axis_crane_bridge_real_t)span;
    const two_axis_crane_bridge_real_t here = (two_axis_crane_bridge_real_t)two_axis_crane_bridge_TICK_QUANTA[span];
    const two_axis_crane_bridge_real_t there = (two_axis_crane_bridge_real_t)two_axis_crane_bridge_TICK_QUANTA[span + 1u];
    return (uint32_t)((here - ((here - there) * share)) + 0.5);
}

/* The load beside the reference, by the linear model: (pace, place) turn by the phase of a tick, and shrink. */

static two_axis_crane_bridge_real_t two_axis_crane_bridge_within_swing(two_axis_crane_bridge_real_t swing)
{
    return two_axis_crane_bridge_within(swing, -two_axis_crane_bridge_LARGEST_SWAY, two_axis_crane_bridge_LARGEST_SWAY);
}

/* The turn of a tick that has so many quanta. The only division. */
static void two_axis_crane_bridge_set_turn(two_axis_crane_bridge_shaper_t *s, uint32_t quanta)
{
    const two_axis_crane_bridge_real_t count = (two_axis_crane_bridge_real_t)quanta;
    const two_axis_crane_bridge_real_t angle = count * two_axis_crane_bridge_SWAY_QUANTUM;
    const two_axis_crane_bridge_real_t square = angle * angle;
    const two_axis_crane_bridge_real_t sine = angle * (1.0 - (square * two_axis_crane_bridge_SIXTH));
    const two_axis_crane_bridge_real_t cosine = 1.0 - ((square * 0.5) * (1.0 - (square * two_axis_crane_bridge_TWELFTH)));
    const two_axis_crane_bridge_real_t kept = two_axis_crane_bridge_SWAY_HELD - (angle * two_axis_crane_bridge_SWAY_LOSS);
    s->sway_quanta = quanta;
    s->sway_inverse = 1.0 / count;
    s->turn_cosine = cosine * kept;
    s->turn_sine = sine * kept;
    s->turn_metres = two_axis_crane_bridge_SWAY_METRES * s->sway_inverse;
}

/* Where the rope changes, the angle of the rope and the moment of momentum stay. */
static void two_axis_crane_bridge_follow_sway(two_axis_crane_bridge_shaper_t *s, uint32_t quanta)
{
    if (quanta != s->sway_quanta) {
        const two_axis_crane_bridge_real_t before = (two_axis_crane_bridge_real_t)s->sway_quanta;
        const two_axis_crane_bridge_real_t shorter = (two_axis_crane_bridge_real_t)quanta * s->sway_inverse;
        two_axis_crane_bridge_set_turn(s, quanta);
        s->sway_place = two_axis_crane_bridge_within_swing(s->sway_place * (before * s->sway_inverse));
        s->sway_pace = two_axis_crane_bridge_within_swing(s->sway_pace * (shorter * shorter));
    }
}

/* Where the load hangs as the tick begins, ahead of the trolley; then let it swing for the tick. */
static two_axis_crane_bridge_real_t two_axis_crane_bridge_predicted_sway(two_axis_crane_bridge_shaper_t *s)
{
    const two_axis_crane_bridge_real_t change = s->reference - s->sway_reference;
    two_axis_crane_bridge_real_t cosine;
    two_axis_crane_bridge_real_t sine;
    two_axis_crane_bridge_real_t metres;
    two_axis_crane_bridge_real_t pace;
    two_axis_crane_bridge_real_t place;
    two_axis_crane_bridge_follow_sway(s, two_axis_crane_bridge_tick_quanta(s->rope_length));
    cosine = s->turn_cosine;
    sine = s->turn_sine;
    metres = s->turn_metres;
    s->sway_reference = s->reference;
    if (two_axis_crane_bridge_equal(change, 0.0) && (two_axis_crane_bridge_abs(s->sway_pace) < two_axis_crane_bridge_FORGOTTEN_SWAY)
        && (two_axis_crane_bridge_abs(s->sway_place) < two_axis_crane_bridge_FORGOTTEN_SWAY)) {
        s->sway_pace = 0.0;
        s->sway_place = 0.0;
    }
    pace = s->sway_pace - change;
    place = s->sway_place;
    s->sway_pace = two_axis_crane_bridge_within_swing((pace * cosine) - (place * sine));
    s->sway_place = two_axis_crane_bridge_within_swing((place * cosine) + (pace * sine));
    return place * metres;
}

/* Residual vibration that a row leaves at most on the rope of now; all of it where that is not known. */
static two_axis_crane_bridge_real_t two_axis_crane_bridge_bound_on_rope(const two_axis_crane_bridge_shaper_t *s, uint8_t row)
{
    two_axis_crane_bridge_real_t bound = two_axis_crane_bridge_RESIDUAL_BOUND[0];
    if ((row > 0u) && ((s->status & (TWO_AXIS_CRANE_BRIDGE_SHAPER_ROPE_INVALID
        | TWO_AXIS_CRANE_BRIDGE_SHAPER_ROPE_OUT_OF_RANGE
        | TWO_AXIS_CRANE_BRIDGE_SHAPER_ROPE_JUMP
        | TWO_AXIS_CRANE_BRIDGE_SHAPER_ROPE_FROZEN)) == 0u)) {
        uint32_t low = two_axis_crane_bridge_FIRST_BOUND[row - 1u];
        uint32_t end = two_axis_crane_bridge_FIRST_BOUND[row];
        while ((end - low) > 1u) {
            const uint32_t middle = low + ((end - low) >> 1);
            if (two_axis_crane_bridge_BOUND_START[middle] <= s->rope_length) {
                low = middle;
            } else {
                end = middle;
            }
        }
        bound = two_axis_crane_bridge_ROPE_BOUND[low];
    }
    return bound;
}

/* Two sums of the digits, to the base 65536, of every number of every table, modulo the prime 65537. */
typedef struct {
    int32_t first;
    int32_t second;
    bool exact;
} two_axis_crane_bridge_sums_t;

static void two_axis_crane_bridge_add_digit(two_axis_crane_bridge_sums_t *sums, int32_t digit)
{
    sums->first += digit;
    if (sums->first < 0) {
        sums->first += 65537;
    } else if (sums->first >= 65537) {
        sums->first -= 65537;
    } else {
        /* within */
    }
    sums->second += sums->first;
    if (sums->second >= 65537) {
        sums->second -= 65537;
    }
}

static void two_axis_crane_bridge_add_whole(two_axis_crane_bridge_sums_t *sums, int32_t number)
{
    const int32_t higher = number / 65536;
    two_axis_crane_bridge_add_digit(sums, higher);
    two_axis_crane_bridge_add_digit(sums, number - (higher * 65536));
}

/* In these tables volatile means: read what stands in memory, not what the compiler knows to stand there. */

static void two_axis_crane_bridge_add_words(two_axis_crane_bridge_sums_t *sums, const volatile uint32_t *table, uint32_t count)
{
    uint32_t i;
    for (i = 0u; i < count; ++i) {
        const uint32_t number = table[i];
        two_axis_crane_bridge_add_whole(sums, (int32_t)number);
    }
}

static void two_axis_crane_bridge_add_counts(two_axis_crane_bridge_sums_t *sums, const volatile uint32_t *table, uint32_t count)
{
    uint32_t i;
    for (i = 0u; i < count; ++i) {
        const uint32_t number = table[i + 1u] - table[i];
        two_axis_crane_bridge_add_whole(sums, (int32_t)number);
    }
}

/* How the reals of a table are taken apart: all are below limit and, but for 0, not below least. */
typedef struct {
    two_axis_crane_bridge_real_t limit;
    two_axis_crane_bridge_real_t inverse;
    two_axis_crane_bridge_real_t least;
    uint32_t count;
} two_axis_crane_bridge_digits_t;

static const two_axis_crane_bridge_digits_t two_axis_crane_bridge_AMPLITUDE_DIGITS = { 2.0, 0.5, 1.0842021724855044e-19, 4u };
static const two_axis_crane_bridge_digits_t two_axis_crane_bridge_MOMENT_TICKS_DIGITS = { 256.0, 0.00390625, 1.3877787807814457e-17, 4u };
static const two_axis_crane_bridge_digits_t two_axis_crane_bridge_RESIDUAL_BOUND_DIGITS = { 2.0, 0.5, 1.0842021724855044e-19, 4u };
static const two_axis_crane_bridge_digits_t two_axis_crane_bridge_ROW_SHORTEST_DIGITS = { 4.0, 0.25, 2.168404344971009e-19, 4u };
static const two_axis_crane_bridge_digits_t two_axis_crane_bridge_ROW_LONGEST_DIGITS = { 16.0, 0.0625, 8.673617379884035e-19, 4u };
static const two_axis_crane_bridge_digits_t two_axis_crane_bridge_BOUND_START_DIGITS = { 16.0, 0.0625, 8.673617379884035e-19, 4u };
static const two_axis_crane_bridge_digits_t two_axis_crane_bridge_ROPE_BOUND_DIGITS = { 0.5, 2.0, 2.710505431213761e-20, 4u };

/* Take reals apart: below 1 by a power of two, each product with 65536 gives a whole digit and an exact rest. */
static void two_axis_crane_bridge_add_reals(two_axis_crane_bridge_sums_t *sums, const volatile two_axis_crane_bridge_real_t *table, uint32_t count,
    const two_axis_crane_bridge_digits_t *digits)
{
    uint32_t i;
    for (i = 0u; i < count; ++i) {
        const two_axis_crane_bridge_real_t number = table[i];
        const two_axis_crane_bridge_real_t size = two_axis_crane_bridge_abs(number);
        if ((size < digits->limit) && (two_axis_crane_bridge_equal(size, 0.0) || (size >= digits->least))) {
            two_axis_crane_bridge_real_t rest = number * digits->inverse;
            uint32_t k;
            for (k = 0u; k < digits->count; ++k) {
                int32_t digit;
                rest = rest * 65536.0;
                digit = (int32_t)rest;
                two_axis_crane_bridge_add_digit(sums, digit);
                rest = rest - (two_axis_crane_bridge_real_t)digit;
            }
            sums->exact = sums->exact && two_axis_crane_bridge_equal(rest, 0.0);
        } else {
            sums->exact = false;
        }
    }
}

/* Whether the tables are those of the design. */
static bool two_axis_crane_bridge_tables_match(void)
{
    two_axis_crane_bridge_sums_t sums = { 1, 0, true };
    two_axis_crane_bridge_add_words(&sums, two_axis_crane_bridge_FIRST_TAP, 3u);
    two_axis_crane_bridge_add_counts(&sums, two_axis_crane_bridge_FIRST_TAP, 3u);
    two_axis_crane_bridge_add_words(&sums, two_axis_crane_bridge_DELAY_TICKS, 11u);
    two_axis_crane_bridge_add_reals(&sums, two_axis_crane_bridge_AMPLITUDE, 11u, &two_axis_crane_bridge_AMPLITUDE_DIGITS);
    two_axis_crane_bridge_add_words(&sums, two_axis_crane_bridge_TAIL_TICKS, 3u);
    two_axis_crane_bridge_add_reals(&sums, two_axis_crane_bridge_MOMENT_TICKS, 3u, &two_axis_crane_bridge_MOMENT_TICKS_DIGITS);
    two_axis_crane_bridge_add_reals(&sums, two_axis_crane_bridge_RESIDUAL_BOUND, 3u, &two_axis_crane_bridge_RESIDUAL_BOUND_DIGITS);
    two_axis_crane_bridge_add_reals(&sums, &two_axis_crane_bridge_ROW_SHORTEST[1], 2u, &two_axis_crane_bridge_ROW_SHORTEST_DIGITS);
    two_axis_crane_bridge_add_reals(&sums, &two_axis_crane_bridge_ROW_LONGEST[1], 2u, &two_axis_crane_bridge_ROW_LONGEST_DIGITS);
    two_axis_crane_bridge_add_counts(&sums, two_axis_crane_bridge_FIRST_BOUND, 2u);
    two_axis_crane_bridge_add_reals(&sums, two_axis_crane_bridge_BOUND_START, 66u, &two_axis_crane_bridge_BOUND_START_DIGITS);
    two_axis_crane_bridge_add_reals(&sums, two_axis_crane_bridge_ROPE_BOUND, 66u, &two_axis_crane_bridge_ROPE_BOUND_DIGITS);
    two_axis_crane_bridge_add_words(&sums, two_axis_crane_bridge_TICK_QUANTA, 195u);
    return sums.exact && (sums.first == 2041) && (sums.second == 5298);
}

/* Outputs of a block whose tables are not those of its design: at rest for ever. */
static void two_axis_crane_bridge_refuse(two_axis_crane_bridge_shaper_output_t *output)
{
    output->reference = 0.0;
    output->stop_distance = 0.0;
    output->stop_time_s = 0.0;
    output->stop_time_ticks = 0u;
    output->residual_bound = 1.0;
    output->row = 0u;
    output->settled = true;
    output->active = false;
    output->error = true;
    output->status = TWO_AXIS_CRANE_BRIDGE_SHAPER_TABLES_INVALID | TWO_AXIS_CRANE_BRIDGE_SHAPER_UNSHAPED;
    output->predicted_sway_m = 0.0;
    output->design_id = TWO_AXIS_CRANE_BRIDGE_SHAPER_DESIGN_ID;
}

static bool two_axis_crane_bridge_stopped(const two_axis_crane_bridge_shaper_t *s)
{
    return s->emergency || s->quick || s->drive_off;
}

static uint32_t two_axis_crane_bridge_full_status(const two_axis_crane_bridge_shaper_t *s)
{
    uint32_t status = s->status;
    if (s->row == 0u) {
        status |= TWO_AXIS_CRANE_BRIDGE_SHAPER_UNSHAPED;
    }
    if ((s->row != s->wanted_row)) {
        status |= TWO_AXIS_CRANE_BRIDGE_SHAPER_ROW_WAITS;
    }
    if (s->quick) {
        status |= TWO_AXIS_CRANE_BRIDGE_SHAPER_QUICK_STOP;
    }
    if (s->emergency) {
        status |= TWO_AXIS_CRANE_BRIDGE_SHAPER_EMERGENCY_STOP;
    }
    if (s->drive_off) {
        status |= TWO_AXIS_CRANE_BRIDGE_SHAPER_DRIVE_NOT_READY;
    }
    if (s->stepping) {
        status |= TWO_AXIS_CRANE_BRIDGE_SHAPER_STEPPING;
    }
    return status;
}

/* Run one tick into s->output. */
static void two_axis_crane_bridge_tick(two_axis_crane_bridge_shaper_t *s, const two_axis_crane_bridge_shaper_input_t *input)
{
    two_axis_crane_bridge_shaper_output_t *const output = &s->output;
    two_axis_crane_bridge_real_t command;
    uint8_t row;

    s->status = 0u;
    two_axis_crane_bridge_read_speed_limit(s, input);
    two_axis_crane_bridge_read_rope_offset(s, input);
    two_axis_crane_bridge_read_rope(s, input);
    two_axis_crane_bridge_watch_drive(s, input);
    command = two_axis_crane_bridge_checked(s, input->command);
    command = two_axis_crane_bridge_limited(s, command);
    command = two_axis_crane_bridge_switched(s, input, command);
    two_axis_crane_bridge_want_row(s, input);
    two_axis_crane_bridge_latch_stops(s, input);
    two_axis_crane_bridge_read_ways(s, input);
    two_axis_crane_bridge_read_steps(s, input);
    if (two_axis_crane_bridge_stopped(s)) {
        two_axis_crane_bridge_stop(s, s->emergency || s->drive_off);
    } else {
        two_axis_crane_bridge_move(s, command);
    }
    two_axis_crane_bridge_watch_speed(s, input->actual_speed);

    two_axis_crane_bridge_look_ahead(s);
    if (s->stepping || !s->foretold) {
        const two_axis_crane_bridge_glide_t stop = two_axis_crane_bridge_foretell(s);
        output->stop_distance = two_axis_crane_bridge_distance(stop.total);
        output->stop_time_s = two_axis_crane_bridge_time_s(stop.ticks);
        output->stop_time_ticks = stop.ticks;
        s->foretold = two_axis_crane_bridge_settled(s) && !two_axis_crane_bridge_stopped(s) && !s->stepping;
    }
    row = two_axis_crane_bridge_stopped(s) ? 0u : s->row;
    output->reference = s->reference;
    output->residual_bound = two_axis_crane_bridge_bound_on_rope(s, row);
    output->row = s->row;
    output->settled = two_axis_crane_bridge_settled(s);
    output->active = (row > 0u);
    output->error = ((s->status & (TWO_AXIS_CRANE_BRIDGE_SHAPER_COMMAND_INVALID
        | TWO_AXIS_CRANE_BRIDGE_SHAPER_SELECTOR_INVALID
        | TWO_AXIS_CRANE_BRIDGE_SHAPER_ROPE_INVALID
        | TWO_AXIS_CRANE_BRIDGE_SHAPER_ROPE_JUMP
        | TWO_AXIS_CRANE_BRIDGE_SHAPER_ROPE_FROZEN
        | TWO_AXIS_CRANE_BRIDGE_SHAPER_HOIST_SPEED_INVALID
        | TWO_AXIS_CRANE_BRIDGE_SHAPER_STEP_SIZE_INVALID
        | TWO_AXIS_CRANE_BRIDGE_SHAPER_WAY_TOO_SHORT
        | TWO_AXIS_CRANE_BRIDGE_SHAPER_DISTANCE_INVALID
        | TWO_AXIS_CRANE_BRIDGE_SHAPER_SPEED_LIMIT_INVALID
        | TWO_AXIS_CRANE_BRIDGE_SHAPER_ROPE_OFFSET_INVALID
        | TWO_AXIS_CRANE_BRIDGE_SHAPER_TRACKING
        | TWO_AXIS_CRANE_BRIDGE_SHAPER_TABLES_INVALID)) != 0u);
    output->status = two_axis_crane_bridge_full_status(s);
    output->predicted_sway_m = two_axis_crane_bridge_predicted_sway(s);
}

void two_axis_crane_bridge_shaper_init(two_axis_crane_bridge_shaper_t *shaper)
{
    two_axis_crane_bridge_shaper_t *const s = shaper;
    s->pending = 0.0;
    s->fresh = 0.0;
    s->base = 0.0;
    s->target = 0.0;
    s->command = 0.0;
    s->reference = 0.0;
    s->unmoved = 0.0;
    s->rope_length = 9.0;
    s->hoist_speed = 0.0;
    s->held_ticks = 0u;
    s->way_forward = 0.0;
    s->way_reverse = 0.0;
    s->left = 0.0;
    s->queued = 0.0;
    s->most_forward = 1.0;
    s->most_reverse = 1.0;
    s->speed_limit = 1.0;
    s->rope_offset = 0.0;
    s->refusal = 0u;
    s->sway_pace = 0.0;
    s->sway_place = 0.0;
    s->sway_reference = 0.0;
    s->low = 0.0;
    s->high = 0.0;
    s->last_low = 0.0;
    s->last_high = 0.0;
    s->filled_ticks = 0u;
    s->outside_ticks = 0u;
    s->head = 500u;
    s->still_ticks = 500u;
    s->status = 0u;
    s->row = 0u;
    s->selected_row = 0u;
    s->wanted_row = 0u;
    s->next_row = 0u;
    s->rope_row = 1u;
    s->lapped = false;
    s->foretold = false;
    s->zero_commanded = false;
    s->invalid = false;
    s->quick = false;
    s->emergency = false;
    s->rope_still = false;
    s->locked = true;
    s->drive_off = true;
    s->shut_forward = false;
    s->shut_reverse = false;
    s->locked_forward = false;
    s->locked_reverse = false;
    s->armed_forward = false;
    s->armed_reverse = false;
    s->row_locked = false;
    s->stepping = false;
    two_axis_crane_bridge_set_turn(s, 1401035u);
    two_axis_crane_bridge_refuse(&s->output);
    s->tables_match = two_axis_crane_bridge_tables_match();
    /* The ring, the last inputs and the last outputs are not read before they are written. */
}

void two_axis_crane_bridge_shaper_step(two_axis_crane_bridge_shaper_t *shaper, const two_axis_crane_bridge_shaper_input_t *input,
    two_axis_crane_bridge_shaper_output_t *output)
{
    if (shaper->tables_match) {
        two_axis_crane_bridge_tick(shaper, input);
    }
    *output = shaper->output;
}
