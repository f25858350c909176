"""The structures of the C block, inputs, outputs and state, and their memory. Not for: constant tables."""

from __future__ import annotations

from collections.abc import Sequence

from swayless.codegen.c_diagnostics import diagnostic_members
from swayless.codegen.c_operator import next_row, operator_flags, operator_sums
from swayless.codegen.c_phase_state import phase_cells, phase_members, phase_ring, ring_length
from swayless.codegen.c_rope import c_said, rope_members
from swayless.codegen.c_spacing import spacing_flags, spacing_members, spacing_ring
from swayless.codegen.c_types import CField, CTypes
from swayless.codegen.clock_names import clock_names
from swayless.codegen.features import Features
from swayless.codegen.interface import input_pins, output_pins
from swayless.codegen.pin import Pin
from swayless.controller.settings import ShaperSettings

SIZES_BYTES = {
    "bool": 1,
    "uint8_t": 1,
    "uint16_t": 2,
    "uint32_t": 4,
    "int32_t": 4,
    "float": 4,
    "int64_t": 8,
    "double": 8,
}
"""Size and natural alignment of the C types in the state."""


class CState:
    """The structures of one block.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    types : CTypes
        Its types.
    features : Features
        Parts of the law in use.
    """

    def __init__(self, settings: ShaperSettings, types: CTypes, features: Features) -> None:
        self._types = types
        self._settings, self._clock = settings, clock_names(settings)
        self._has_rope_rows = features.has_rope_rows
        self._last = ring_length(settings) - 1
        self.inputs = [self._member(pin) for pin in input_pins(settings)]
        self.outputs = [self._member(pin) for pin in output_pins(settings)]
        self.cells = [] if settings.clock is None else phase_cells(settings, types)
        rope = [] if settings.rope is None else rope_members(settings.rope, types)
        sums, commands = self._sums(features), self._commands(features)
        operator = operator_sums(settings, types, features)
        told = diagnostic_members(settings, types)
        self.members = [*sums, *commands, *rope, *operator, *told, *self._buffers(features)]
        self.members += [*self._flags(features), *operator_flags(features)]

    def _member(self, pin: Pin) -> CField:
        types = {"bool": "bool", "real": self._types.real, "row": "uint8_t", "word": "uint32_t"}
        return CField(types[pin.kind], pin.c_name, pin.text(is_integer=self._types.number.is_integer))

    def _sums(self, features: Features) -> list[CField]:
        if features.has_phase_clock:
            return phase_members(self._settings, self._types)
        if features.has_spacing:
            return spacing_members(self._settings, self._types)
        zero, wide = self._types.literal(0), self._types.sum
        if self._types.number.is_integer:
            second = CField(wide, "carry", "what rounding owes the next reference, over 2^30", "", zero)
        else:
            second = CField(wide, "fresh", "the same from the commands of this lap alone", "", zero)
        return [CField(wide, "pending", "sum of the references still to come", "", zero), second]

    def _commands(self, features: Features) -> list[CField]:
        names = [
            ("base", self._base_doc),
            ("target", "target of the ramp"),
            ("command", "ramped command"),
            ("reference", "last reference"),
        ]
        if features.has_resolution:
            names.append(("held", "command held until it changes by the resolution"))
        return [CField(self._types.real, name, doc, "", self._types.literal(0)) for name, doc in names]

    @property
    def _base_doc(self) -> str:
        return "command of the last rest" if self._settings.clock is None else "command shaped last"

    def _buffers(self, features: Features) -> list[CField]:
        clock, still = self._clock, f"{self._settings.longest_lag}u"
        still_doc = f"{clock.unit} without change, up to the longest {clock.lag}"
        return [
            *([CField(self._types.input, "input", "last inputs")] if features.can_idle else []),
            CField(self._types.output, "output", "last outputs"),
            *self._ring(features),
            CField("uint32_t", "head", "cell of the newest command", "", f"{self._last}u"),
            CField("uint32_t", clock.c_still, still_doc, "", still),
            CField("uint32_t", "status", "status bits of this tick", "", "0u"),
            CField("uint8_t", "row", "row in use", "", "0u"),
            CField("uint8_t", "selected_row", "last valid selector", "", "0u"),
            CField("uint8_t", "wanted_row", "row that takes over when settled", "", "0u"),
            *next_row(features),
            *([CField("uint8_t", "rope_row", "row of the rope", "", "1u")] if self._has_rope_rows else []),
        ]

    def _ring(self, features: Features) -> list[CField]:
        if features.has_phase_clock:
            return phase_ring(self._settings, self._types)
        if features.has_spacing:
            return spacing_ring(self._settings, self._types)
        ring = f"[{self._types.name.upper()}_SHAPER_RING]"
        return [CField(self._types.real, "ring", "last ramped commands", ring, elements=self._last + 1)]

    def _flags(self, features: Features) -> list[CField]:
        names = [
            *self._running_flags(features),
            ("foretold", "settled, and the stop is foretold"),
            *([("idle", "the last tick began and ended settled")] if features.can_idle else []),
            ("zero_commanded", "the command is a valid 0"),
            ("invalid", "a command was not finite"),
            ("quick", "quick stop is latched"),
            ("emergency", "emergency stop is latched"),
        ]
        if features.has_inching:
            names.append(("inching", "a small command passes unshaped"))
        rope = self._settings.rope
        if rope is not None:
            still = ("rope_still", "the last reading of the rope changed nothing")
            names.append((c_said(rope.measured, still[0]), c_said(rope.measured, still[1])))
        return [CField("bool", name, doc, "", "false") for name, doc in names]

    def _running_flags(self, features: Features) -> list[tuple[str, str]]:
        if features.has_phase_clock:
            return [("running", "parts of changes may be under way")]
        if features.has_spacing:
            return spacing_flags(self._settings)
        return [("lapped", "the ring is full of commands since the last rest")]

    @property
    def ram_bytes(self) -> int:
        """Upper bound of the size of the state, with natural alignment."""
        return self._layout(self.members)[0]

    def _layout(self, members: Sequence[CField]) -> tuple[int, int]:
        """Size and alignment of a structure, with natural alignment of its members."""
        size, widest = 0, 1
        for member in members:
            width, alignment = self._size_of(member.c_type)
            size = -(-size // alignment) * alignment + width * member.elements
            widest = max(widest, alignment)
        return -(-size // widest) * widest, widest

    def _size_of(self, c_type: str) -> tuple[int, int]:
        types = self._types
        structures = {types.input: self.inputs, types.output: self.outputs, types.cell: self.cells}
        if c_type in structures:
            return self._layout(structures[c_type])
        width = SIZES_BYTES[self._types.plain_real if c_type == self._types.real else c_type]
        return width, width
