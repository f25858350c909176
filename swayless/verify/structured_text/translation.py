"""A function block as the Python source of a factory: one closure per instance, its variables the state.

Not for: running it. A block::

    FUNCTION_BLOCK FB_Count  VAR_INPUT Up : BOOL; END_VAR  VAR_OUTPUT Count : DINT; END_VAR ...

becomes a factory that returns the step function of a new instance::

    def new_fb_count():
        v_count = 0
        def step(v_up):
            nonlocal v_count
            ...
            return (v_count, )
        return step
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from swayless.verify.structured_text.declarations import check_name, read_declarations
from swayless.verify.structured_text.expressions import Expressions
from swayless.verify.structured_text.faults import Problems
from swayless.verify.structured_text.literals import Pool
from swayless.verify.structured_text.scope import Block, Scope, Variable
from swayless.verify.structured_text.statements import Statements
from swayless.verify.structured_text.tree import descendants, part, text_of

if TYPE_CHECKING:
    from tree_sitter import Node

INDENT = "    "


def translate_block(node: Node, blocks: Mapping[str, Block], pool: Pool) -> Block:
    """Translate a ``function_block_declaration``.

    Parameters
    ----------
    node : tree_sitter.Node
        The function block.
    blocks : mapping of str to Block
        Function blocks declared before it, by name in upper case.
    pool : Pool
        Receives the objects that the source refers to.

    Raises
    ------
    SubsetError
        With every problem in its declarations or, when there is none, in its statements.
    """
    name = check_name(part(node, "name"), blocks)
    scope = read_declarations(node, blocks)
    loop_names = frozenset(
        text_of(part(loop, "control")).upper() for loop in descendants(node, "for_statement")
    )
    problems = Problems()
    statements = Statements(Expressions(scope, pool, loop_names), problems)
    statements.body(node)
    problems.raise_if_any()
    factory = f"new_{name.lower()}"
    inner = [*_state(scope, loop_names, pool), *_step(scope, loop_names, statements.lines), "return step"]
    source = "\n".join([f"def {factory}():", *(INDENT + line for line in inner), ""])
    return Block(name, scope.of_role("input"), scope.of_role("output"), factory, source)


def _kept(scope: Scope, loop_names: frozenset[str]) -> Iterator[Variable]:
    """Yield the variables that live from step to step; inputs are arguments, FOR variables are local."""
    for key, variable in scope.variables.items():
        if variable.role in ("output", "local") and key not in loop_names:
            yield variable
    for instance in scope.instances.values():
        yield from (*instance.inputs.values(), *instance.outputs.values())


def _state(scope: Scope, loop_names: frozenset[str], pool: Pool) -> Iterator[str]:
    for variable in _kept(scope, loop_names):
        if isinstance(variable.initial, tuple):
            yield f"{variable.code} = list({pool.add(variable.initial)})"
        else:
            yield f"{variable.code} = {pool.code_of(variable.initial)}"
    for variable in scope.of_role("constant"):
        if isinstance(variable.initial, tuple):
            yield f"{variable.code} = {pool.add(variable.initial)}"
    for instance in scope.instances.values():
        yield f"{instance.code} = {instance.block.factory}()"


def _step(scope: Scope, loop_names: frozenset[str], body: list[str]) -> Iterator[str]:
    yield f"def step({', '.join(variable.code for variable in scope.of_role('input'))}):"
    for variable in _kept(scope, loop_names):
        if not isinstance(variable.initial, tuple):
            yield f"{INDENT}nonlocal {variable.code}"
    yield from body
    outputs = "".join(f"{variable.code}, " for variable in scope.of_role("output"))
    yield f"{INDENT}return ({outputs})"
