"""Everything that the wiring of several axes prints: one pendant, one measured rope, a block for each axis.

Not for: the blocks themselves (`c_model`, `st_model`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from swayless.codegen.c_model import CModel
from swayless.codegen.c_types import CTypes
from swayless.codegen.interface import input_pins, output_pins
from swayless.codegen.names import check_st_names
from swayless.codegen.pin import Pin, st_name
from swayless.codegen.provenance import Provenance
from swayless.codegen.render import GeneratedFile, render
from swayless.codegen.st_types import StTypes
from swayless.controller.settings import ShaperSettings
from swayless.errors import CodegenError

SHARED_FIELDS = frozenset({"enable", "emergency_stop", "quick_stop", "selector", "step_size"}) | {
    *("rope_length", "hoist_speed", "rope_length_valid", "rope_offset"),
}
"""Inputs of which a crane has one for all axes: its buttons, its knob and its rope."""


@dataclass(frozen=True)
class AxisBlock:
    """The block of one axis.

    Parameters
    ----------
    axis : str
        Name of the axis.
    settings : ShaperSettings
        Its block.
    origin : Provenance
        Where it comes from; its name prefixes the block's symbols.
    """

    axis: str
    settings: ShaperSettings
    origin: Provenance

    @property
    def name(self) -> str:
        """Prefix of the block's symbols."""
        return self.origin.name

    @property
    def st_axis(self) -> str:
        """Name of the axis as Structured Text writes names."""
        return st_name(self.axis)

    @cached_property
    def own_pins(self) -> tuple[Pin, ...]:
        """Inputs that only this axis has."""
        return tuple(pin for pin in input_pins(self.settings) if not self.is_shared(pin))

    @cached_property
    def shared_pins(self) -> tuple[Pin, ...]:
        """Inputs that this axis has in common with the others."""
        return tuple(pin for pin in input_pins(self.settings) if self.is_shared(pin))

    @property
    def output_pins(self) -> tuple[Pin, ...]:
        """Outputs of the block."""
        return output_pins(self.settings)

    def is_shared(self, pin: Pin) -> bool:
        """Whether a crane has one input for all axes."""
        return pin.field in SHARED_FIELDS


@dataclass(frozen=True)
class AxesModel:
    """The code model of the wiring.

    Parameters
    ----------
    name : str
        Name of the whole machine.
    blocks : tuple of AxisBlock
        At least one.

    Raises
    ------
    CodegenError
        If the axes differ in their number type or tick, or names collide.
    """

    name: str
    blocks: tuple[AxisBlock, ...]

    def __post_init__(self) -> None:
        first = self.blocks[0].settings
        for block in self.blocks[1:]:
            if block.settings.number != first.number or block.settings.tick_s != first.tick_s:
                raise CodegenError(
                    f"axes {self.blocks[0].axis} and {block.axis} differ in number type or tick: "
                    "one task calls them all"
                )
        if not first.number.is_integer:
            own = [f"{b.st_axis}{p.st_name}" for b in self.blocks for p in (*b.own_pins, *b.output_pins)]
            blocks = [block.st_axis for block in self.blocks]
            shared = [pin.st_name for pin in self.shared_pins]
            check_st_names(self.name, [f"FB_{self.name}_Axes", *blocks, *shared, *own])

    @property
    def shared_pins(self) -> tuple[Pin, ...]:
        """Inputs that axes have in common, each once."""
        found = {pin.field: pin for block in self.blocks for pin in block.shared_pins}
        return tuple(found.values())

    @property
    def is_integer(self) -> bool:
        """Whether the number type is int32."""
        return self.blocks[0].settings.number.is_integer

    @property
    def st_types(self) -> StTypes:
        """Types of the wiring in Structured Text."""
        return StTypes(self.blocks[0].settings.number)

    @property
    def tick_s_literal(self) -> str:
        """Length of a tick, for people."""
        return repr(self.blocks[0].settings.tick_s)

    @cached_property
    def c_models(self) -> tuple[CModel, ...]:
        """Models of the blocks, for what their examples know of them."""
        return tuple(CModel(block.settings, block.origin) for block in self.blocks)

    @property
    def c_ticks(self) -> str:
        """Ticks of the example: until every axis stands."""
        return f"{max(model.example_ticks for model in self.c_models)}u"

    @property
    def c_format(self) -> str:
        """Format of one line of the example."""
        each = "%ld" if self.is_integer else "%.9g"
        return f'"%lu{(" " + each) * len(self.blocks)}\\n"'

    @property
    def c_axis_names(self) -> str:
        """Axes, for people."""
        return ", ".join(block.axis for block in self.blocks)

    @property
    def c_rope_length(self) -> str:
        """Input of the measured quantity, where there is one."""
        rope = self.blocks[0].settings.rope
        return "" if rope is None else rope.measured.c_value(is_integer=self.is_integer)

    @property
    def c_rope_valid(self) -> str:
        """Input that says whether it is to be believed."""
        rope = self.blocks[0].settings.rope
        return "" if rope is None else rope.measured.c_valid

    @property
    def c_example_inputs(self) -> dict[str, str]:
        """Inputs of the example that are not 0 when nothing is touched: names in the pendant, and values."""
        found = {}
        for block, model in zip(self.blocks, self.c_models, strict=True):
            shared = {pin.c_name for pin in block.shared_pins}
            for name, value in model.options.example_inputs:
                found[name if name in shared else f"{block.axis}_{name}"] = value
        return found

    @property
    def c_real(self) -> str:
        """Type of shared numbers."""
        return CTypes(self.blocks[0].name, self.blocks[0].settings.number).real

    def c_type(self, pin: Pin, real: str) -> str:
        """C type of an input."""
        return {"bool": "bool", "real": real, "row": "uint8_t", "word": "uint32_t"}[pin.kind]

    def doc(self, pin: Pin) -> str:
        """Comment of a pin."""
        return pin.text(is_integer=self.is_integer).replace("see above", "see its block")

    def st_initial(self, pin: Pin) -> str:
        """Give the initial value of an input that is not wired."""
        return f" := {pin.st_initial}" if pin.st_initial else ""


def axes_harness(name: str, blocks: Sequence[AxisBlock]) -> GeneratedFile:
    """Generate the program that runs the wiring in C over recorded inputs, for verification only.

    Parameters
    ----------
    name, blocks
        As for `generate_axes`.
    """
    model = AxesModel(name, tuple(blocks))
    return GeneratedFile("axes_harness.c", render("c/axes_harness.c.j2", name, model))


def generate_axes(name: str, blocks: Sequence[AxisBlock], target: str) -> tuple[GeneratedFile, ...]:
    """Generate the wiring of several axes for one target.

    Parameters
    ----------
    name : str
        Name of the whole machine.
    blocks : sequence of AxisBlock
        The blocks, in the order of the machine file.
    target : str
        Name of a target; Structured Text is not for int32.

    Raises
    ------
    CodegenError
        If the axes differ in number type or tick, or a name is not allowed.
    """
    model = AxesModel(name, tuple(blocks))
    if target == "c":
        return (GeneratedFile(f"{name}_example.c", render("c/axes_example.c.j2", name, model)),)
    return (GeneratedFile(f"FB_{name}_Axes.st", render("st/axes.st.j2", name, model)),)
