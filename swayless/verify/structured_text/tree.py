"""From a source to a parse tree that holds nothing but the portable subset. Not for: types or meaning."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from swayless.errors import ToolMissingError
from swayless.verify.structured_text.faults import Problems, SubsetError
from swayless.verify.structured_text.text import code_of

if TYPE_CHECKING:
    from tree_sitter import Node, Parser

MAX_DEPTH = 50
"""Deepest nesting of a statement or expression: Python's compiler takes 200 parentheses, a node makes 3."""

LITERALS = frozenset({"integer_literal", "real_literal", "boolean_literal"})
OPERATIONS = frozenset({"binary_expression", "unary_expression", "parenthesized_expression"})
OPERANDS = frozenset({"identifier", "index_expression", "member_access_expression", "call_expression"})
EXPRESSIONS = LITERALS | OPERATIONS | OPERANDS
OPERATORS = frozenset({"+", "-", "*", "/", "MOD", "AND", "OR", "XOR", "=", "<>", "<", "<=", ">", ">="})
COMPOUND = frozenset({"if_statement", "for_statement", "case_statement"})
STATEMENTS = COMPOUND | {"assignment_statement", "invocation_statement", "empty_statement"}
SECTION = frozenset({"variable_declaration", "END_VAR"})

CHILDREN = {
    "source_file": {"function_block_declaration"},
    "function_block_declaration": STATEMENTS
    | {"FUNCTION_BLOCK", "identifier", "var_input", "var_output", "var_block", "END_FUNCTION_BLOCK"},
    "var_input": SECTION | {"VAR_INPUT"},
    "var_output": SECTION | {"VAR_OUTPUT"},
    "var_block": SECTION | {"VAR", "var_qualifier_list"},
    "var_qualifier_list": {"var_qualifier"},
    "var_qualifier": {"CONSTANT"},
    "variable_declaration": LITERALS
    | {",", ":", ";", ":=", "[", "]"}
    | {"identifier", "elementary_type", "array_type"},
    "elementary_type": {"BOOL", "INT", "DINT", "REAL", "LREAL"},
    "array_type": {"ARRAY", "[", "subrange", "]", "OF", "elementary_type"},
    "subrange": {"integer_literal", ".."},
    "boolean_literal": {"TRUE", "FALSE"},
    "parenthesized_expression": EXPRESSIONS | {"(", ")"},
    "unary_expression": EXPRESSIONS | {"NOT", "-"},
    "binary_expression": EXPRESSIONS | OPERATORS,
    "index_expression": EXPRESSIONS | {"[", "]"},
    "member_access_expression": {"identifier", "."},
    "call_expression": {"identifier", "argument_list"},
    "argument_list": EXPRESSIONS | {"(", ")", ",", "named_argument"},
    "named_argument": EXPRESSIONS | {":="},
    "assignment_statement": EXPRESSIONS | {":=", ";"},
    "invocation_statement": {"call_expression", ";"},
    "empty_statement": {";"},
    "if_statement": STATEMENTS | EXPRESSIONS | {"IF", "THEN", "elsif_clause", "else_clause", "END_IF"},
    "elsif_clause": STATEMENTS | EXPRESSIONS | {"ELSIF", "THEN"},
    "else_clause": STATEMENTS | {"ELSE"},
    "for_statement": STATEMENTS | EXPRESSIONS | {"FOR", ":=", "TO", "BY", "DO", "END_FOR"},
    "case_statement": EXPRESSIONS | {"CASE", "OF", "case_clause", "else_clause", "END_CASE"},
    "case_clause": STATEMENTS | {"case_value", ",", ":"},
    "case_value": {"integer_literal"},
}
"""What each node of the tree may hold. All that is not listed is refused, so nothing is ever ignored."""

WHY_NOT = {
    "array_repetition": "write every initial value out",
    "structure_initializer": "set the fields in the body",
    "exit_statement": "let the loop end by its bounds",
    "return_statement": "use IF",
    "continue_statement": "use IF",
    "while_statement": "use FOR with constant bounds",
    "repeat_statement": "use FOR with constant bounds",
}


def line_of(node: Node) -> int:
    """Line on which a node begins, from 1."""
    return node.start_point[0] + 1


def text_of(node: Node) -> str:
    """Source text of a node on one line."""
    return " ".join((node.text or b"").decode("ascii").split())


def refusal(node: Node, message: str) -> SubsetError:
    """Make the error to raise for one node."""
    return SubsetError([(line_of(node), message)])


def part(node: Node, name: str) -> Node:
    """Return the child that the grammar calls `name` and always has."""
    child = node.child_by_field_name(name)
    assert child is not None, f"{node.type} has no {name}"  # noqa: S101  the grammar promises it
    return child


def descendants(node: Node, kind: str) -> Iterator[Node]:
    """Yield the nodes of one kind below a node, in no particular order."""
    stack = [node]
    while stack:
        current = stack.pop()
        if current.type == kind:
            yield current
        stack += current.children


def parse(source: str) -> Node:
    """Parse a source and refuse every construct outside the portable subset.

    Parameters
    ----------
    source : str
        Text of a file: ASCII, LF.

    Returns
    -------
    tree_sitter.Node
        The ``source_file`` node. Comments are not in the tree.

    Raises
    ------
    SubsetError
        With every problem of the first stage that found one: text, syntax, constructs.
    ToolMissingError
        If the parser is not installed.
    """
    root = _parser().parse(code_of(source).encode("ascii")).root_node
    problems = Problems()
    for node in _syntax_errors(root):
        problems.add(line_of(node), _describe(node))
    problems.raise_if_any()
    _check_children(root, problems)
    problems.raise_if_any()
    return root


def _parser() -> Parser:
    try:
        # Imported here, as the parser is an extra that only running Structured Text needs.
        import tree_sitter
        import tree_sitter_iec61131_3_st
    except ImportError as missing:
        raise ToolMissingError(
            f"running Structured Text needs the Python package {missing.name}: pip install 'swayless[verify]'"
        ) from missing
    return tree_sitter.Parser(tree_sitter.Language(tree_sitter_iec61131_3_st.language()))


def _syntax_errors(root: Node) -> Iterator[Node]:
    stack = [root]
    while stack:
        node = stack.pop()
        if node.is_error or node.is_missing:
            yield node
        elif node.has_error:
            stack += node.children


def _describe(node: Node) -> str:
    if node.is_missing:
        return f"{node.type} is missing"
    found = text_of(node)
    return f"syntax error at {found[:40] + '...' if len(found) > 40 else found!r}"


def _check_children(root: Node, problems: Problems) -> None:
    stack = [(root, 0)]
    while stack:
        node, depth = stack.pop()
        if depth > MAX_DEPTH:
            problems.add(line_of(node), f"nested deeper than {MAX_DEPTH} levels")
            continue
        for child in node.children:
            if child.type not in CHILDREN[node.type]:
                reason = WHY_NOT.get(child.type, f"not allowed here ({node.type.replace('_', ' ')})")
                problems.add(
                    line_of(child), f"{text_of(child)[:60]!r} is outside the portable subset: {reason}"
                )
            elif child.type in CHILDREN:
                stack.append((child, depth + 1))
