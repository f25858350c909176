"""What a controller would do wrong without a word is an error here, with its line and values."""

import math

import pytest

from swayless.verify.structured_text import ExecutionError, load

DINT_MIN, DINT_MAX = -(2**31), 2**31 - 1
DINT = "outside -2147483648 to 2147483647"
INT = "outside -32768 to 32767"

HEAD = """FUNCTION_BLOCK FB_T
VAR_INPUT
  A, B : DINT;
  Few : INT;
  X : LREAL;
END_VAR
VAR
  Result : DINT;
  Small : INT;
  Ring : ARRAY[0..9] OF DINT;
  I : DINT;
END_VAR
"""


def fault_of(statement, **inputs):
    instance = load(f"{HEAD}{statement}\nEND_FUNCTION_BLOCK\n").instantiate()
    with pytest.raises(ExecutionError) as caught:
        instance.step(inputs)
    assert caught.value.line == HEAD.count("\n") + 1
    prefix = f"line {caught.value.line}: "
    assert str(caught.value).startswith(prefix)
    return str(caught.value).removeprefix(prefix)


@pytest.mark.parametrize(
    ("statement", "inputs", "message"),
    [
        (
            "Result := A + B;",
            {"A": DINT_MAX, "B": 1},
            f"DINT A + B = 2147483648 is {DINT} (A = 2147483647, B = 1)",
        ),
        ("Result := A - 1;", {"A": DINT_MIN}, f"DINT A - 1 = -2147483649 is {DINT} (A = -2147483648)"),
        (
            "Result := A * B;",
            {"A": 65536, "B": 32768},
            f"DINT A * B = 2147483648 is {DINT} (A = 65536, B = 32768)",
        ),
        ("Result := -A;", {"A": DINT_MIN}, f"DINT -A = 2147483648 is {DINT} (A = -2147483648)"),
        ("Result := ABS(A);", {"A": DINT_MIN}, f"DINT ABS(A) = 2147483648 is {DINT} (A = -2147483648)"),
        (
            "Result := A / B;",
            {"A": DINT_MIN, "B": -1},
            f"DINT A / B = 2147483648 is {DINT} (A = -2147483648, B = -1)",
        ),
        ("Small := Few + 1;", {"Few": 32767}, f"INT Few + 1 = 32768 is {INT} (Few = 32767)"),
        ("Small := Few * Few;", {"Few": 200}, f"INT Few * Few = 40000 is {INT} (Few = 200)"),
        ("Result := (A + 1) - 1;", {"A": DINT_MAX}, f"DINT A + 1 = 2147483648 is {DINT} (A = 2147483647)"),
        ("Result := A / B;", {"A": 5}, "A / B divides 5 by zero (A = 5, B = 0)"),
        ("Result := A MOD (B + 1);", {"A": 5, "B": -1}, "A MOD (B + 1) divides 5 by zero (A = 5, B = -1)"),
        ("Result := Ring[A];", {"A": 10}, "index A of Ring = 10 is outside 0 to 9 (A = 10)"),
        ("Result := Ring[A - 1];", {"A": 0}, "index A - 1 of Ring = -1 is outside 0 to 9 (A = 0)"),
        ("Ring[A] := 1;", {"A": -1}, "index A of Ring = -1 is outside 0 to 9 (A = -1)"),
        ("Result := Ring[Few];", {"Few": 10}, "index Few of Ring = 10 is outside 0 to 9 (Few = 10)"),
        ("Result := TRUNC(X);", {"X": 2147483648.0}, f"TRUNC(X) = 2147483648.0 is {DINT} (X = 2147483648.0)"),
        ("Result := TRUNC(X);", {"X": -math.inf}, f"TRUNC(X) = -inf is {DINT} (X = -inf)"),
        ("Result := TRUNC(X * 2.0);", {"X": math.nan}, f"TRUNC(X * 2.0) = nan is {DINT} (X = nan)"),
        ("Result := TRUNC(X / 0.0);", {"X": 1.0}, f"TRUNC(X / 0.0) = inf is {DINT} (X = 1.0)"),
    ],
)
def test_fault_names_expression_result_range_and_values(statement, inputs, message):
    assert fault_of(statement, **inputs) == message


def test_a_loop_that_leaves_the_array_says_where():
    loop = "FOR I := 0 TO 5 DO Ring[I + 5] := I; END_FOR;"
    assert fault_of(loop) == "index I + 5 of Ring = 10 is outside 0 to 9 (I = 5)"


def test_the_line_is_the_one_of_the_statement_inside_a_compound_one():
    source = f"{HEAD}IF A = 0 THEN\n  Result := 1;\n\n  Result := Ring[B];\nEND_IF;\nEND_FUNCTION_BLOCK\n"
    with pytest.raises(ExecutionError) as caught:
        load(source).instantiate().step({"B": 12})
    assert caught.value.line == HEAD.count("\n") + 4


def test_a_fault_in_an_inner_block_has_the_line_of_the_inner_block():
    inner = HEAD.replace("FB_T", "FB_Inner") + "Result := A + 1;\nEND_FUNCTION_BLOCK\n"
    call = "Part(A := 2147483647);"
    outer = f"FUNCTION_BLOCK FB_Outer\nVAR\n  Part : FB_Inner;\nEND_VAR\n{call}\nEND_FUNCTION_BLOCK\n"
    with pytest.raises(ExecutionError) as caught:
        load(inner + outer).instantiate().step({})
    assert caught.value.line == HEAD.count("\n") + 1


def test_what_just_fits_is_no_fault():
    source = f"{HEAD}Result := (A - 1) + B;\nSmall := Few - 1;\nRing[A] := Ring[0];\nEND_FUNCTION_BLOCK\n"
    assert load(source).instantiate().step({"A": 9, "B": DINT_MAX - 8, "Few": -32767}) == {}
