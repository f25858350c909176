"""Interface, state and nesting of function blocks, and what an instance accepts."""

import math
import sys

import numpy as np
import pytest

from swayless.errors import ToolMissingError, VerificationError
from swayless.verify.structured_text import InputError, SubsetError, load

COUNTER = """FUNCTION_BLOCK FB_Counter
VAR_INPUT
  Stride : DINT := 1;
END_VAR
VAR_OUTPUT
  Total : DINT := 100;
END_VAR
VAR
  History : ARRAY[0..1] OF DINT := [0, -1];
END_VAR
Total := Total + Stride;
History[0] := History[1];
History[1] := Total;
END_FUNCTION_BLOCK
"""
OUTER = """
FUNCTION_BLOCK FB_Outer
VAR_INPUT
  Run : BOOL;
END_VAR
VAR_OUTPUT
  Before, After, Other : DINT;
END_VAR
VAR
  First, Second : FB_Counter;
END_VAR
Before := First.Total;
IF Run THEN
  First(Stride := 10);
  Second();
END_IF;
After := First.Total;
Other := second.TOTAL;
END_FUNCTION_BLOCK
"""
TYPED = """FUNCTION_BLOCK FB_Typed
VAR_INPUT
  Flag : BOOL;
  Few : INT;
  Many : DINT;
  Value : REAL;
END_VAR
VAR_OUTPUT
  Echo : REAL;
  Big : BOOL;
END_VAR
Echo := Value;
Big := Value > 1.0;
END_FUNCTION_BLOCK
"""


def test_interface_is_ordered_and_typed():
    block = load(TYPED)
    assert block.name == "FB_Typed"
    assert list(block.inputs.items()) == [
        ("Flag", "BOOL"),
        ("Few", "INT"),
        ("Many", "DINT"),
        ("Value", "REAL"),
    ]
    assert list(block.outputs.items()) == [("Echo", "REAL"), ("Big", "BOOL")]


def test_state_is_kept_from_step_to_step_and_inputs_too():
    instance = load(COUNTER).instantiate()
    assert [instance.step(inputs)["Total"] for inputs in ({}, {"Stride": 5}, {})] == [101, 106, 111]


def test_instances_share_nothing():
    block = load(COUNTER.replace("Total := Total + Stride", "Total := History[1] + Stride"))
    first, second = block.instantiate(), block.instantiate()
    assert first.step({}) == {"Total": 0}
    assert first.step({}) == {"Total": 1}
    assert second.step({}) == {"Total": 0}
    first.step({"Stride": 100})
    assert block.instantiate().step({}) == {"Total": 0}


def test_inner_blocks_keep_their_state_and_their_inputs():
    instance = load(COUNTER + OUTER).instantiate()
    assert instance.step({}) == {"Before": 100, "After": 100, "Other": 100}
    assert instance.step({"Run": True}) == {"Before": 100, "After": 110, "Other": 101}
    assert instance.step({}) == {"Before": 110, "After": 120, "Other": 102}


def test_the_last_block_of_a_file_is_the_one_to_run():
    assert load(COUNTER + OUTER).name == "FB_Outer"


def test_outputs_are_plain_python_values():
    outputs = load(TYPED).instantiate().step({"Value": np.float32(2.5), "Flag": np.bool_(True)})
    assert outputs == {"Echo": 2.5, "Big": True}
    assert [type(value) for value in outputs.values()] == [float, bool]


def test_numpy_scalars_are_accepted():
    instance = load(TYPED).instantiate()
    instance.step({"Few": np.int16(-5), "Many": np.int64(5), "Value": np.float64(0.5)})
    assert math.isnan(instance.step({"Value": math.nan})["Echo"])


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("Speed", 1.0, "Speed is not an input: the inputs are Flag, Few, Many, Value"),
        ("flag", True, "flag is not an input: the inputs are Flag, Few, Many, Value"),
        ("Flag", 1, "Flag = 1 is of type int: it takes BOOL"),
        ("Few", 1.0, "Few = 1.0 is of type float: it takes INT"),
        ("Many", True, "Many = True is of type bool: it takes DINT"),
        ("Value", 2, "Value = 2 is of type int: it takes REAL"),
        ("Few", 32768, "Few = 32768 is outside INT, -32768 to 32767"),
        ("Many", -2147483649, "Many = -2147483649 is outside DINT, -2147483648 to 2147483647"),
        ("Value", 0.1, "Value = 0.1 is no REAL, try 0.10000000149011612"),
        ("Value", 1e300, "Value = 1e+300 is no REAL, try inf"),
    ],
)
def test_a_wrong_input_is_refused(name, value, message):
    with pytest.raises(InputError) as caught:
        load(TYPED).instantiate().step({name: value})
    assert str(caught.value) == message


def test_a_refused_input_changes_nothing():
    instance = load(COUNTER).instantiate()
    with pytest.raises(InputError):
        instance.step({"Stride": 50, "Total": 0})
    assert instance.step({}) == {"Total": 101}


def test_errors_are_verification_errors():
    with pytest.raises(VerificationError):
        load("FUNCTION_BLOCK FB_T\nX := 1;\nEND_FUNCTION_BLOCK\n")


def test_every_problem_is_reported_at_once_with_its_line():
    with pytest.raises(SubsetError) as caught:
        load(
            "FUNCTION_BLOCK FB_T\nVAR\n  X : DINT;\nEND_VAR\nX := Y;\nX := 1.0;\n"
            "IF X THEN\n  Z := 1;\nEND_IF;\nEND_FUNCTION_BLOCK\n"
        )
    assert [line for line, _ in caught.value.problems] == [5, 6, 7]
    assert caught.value.line == 5
    assert str(caught.value).splitlines() == [
        "line 5: Y is not declared as a variable",
        "line 6: 1.0 is not a literal of type DINT",
        "line 7: X is DINT where BOOL is needed: convert it",
    ]


@pytest.mark.parametrize("package", ["tree_sitter", "tree_sitter_iec61131_3_st"])
def test_a_missing_parser_is_named_with_the_extra_that_brings_it(monkeypatch, package):
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(ToolMissingError) as caught:
        load(COUNTER)
    assert package in str(caught.value)
    assert "pip install 'swayless[verify]'" in str(caught.value)
