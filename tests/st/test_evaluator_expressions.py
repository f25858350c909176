"""What an expression of the portable subset is worth, against values computed by hand."""

import math

import numpy as np
import pytest

from swayless.verify.structured_text import load

DINT_MIN, DINT_MAX = -(2**31), 2**31 - 1


def evaluated(expression, result="DINT", **inputs):
    """Value of an expression over the inputs A to D (DINT), P to S (BOOL) and X, Y (the real type)."""
    real = result if result in ("REAL", "LREAL") else "LREAL"
    block = load(
        f"FUNCTION_BLOCK FB_T\nVAR_INPUT\n  A, B, C, D : DINT;\n  P, Q, R, S : BOOL;\n  X, Y : {real};\n"
        f"  Small : INT;\nEND_VAR\nVAR_OUTPUT\n  Result : {result};\nEND_VAR\n"
        f"Result := {expression};\nEND_FUNCTION_BLOCK\n"
    )
    return block.instantiate().step(inputs)["Result"]


@pytest.mark.parametrize(
    ("expression", "inputs", "expected"),
    [
        ("A + B + C", {"A": 1, "B": 2, "C": 3}, 6),
        ("A - B - C", {"A": 10, "B": 3, "C": 2}, 5),
        ("(A - B) + C", {"A": 10, "B": 3, "C": 2}, 9),
        ("A / B / C", {"A": 100, "B": 5, "C": 2}, 10),
        ("(A * B) / C", {"A": 7, "B": 3, "C": 2}, 10),
        ("A -1", {"A": 3}, 2),
        ("A-1", {"A": 3}, 2),
        ("A - (-1)", {"A": 3}, 4),
        ("-A", {"A": 3}, -3),
        ("A * (-B)", {"A": 3, "B": 2}, -6),
        ("A / B", {"A": 7, "B": 2}, 3),
        ("A / B", {"A": -7, "B": 2}, -3),
        ("A / B", {"A": 7, "B": -2}, -3),
        ("A / B", {"A": -7, "B": -2}, 3),
        ("A MOD B", {"A": 7, "B": 4}, 3),
        ("A MOD B", {"A": -7, "B": 4}, -3),
        ("A MOD B", {"A": 7, "B": -4}, 3),
        ("A MOD B", {"A": -7, "B": -4}, -3),
        ("(-7) MOD B", {"B": 4}, -3),
        ("A MOD B", {"A": DINT_MIN, "B": -1}, 0),
        ("ABS(A)", {"A": -5}, 5),
        ("ABS(A)", {"A": DINT_MIN + 1}, DINT_MAX),
        ("A + B", {"A": DINT_MAX, "B": 0}, DINT_MAX),
        ("A - B", {"A": DINT_MIN, "B": 0}, DINT_MIN),
        ("INT_TO_DINT(Small) + A", {"Small": -32768, "A": 1}, -32767),
        ("-2147483648", {}, DINT_MIN),
        ("((A))", {"A": 4}, 4),
        ("a + Result", {"A": 4}, 4),
    ],
)
def test_integer_expression(expression, inputs, expected):
    assert evaluated(expression, **inputs) == expected


@pytest.mark.parametrize(
    ("expression", "true_for"),
    [
        ("P AND Q", "p and q"),
        ("P OR Q", "p or q"),
        ("P XOR Q", "p != q"),
        ("NOT P AND Q", "(not p) and q"),
        ("NOT P OR Q", "(not p) or q"),
        ("P AND NOT Q", "p and not q"),
        ("P AND Q AND R", "p and q and r"),
        ("P OR Q OR R", "p or q or r"),
        ("P XOR Q XOR R", "(p + q + r) % 2 == 1"),
        ("P OR (Q AND R)", "p or (q and r)"),
        ("(P OR Q) AND R", "(p or q) and r"),
        ("P = Q", "p == q"),
        ("P <> Q", "p != q"),
        ("(A < B) AND (B <= A)", "False"),
    ],
)
def test_boolean_expression_over_its_whole_truth_table(expression, true_for):
    for p in (False, True):
        for q in (False, True):
            for r in (False, True):
                expected = eval(true_for, {"p": p, "q": q, "r": r})
                assert evaluated(expression, "BOOL", P=p, Q=q, R=r) is expected


@pytest.mark.parametrize("operator", ["<", "<=", ">", ">=", "=", "<>"])
@pytest.mark.parametrize("real", ["LREAL", "REAL"])
def test_comparisons_follow_ieee_754(operator, real):
    source = (
        f"FUNCTION_BLOCK FB_T\nVAR_INPUT\n  X, Y : {real};\nEND_VAR\nVAR_OUTPUT\n  Holds : BOOL;\nEND_VAR\n"
        f"Holds := X {operator} Y;\nEND_FUNCTION_BLOCK\n"
    )
    instance = load(source).instantiate()
    values = [-math.inf, -1.0, -0.0, 0.0, 2.5, math.inf, math.nan]
    python = {"=": "==", "<>": "!="}.get(operator, operator)
    for x in values:
        for y in values:
            expected = eval(f"x {python} y", {"x": x, "y": y})
            assert instance.step({"X": x, "Y": y}) == {"Holds": expected}


@pytest.mark.parametrize(
    ("expression", "inputs", "expected"),
    [
        ("X / Y", {"X": 1.0, "Y": 0.0}, math.inf),
        ("X / Y", {"X": 1.0, "Y": -0.0}, -math.inf),
        ("X / Y", {"X": 0.0, "Y": 0.0}, math.nan),
        ("X / Y", {"X": math.nan, "Y": 0.0}, math.nan),
        ("X - Y", {"X": math.inf, "Y": math.inf}, math.nan),
        ("X * Y", {"X": 2.0**100, "Y": 2.0**100}, {"LREAL": 2.0**200, "REAL": math.inf}),
        ("SQRT(X)", {"X": 2.25}, 1.5),
        ("SQRT(X)", {"X": -1.0}, math.nan),
        ("SQRT(X)", {"X": -0.0}, -0.0),
        ("-X", {"X": 0.0}, -0.0),
        ("ABS(X)", {"X": -0.0}, 0.0),
        ("ABS(X)", {"X": -math.inf}, math.inf),
        ("X + (-1.5E-1)", {"X": 0.0}, {"LREAL": -0.15, "REAL": float(np.float32(-0.15))}),
        ("X - 1.0", {"X": 1.0}, 0.0),
        ("X -1.0", {"X": 1.0}, 0.0),
    ],
)
@pytest.mark.parametrize("real", ["LREAL", "REAL"])
def test_real_expression_follows_ieee_754(expression, inputs, expected, real):
    expected = expected[real] if isinstance(expected, dict) else expected
    singles = {name: float(np.float32(value)) for name, value in inputs.items()} if real == "REAL" else inputs
    # repr tells -0.0 from 0.0 and takes every NaN as one.
    assert repr(evaluated(expression, real, **singles)) == repr(expected)


@pytest.mark.parametrize(
    ("value", "expected"),
    [(2.9, 2), (-2.9, -2), (0.0, 0), (2147483647.9, DINT_MAX), (-2147483648.9, DINT_MIN)],
)
def test_trunc_drops_the_fraction(value, expected):
    assert evaluated("TRUNC(X)", "DINT", X=value) == expected


def test_conversion_to_real_rounds_to_nearest_even():
    assert evaluated("DINT_TO_REAL(A)", "REAL", A=16777217) == 16777216.0
    assert evaluated("DINT_TO_REAL(A)", "REAL", A=16777219) == 16777220.0


def test_conversion_to_lreal_is_exact():
    assert evaluated("DINT_TO_LREAL(A)", "LREAL", A=DINT_MAX) == 2147483647.0
    assert evaluated("INT_TO_LREAL(Small)", "LREAL", Small=-32768) == -32768.0


def test_every_real_operation_is_rounded_to_single():
    # 1 + 2^-24 is a tie in single precision and goes to 1, though a double would hold it.
    assert evaluated("(X + Y) - X", "REAL", X=1.0, Y=2.0**-24) == 0.0
    assert evaluated("(X + Y) - X", "LREAL", X=1.0, Y=2.0**-24) == 2.0**-24


def test_literals_are_rounded_to_single_once():
    # Just below the middle of two singles, and nearest to that middle as a double.
    assert evaluated("1.00000017881393432617187499", "REAL") == 1.0 + 2.0**-23
    assert evaluated("1.00000017881393432617187501", "REAL") == 1.0 + 2.0**-22
    assert evaluated("1.0E-45", "REAL") == 2.0**-149


def test_both_operands_of_and_are_evaluated():
    source = (
        "FUNCTION_BLOCK FB_T\nVAR_INPUT\n  I : DINT;\nEND_VAR\nVAR_OUTPUT\n  Found : BOOL;\nEND_VAR\n"
        "VAR\n  Seen : ARRAY[0..3] OF BOOL;\nEND_VAR\n"
        "Found := (I < 4) AND Seen[I];\nEND_FUNCTION_BLOCK\n"
    )
    with pytest.raises(AssertionError, match=r"line 11: index I of Seen = 4 is outside 0 to 3 \(I = 4\)"):
        load(source).instantiate().step({"I": 4})
