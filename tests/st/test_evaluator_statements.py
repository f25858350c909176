"""What a statement of the portable subset does, against values worked out by hand."""

import pytest

from swayless.verify.structured_text import load


def ran(body, inputs=None, local="", result="DINT"):
    """Result of a body over the inputs N (DINT) and P, Q (BOOL)."""
    section = f"VAR\n{local}END_VAR\n" if local else ""
    block = load(
        "FUNCTION_BLOCK FB_T\nVAR_INPUT\n  N : DINT;\n  P, Q : BOOL;\nEND_VAR\n"
        f"VAR_OUTPUT\n  Result : {result};\nEND_VAR\n{section}{body}\nEND_FUNCTION_BLOCK\n"
    )
    return block.instantiate().step(inputs or {})["Result"]


@pytest.mark.parametrize(
    ("p", "q", "expected"), [(True, True, 1), (True, False, 1), (False, True, 2), (False, False, 3)]
)
def test_if_takes_the_first_branch_that_holds(p, q, expected):
    body = "IF P THEN\n  Result := 1;\nELSIF Q THEN\n  Result := 2;\nELSE\n  Result := 3;\nEND_IF;"
    assert ran(body, {"P": p, "Q": q}) == expected


def test_if_without_else_may_do_nothing():
    assert ran("IF P THEN\n  Result := 1;\nEND_IF;") == 0


def test_if_nests():
    inner = "IF Q THEN\n    Result := 1;\n  ELSE\n    Result := 2;\n  END_IF;"
    body = f"IF P THEN\n  {inner}\n  Result := Result + 10;\nEND_IF;"
    assert ran(body, {"P": True, "Q": True}) == 11
    assert ran(body, {"P": True, "Q": False}) == 12


@pytest.mark.parametrize(("n", "expected"), [(0, 10), (1, 20), (2, 20), (-3, 30), (7, 99), (3, 99)])
def test_case_takes_the_branch_of_its_label(n, expected):
    body = (
        "CASE N OF\n  0:\n    Result := 10;\n  1, 2:\n    Result := 5;\n    Result := Result * 4;\n"
        "  -3:\n    Result := 30;\nELSE\n  Result := 99;\nEND_CASE;"
    )
    assert ran(body, {"N": n}) == expected


def test_case_inside_case_leaves_the_outer_one_alone():
    inner = "CASE N - 1 OF\n  0:\n    Result := 1;\nELSE\n    Result := 2;\n  END_CASE;"
    body = f"CASE N OF\n  1:\n    {inner}\n  0:\n    Result := 3;\nELSE\n  Result := 4;\nEND_CASE;"
    assert [ran(body, {"N": n}) for n in (0, 1, 2)] == [3, 1, 4]


@pytest.mark.parametrize(
    ("bounds", "visited"),
    [
        ("0 TO 3", [0, 1, 2, 3]),
        ("0 TO 3 BY 1", [0, 1, 2, 3]),
        ("1 TO 8 BY 3", [1, 4, 7]),
        ("3 TO 0 BY -1", [3, 2, 1, 0]),
        ("-2 TO 2 BY 2", [-2, 0, 2]),
        ("LAST - 1 TO LAST", [4, 5]),
    ],
)
def test_for_visits(bounds, visited):
    source = (
        "FUNCTION_BLOCK FB_T\nVAR_OUTPUT\n  Digits : DINT;\nEND_VAR\n"
        "VAR CONSTANT\n  LAST : DINT := 5;\nEND_VAR\n"
        f"VAR\n  I : DINT;\nEND_VAR\nFOR I := {bounds} DO\n  Digits := (Digits * 10) + (I + 2);\nEND_FOR;\n"
        "END_FUNCTION_BLOCK\n"
    )
    digits = 0
    for value in visited:
        digits = digits * 10 + value + 2
    assert load(source).instantiate().step({}) == {"Digits": digits}


def test_for_nests_and_an_int_may_control_it():
    inner = "FOR J := 0 TO 1 DO\n    Result := Result + ((I * 10) + INT_TO_DINT(J));\n  END_FOR;"
    body = f"FOR I := 0 TO 2 DO\n  {inner}\nEND_FOR;"
    assert ran(body, local="  I : DINT;\n  J : INT;\n") == 2 * (0 + 10 + 20) + 3 * (0 + 1)


def test_for_may_use_its_variable_twice_in_a_row():
    loop = "FOR I := 0 TO 1 DO\n  Result := Result + I;\nEND_FOR;\n"
    assert ran(loop + loop, local="  I : DINT;\n") == 2


def test_arrays_are_read_and_written_by_element():
    body = "Ring[2] := 7;\nRing[N] := Ring[2] + Ring[N + 1];\nResult := Ring[0];"
    assert ran(body, {"N": 0}, local="  Ring : ARRAY[0..2] OF DINT := [1, 20, 300];\n") == 27


def test_an_index_may_be_an_element():
    body = "Result := Table[Table[N]];"
    assert ran(body, {"N": 1}, local="  Table : ARRAY[0..2] OF DINT := [5, 2, 9];\n") == 9


def test_statements_run_in_order_and_comments_do_nothing():
    body = "Result := 1; (* Result := 5; *)\nResult (* in *) := Result + (* between *) 1;\n(* a ** b *)"
    assert ran(body) == 2


def test_keywords_are_upper_case_and_names_ignore_case():
    assert ran("result := n;\nRESULT := Result + 1;", {"N": 3}) == 4


def test_int_keeps_its_own_type():
    assert ran("Result := (Few * 2) - 1;", local="  Few : INT := 16000;\n", result="INT") == 31999
