"""What operators make of translated operands. Not for: precedence, which the parse tree holds."""

from __future__ import annotations

from typing import TYPE_CHECKING

from swayless.verify.structured_text.arithmetic import FLOATS, INTEGER_RANGES
from swayless.verify.structured_text.literals import Pool
from swayless.verify.structured_text.tree import part, refusal, text_of
from swayless.verify.structured_text.values import UNTYPED, Span, Value, adapted, check, clipped

if TYPE_CHECKING:
    from tree_sitter import Node

LOGICAL = {"AND": "&", "OR": "|", "XOR": "^"}
EQUALITY = {"=": "==", "<>": "!="}
ORDER = {"<": "<", "<=": "<=", ">": ">", ">=": ">="}
COMPARISONS = EQUALITY | ORDER
VARIABLES = ("identifier", "index_expression", "member_access_expression")


def check_parentheses(node: Node) -> None:
    """Refuse operators in a row whose order a reader, or a compiler, might take differently.

    Allowed without parentheses are a chain of one operator, from the left, and NOT beside AND, OR, XOR.
    """
    operator, left, right = _operator(node), part(node, "left"), part(node, "right")
    chain = left.type == "binary_expression" and operator not in COMPARISONS and _operator(left) == operator
    for operand in (right,) if chain else (left, right):
        beside_not = operator in LOGICAL and _operator(operand) == "NOT"
        operation = operand.type in ("binary_expression", "unary_expression") and not beside_not
        if operation or text_of(operand).startswith("-"):
            raise refusal(operand, f"{text_of(operand)} needs parentheses beside {operator}")


def binary(pool: Pool, node: Node, left: Value, right: Value) -> Value:
    """Translate an operator between two operands; both are always evaluated."""
    operator = _operator(node)
    left, right = _of_one_type(pool, node, left, right)
    names = {**left.names, **right.names}
    kind = left.type_name
    if operator in LOGICAL and kind == "BOOL":
        return Value(node, f"({left.code} {LOGICAL[operator]} {right.code})", "BOOL", names=names)
    if operator in (EQUALITY if kind == "BOOL" else COMPARISONS):
        return Value(node, f"({left.code} {COMPARISONS[operator]} {right.code})", "BOOL", names=names)
    if operator == "/" and kind in FLOATS:
        return Value(node, f"divide_{kind}({left.code}, {right.code})", kind, names=names)
    if operator in ("+", "-", "*") and kind in FLOATS:
        return Value(node, f"({left.code} {operator} {right.code})", kind, names=names)
    if operator in ("+", "-", "*", "/", "MOD") and kind in INTEGER_RANGES:
        return _integer(pool, node, left, right)
    raise refusal(node, f"{operator} does not take {kind}")


def negated(node: Node, operand: Value) -> Value:
    """Translate NOT, which is portable in front of a variable only."""
    if (
        operand.node.type not in VARIABLES
        or operand.type_name != "BOOL"
        or operand.node != part(node, "operand")
    ):
        raise refusal(node, f"{text_of(node)}: NOT takes a BOOL variable only, assign the rest to one first")
    return Value(node, f"(not {operand.code})", "BOOL", names=operand.names)


def minus(pool: Pool, node: Node, operand: Value) -> Value:
    """Translate the unary minus."""
    if part(node, "operand").type == "unary_expression" or operand.type_name == UNTYPED:
        raise refusal(node, f"{text_of(node)}: write a number as -1.0 and other signs in parentheses")
    kind, (low, high) = operand.type_name, operand.span
    if kind not in (*FLOATS, *INTEGER_RANGES):
        raise refusal(node, f"- does not take {kind}")
    value = Value(node, f"(-{operand.code})", kind, (-high, -low), operand.names)
    return in_range(pool, value) if kind in INTEGER_RANGES else value


def in_range(pool: Pool, value: Value) -> Value:
    """Make sure that an integer stays in the range of its type."""
    kind = value.type_name
    return clipped(pool, value, f"{kind} {text_of(value.node)}", INTEGER_RANGES[kind])


def _operator(node: Node) -> str:
    operator = node.child_by_field_name("operator")
    return operator.type if operator is not None else ""


def _of_one_type(pool: Pool, node: Node, left: Value, right: Value) -> tuple[Value, Value]:
    if left.type_name == UNTYPED and right.type_name == UNTYPED:
        raise refusal(node, f"{text_of(node)}: two literals have no common type, write the result")
    if left.type_name == UNTYPED:
        return adapted(pool, left, right.type_name), right
    return left, adapted(pool, right, left.type_name)


def _integer(pool: Pool, node: Node, left: Value, right: Value) -> Value:
    operator, kind = _operator(node), left.type_name
    names = {**left.names, **right.names}
    span = _span(operator, left.span, right.span)
    if operator in ("/", "MOD"):
        if right.constant == 0:
            raise refusal(node, f"{text_of(node)} divides by zero")
        method = "quotient" if operator == "/" else "remainder"
        place = Value(node, "", kind, span, names)
        divide = check(pool, place, text_of(node), INTEGER_RANGES[kind])
        code = f"{divide}.{method}({left.code}, {right.code}{place.arguments})"
    else:
        code = f"({left.code} {operator} {right.code})"
    return in_range(pool, Value(node, code, kind, span, names))


def _span(operator: str, left: Span, right: Span) -> Span:
    (a, b), (c, d) = left, right
    match operator:
        case "+":
            return a + c, b + d
        case "-":
            return a - d, b - c
        case "*":
            products = (a * c, a * d, b * c, b * d)
            return min(products), max(products)
        case "/":
            largest = max(abs(a), abs(b))
            return -largest, largest
        case _:
            # A remainder is smaller than the divisor and has the sign of the dividend.
            largest = max(abs(c), abs(d)) - 1
            return max(min(a, 0), -largest), min(max(b, 0), largest)
