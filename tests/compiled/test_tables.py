"""Generated C refuses tables that are not those of its design: any bit of any of them."""

import re
from dataclasses import replace

import numpy as np
import pytest

from swayless.codegen import GeneratedFile, c_harness, generate
from swayless.controller.diagnostics import DesignFacts
from swayless.controller.status import Status
from swayless.errors import CodegenError
from swayless.verify import compare, find_compiler
from swayless.verify.c_run import CompiledBlock
from swayless.verify.reference_run import run_reference
from swayless.verify.stimulus import soak
from tests.compiled.operated_blocks import BLOCKS
from tests.unit.codegen.test_provenance import ORIGIN

HASTY = replace(find_compiler(), strict=("-std=c99", "-O1", "-ffp-contract=off"))
"""Optimised all the same: the compiler must not know better what stands in a table than the memory does."""

TABLE = re.compile(r"static const (\w+) crane_(\w+)\[\d+\] = \{\n(.*?)\n\};", re.DOTALL)
LITERAL = re.compile(r"[-\w.+]+")


def with_one_bit_changed(literal, c_type):
    """The literal of a number that differs in its last bit."""
    if c_type == "bool":
        return {"true": "false", "false": "true"}[literal]
    if re.fullmatch(r"-?\d+u?", literal):
        return str(int(literal.rstrip("u")) ^ 1) + "u" * literal.endswith("u")
    return repr(float(np.nextafter(float(literal), np.inf)))


def sources(text):
    """Name, and source with one bit changed, of each table: in its first, last or middle number."""
    for place, table in enumerate(TABLE.finditer(text)):
        c_type, name, body = table.groups()
        literals = list(LITERAL.finditer(body))
        chosen = literals[[0, -1, len(literals) // 2][place % 3]]
        other = with_one_bit_changed(chosen.group(), c_type)
        start = table.start(3) + chosen.start()
        yield name, text[:start] + other + text[start + len(chosen.group()) :]


def with_other_sums(settings):
    """The block as a reference that refuses its tables."""
    facts = settings.diagnostics.facts
    sums = facts.checksum._replace(first=(facts.checksum.first + 1) % 65537)
    return replace(
        settings, diagnostics=replace(settings.diagnostics, facts=DesignFacts(facts.design_id, sums))
    )


@pytest.mark.parametrize(("name", "number", "tables"), [("mixed", "int32", 11), ("by rope", "double", 13)])
def test_a_changed_bit_of_any_table_stops_the_block_for_ever(name, number, tables):
    settings = BLOCKS[name](number)
    inputs = soak(settings, ticks=20).inputs
    refused = run_reference(with_other_sums(settings), inputs)
    assert set(refused["status"].tolist()) == {int(Status.TABLES_INVALID | Status.UNSHAPED)}
    header, source, _ = generate(settings, ORIGIN, "c")
    changed = [each for each in sources(source.text) if each[0] != "SERIES"]  # constants of a formula
    assert len(changed) == tables
    for table, text in changed:
        files = (header, GeneratedFile(source.path, text))
        with CompiledBlock(files, c_harness(settings, ORIGIN), HASTY, settings) as made:
            assert compare(refused, made.run(inputs)).is_equal, table


def test_code_is_not_made_of_tables_that_are_not_those_of_the_design():
    with pytest.raises(CodegenError, match="not those of its design: make its facts again"):
        generate(with_other_sums(BLOCKS["mixed"]("float")), ORIGIN, "c")
