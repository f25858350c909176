"""Values that stand in the source as digits, and how translated code writes them. Not for: expressions."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from swayless.verify.structured_text.arithmetic import FLOATS, INTEGER_RANGES, lreal, real
from swayless.verify.structured_text.tree import refusal, text_of

if TYPE_CHECKING:
    from tree_sitter import Node

Scalar: TypeAlias = bool | int | float | np.float32

INTEGER = re.compile(r"-?[0-9]+", re.ASCII)
DECIMAL = re.compile(r"-?[0-9]+\.[0-9]+(E[+-]?[0-9]+)?", re.ASCII)
NOT_ZERO = re.compile(r"-?[0-9.]*[1-9]", re.ASCII)
MAX_LITERAL = 1.0e38
"""Magnitudes from here on are refused: a compiler that was checked reads literals as singles."""


def literal_value(node: Node, type_name: str) -> Scalar:
    """Read a literal as a value of the type that its place needs.

    Parameters
    ----------
    node : tree_sitter.Node
        A boolean, integer or real literal.
    type_name : str
        BOOL, INT, DINT, REAL or LREAL.

    Raises
    ------
    SubsetError
        If the literal is of another kind, out of range, or not written in the portable way.
    """
    text = text_of(node)
    if node.type == "boolean_literal" and type_name == "BOOL":
        return text == "TRUE"
    if node.type == "integer_literal" and type_name in INTEGER_RANGES:
        return _integer(node, text, type_name)
    if node.type == "real_literal" and type_name in FLOATS:
        return _float(node, text, type_name)
    point = ": write it with a point" if type_name in FLOATS and node.type == "integer_literal" else ""
    raise refusal(node, f"{text} is not a literal of type {type_name}{point}")


def _integer(node: Node, text: str, type_name: str) -> int:
    if not INTEGER.fullmatch(text):
        raise refusal(node, f"{text} is not portable: write an integer as 12 or -12")
    low, high = INTEGER_RANGES[type_name]
    if not low <= int(text) <= high:
        raise refusal(node, f"{text} is outside {type_name}, {low} to {high}")
    return int(text)


def _float(node: Node, text: str, type_name: str) -> float | np.float32:
    if not DECIMAL.fullmatch(text):
        raise refusal(node, f"{text} is not portable: write a real as 2.0 or -1.0E-3")
    if abs(lreal(text)) >= MAX_LITERAL:
        raise refusal(node, f"{text} is not portable: magnitudes stay below 1.0E38")
    value = lreal(text) if type_name == "LREAL" else real(text)
    if value == 0.0 and NOT_ZERO.match(text):
        raise refusal(node, f"{text} is too small for {type_name}: it would become 0")
    return value


class Pool:
    """Objects that translated code refers to by name: what has no exact Python literal, and checks.

    Examples
    --------
    >>> pool = Pool()
    >>> pool.code_of(True), pool.code_of(-5), pool.code_of(0.1), pool.code_of(np.float32(0.1))
    ('True', '(-5)', '0.1', 'c_0')
    """

    def __init__(self) -> None:
        self.objects: dict[str, object] = {}

    def add(self, value: object) -> str:
        """Keep an object and return the name by which code reaches it."""
        name = f"c_{len(self.objects)}"
        self.objects[name] = value
        return name

    def code_of(self, value: Scalar) -> str:
        """Return the code of a constant, exact to the bit."""
        if isinstance(value, np.float32):
            return self.add(value)
        return f"({value!r})" if repr(value).startswith("-") else repr(value)
