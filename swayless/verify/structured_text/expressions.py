"""Expressions of one function block: what they read, what they call. Not for: statements."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from swayless.verify.structured_text import operators
from swayless.verify.structured_text.arithmetic import FLOATS, INTEGER_RANGES
from swayless.verify.structured_text.literals import Pool
from swayless.verify.structured_text.scope import Scope, Variable
from swayless.verify.structured_text.tree import LITERALS, part, refusal, text_of
from swayless.verify.structured_text.values import UNTYPED, Span, Value, adapted, check, clipped, constant

if TYPE_CHECKING:
    from tree_sitter import Node

CONVERSIONS = ("INT_TO_DINT", "INT_TO_REAL", "INT_TO_LREAL", "DINT_TO_REAL", "DINT_TO_LREAL")
NUMBERS = (*INTEGER_RANGES, *FLOATS)


class Expressions:
    """Translates the expressions of one function block.

    Parameters
    ----------
    scope : Scope
        Its names.
    pool : Pool
        Receives constants and checks.
    loop_names : frozenset of str
        Variables, in upper case, that control a FOR anywhere in the block.
    """

    def __init__(self, scope: Scope, pool: Pool, loop_names: frozenset[str]) -> None:
        self.scope = scope
        self.pool = pool
        self.loop_names = loop_names
        self.open_loops: dict[str, Span] = {}
        self._translators = {
            **dict.fromkeys(LITERALS, lambda node: Value(node, text_of(node), UNTYPED)),
            "identifier": self._variable,
            "index_expression": self.element,
            "member_access_expression": self._output,
            "parenthesized_expression": lambda node: self.value(node.named_children[0]),
            "unary_expression": self._unary,
            "binary_expression": self._binary,
            "call_expression": self._call,
        }

    def typed(self, node: Node, type_name: str) -> Value:
        """Translate an expression that must be of the given type."""
        return adapted(self.pool, self.value(node), type_name)

    def value(self, node: Node) -> Value:
        """Translate an expression."""
        return self._translators[node.type](node)

    def element(self, node: Node) -> Value:
        """Translate an element of an array, read or assigned."""
        target, index_node = part(node, "object"), part(node, "index")
        if target.type != "identifier":
            raise refusal(node, f"{text_of(node)}: only a variable takes an index, and only one")
        array = self.scope.variable(target)
        if not isinstance(array.initial, tuple):
            raise refusal(node, f"{array.name} is not an array")
        index = self.value(index_node)
        index = index if index.type_name == "INT" else adapted(self.pool, index, "DINT")
        what = f"index {text_of(index_node)} of {array.name}"
        index = clipped(self.pool, index, what, (0, len(array.initial) - 1))
        return _read(node, array, f"{array.code}[{index.code}]", index.names)

    def _variable(self, node: Node) -> Value:
        variable = self.scope.variable(node)
        key = variable.name.upper()
        if isinstance(variable.initial, tuple):
            raise refusal(node, f"{variable.name} is an array: it needs an index")
        if key in self.loop_names and key not in self.open_loops:
            raise refusal(
                node, f"{variable.name} controls a FOR: outside of that loop its value is not portable"
            )
        if variable.role == "constant":
            return constant(self.pool, node, variable.type_name, variable.initial)
        value = _read(node, variable, variable.code, {variable.name: variable.code})
        return Value(node, value.code, value.type_name, self.open_loops.get(key, value.span), value.names)

    def _output(self, node: Node) -> Value:
        instance = self.scope.instance(part(node, "object"))
        name = text_of(part(node, "member"))
        output = instance.outputs.get(name.upper())
        if output is None:
            raise refusal(node, f"{name} is not an output of {instance.block.name}")
        return _read(node, output, output.code, {output.name: output.code})

    def _unary(self, node: Node) -> Value:
        operand = self.value(part(node, "operand"))
        if part(node, "operator").type == "NOT":
            return operators.negated(node, operand)
        return operators.minus(self.pool, node, operand)

    def _binary(self, node: Node) -> Value:
        operators.check_parentheses(node)
        left, right = self.value(part(node, "left")), self.value(part(node, "right"))
        return operators.binary(self.pool, node, left, right)

    def _call(self, node: Node) -> Value:
        name = text_of(part(node, "function"))
        arguments = part(node, "arguments").named_children
        if name not in ("ABS", "SQRT", "TRUNC", *CONVERSIONS):
            raise refusal(
                node,
                f"{name} is not one of the portable functions ABS, SQRT, TRUNC, {', '.join(CONVERSIONS)}",
            )
        if len(arguments) != 1 or arguments[0].type == "named_argument":
            raise refusal(node, f"{name} takes one argument, without its name")
        source, _, target = name.partition("_TO_")
        if target:
            return self._conversion(node, self.typed(arguments[0], source), target)
        value = self.value(arguments[0])
        if value.type_name not in (NUMBERS if name == "ABS" else FLOATS):
            raise refusal(node, f"{name} does not take {text_of(arguments[0])}, which is {value.type_name}")
        return self._function(node, name, value)

    def _conversion(self, node: Node, value: Value, target: str) -> Value:
        if target in FLOATS:
            return Value(node, f"to_{target}({value.code})", target, names=value.names)
        return Value(node, value.code, target, value.span, value.names)

    def _function(self, node: Node, name: str, value: Value) -> Value:
        kind = value.type_name
        match name:
            case "SQRT":
                return Value(node, f"sqrt_{kind}({value.code})", kind, names=value.names)
            case "TRUNC":
                limits = INTEGER_RANGES["DINT"]
                truncate = check(self.pool, value, text_of(node), limits)
                code = f"{truncate}.truncated({value.code}{value.arguments})"
                return Value(node, code, "DINT", limits, value.names)
            case _:
                span = (0, max(abs(value.span[0]), abs(value.span[1])))
                magnitude = Value(node, f"abs({value.code})", kind, span, value.names)
                return operators.in_range(self.pool, magnitude) if kind in INTEGER_RANGES else magnitude


def _read(node: Node, variable: Variable, code: str, names: Mapping[str, str]) -> Value:
    return Value(node, code, variable.type_name, INTEGER_RANGES.get(variable.type_name, (0, 0)), names)
