"""Everything the C templates print for a command shaper. Not for: layout."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

from swayless.codegen.c_checksum import CChecked
from swayless.codegen.c_clock import CClock
from swayless.codegen.c_options import COptions
from swayless.codegen.c_rope import c_said
from swayless.codegen.c_state import CState
from swayless.codegen.c_tables import CTables
from swayless.codegen.c_templates import source_templates
from swayless.codegen.c_types import CTypes
from swayless.codegen.clock_names import ClockNames, clock_names
from swayless.codegen.features import Features, features_of
from swayless.codegen.names import check_c_names
from swayless.codegen.provenance import Provenance, check_comments, header_lines
from swayless.codegen.status_bits import StatusBit, status_bits
from swayless.controller.measured import ROPE, Measured
from swayless.controller.settings import ShaperSettings
from swayless.controller.status import ERROR_BITS


@dataclass(frozen=True)
class CModel:
    """The code model of a command shaper in C.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    origin : Provenance
        Where it comes from.

    Raises
    ------
    CodegenError
        If the machine name cannot prefix C symbols, or a text cannot stand in a comment.
    """

    settings: ShaperSettings
    origin: Provenance

    def __post_init__(self) -> None:
        check_c_names(self.origin.name)
        check_comments(self.settings, self.origin)

    @property
    def name(self) -> str:
        """Prefix of every symbol."""
        return self.origin.name

    @property
    def macro(self) -> str:
        """Prefix of every macro."""
        return self.name.upper()

    @property
    def is_integer(self) -> bool:
        """Whether the number type is int32."""
        return self.settings.number.is_integer

    @property
    def real_doc(self) -> str:
        """What the number type holds."""
        if self.is_integer:
            return "whole counts; lengths in mm, times in whole seconds, ratios in millionths"
        return f"{self.types.plain_real}, IEEE 754"

    def literal(self, value: Any) -> str:
        """Literal of the number type."""
        return self.types.literal(value)

    @property
    def _measured(self) -> Measured:
        return ROPE if self.settings.rope is None else self.settings.rope.measured

    def said(self, text: str) -> str:
        """Say of what is measured what a name or a comment says of a rope."""
        return c_said(self._measured, text)

    @property
    def zero(self) -> str:
        """Literal 0."""
        return self.literal(0)

    @property
    def one(self) -> str:
        """Literal 1."""
        return self.literal(1)

    @property
    def minus(self) -> str:
        """What turns a number round: from 0, so that 0 is never -0."""
        return "-" if self.is_integer else f"{self.zero} - "

    @property
    def half(self) -> str:
        """Literal 1/2, float types only."""
        return self.literal(0.5)

    @cached_property
    def types(self) -> CTypes:
        """C types of the block."""
        return CTypes(self.name, self.settings.number)

    @cached_property
    def state(self) -> CState:
        """Structures of the block."""
        return CState(self.settings, self.types, self.features)

    @cached_property
    def data(self) -> CTables:
        """Constants, ramps and tables of the block."""
        return CTables(self.settings, self.types, self.features)

    @property
    def names(self) -> ClockNames:
        """Names of what the clock counts."""
        return clock_names(self.settings)

    @cached_property
    def clock(self) -> CClock:
        """What depends on the clock and on a measured rope."""
        return CClock(self.settings, self.types)

    @cached_property
    def features(self) -> Features:
        """Parts of the law in use."""
        return features_of(self.settings)

    @cached_property
    def options(self) -> COptions:
        """What depends on functions that only some blocks have."""
        return COptions(self.settings, self.types, self.features)

    @cached_property
    def checked(self) -> CChecked:
        """The check of the tables, where the block has one."""
        return CChecked(self.settings, self.types, self.data.tables)

    @property
    def templates(self) -> list[str]:
        """Templates of the source after its constants, in order."""
        return source_templates(self.features, self.clock.filter_templates, is_integer=self.is_integer)

    @property
    def tick_s_literal(self) -> str:
        """Length of a tick, for people."""
        return repr(self.settings.tick_s)

    @property
    def last_selector(self) -> str:
        """Largest selector: the last row, or 1 where the rope chooses the row."""
        return "1u" if self.features.has_rope_rows else f"(uint8_t){self.macro}_SHAPER_ROWS"

    @property
    def row_count(self) -> int:
        """Rows besides row 0."""
        return len(self.settings.bank.rows)

    @property
    def design_id(self) -> str:
        """First 32 bits of the design's SHA-256."""
        return self.origin.design_sha256[:8]

    @property
    def error_mask(self) -> str:
        """Bits that raise `error`."""
        names = [bit.name for bit in self.settings.status_bits if bit & ERROR_BITS]
        mark = " | " if len(names) == 2 else "\n        | "
        return "(" + mark.join(f"{self.macro}_SHAPER_{name}" for name in names) + ")"

    @property
    def step_rounding_doc(self) -> str:
        """How ramp steps are rounded."""
        return "rounded down to whole counts" if self.is_integer else "rounded up to the grid"

    @property
    def c_command_on_grid(self) -> str:
        """The command on the grid of the ramp steps, where whole counts are already."""
        return "command" if self.is_integer else f"{self.name}_on_grid(command)"

    @cached_property
    def provenance(self) -> list[str]:
        """Head of the header."""
        facts = [
            f"Call {self.name}_shaper_init() once, then {self.name}_shaper_step() once per tick.",
            f"State: {self.state.ram_bytes} bytes at most, owned by the caller; no heap, globals or libm.",
            f"Work per tick: {self._work}.",
        ]
        if not self.is_integer:
            facts += ["Bit equality with the reference needs -ffp-contract=off, and no -ffast-math."]
        return [f" {line}".rstrip() for line in header_lines(self.settings, self.origin, facts)]

    @property
    def _work(self) -> str:
        taps = f"the taps of the row in use, at most {self.most_taps}"
        if self.features.has_phase_clock:
            return f"{taps}, and at most {self.clock.most_cells} cells of each; none settled on a still rope"
        if self.features.has_spacing:
            return f"{taps}, and {self.clock.look_ups} looks into the table of the spacing; none when settled"
        return f"{taps}; none when settled"

    @property
    def init_cost(self) -> str:
        """Work of the first call."""
        if self.features.has_facts:
            return "O(numbers of the tables)"
        return "O(cells of the ring)" if self.features.spacing_law == "original" else "O(1)"

    @property
    def source_provenance(self) -> list[str]:
        """Head of the source file."""
        return [
            f" {self.name}: command shaper, see {self.name}_shaper.h.",
            f" Design SHA-256 {self.origin.design_sha256}.",
        ]

    @property
    def most_taps(self) -> int:
        """Taps of the longest row."""
        return max(len(table.amplitudes) for table in self.settings.row_tables)

    @property
    def status_bits(self) -> tuple[StatusBit, ...]:
        """The status word."""
        return status_bits(self.settings.status_bits, self._measured.explain)

    @property
    def target_argument(self) -> str:
        """Argument of the row at rest, when inching makes it matter."""
        return ", target" if self.features.has_inching else ""

    @property
    def command_argument(self) -> str:
        """The same, for a stop at once."""
        return ", s->command" if self.features.has_inching else ""

    @property
    def example_press_ticks(self) -> int:
        """Ticks of the example's jog: until the reference has arrived at the command."""
        limits = self.settings.limits
        ramp_ticks = int(limits.max_command / limits.acceleration_step) + 1
        return ramp_ticks + self.settings.longest_delay_ticks + (1 if self._example_waits else 0)

    @property
    def _example_waits(self) -> bool:
        """Whether a command counts only after it has been 0."""
        return self.features.starts_from_zero or self.features.has_feedback

    @property
    def example_pressed(self) -> str:
        """When the example presses; where a command counts only after a 0, not in the first tick."""
        press = f"(tick < {self.example_press_ticks}u)"
        return f"((tick > 0u) && {press})" if self._example_waits else press

    @property
    def example_ticks(self) -> int:
        """Ticks of the example: until the reference is 0 again."""
        limits = self.settings.limits
        ramp_ticks = int(limits.max_command / limits.deceleration_step) + 1
        return self.example_press_ticks + ramp_ticks + 2 * self.settings.longest_delay_ticks

    @property
    def example_format(self) -> str:
        """Format of one line of the example."""
        return '"%lu %ld %ld %ld\\n"' if self.is_integer else '"%lu %.9g %.9g %.9g\\n"'

    @property
    def example_cast(self) -> str:
        """Cast that the format needs."""
        return {"int32": "(long)", "float": "(double)", "double": ""}[self.settings.number.name]
