"""The names of one function block and what they stand for. Not for: reading them, see `declarations`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal, TypeAlias

from swayless.verify.structured_text.literals import Scalar
from swayless.verify.structured_text.tree import refusal, text_of

if TYPE_CHECKING:
    from tree_sitter import Node

Role: TypeAlias = Literal["input", "output", "local", "constant"]


@dataclass(frozen=True)
class Variable:
    """A scalar or an array.

    Parameters
    ----------
    name : str
        As declared.
    type_name : str
        BOOL, INT, DINT, REAL or LREAL, of each element.
    role : str
        input, output, local or constant.
    code : str
        Name in the translated code.
    initial : scalar, or tuple of scalars
        A tuple makes it an array, indexed from 0.
    """

    name: str
    type_name: str
    role: Role
    code: str
    initial: Scalar | tuple[Scalar, ...]


@dataclass(frozen=True)
class Block:
    """A translated function block: its interface, and the Python source of its factory."""

    name: str
    inputs: tuple[Variable, ...]
    outputs: tuple[Variable, ...]
    factory: str
    source: str


@dataclass(frozen=True)
class BlockInstance:
    """A variable whose type is a function block. Its inputs and outputs are copied at each call.

    Parameters
    ----------
    name : str
        As declared.
    block : Block
        Its type.
    code : str
        Name of its step function in the translated code.
    inputs, outputs : mapping of str to Variable
        The caller's copies, by name in upper case.
    """

    name: str
    block: Block
    code: str
    inputs: Mapping[str, Variable]
    outputs: Mapping[str, Variable]


@dataclass
class Scope:
    """The declared names of one block, by name in upper case: the language ignores case.

    Parameters
    ----------
    taken : set of str
        Names that a declaration must not use again: the blocks of the file and what is declared so far.
    """

    taken: set[str]
    variables: dict[str, Variable] = field(default_factory=dict)
    instances: dict[str, BlockInstance] = field(default_factory=dict)

    def variable(self, node: Node) -> Variable:
        """Return the variable of an identifier, or refuse it."""
        name = text_of(node)
        if name.upper() not in self.variables:
            raise refusal(node, f"{name} is not declared as a variable")
        return self.variables[name.upper()]

    def instance(self, node: Node) -> BlockInstance:
        """Return the function block instance of an identifier, or refuse it."""
        name = text_of(node)
        if name.upper() not in self.instances:
            raise refusal(node, f"{name} is not declared as a function block")
        return self.instances[name.upper()]

    def of_role(self, role: Role) -> tuple[Variable, ...]:
        """Return the variables of one role, in order of declaration."""
        return tuple(variable for variable in self.variables.values() if variable.role == role)
