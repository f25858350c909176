"""A translated expression: its Python code, its type and the range it can take. Not for: reading the tree."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, TypeAlias

from swayless.verify.structured_text.arithmetic import INTEGER_RANGES, Check
from swayless.verify.structured_text.literals import Pool, Scalar, literal_value
from swayless.verify.structured_text.tree import line_of, refusal, text_of

if TYPE_CHECKING:
    from tree_sitter import Node

Span: TypeAlias = tuple[int, int]
"""Smallest and largest value an integer expression can take, as far as its operands tell."""

UNTYPED = "untyped"
"""Type of a literal until the other operand, or the place it stands in, gives it one."""


@dataclass(frozen=True)
class Value:
    """The translation of one expression.

    Parameters
    ----------
    node : tree_sitter.Node
        Where it stands; for a literal the literal itself.
    code : str
        Python expression. It has no side effect that outlives it, and parentheses where it needs them.
    type_name : str
        BOOL, INT, DINT, REAL, LREAL or `UNTYPED`.
    span : (int, int)
        Range of an integer; (0, 0) and without meaning for the others.
    names : mapping of str to str
        Variables in it and their code, for messages.
    """

    node: Node
    code: str
    type_name: str
    span: Span = (0, 0)
    names: Mapping[str, str] = field(default_factory=dict)

    @property
    def constant(self) -> int | None:
        """The value of an integer that can take only one."""
        low, high = self.span
        return low if self.type_name in INTEGER_RANGES and low == high else None

    @property
    def arguments(self) -> str:
        """Code that passes the values of `names` on, to follow other arguments."""
        return "".join(f", {code}" for code in self.names.values())


def constant(pool: Pool, node: Node, type_name: str, scalar: Scalar) -> Value:
    """Make the value of a literal or of a scalar constant."""
    span = (int(scalar), int(scalar)) if type_name in INTEGER_RANGES else (0, 0)
    return Value(node, pool.code_of(scalar), type_name, span)


def adapted(pool: Pool, value: Value, type_name: str) -> Value:
    """Give a literal the type its place needs, and refuse any other value that is not of that type."""
    if value.type_name == UNTYPED:
        return constant(pool, value.node, type_name, literal_value(value.node, type_name))
    if value.type_name != type_name:
        raise refusal(
            value.node, f"{text_of(value.node)} is {value.type_name} where {type_name} is needed: convert it"
        )
    return value


def check(pool: Pool, value: Value, what: str, limits: Span) -> str:
    """Make the run-time check of a value and return its name in the code."""
    return pool.add(Check(line_of(value.node), what, *limits, names=tuple(value.names)))


def clipped(pool: Pool, value: Value, what: str, limits: Span) -> Value:
    """Make sure that an integer stays within limits.

    Nothing is added where the ranges of the operands prove it, a run-time check where they do not; what
    is outside in every case is refused at once.
    """
    low, high = max(value.span[0], limits[0]), min(value.span[1], limits[1])
    if (low, high) == value.span:
        return value
    if low > high:
        raise refusal(value.node, f"{what} is always outside {limits[0]} to {limits[1]}")
    failure = f"{check(pool, value, what, limits)}.outside(_t{value.arguments})"
    code = f"(_t if {limits[0]} <= (_t := {value.code}) <= {limits[1]} else {failure})"
    return replace(value, code=code, span=(low, high))
