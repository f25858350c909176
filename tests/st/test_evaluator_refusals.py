"""Each construct outside the portable subset is refused with its line and the reason."""

import pytest

from swayless.verify.structured_text import SubsetError, load

HEAD = """FUNCTION_BLOCK FB_T
VAR_INPUT
  P : BOOL;
  N : DINT;
  X : LREAL;
END_VAR
VAR_OUTPUT
  Q : BOOL;
  K : DINT;
  Y : LREAL;
END_VAR
VAR CONSTANT
  LAST : DINT := 3;
  FIXED : ARRAY[0..1] OF DINT := [4, 5];
END_VAR
VAR
  I, J : DINT;
  Few : INT;
  Ring : ARRAY[0..3] OF LREAL;
  Flags : ARRAY[0..1] OF BOOL;
END_VAR
"""
LINE = HEAD.count("\n") + 1
LOOP = "FOR I := {} DO Y := 1.0; END_FOR;"


def refusal_of(source):
    with pytest.raises(SubsetError) as caught:
        load(source)
    return caught.value.problems


def with_body(body):
    return f"{HEAD}{body}\nEND_FUNCTION_BLOCK\n"


def test_the_head_alone_is_accepted():
    assert load(with_body("Q := P;")).name == "FB_T"


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ("Q := P; // hello", "line comments are not portable: use (* *)"),
        ("Q := P; /* hello */", "C comments are not portable: use (* *)"),
        ("Q := P; (* a (* b *) c *)", "a comment must not hold (*"),
        ("Q := P; (* 5 $ *)", "a comment must not hold $"),
        ("Q := P; (* {attribute} *)", "a comment must not hold {"),
        ("Q := P; (* open", "the comment does not end"),
        ("{attribute} Q := P;", "pragmas are not portable"),
        ("Y := X ** 2.0;", "the power operator is not portable: multiply"),
        ("Q := P & P;", "write AND"),
        ("K := 16#FF;", "typed and based literals are not portable: write a plain decimal number"),
        ("Y := LREAL#1.0;", "typed and based literals are not portable: write a plain decimal number"),
        ("Q := P;\r", "line ends must be LF, found CR"),
        ("\tQ := P;", "indent with spaces, found a tab"),
        ("Q := P; (* 5 \u00b5m *)", "character '\u00b5' is not ASCII"),
        ("Q := 'P';", 'character "\'" is not portable'),
        ("Y := X^;", "character '^' is not portable"),
        ("A__b := 1;", "A__b holds two underscores in a row"),
        ("Speed_ := 1;", "Speed_ ends in an underscore"),
        (f"{'a' * 41} := 1;", f"{'a' * 41} has 41 characters, at most 40 are allowed"),
        (
            "if P THEN Q := P; END_IF;",
            "if is reserved: as a keyword it is written IF, as a name choose another",
        ),
        ("Q := True;", "True is reserved: as a keyword it is written TRUE, as a name choose another"),
        ("Step := 1;", "Step is reserved: as a keyword it is written STEP, as a name choose another"),
    ],
)
def test_text_that_is_not_portable(body, message):
    assert (LINE, message) in refusal_of(with_body(body))


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ("Q := P", "; is missing"),
        ("Q := P +;", "identifier is missing"),
        ("Q P;", "syntax error at 'Q P;'"),
        ("EXIT;", "'EXIT;' is outside the portable subset: let the loop end by its bounds"),
        ("RETURN;", "'RETURN;' is outside the portable subset: use IF"),
        ("CONTINUE;", "'CONTINUE;' is outside the portable subset: use IF"),
        (
            "WHILE P DO Q := P; END_WHILE;",
            "'WHILE P DO Q := P; END_WHILE' is outside the portable subset: use FOR with constant bounds",
        ),
        (
            "REPEAT Q:=P; UNTIL P END_REPEAT;",
            "'REPEAT Q:=P; UNTIL P END_REPEAT' is outside the portable subset: use FOR with constant bounds",
        ),
        (
            "CASE N OF 1..3: Q := P; ELSE Q := P; END_CASE;",
            "'1..3' is outside the portable subset: not allowed here (case value)",
        ),
        (
            "CASE N OF LAST: Q := P; ELSE Q := P; END_CASE;",
            "'LAST' is outside the portable subset: not allowed here (case value)",
        ),
        ("Y := Ring[0, 1];", "',' is outside the portable subset: not allowed here (index expression)"),
        ("Q := P;;", "a lone ; is not portable"),
        ("IF P THEN Q := P; END_IF", "; is missing after END_IF"),
        ("IF P THEN Q := P; END_IF Q := P;", "; is missing after END_IF"),
        ("IF P THEN END_IF;", "a list of statements must not be empty"),
        ("IF P THEN Q := P; ELSE END_IF;", "a list of statements must not be empty"),
        ("IF P THEN ; END_IF;", "a lone ; is not portable"),
    ],
)
def test_construct_that_is_not_portable(body, message):
    assert (LINE, message) in refusal_of(with_body(body))


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ("K := X;", "X is LREAL where DINT is needed: convert it"),
        ("Y := N;", "N is DINT where LREAL is needed: convert it"),
        ("K := Few;", "Few is INT where DINT is needed: convert it"),
        ("K := N + Few;", "Few is INT where DINT is needed: convert it"),
        ("Y := X + N;", "N is DINT where LREAL is needed: convert it"),
        ("Y := X + 1;", "1 is not a literal of type LREAL: write it with a point"),
        ("Y := 0;", "0 is not a literal of type LREAL: write it with a point"),
        ("K := N + 1.0;", "1.0 is not a literal of type DINT"),
        ("Q := N;", "N is DINT where BOOL is needed: convert it"),
        ("IF N THEN Q := P; END_IF;", "N is DINT where BOOL is needed: convert it"),
        ("Q := P AND N;", "N is DINT where BOOL is needed: convert it"),
        ("K := N AND N;", "AND does not take DINT"),
        ("Q := P < Q;", "< does not take BOOL"),
        ("Q := P + Q;", "+ does not take BOOL"),
        ("Y := X MOD X;", "MOD does not take LREAL"),
        ("Q := -P;", "- does not take BOOL"),
        ("K := 2 + 3;", "2 + 3: two literals have no common type, write the result"),
        ("Y := 1.0 / 3.0;", "1.0 / 3.0: two literals have no common type, write the result"),
        ("Y := 1.0E38;", "1.0E38 is not portable: magnitudes stay below 1.0E38"),
        ("Y := -2.5E38;", "-2.5E38 is not portable: magnitudes stay below 1.0E38"),
        ("Y := 1.0E-400;", "1.0E-400 is too small for LREAL: it would become 0"),
        ("Y := 1E5;", "1E5 is not portable: write a real as 2.0 or -1.0E-3"),
        ("Y := +1.0;", "+1.0 is not portable: write a real as 2.0 or -1.0E-3"),
        ("K := 1_000;", "1_000 is not portable: write an integer as 12 or -12"),
        ("K := 2147483648;", "2147483648 is outside DINT, -2147483648 to 2147483647"),
        ("Few := 32768;", "32768 is outside INT, -32768 to 32767"),
        ("K := Unknown;", "Unknown is not declared as a variable"),
        ("Unknown := 1;", "Unknown is not declared as a variable"),
        ("Y := Ring;", "Ring is an array: it needs an index"),
        ("Ring := Ring;", "Ring is an array: assign it element by element"),
        ("Y := X[0];", "X is not an array"),
        ("Y := Ring[0][1];", "Ring[0][1]: only a variable takes an index, and only one"),
        ("Y := Ring[4];", "index 4 of Ring is always outside 0 to 3"),
        ("Y := Ring[-1];", "index -1 of Ring is always outside 0 to 3"),
        ("Y := Ring[LAST + 1];", "index LAST + 1 of Ring is always outside 0 to 3"),
        ("Y := Ring[X];", "X is LREAL where DINT is needed: convert it"),
        ("K := N / 0;", "N / 0 divides by zero"),
        ("K := N MOD 0;", "N MOD 0 divides by zero"),
        ("N := 1;", "N is declared as input: only outputs and locals are assigned"),
        ("LAST := 1;", "LAST is declared as constant: only outputs and locals are assigned"),
        ("FIXED[0] := 1;", "FIXED is declared as constant: only outputs and locals are assigned"),
    ],
)
def test_type_or_value_that_does_not_fit(body, message):
    assert refusal_of(with_body(body)) == ((LINE, message),)


@pytest.mark.parametrize(
    ("expression", "message"),
    [
        ("P OR P AND P", "P AND P needs parentheses beside OR"),
        ("P AND P OR P", "P AND P needs parentheses beside OR"),
        ("P AND (NOT P) OR P", "P AND (NOT P) needs parentheses beside OR"),
        ("P AND N < 3", "N < 3 needs parentheses beside AND"),
        ("N + 1 < 3", "N + 1 needs parentheses beside <"),
        ("N < K - 1", "K - 1 needs parentheses beside <"),
        ("P = Q = P", "P = Q needs parentheses beside ="),
        ("X - Y + X > 0.0", "X - Y + X needs parentheses beside >"),
        ("NOT P = Q", "NOT P needs parentheses beside ="),
        ("N * -K > 3", "N * -K needs parentheses beside >"),
        ("NOT (N < 3)", "NOT (N < 3): NOT takes a BOOL variable only, assign the rest to one first"),
        ("NOT (P)", "NOT (P): NOT takes a BOOL variable only, assign the rest to one first"),
        ("NOT NOT P", "NOT NOT P: NOT takes a BOOL variable only, assign the rest to one first"),
        ("NOT TRUE", "NOT TRUE: NOT takes a BOOL variable only, assign the rest to one first"),
        ("NOT N", "NOT N: NOT takes a BOOL variable only, assign the rest to one first"),
        ("(N - -K) = 3", "-K needs parentheses beside -"),
        ("(N * -1) = 3", "-1 needs parentheses beside *"),
        ("(-7 MOD N) = 3", "-7 needs parentheses beside MOD"),
        ("(-N MOD 4) = 3", "-N needs parentheses beside MOD"),
        ("(N + K * 2) = 3", "K * 2 needs parentheses beside +"),
        ("(N - (K - 1) + 2) = 3", "N - (K - 1) needs parentheses beside +"),
        ("(- 5) = N", "- 5: write a number as -1.0 and other signs in parentheses"),
        ("(--N) = 3", "--N: write a number as -1.0 and other signs in parentheses"),
    ],
)
def test_operators_without_the_parentheses_they_need(expression, message):
    assert refusal_of(with_body(f"Q := {expression};")) == ((LINE, message),)


@pytest.mark.parametrize(
    ("expression", "message"),
    [
        ("SIN(X)", "SIN is not one of the portable functions ABS, SQRT, TRUNC, INT_TO_DINT, INT_TO_REAL"),
        ("LIMIT(0.0, X, 1.0)", "LIMIT is not one of the portable functions"),
        ("Other(X)", "Other is not one of the portable functions"),
        ("SQRT(X, X)", "SQRT takes one argument, without its name"),
        ("SQRT()", "SQRT takes one argument, without its name"),
        ("SQRT(IN := X)", "SQRT takes one argument, without its name"),
        ("SQRT(N)", "SQRT does not take N, which is DINT"),
        ("SQRT(2.0)", "SQRT does not take 2.0, which is untyped"),
        ("ABS(P)", "ABS does not take P, which is BOOL"),
        ("DINT_TO_LREAL(Few)", "Few is INT where DINT is needed: convert it"),
        ("DINT_TO_LREAL(1.0)", "1.0 is not a literal of type DINT"),
    ],
)
def test_function_that_is_not_portable(expression, message):
    ((line, found),) = refusal_of(with_body(f"Y := {expression};"))
    assert line == LINE
    assert found.startswith(message)


@pytest.mark.parametrize("name", ["LREAL_TO_DINT", "LREAL_TO_INT"])
def test_rounding_conversions_differ_between_compilers(name):
    ((line, message),) = refusal_of(with_body(f"K := {name}(X);"))
    assert (line, message.split(",")[0]) == (LINE, f"{name} is not one of the portable functions ABS")


@pytest.mark.parametrize(
    ("body", "message"),
    [
        (LOOP.format("0 TO 0"), "a FOR of 1 trips is not portable: at least 2, else unroll it"),
        (LOOP.format("1 TO 0"), "a FOR of 0 trips is not portable: at least 2, else unroll it"),
        (LOOP.format("0 TO 3 BY -1"), "a FOR of 0 trips is not portable: at least 2, else unroll it"),
        (LOOP.format("0 TO 3 BY 4"), "a FOR of 1 trips is not portable: at least 2, else unroll it"),
        (LOOP.format("0 TO 3 BY 0"), "a FOR must not step by 0"),
        (LOOP.format("0 TO N"), "N is not constant: the bounds of a FOR must be"),
        (LOOP.format("N TO 5"), "N is not constant: the bounds of a FOR must be"),
        (LOOP.format("0 TO 5 BY N"), "N is not constant: the bounds of a FOR must be"),
        (LOOP.format("0 TO 3.0"), "3.0 is not a literal of type DINT"),
        (LOOP.format("2147483646 TO 2147483647"), "I would pass the end of DINT: the loop may never end"),
        ("FOR N := 0 TO 3 DO Y := 1.0; END_FOR;", "N cannot control a FOR: it must be an INT or DINT of VAR"),
        ("FOR K := 0 TO 3 DO Y := 1.0; END_FOR;", "K cannot control a FOR: it must be an INT or DINT of VAR"),
        (
            "FOR Ring := 0 TO 3 DO Y := 1.0; END_FOR;",
            "Ring cannot control a FOR: it must be an INT or DINT of VAR",
        ),
        (
            "FOR I := 0 TO 3 DO FOR I := 0 TO 3 DO Y := 1.0; END_FOR; END_FOR;",
            "I controls a FOR around this one already",
        ),
        ("FOR I := 0 TO 3 DO I := 2; END_FOR;", "I controls a FOR: it is not assigned"),
        ("I := 0; FOR I := 0 TO 3 DO Y := 1.0; END_FOR;", "I controls a FOR: it is not assigned"),
        (
            "FOR I := 0 TO 3 DO Y := 1.0; END_FOR; K := I;",
            "I controls a FOR: outside of that loop its value is not portable",
        ),
        (
            "K := I; FOR I := 0 TO 3 DO Y := 1.0; END_FOR;",
            "I controls a FOR: outside of that loop its value is not portable",
        ),
        ("CASE N OF 1: Q := P; END_CASE;", "a CASE needs an ELSE"),
        ("CASE N OF 1: Q := P; 2, 1: Q := P; ELSE Q := P; END_CASE;", "label 1 stands in this CASE already"),
        ("CASE X OF 1: Q := P; ELSE Q := P; END_CASE;", "CASE takes an INT or DINT, X is LREAL"),
        ("CASE Few OF 40000: Q := P; ELSE Q := P; END_CASE;", "40000 is outside INT, -32768 to 32767"),
        ("Missing(A := 1);", "Missing is not declared as a function block"),
        ("Y := Missing.Out;", "Missing is not declared as a function block"),
        ("X.Y := 1.0;", "X.Y cannot be assigned: only variables and array elements can"),
    ],
)
def test_statement_that_is_not_portable(body, message):
    assert refusal_of(with_body(body)) == ((LINE, message),)
