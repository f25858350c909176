"""Each declaration outside the portable subset is refused with its line and the reason."""

import pytest

from swayless.verify.structured_text import SubsetError, load


def problems_of(source):
    with pytest.raises(SubsetError) as caught:
        load(source)
    return caught.value.problems


def declared(sections):
    return (
        f"FUNCTION_BLOCK FB_T\n{sections}VAR_OUTPUT\n  Ok : BOOL;\nEND_VAR\nOk := TRUE;\nEND_FUNCTION_BLOCK\n"
    )


def local(declaration):
    return declared(f"VAR\n  {declaration}\nEND_VAR\n")


@pytest.mark.parametrize(
    "declaration",
    [
        "A : BOOL := TRUE;",
        "A, B : DINT := -5;",
        "A : LREAL := -1.0E-3;",
        "A : ARRAY[0..2] OF LREAL := [1.0, -2.0, 3.5E-1];",
        "A : ARRAY [0 .. 2] OF BOOL;",
        f"{'a' * 40} : INT;",
    ],
)
def test_portable_declaration(declaration):
    assert load(local(declaration)).instantiate().step({}) == {"Ok": True}


@pytest.mark.parametrize(
    ("declaration", "message"),
    [
        (
            "A : ARRAY[0..2] OF LREAL := [3(0.0)];",
            "'3(0.0)' is outside the portable subset: write every initial value out",
        ),
        ("A : ARRAY[0..2] OF LREAL := [1.0, 2.0];", "A: 2 initial values for 3 elements"),
        ("A : ARRAY[0..1] OF LREAL := [1.0, 2];", "2 is not a literal of type LREAL: write it with a point"),
        ("A : ARRAY[0..1] OF LREAL := 1.0;", "A: the initial values of an array stand in [ ]"),
        ("A : ARRAY[1..2] OF LREAL;", "A: array bounds start at 0 and rise, found 1..2"),
        ("A : ARRAY[0..-1] OF LREAL;", "A: array bounds start at 0 and rise, found 0..-1"),
        ("A : ARRAY[0..N] OF LREAL;", "'N' is outside the portable subset: not allowed here (subrange)"),
        (
            "A : ARRAY[0..1, 0..1] OF LREAL;",
            "',' is outside the portable subset: not allowed here (array type)",
        ),
        ("A : DINT := [1];", "A: the initial value must be one literal"),
        ("A : DINT := B;", "A: the initial value must be one literal"),
        (
            "A : DINT := 1 + 2;",
            "'1 + 2' is outside the portable subset: not allowed here (variable declaration)",
        ),
        ("A : DINT := 1.0;", "1.0 is not a literal of type DINT"),
        ("A : LREAL := 1;", "1 is not a literal of type LREAL: write it with a point"),
        ("A : BOOL := 1;", "1 is not a literal of type BOOL"),
        ("A : INT := 40000;", "40000 is outside INT, -32768 to 32767"),
        ("A : UDINT;", "'UDINT' is outside the portable subset: not allowed here (elementary type)"),
        ("A : TIME;", "'TIME' is outside the portable subset: not allowed here (elementary type)"),
        ("A : STRING;", "'STRING' is outside the portable subset: not allowed here (variable declaration)"),
        (
            "A : POINTER TO DINT;",
            "'POINTER TO DINT' is outside the portable subset: not allowed here (variable declaration)",
        ),
        ("A : FB_Other;", "FB_Other is not a type and no function block declared above"),
        ("A : FB_T;", "FB_T is not a type and no function block declared above"),
        ("A : DINT; a : BOOL;", "a is declared already; upper and lower case are the same"),
        ("A, A : DINT;", "A is declared already; upper and lower case are the same"),
        ("fb_t : DINT;", "fb_t is declared already; upper and lower case are the same"),
        ("LOG : DINT;", "LOG is reserved: choose another name"),
        ("EN : BOOL;", "EN is reserved: choose another name"),
    ],
)
def test_declaration_that_is_not_portable(declaration, message):
    assert problems_of(local(declaration)) == ((3, message),)


def test_names_collide_across_sections():
    assert problems_of(local("OK : DINT;")) == (
        (6, "Ok is declared already; upper and lower case are the same"),
    )


@pytest.mark.parametrize(
    ("section", "message"),
    [
        ("VAR\nEND_VAR\n", "a VAR section must not be empty"),
        (
            "VAR RETAIN\n  A : DINT;\nEND_VAR\n",
            "'RETAIN' is outside the portable subset: not allowed here (var qualifier)",
        ),
        (
            "VAR_TEMP\n  A : DINT;\nEND_VAR\n",
            "'VAR_TEMP A : DINT; END_VAR' is outside the portable subset: "
            "not allowed here (function block declaration)",
        ),
        (
            "VAR_IN_OUT\n  A : DINT;\nEND_VAR\n",
            "'VAR_IN_OUT A : DINT; END_VAR' is outside the portable subset: "
            "not allowed here (function block declaration)",
        ),
    ],
)
def test_section_that_is_not_portable(section, message):
    assert problems_of(declared(section)) == ((2, message),)


@pytest.mark.parametrize(
    ("section", "message"),
    [
        ("VAR CONSTANT\n  A : DINT;\nEND_VAR\n", "A: a constant needs an initial value"),
        (
            "VAR_INPUT\n  A : ARRAY[0..1] OF DINT;\nEND_VAR\n",
            "A: inputs and outputs are scalars, an array is not portable there",
        ),
        (
            "VAR\n  A : REAL := 1.0E-50;\nEND_VAR\n",
            "1.0E-50 is too small for REAL: it would become 0",
        ),
    ],
)
def test_variable_that_is_not_portable_in_its_section(section, message):
    assert problems_of(declared(section)) == ((3, message),)


def test_one_real_type_per_file():
    other = declared("VAR\n  A : REAL;\nEND_VAR\n").replace("FB_T", "FB_Other")
    assert problems_of(local("A : LREAL;") + other) == ((12, "REAL after LREAL: one real type per file"),)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        ("Part(B := 1);", "B is not an input of FB_Part"),
        ("Part(A := 1, a := 2);", "a is given twice"),
        ("Part(1);", "1: write arguments as Name := value"),
        ("Part(A := TRUE);", "TRUE is not a literal of type DINT"),
        ("Part(A := 1, Out => K);", "'=>' is outside the portable subset: not allowed here (named argument)"),
        ("Part.A := 1;", "Part.A cannot be assigned: only variables and array elements can"),
        ("K := Part.A;", "A is not an output of FB_Part"),
        ("K := Part.Gone;", "Gone is not an output of FB_Part"),
        ("K := Part;", "Part is not declared as a variable"),
        ("FB_Part(A := 1);", "FB_Part is not declared as a function block"),
    ],
)
def test_use_of_an_inner_block_that_is_not_portable(call, message):
    inner = (
        "FUNCTION_BLOCK FB_Part\nVAR_INPUT\n  A : DINT;\nEND_VAR\nVAR_OUTPUT\n  Out : DINT;\nEND_VAR\n"
        "Out := A;\nEND_FUNCTION_BLOCK\n"
    )
    outer = f"FUNCTION_BLOCK FB_T\nVAR\n  Part : FB_Part;\n  K : DINT;\nEND_VAR\n{call}\nEND_FUNCTION_BLOCK\n"
    assert problems_of(inner + outer) == ((15, message),)


@pytest.mark.parametrize(
    ("section", "message"),
    [
        (
            "VAR_INPUT\n  Part : FB_Part;\nEND_VAR\n",
            "Part: a function block is declared in a plain VAR section",
        ),
        (
            "VAR CONSTANT\n  Part : FB_Part;\nEND_VAR\n",
            "Part: a function block is declared in a plain VAR section",
        ),
        (
            "VAR\n  Part : FB_Part := 1;\nEND_VAR\n",
            "Part: a function block is declared in a plain VAR section",
        ),
    ],
)
def test_inner_block_is_a_plain_local(section, message):
    inner = "FUNCTION_BLOCK FB_Part\nVAR\n  A : DINT;\nEND_VAR\nA := 1;\nEND_FUNCTION_BLOCK\n"
    assert problems_of(inner + declared(section)) == ((9, f"{message}, without initial value"),)


@pytest.mark.parametrize(
    ("source", "line", "message"),
    [
        ("", 1, "the file holds no function block"),
        ("(* nothing *)\n", 1, "the file holds no function block"),
        (local("A : DINT;") * 2, 10, "FB_T is declared already; upper and lower case are the same"),
        (local("A : DINT;").replace("FB_T", "TON"), 1, "TON is reserved: choose another name"),
        (
            local("A : DINT;").replace("FB_T", "FB_T EXTENDS FB_Base"),
            1,
            "'EXTENDS' is outside the portable subset: not allowed here (function block declaration)",
        ),
        (local("A : DINT;").replace("END_FUNCTION_BLOCK\n", ""), 8, "END_FUNCTION_BLOCK is missing"),
        (
            "PROGRAM Go\nX := 1;\nEND_PROGRAM\n",
            1,
            "'PROGRAM Go X := 1; END_PROGRAM' is outside the portable subset: not allowed here (source file)",
        ),
    ],
)
def test_file_that_is_not_portable(source, line, message):
    assert (line, message) in problems_of(source)


def test_deep_nesting_is_refused_before_python_refuses_it():
    deep = "(" * 60 + "TRUE" + ")" * 60
    source = f"FUNCTION_BLOCK FB_T\nVAR_OUTPUT\n  Ok : BOOL;\nEND_VAR\nOk := {deep};\nEND_FUNCTION_BLOCK\n"
    assert problems_of(source) == ((5, "nested deeper than 50 levels"),)


def test_the_deepest_nesting_allowed_still_compiles():
    # Each index is a range check with three parentheses: the most that one level makes.
    depth = 46
    source = (
        "FUNCTION_BLOCK FB_T\nVAR_OUTPUT\n  K : DINT;\nEND_VAR\n"
        "VAR\n  A : ARRAY[0..1] OF DINT := [1, 0];\nEND_VAR\n"
        f"K := {'A[' * depth}K{']' * depth};\nEND_FUNCTION_BLOCK\n"
    )
    assert load(source).instantiate().step({}) == {"K": 0}


def test_statements_nest_twelve_levels():
    def nested(levels):
        return "IF Ok THEN\n" * levels + "Ok := FALSE;\n" + "END_IF;\n" * levels

    def source(levels):
        body = nested(levels)
        return f"FUNCTION_BLOCK FB_T\nVAR_OUTPUT\n  Ok : BOOL := TRUE;\nEND_VAR\n{body}END_FUNCTION_BLOCK\n"

    assert load(source(11)).instantiate().step({}) == {"Ok": False}
    assert problems_of(source(12)) == ((16, "statements are nested deeper than 12"),)
