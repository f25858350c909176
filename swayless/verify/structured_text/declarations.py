"""What the names of one function block stand for, read from its VAR sections. Not for: statements."""

from __future__ import annotations

from collections.abc import Container, Mapping
from typing import TYPE_CHECKING

import numpy as np

from swayless.verify.structured_text.faults import Problems
from swayless.verify.structured_text.literals import Scalar, literal_value
from swayless.verify.structured_text.names import RESERVED
from swayless.verify.structured_text.scope import Block, BlockInstance, Role, Scope, Variable
from swayless.verify.structured_text.tree import LITERALS, line_of, part, refusal, text_of

if TYPE_CHECKING:
    from tree_sitter import Node

ROLES: dict[str, Role] = {"var_input": "input", "var_output": "output", "var_block": "local"}
ZERO: dict[str, Scalar] = {"BOOL": False, "INT": 0, "DINT": 0, "REAL": np.float32(0.0), "LREAL": 0.0}


def read_declarations(block: Node, blocks: Mapping[str, Block]) -> Scope:
    """Read the VAR sections of a ``function_block_declaration``.

    Parameters
    ----------
    block : tree_sitter.Node
        The function block.
    blocks : mapping of str to Block
        Function blocks declared before it, by name in upper case.

    Raises
    ------
    SubsetError
        With every wrong declaration.
    """
    scope = Scope({text_of(part(block, "name")).upper(), *blocks})
    problems = Problems()
    for section in block.children:
        if section.type not in ROLES:
            continue
        constant = any(node.type == "var_qualifier_list" for node in section.children)
        declarations = [node for node in section.children if node.type == "variable_declaration"]
        if not declarations:
            problems.add(line_of(section), "a VAR section must not be empty")
        for declaration in declarations:
            with problems:
                _declare(scope, blocks, declaration, "constant" if constant else ROLES[section.type])
    problems.raise_if_any()
    return scope


def check_name(node: Node, taken: Container[str]) -> str:
    """Return the name that a declaration introduces, or refuse it; `taken` is in upper case."""
    name = text_of(node)
    if name.upper() in RESERVED:
        raise refusal(node, f"{name} is reserved: choose another name")
    if name.upper() in taken:
        raise refusal(node, f"{name} is declared already; upper and lower case are the same")
    return name


def _declare(scope: Scope, blocks: Mapping[str, Block], declaration: Node, role: Role) -> None:
    type_node = part(declaration, "type")
    for node in declaration.children_by_field_name("names"):
        if node.type != "identifier":
            continue
        name = check_name(node, scope.taken)
        scope.taken.add(name.upper())
        if type_node.type == "identifier":
            scope.instances[name.upper()] = _instance(name, declaration, blocks, role)
        else:
            scope.variables[name.upper()] = _variable(name, declaration, role)


def _instance(name: str, declaration: Node, blocks: Mapping[str, Block], role: Role) -> BlockInstance:
    type_node = part(declaration, "type")
    block = blocks.get(text_of(type_node).upper())
    if block is None:
        raise refusal(type_node, f"{text_of(type_node)} is not a type and no function block declared above")
    if role != "local" or declaration.child_by_field_name("initial_value") is not None:
        raise refusal(
            type_node, f"{name}: a function block is declared in a plain VAR section, without initial value"
        )
    inputs, outputs = _copies(name, block.inputs), _copies(name, block.outputs)
    return BlockInstance(name, block, f"s_{name.lower()}", inputs, outputs)


def _copies(name: str, interface: tuple[Variable, ...]) -> dict[str, Variable]:
    return {
        inner.name.upper(): Variable(
            f"{name}.{inner.name}", inner.type_name, "local", f"v_{name.lower()}__{inner.code}", inner.initial
        )
        for inner in interface
    }


def _variable(name: str, declaration: Node, role: Role) -> Variable:
    type_node = part(declaration, "type")
    initial_nodes = declaration.children_by_field_name("initial_value")
    if role == "constant" and not initial_nodes:
        raise refusal(declaration, f"{name}: a constant needs an initial value")
    if type_node.type == "elementary_type":
        type_name, initial = text_of(type_node), _scalar(name, text_of(type_node), initial_nodes)
        return Variable(name, type_name, role, f"v_{name.lower()}", initial)
    if role in ("input", "output"):
        raise refusal(type_node, f"{name}: inputs and outputs are scalars, an array is not portable there")
    element = text_of(part(type_node, "element_type"))
    values = _array(name, element, _length(name, type_node), initial_nodes)
    return Variable(name, element, role, f"v_{name.lower()}", values)


def _scalar(name: str, type_name: str, initial: list[Node]) -> Scalar:
    if not initial:
        return ZERO[type_name]
    if len(initial) > 1 or initial[0].type not in LITERALS:
        raise refusal(initial[0], f"{name}: the initial value must be one literal")
    return literal_value(initial[0], type_name)


def _array(name: str, type_name: str, length: int, initial: list[Node]) -> tuple[Scalar, ...]:
    if not initial:
        return (ZERO[type_name],) * length
    if initial[0].type != "[":
        raise refusal(initial[0], f"{name}: the initial values of an array stand in [ ]")
    literals = [node for node in initial if node.is_named]
    if len(literals) != length:
        raise refusal(initial[0], f"{name}: {len(literals)} initial values for {length} elements")
    return tuple(literal_value(node, type_name) for node in literals)


def _length(name: str, array: Node) -> int:
    subrange = part(array, "range")
    low, high = (literal_value(part(subrange, end), "DINT") for end in ("lower", "upper"))
    if low != 0 or high < 0:
        raise refusal(subrange, f"{name}: array bounds start at 0 and rise, found {low}..{high}")
    return int(high) + 1
