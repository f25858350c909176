"""Load a Structured Text file and step its function block. Not for: comparing with a reference."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from swayless.verify.structured_text.arithmetic import FLOATS, RUNTIME
from swayless.verify.structured_text.faults import Problems, SubsetError
from swayless.verify.structured_text.inputs import accepted
from swayless.verify.structured_text.literals import Pool, Scalar
from swayless.verify.structured_text.scope import Block, Variable
from swayless.verify.structured_text.translation import translate_block
from swayless.verify.structured_text.tree import descendants, line_of, parse, text_of

if TYPE_CHECKING:
    from tree_sitter import Node

Step: TypeAlias = Callable[..., tuple[Scalar, ...]]

PYTHON_TYPES = {"BOOL": bool, "INT": int, "DINT": int, "REAL": float, "LREAL": float}
"""What a step returns for each type."""


def load(source: str) -> FunctionBlock:
    """Parse, check and translate a file of function blocks; the last one is the one to run.

    Parameters
    ----------
    source : str
        Text of the file: the portable subset, inner blocks before outer ones.

    Raises
    ------
    SubsetError
        With the line of everything that is outside the portable subset.
    ToolMissingError
        If the parser is not installed.

    Examples
    --------
    >>> block = load('''FUNCTION_BLOCK FB_Mean
    ... VAR_INPUT
    ...   Command : LREAL; (* m/s *)
    ... END_VAR
    ... VAR_OUTPUT
    ...   Reference : LREAL; (* m/s *)
    ... END_VAR
    ... VAR
    ...   Last : LREAL;
    ... END_VAR
    ... Reference := 0.5 * (Command + Last);
    ... Last := Command;
    ... END_FUNCTION_BLOCK
    ... ''')
    >>> shaper = block.instantiate()
    >>> shaper.step({"Command": 1.0}), shaper.step({})
    ({'Reference': 0.5}, {'Reference': 1.0})
    """
    root = parse(source)
    _check_one_float_type(root)
    pool = Pool()
    blocks: dict[str, Block] = {}
    problems = Problems()
    for node in root.children:
        with problems:
            block = translate_block(node, blocks, pool)
            blocks[block.name.upper()] = block
    problems.raise_if_any()
    if not blocks:
        raise SubsetError([(1, "the file holds no function block")])
    *_, last = blocks.values()
    return FunctionBlock(last, _factory(blocks, last, pool))


def _check_one_float_type(root: Node) -> None:
    nodes = [node for node in descendants(root, "elementary_type") if text_of(node) in FLOATS]
    nodes.sort(key=line_of)
    others = [node for node in nodes if text_of(node) != text_of(nodes[0])]
    if others:
        first, other = text_of(nodes[0]), text_of(others[0])
        raise SubsetError([(line_of(others[0]), f"{other} after {first}: one real type per file")])


def _factory(blocks: Mapping[str, Block], last: Block, pool: Pool) -> Callable[[], Step]:
    namespace: dict[str, object] = {**RUNTIME, **pool.objects}
    source = "".join(block.source for block in blocks.values())
    # The source was made above from checked nodes: no text of the file reaches it but names and numbers.
    exec(compile(source, f"<{last.name}>", "exec"), namespace)  # noqa: S102
    factory: Callable[[], Step] = namespace[last.factory]  # type: ignore[assignment]  # made by exec
    return factory


class FunctionBlock:
    """A checked and translated function block. Make one with `load`.

    Attributes
    ----------
    name : str
        Name of the block.
    inputs, outputs : mapping of str to str
        Names and types (BOOL, INT, DINT, REAL, LREAL), in order of declaration.
    """

    def __init__(self, block: Block, factory: Callable[[], Step]) -> None:
        self.name = block.name
        self.inputs = _interface(block.inputs)
        self.outputs = _interface(block.outputs)
        self._initial = {variable.name: variable.initial for variable in block.inputs}
        self._factory = factory

    def instantiate(self) -> Instance:
        """Make an instance with a state of its own, at its initial values."""
        return Instance(self, self._factory(), dict(self._initial))


def _interface(variables: tuple[Variable, ...]) -> Mapping[str, str]:
    return MappingProxyType({variable.name: variable.type_name for variable in variables})


class Instance:
    """One instance of a function block. Make one with `FunctionBlock.instantiate`."""

    def __init__(self, block: FunctionBlock, step: Step, inputs: dict[str, object]) -> None:
        self._types = block.inputs
        self._results = [(name, PYTHON_TYPES[kind]) for name, kind in block.outputs.items()]
        self._inputs = inputs
        self._step = step

    def step(self, inputs: Mapping[str, bool | int | float]) -> dict[str, bool | int | float]:
        """Set inputs, run the body once, and read the outputs: one call of the block, one tick.

        Parameters
        ----------
        inputs : mapping of str to bool, int or float
            New values of inputs; the others keep theirs, as in a controller. A REAL takes a float that a
            single holds exactly.

        Returns
        -------
        dict of str to bool, int or float
            Every output in order of declaration; a REAL is widened to a float, without rounding.

        Raises
        ------
        InputError
            If a name is not an input, or a value does not fit its type. Nothing has run then.
        ExecutionError
            If an integer overflows, an index leaves its array, or an integer is divided by zero. The
            instance has stopped in the middle of its step and is of no further use.
        """
        # A controller does not warn of an overflow or an invalid operation: IEEE 754 has a result.
        with np.errstate(all="ignore"):
            self._inputs |= {name: accepted(self._types, name, value) for name, value in inputs.items()}
            results = self._step(*self._inputs.values())
        return {name: kind(value) for (name, kind), value in zip(self._results, results, strict=True)}
