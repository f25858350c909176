"""Statements of one function block, as lines of Python. Not for: expressions or declarations."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from itertools import pairwise
from typing import TYPE_CHECKING

from swayless.verify.structured_text.arithmetic import INTEGER_RANGES
from swayless.verify.structured_text.expressions import Expressions
from swayless.verify.structured_text.faults import Problems
from swayless.verify.structured_text.literals import literal_value
from swayless.verify.structured_text.scope import Variable
from swayless.verify.structured_text.tree import COMPOUND, STATEMENTS, line_of, part, refusal, text_of
from swayless.verify.structured_text.values import Span, Value

if TYPE_CHECKING:
    from tree_sitter import Node

MIN_TRIPS = 2
"""A released compiler runs a loop of one trip zero times."""

MAX_NESTING = 12
"""Deepest nesting of statements: Python takes 20 loops in one another, and a reader fewer."""


class Statements:
    """Translates the statements of one function block.

    Parameters
    ----------
    expressions : Expressions
        Translates what the statements compute.
    problems : Problems
        Receives what is wrong in a statement, so that the next ones are read too.

    Attributes
    ----------
    lines : list of str
        The Python code so far.
    """

    def __init__(self, expressions: Expressions, problems: Problems) -> None:
        self.lines: list[str] = []
        self._expressions = expressions
        self._scope = expressions.scope
        self._problems = problems
        self._depth = 0

    def body(self, parent: Node) -> None:
        """Translate the statements that are children of a node, one level deeper."""
        statements = _checked_semicolons(parent, self._problems)
        if not statements:
            self._problems.add(line_of(parent), "a list of statements must not be empty")
        if self._depth == MAX_NESTING:
            raise refusal(parent, f"statements are nested deeper than {MAX_NESTING}")
        self._depth += 1
        for statement in statements:
            with self._problems:
                self._statement(statement)
        self._depth -= 1

    def _write(self, line: str) -> None:
        self.lines.append("    " * self._depth + line)

    def _statement(self, node: Node) -> None:
        match node.type:
            case "assignment_statement":
                self._assignment(node)
            case "if_statement":
                self._if(node)
            case "for_statement":
                self._for(node)
            case "case_statement":
                self._case(node)
            case _:
                self._invocation(node.named_children[0])

    def _assignment(self, node: Node) -> None:
        left = part(node, "left")
        if left.type not in ("identifier", "index_expression"):
            raise refusal(left, f"{text_of(left)} cannot be assigned: only variables and array elements can")
        variable = self._scope.variable(left if left.type == "identifier" else part(left, "object"))
        if variable.role not in ("output", "local"):
            raise refusal(
                left, f"{variable.name} is declared as {variable.role}: only outputs and locals are assigned"
            )
        if variable.name.upper() in self._expressions.loop_names:
            raise refusal(left, f"{variable.name} controls a FOR: it is not assigned")
        if left.type == "identifier" and isinstance(variable.initial, tuple):
            raise refusal(left, f"{variable.name} is an array: assign it element by element")
        target = variable.code if left.type == "identifier" else self._expressions.element(left).code
        self._write(f"{target} = {self._expressions.typed(part(node, 'right'), variable.type_name).code}")

    def _if(self, node: Node) -> None:
        self._branch("if", node)
        for clause in node.children:
            if clause.type == "elsif_clause":
                self._branch("elif", clause)
            elif clause.type == "else_clause":
                self._write("else:")
                self.body(clause)

    def _branch(self, word: str, node: Node) -> None:
        condition = self._expressions.typed(part(node, "condition"), "BOOL")
        self._write(f"{word} {condition.code}:")
        self.body(node)

    def _for(self, node: Node) -> None:
        control = self._control(part(node, "control"))
        start, end = (self._bound(node, end, control) for end in ("start", "end"))
        step = self._bound(node, "step", control) if node.child_by_field_name("step") is not None else 1
        if step == 0:
            raise refusal(node, "a FOR must not step by 0")
        trips = range(start, end + (1 if step > 0 else -1), step)
        if len(trips) < MIN_TRIPS:
            raise refusal(
                node, f"a FOR of {len(trips)} trips is not portable: at least {MIN_TRIPS}, else unroll it"
            )
        low, high = INTEGER_RANGES[control.type_name]
        if not low <= trips[-1] + step <= high:
            raise refusal(
                node, f"{control.name} would pass the end of {control.type_name}: the loop may never end"
            )
        self._write(f"for {control.code} in {trips!r}:")
        with self._open_loop(control, (min(trips[0], trips[-1]), max(trips[0], trips[-1]))):
            self.body(node)

    def _control(self, node: Node) -> Variable:
        control = self._scope.variable(node)
        usable = control.role == "local" and control.type_name in INTEGER_RANGES
        if not usable or isinstance(control.initial, tuple):
            raise refusal(node, f"{control.name} cannot control a FOR: it must be an INT or DINT of VAR")
        if control.name.upper() in self._expressions.open_loops:
            raise refusal(node, f"{control.name} controls a FOR around this one already")
        return control

    def _bound(self, node: Node, name: str, control: Variable) -> int:
        bound = self._expressions.typed(part(node, name), control.type_name)
        if bound.constant is None:
            raise refusal(bound.node, f"{text_of(bound.node)} is not constant: the bounds of a FOR must be")
        return bound.constant

    @contextmanager
    def _open_loop(self, control: Variable, span: Span) -> Iterator[None]:
        self._expressions.open_loops[control.name.upper()] = span
        try:
            yield
        finally:
            del self._expressions.open_loops[control.name.upper()]

    def _case(self, node: Node) -> None:
        subject = self._subject(part(node, "subject"))
        self._write(f"_s = {subject.code}")
        seen: set[int] = set()
        word = "if"
        for clause in node.children:
            if clause.type == "case_clause":
                self._write(f"{word} _s in {self._labels(clause, subject.type_name, seen)!r}:")
                self.body(clause)
                word = "elif"
            elif clause.type == "else_clause":
                self._write("else:")
                self.body(clause)
        if node.children[-2].type != "else_clause":
            raise refusal(node, "a CASE needs an ELSE")

    def _subject(self, node: Node) -> Value:
        subject = self._expressions.value(node)
        if subject.type_name not in INTEGER_RANGES:
            raise refusal(node, f"CASE takes an INT or DINT, {text_of(node)} is {subject.type_name}")
        return subject

    def _labels(self, clause: Node, type_name: str, seen: set[int]) -> tuple[int, ...]:
        nodes = [value.named_children[0] for value in clause.children if value.type == "case_value"]
        labels = tuple(int(literal_value(node, type_name)) for node in nodes)
        for node, label in zip(nodes, labels, strict=True):
            if label in seen:
                raise refusal(node, f"label {label} stands in this CASE already")
            seen.add(label)
        return labels

    def _invocation(self, call: Node) -> None:
        instance = self._scope.instance(part(call, "function"))
        given: set[str] = set()
        for argument in part(call, "arguments").named_children:
            if argument.type != "named_argument":
                raise refusal(argument, f"{text_of(argument)}: write arguments as Name := value")
            name = text_of(part(argument, "name"))
            copy = instance.inputs.get(name.upper())
            if copy is None:
                raise refusal(argument, f"{name} is not an input of {instance.block.name}")
            if name.upper() in given:
                raise refusal(argument, f"{name} is given twice")
            given.add(name.upper())
            value = self._expressions.typed(part(argument, "value"), copy.type_name)
            self._write(f"{copy.code} = {value.code}")
        inputs = ", ".join(copy.code for copy in instance.inputs.values())
        outputs = "".join(f"{copy.code}, " for copy in instance.outputs.values())
        self._write(f"({outputs}) = {instance.code}({inputs})")


def _checked_semicolons(parent: Node, problems: Problems) -> list[Node]:
    """Return the statements of a node; one ; must follow each END_xxx and none may stand alone."""
    nodes = [node for node in parent.children if node.type in STATEMENTS]
    for before, node in pairwise([None, *nodes, None]):
        owed = before if before is not None and before.type in COMPOUND else None
        given = node if node is not None and node.type == "empty_statement" else None
        if owed is not None and given is None:
            problems.add(owed.end_point[0] + 1, f"; is missing after {owed.children[-1].type}")
        if given is not None and owed is None:
            problems.add(line_of(given), "a lone ; is not portable")
    return [node for node in nodes if node.type != "empty_statement"]
