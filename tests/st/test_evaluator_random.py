"""Random expressions and programs give the same bits as numpy, and the same integers as exact arithmetic."""

import math
from fractions import Fraction

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from swayless.verify.structured_text import ExecutionError, SubsetError, load
from swayless.verify.structured_text.arithmetic import real

DINT_MIN, DINT_MAX = -(2**31), 2**31 - 1
FIXED = settings(derandomize=True, deadline=None, max_examples=150)
NUMPY = {"LREAL": np.float64, "REAL": np.float32}
WIDTH = {"LREAL": 64, "REAL": 32}
VARIABLES = ("A", "B", "C")
COMPARE = {"<": np.less, "<=": np.less_equal, "=": np.equal, "<>": np.not_equal, ">": np.greater}
ARITHMETIC = {"+": np.add, "-": np.subtract, "*": np.multiply, "/": np.divide}

# Four digits and a small exponent round to the same single by way of a double: numpy is a fair reference.
literals = st.from_regex(r"-?[0-9]\.[0-9]{3}E-?[0-9]", fullmatch=True, alphabet="-0123456789.E").filter(
    lambda text: float(text) != 0.0
)
variables = st.sampled_from(VARIABLES)


def trees(operators):
    """Nested tuples (operator, left, right) or (function, operand); a literal only beside something typed."""

    def grow(inner):
        return st.one_of(
            st.tuples(st.sampled_from(operators), inner, st.one_of(inner, literals)),
            st.tuples(st.sampled_from(operators), literals, inner),
            st.tuples(st.sampled_from(["-", "ABS", "SQRT"]), inner),
        )

    return st.recursive(variables, grow, max_leaves=12)


def text_of(tree):
    match tree:
        case str():
            return f"({tree})" if tree.startswith("-") else tree
        case (function, operand):
            return f"(-{text_of(operand)})" if function == "-" else f"{function}({text_of(operand)})"
        case (operator, left, right):
            return f"({text_of(left)} {operator} {text_of(right)})"


def with_numpy(tree, values, kind):
    match tree:
        case str():
            return values[tree] if tree in values else kind(tree)
        case (function, operand):
            ufunc = {"-": np.negative, "ABS": np.absolute, "SQRT": np.sqrt}[function]
            return ufunc(with_numpy(operand, values, kind))
        case (operator, left, right):
            ufunc = ARITHMETIC[operator]
            return ufunc(with_numpy(left, values, kind), with_numpy(right, values, kind))


def same_bits(left, right):
    return (math.isnan(left) and math.isnan(right)) or (
        left == right and math.copysign(1, left) == math.copysign(1, right)
    )


def source_of(real_type, declarations, body):
    inputs = "".join(f"  {name} : {real_type};\n" for name in VARIABLES)
    return f"FUNCTION_BLOCK FB_T\nVAR_INPUT\n{inputs}END_VAR\n{declarations}{body}END_FUNCTION_BLOCK\n"


def ticks_of(real_type):
    floats = st.floats(width=WIDTH[real_type], allow_nan=True, allow_infinity=True)
    return st.lists(st.tuples(floats, floats, floats), min_size=1, max_size=6)


@FIXED
@given(data=st.data(), real_type=st.sampled_from(["LREAL", "REAL"]))
def test_random_expressions_equal_numpy_bit_for_bit(data, real_type):
    kind = NUMPY[real_type]
    roots = data.draw(st.lists(trees(list(ARITHMETIC)), min_size=1, max_size=4))
    outputs = "".join(f"  R{index} : {real_type};\n" for index in range(len(roots)))
    body = "".join(f"R{index} := {text_of(root)};\n" for index, root in enumerate(roots))
    instance = load(source_of(real_type, f"VAR_OUTPUT\n{outputs}END_VAR\n", body)).instantiate()
    for tick in data.draw(ticks_of(real_type)):
        values = {name: kind(value) for name, value in zip(VARIABLES, tick, strict=True)}
        results = instance.step(values).values()
        with np.errstate(all="ignore"):
            expected = [float(with_numpy(root, values, kind)) for root in roots]
        assert all(map(same_bits, results, expected)), (results, expected)


STATE = ("S0", "S1", "S2")


@st.composite
def programs(draw):
    """Lists of (target, tree, None), or (target, tree, (comparison, name, name, other tree)): IF and ELSE."""
    count = draw(st.integers(1, 6))
    targets = st.sampled_from(STATE)
    root = st.tuples(st.just("+"), trees(["+", "-", "*"]), targets)
    condition = st.tuples(
        st.sampled_from(sorted(COMPARE)), st.sampled_from(STATE + VARIABLES), variables, root
    )
    return [(draw(targets), draw(root), draw(st.none() | condition)) for _ in range(count)]


def lines_of(program):
    for target, tree, condition in program:
        if condition is None:
            yield f"{target} := {text_of(tree)};\n"
        else:
            comparison, left, right, other = condition
            yield f"IF {left} {comparison} {right} THEN\n  {target} := {text_of(tree)};\n"
            yield f"ELSE\n  {target} := {text_of(other)};\nEND_IF;\n"


@FIXED
@given(data=st.data(), program=programs(), real_type=st.sampled_from(["LREAL", "REAL"]))
def test_random_programs_equal_numpy_bit_for_bit_tick_after_tick(data, program, real_type):
    kind = NUMPY[real_type]
    outputs = "".join(f"  {name} : {real_type};\n" for name in STATE)
    source = source_of(real_type, f"VAR_OUTPUT\n{outputs}END_VAR\n", "".join(lines_of(program)))
    instance = load(source).instantiate()
    values = dict.fromkeys(STATE, kind(0.0))
    for tick in data.draw(ticks_of(real_type)):
        inputs = {name: kind(value) for name, value in zip(VARIABLES, tick, strict=True)}
        values |= inputs
        with np.errstate(all="ignore"):
            for target, tree, condition in program:
                taken = condition is None or COMPARE[condition[0]](values[condition[1]], values[condition[2]])
                values[target] = with_numpy(tree if taken else condition[3], values, kind)
        assert all(same_bits(found, float(values[name])) for name, found in instance.step(inputs).items())


@FIXED
@given(data=st.data(), count=st.integers(2, 12), real_type=st.sampled_from(["LREAL", "REAL"]))
def test_a_tap_filter_over_a_ring_equals_numpy_bit_for_bit(data, count, real_type):
    kind = NUMPY[real_type]
    taps = data.draw(st.lists(literals, min_size=count, max_size=count))
    command = [kind(v) for v in data.draw(st.lists(st.floats(-4.0, 4.0, width=16), min_size=1, max_size=30))]
    declarations = (
        f"VAR_OUTPUT\n  R : {real_type};\nEND_VAR\nVAR CONSTANT\n"
        f"  Taps : ARRAY[0..{count - 1}] OF {real_type} := [{', '.join(taps)}];\nEND_VAR\n"
        f"VAR\n  Ring : ARRAY[0..{count - 1}] OF {real_type};\n  I, Head, Cell : DINT;\nEND_VAR\n"
    )
    body = (
        f"Head := (Head + 1) MOD {count};\nRing[Head] := A;\nR := 0.0;\nFOR I := 0 TO {count - 1} DO\n"
        f"  Cell := Head - I;\n  IF Cell < 0 THEN\n    Cell := Cell + {count};\n  END_IF;\n"
        "  R := R + (Taps[I] * Ring[Cell]);\nEND_FOR;\n"
    )
    instance = load(source_of(real_type, declarations, body)).instantiate()
    for tick, value in enumerate(command):
        expected = kind(0.0)
        for delay, tap in enumerate(taps):
            past = command[tick - delay] if delay <= tick else kind(0.0)
            expected = expected + kind(tap) * past
        assert same_bits(instance.step({"A": value})["R"], float(expected))


integers = st.integers(DINT_MIN, DINT_MAX) | st.integers(-9, 9) | st.sampled_from([DINT_MIN, DINT_MAX])


def integer_trees():
    def grow(inner):
        literal = integers.map(str)
        operators = st.sampled_from(["+", "-", "*", "/", "MOD"])
        return st.one_of(
            st.tuples(operators, inner, inner | literal),
            st.tuples(operators, literal, inner),
            st.tuples(st.sampled_from(["-", "ABS"]), inner),
        )

    return st.recursive(variables, grow, max_leaves=6)


def exactly(tree, values):
    """Value in unbounded integers; ArithmeticError where a DINT overflows or a divisor is zero."""
    match tree:
        case str():
            return values[tree] if tree in values else int(tree)
        case (function, operand):
            operand = exactly(operand, values)
            result = -operand if function == "-" else abs(operand)
        case (operator, left, right):
            left, right = exactly(left, values), exactly(right, values)
            quotient = math.trunc(Fraction(left, right)) if operator in ("/", "MOD") else 0
            result = {
                "+": left + right,
                "-": left - right,
                "*": left * right,
                "/": quotient,
                "MOD": left - right * quotient,
            }[operator]
    if not DINT_MIN <= result <= DINT_MAX:
        raise OverflowError
    return result


@FIXED
@given(tree=integer_trees(), ticks=st.lists(st.tuples(integers, integers, integers), min_size=1, max_size=6))
def test_random_integer_expressions_equal_exact_arithmetic_or_fail_where_it_leaves_dint(tree, ticks):
    def expected(values):
        try:
            return exactly(tree, values)
        except ArithmeticError:
            return None

    rows = [dict(zip(VARIABLES, tick, strict=True)) for tick in ticks]
    source = source_of("DINT", "VAR_OUTPUT\n  R : DINT;\nEND_VAR\n", f"R := {text_of(tree)};\n")
    try:
        instance = load(source).instantiate()
    except SubsetError:  # what can be seen to fail whatever the inputs are
        assert all(expected(values) is None for values in rows)
        return
    for values in rows:
        try:
            found = instance.step(values)["R"]
        except ExecutionError:
            found = None
        assert found == expected(values)


@FIXED
@given(
    text=st.from_regex(r"-?[0-9]\.[0-9]{1,40}E-?[0-3]?[0-9]", fullmatch=True, alphabet="-0123456789.E"),
)
def test_singles_are_the_nearest_to_their_decimal_text(text):
    single, exact = real(text), Fraction(text)
    distance = abs(Fraction(float(single)) - exact)
    for side in (-np.inf, np.inf):
        neighbour = np.nextafter(single, np.float32(side))
        assert not np.isfinite(neighbour) or distance <= abs(Fraction(float(neighbour)) - exact)
