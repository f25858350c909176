"""Everything the Structured Text templates print for a command shaper. Not for: layout."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from swayless.codegen.features import Features, features_of
from swayless.codegen.interface import input_pins, output_pins
from swayless.codegen.names import check_st_names
from swayless.codegen.pin import Pin
from swayless.codegen.provenance import Provenance, check_comments, header_lines
from swayless.codegen.st_checksum import StChecksum, checksum_of
from swayless.codegen.st_diagnostics import bound_strides
from swayless.codegen.st_functions import function_lines
from swayless.codegen.st_operator import contactor_names, plan_strides
from swayless.codegen.st_parts import BlockLaw, law_of, parts_in_use
from swayless.codegen.st_phase import most_cells_a_tick
from swayless.codegen.st_rope import st_said
from swayless.codegen.st_sections import Section, sections_of
from swayless.codegen.st_spacing import strides
from swayless.codegen.st_status import status_names
from swayless.codegen.st_tables import StTables
from swayless.codegen.st_types import Constant, StTypes, Table, Variable, bytes_of
from swayless.controller.measured import ROPE
from swayless.controller.settings import ShaperSettings
from swayless.controller.spacing_filter import spacing_of

LOADING = (
    "After a change of this file load it with a cold start: an online change would keep the old tables.",
    "Where the runtime stops at floating-point exceptions (in TwinCAT an option of the task), it may stop at",
    "an input that is not a number, before the block can refuse it: switch that off, or keep these away.",
)
"""What a controller may do to the block."""


@dataclass(frozen=True)
class StModel:
    """The code model of a command shaper in Structured Text.

    Parameters
    ----------
    settings : ShaperSettings
        The block, in double or float.
    origin : Provenance
        Where it comes from.

    Raises
    ------
    CodegenError
        If the number type is int32, a name is reserved, too long or collides, or a text cannot stand in a
        comment.
    """

    settings: ShaperSettings
    origin: Provenance

    def __post_init__(self) -> None:
        names = [pin.st_name for pin in (*input_pins(self.settings), *output_pins(self.settings))]
        names += [item.st_name for group in (self.st_constants, self.st_tables) for item in group]
        names += [variable.st_name for section in self.st_sections for variable in section.variables]
        check_comments(self.settings, self.origin)
        check_st_names(self.name, [f"FB_{self.name}_Shaper", "Initialized", *names])

    @property
    def name(self) -> str:
        """Machine name."""
        return self.origin.name

    @cached_property
    def types(self) -> StTypes:
        """Types and literals of the block."""
        return StTypes(self.settings.number)

    @property
    def st_real(self) -> str:
        """Type of commands and references."""
        return self.types.real

    @cached_property
    def features(self) -> Features:
        """Parts of the law in use."""
        return features_of(self.settings)

    @property
    def st_law(self) -> BlockLaw:
        """What a tap waits for."""
        return law_of(self.settings)

    @cached_property
    def parts(self) -> frozenset[str]:
        """Parts of the law in use, by the names of `parts_in_use`."""
        return parts_in_use(self.settings)

    @property
    def st_is_settled(self) -> str:
        """Condition that nothing is pending."""
        return "(StillTicks >= LastTicks)" if self.settings.clock is None else "(StillQuanta >= LastQuanta)"

    @property
    def row_count(self) -> int:
        """Rows besides row 0."""
        return len(self.settings.bank.rows)

    @property
    def last_selector(self) -> int:
        """Largest selector: the last row, or 1 where the rope chooses the row."""
        return self.settings.last_selector

    @cached_property
    def most_taps(self) -> int:
        """Taps of the longest row."""
        return max(len(table.amplitudes) for table in self.settings.row_tables)

    @property
    def st_row_to_come(self) -> str:
        """Row that takes over at rest."""
        return "NextRow" if self.features.has_way else "WantedRow"

    @property
    def st_last_tap(self) -> int:
        """Upper bound of loops over taps: one released compiler skips loops of a single trip.

        The phase clock has loops over taps from 1 on, the tick clock from 0.
        """
        return max(self.most_taps - 1, 1 if self.settings.clock is None else 2)

    @property
    def st_most_cells(self) -> int:
        """Upper bound of the loop over the cells that a tap passes in a tick; phase clock only."""
        assert self.settings.clock is not None  # noqa: S101 - only templates of the phase clock ask
        return most_cells_a_tick(self.settings.clock)

    @property
    def st_last_stride(self) -> int:
        """Last step of the look-up of the spacing; original and modified law only."""
        return len(strides(spacing_of(self.settings))) - 1

    @property
    def st_last_plan(self) -> int:
        """Last trial of the search for the speed of a planned move: the largest speed, then each stride."""
        return len(plan_strides(self.settings))

    @property
    def st_bound_rows(self) -> int:
        """Upper bound of a loop over rows, at least 2."""
        return max(self.row_count, 2)

    @property
    def st_last_bound_stride(self) -> int:
        """Last step of the look-up of a bound over the rope; blocks with such bounds only."""
        assert self.settings.diagnostics.rope_bounds is not None  # noqa: S101 - only such blocks ask
        return len(bound_strides(self.settings.diagnostics.rope_bounds)) - 1

    @property
    def st_contactor(self) -> list[str]:
        """Constants of the speeds that a drive behind contactors knows, rising."""
        return contactor_names(self.settings)

    def st_said(self, text: str) -> str:
        """Say of the measured quantity what a template says of a rope."""
        assert self.settings.rope is not None  # noqa: S101 - only blocks that measure one ask
        return st_said(self.settings.rope.measured, text)

    @property
    def st_position(self) -> str:
        """Variable that the spacing is looked up by."""
        return self.st_said("RopeNow")

    @property
    def st_bits(self) -> dict[str, int]:
        """Values of the status bits."""
        return {bit.name or "": bit.value for bit in self.settings.status_bits}

    @property
    def st_status(self) -> dict[str, str]:
        """Constants of the status bits."""
        return status_names(self.settings)

    @cached_property
    def provenance(self) -> list[str]:
        """Head of the file."""
        measured = ROPE if self.settings.rope is None else self.settings.rope.measured
        facts = [
            "Call the block once per tick, in a task of exactly that cycle; declare one instance per axis.",
            f"Work per call: at most {self._work}, no functions but ABS and TRUNC.",
            *self._memory,
            *LOADING,
            "",
            *function_lines(self.settings),
            "Status is the sum of:",
            *(f"  {bit.value} {measured.explain(bit)}" for bit in self.settings.status_bits),
        ]
        return header_lines(self.settings, self.origin, facts)

    @property
    def _work(self) -> str:
        """What a call does at most, but for the first one of a block that sums up its tables."""
        divisions = ("no division", "one division")[self._divides]
        if self.settings.is_spaced:
            steps = self.st_last_stride + 1
            return f"{self.most_taps} taps, and a look-up of {steps} steps{self._trials}; {divisions}"
        if self.settings.clock is None:
            return f"{self.most_taps} taps{self._trials}; {divisions}"
        divisions = ("three divisions", "four divisions")[self._divides]
        return f"{self.most_taps} taps of {self.st_most_cells} cells of the ring each; {divisions}"

    @property
    def _trials(self) -> str:
        return f", {self.st_last_plan + 1} speeds of a planned move" if "plan" in self.parts else ""

    @property
    def _divides(self) -> bool:
        """Whether the model of the load divides where the rope changes."""
        return "sway rope" in self.parts

    @property
    def _memory(self) -> list[str]:
        """What a block that keeps several rings takes."""
        if not self.settings.is_spaced:
            return []
        tables = sum(table.bytes for table in self.st_tables)
        variables = (each for section in self.st_sections for each in section.variables)
        state = sum(bytes_of(each.st_type) for each in variables)
        return [f"Memory: {state} bytes of variables for each instance, {tables} of tables."]

    @property
    def inputs(self) -> list[Variable]:
        """Inputs of the block."""
        return [self._pin(pin) for pin in input_pins(self.settings)]

    @property
    def outputs(self) -> list[Variable]:
        """Outputs of the block."""
        return [self._pin(pin) for pin in output_pins(self.settings)]

    def _pin(self, pin: Pin) -> Variable:
        initial = f" := {pin.st_initial}" if pin.st_initial else ""
        return Variable(pin.st_name, self.types.type_of(pin.kind), pin.text(is_integer=False), initial)

    @cached_property
    def _data(self) -> StTables:
        return StTables(self.settings, self.types, self.features)

    @cached_property
    def st_constants(self) -> list[Constant]:
        """Scalar constants, each with its origin."""
        return self._data.constants

    @cached_property
    def st_tables(self) -> list[Table]:
        """Tables of taps and rows."""
        return self._data.tables

    @cached_property
    def st_sections(self) -> list[Section]:
        """Variables: what lives from call to call, and what a call computes on its way."""
        return sections_of(self.settings, self.types)

    @property
    def st_state(self) -> list[Variable]:
        """Variables with a value after power-on."""
        return [each for section in self.st_sections for each in section.variables if each.st_reset]

    @cached_property
    def st_checksum(self) -> StChecksum:
        """How the tables are summed up; blocks with design facts only."""
        return checksum_of(self.settings, self.types)
