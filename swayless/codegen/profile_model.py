"""Everything the templates of the motion profile print, for C and Structured Text. Not for: layout."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

from swayless.codegen.c_types import CTypes
from swayless.codegen.literals import c_literal, shortest, st_literal
from swayless.codegen.names import check_c_names, check_st_names
from swayless.codegen.pin import Pin
from swayless.codegen.profile_pins import INPUTS, OUTPUTS
from swayless.codegen.profile_st_state import (
    ST_ARRAYS,
    ST_STOP_ARRAYS,
    ST_STOP_VARIABLES,
    ST_TERMS,
    ST_VARIABLES,
)
from swayless.codegen.profile_tables import (
    PlayedPieces,
    ProfileTable,
    move_pieces,
    profile_tables,
    stop_pieces,
)
from swayless.codegen.provenance import comment_text
from swayless.codegen.st_types import ST_BYTES, StTypes, Variable
from swayless.codegen.status_bits import StatusBit, status_bits
from swayless.controller.number import number_type
from swayless.controller.profile import ProfileSettings, ProfileStatus, explain_profile
from swayless.controller.profile.settings import LARGEST_POSITION


@dataclass(frozen=True)
class ProfileOrigin:
    """Where a motion profile comes from, as the head of its files says.

    Parameters
    ----------
    name : str
        Prefix of every symbol.
    generator : str
        Name and version of what made the design.
    source : str or None
        Base name of the file that asked for it.
    facts : tuple of str
        What was designed and proved, one line each.
    example : tuple of two floats
        Start and target of the move that the example plays.

    Raises
    ------
    CodegenError
        If a text cannot stand in a comment.
    """

    name: str
    generator: str
    source: str | None = None
    facts: tuple[str, ...] = ()
    example: tuple[float, float] = (0.0, 1.0)

    def __post_init__(self) -> None:
        for text in (self.generator, self.source or "", *self.facts):
            comment_text(text)


class ProfileConstant(NamedTuple):
    """One constant of the number type: names and literals in both languages, and where it comes from."""

    c_name: str
    c_text: str
    st_name: str
    st_text: str
    doc: str


@dataclass(frozen=True)
class ProfileCode:
    """The code model of a motion profile.

    Parameters
    ----------
    settings : ProfileSettings
        Every constant of the block.
    origin : ProfileOrigin
        Where it comes from.

    Raises
    ------
    CodegenError
        If a name is reserved or too long.
    """

    settings: ProfileSettings
    origin: ProfileOrigin

    def __post_init__(self) -> None:
        check_c_names(self.name)
        names = [pin.st_name for pin in (*INPUTS, *OUTPUTS)]
        names += [variable.st_name for variable in (*self.st_variables, *self.st_arrays, ST_TERMS)]
        names += [constant.st_name for constant in self.constants] + [t.st_name for t in self.tables]
        check_st_names(self.name, [f"FB_{self.name}_Profile", *names])

    @property
    def name(self) -> str:
        """Prefix of every symbol."""
        return self.origin.name

    @property
    def macro(self) -> str:
        """Prefix of macros."""
        return self.name.upper()

    @cached_property
    def types(self) -> CTypes:
        """C types and literals."""
        return CTypes(self.name, self.settings.number)

    @cached_property
    def st_types(self) -> StTypes:
        """Structured Text types."""
        return StTypes(self.settings.number)

    def literal(self, value: Any) -> str:
        """C literal of the number type."""
        return self.types.literal(value)

    @cached_property
    def tick_s_literal(self) -> str:
        """Length of a tick as a C double."""
        return shortest(self.settings.tick_s, number_type("double"))

    @cached_property
    def constants(self) -> tuple[ProfileConstant, ...]:
        """Constants of the number type."""
        s = self.settings
        rate = "longest travel that keeps the limit of the rate"
        travel = rate if s.max_travel < LARGEST_POSITION else "longest travel: no rate is limited"
        held = "reference that holds the plant, per unit of position: 1 / G(0)"
        values = (
            ("HOLD_RATIO", "HoldRatio", s.hold_ratio, held),
            ("LOWEST", "LowestReference", s.limits[0], "limit of the design"),
            ("HIGHEST", "HighestReference", s.limits[1], "limit of the design"),
            ("MAX_TRAVEL", "MaxTravel", s.max_travel, travel),
            ("LARGEST_POSITION", "LargestPosition", LARGEST_POSITION, "beyond it sums lose their meaning"),
            ("SHAPE_LOW", "ShapeLow", s.extremes.shape[0], "least of the table and of every stop of it"),
            ("SHAPE_HIGH", "ShapeHigh", s.extremes.shape[1], "largest of the same"),
            ("REST_LOW", "RestLow", s.extremes.rest[0], "least share of the travel at which a stop rests"),
            ("REST_HIGH", "RestHigh", s.extremes.rest[1], "largest of the same"),
            ("FIRST_POSITION", "FirstPosition", s.first_position, "held before any start was good"),
        )
        return tuple(
            ProfileConstant(c, c_literal(value, s.number), st, st_literal(value, s.number), doc)
            for c, st, value, doc in values
        )

    @cached_property
    def tables(self) -> tuple[ProfileTable, ...]:
        """Every table."""
        return profile_tables(self.settings)

    @cached_property
    def status_bits(self) -> tuple[StatusBit, ...]:
        """Bits of the status word."""
        return status_bits(ProfileStatus, explain_profile)

    @property
    def bit(self) -> dict[str, int]:
        """Value of each status bit."""
        return {bit.name: bit.value for bit in self.status_bits}

    @property
    def inputs(self) -> tuple[Pin, ...]:
        """Pins that the block reads."""
        return INPUTS

    @property
    def outputs(self) -> tuple[Pin, ...]:
        """Pins that it writes."""
        return OUTPUTS

    def c_type(self, field: Pin) -> str:
        """C type of a pin."""
        return {"bool": "bool", "real": self.types.plain_real, "word": "uint32_t"}[field.kind]

    def st_type(self, field: Pin) -> str:
        """Structured Text type of a pin."""
        return self.st_types.type_of(field.kind)

    @property
    def st_conversion(self) -> str:
        """Structured Text function from a count to a number."""
        return f"DINT_TO_{self.st_types.real}"

    @property
    def st_variables(self) -> tuple[Variable, ...]:
        """Variables that the block uses, their type as a kind."""
        needs = {
            "Local": self.has_polynomials,
            "PieceTick": self.counts_ticks,
            "Term": self.move.degree > 1 or self.stop_terms > 1,
            "GainRow": self.stop_terms > 1,
        }
        every = ST_VARIABLES if self.stop is None else (*ST_VARIABLES, *ST_STOP_VARIABLES)
        return tuple(variable for variable in every if needs.get(variable.st_name, True))

    @property
    def st_arrays(self) -> tuple[Variable, ...]:
        """Arrays of the number type, one cell longer than the states."""
        return ST_ARRAYS if self.stop is None else (*ST_ARRAYS, *ST_STOP_ARRAYS)

    @property
    def st_terms(self) -> Variable:
        """Array for the coefficients of a piece of the stop."""
        return ST_TERMS

    @property
    def states(self) -> int:
        """States of the plant."""
        return self.settings.model.order

    @property
    def columns(self) -> int:
        """Columns of the plant's tables: its states and the shape."""
        return self.states + 1

    @property
    def last_state(self) -> int:
        """Index of the last state."""
        return self.states - 1

    @cached_property
    def move(self) -> PlayedPieces:
        """What a move plays."""
        return move_pieces(self.settings)

    @cached_property
    def stop(self) -> PlayedPieces | None:
        """What a stop plays; none where no stop is sooner than the end of the move."""
        return stop_pieces(self.settings)

    @property
    def played(self) -> tuple[PlayedPieces, ...]:
        """All that can play."""
        return (self.move,) if self.stop is None else (self.move, self.stop)

    @property
    def has_polynomials(self) -> bool:
        """Whether a piece of either has a variable."""
        return any(played.degree for played in self.played)

    @property
    def counts_ticks(self) -> bool:
        """Whether a piece may last longer than a tick."""
        return not all(played.is_raw for played in self.played)

    @property
    def stop_ranges(self) -> int:
        """Number of ranges of ticks in which a stop may begin."""
        return 0 if self.settings.stop is None else len(self.settings.stop.ranges)

    @property
    def stop_terms(self) -> int:
        """Coefficients of a piece of the stop that the block keeps; a tick of its own needs none."""
        return 0 if self.stop is None or self.stop.is_raw else self.stop.coefficients

    @property
    def stop_ticks(self) -> int:
        """At most so many ticks after an abort the plant rests."""
        return self.settings.rest_ticks

    @property
    def how_it_stops(self) -> str:
        """What brings the plant to rest after an abort."""
        if self.stop is None:
            return "by the end of the move; no stop is sooner"
        return "by a stop from the next tick that allows one, or the end of the move"

    @property
    def abort_doc(self) -> str:
        """What an abort does, for a comment."""
        if self.stop is None:
            return "after an abort the move goes on to its end, as aborted: no stop is sooner"
        return "after an abort begin a stop in the first tick that allows one"

    def st_first(self, coefficients: int) -> str:
        """Index of the first coefficient of a piece; one of each tick needs no product."""
        return "Piece" if coefficients == 1 else f"Piece * {coefficients}"

    def st_offset(self, first: str, offset: str) -> str:
        """Index that lies behind another one, or the offset where that is 0.

        Parameters
        ----------
        first : str
            Index; empty for 0.
        offset : str
            Variable or number.
        """
        if not first:
            return offset
        return first if offset == "0" else f"({first}) + {offset}"

    def st_cell(self, row: str, column: str) -> str:
        """Index of a cell of a table whose rows have a column for each state and the shape.

        Parameters
        ----------
        row : str
            Variable that counts rows; empty where the table has only one.
        column : str
            Variable or number.
        """
        return self.st_offset(f"{row} * {self.columns}" if row else "", column)

    @property
    def holds_with_input(self) -> bool:
        """Whether another position needs another reference."""
        return self.settings.hold_ratio != 0.0

    @property
    def example_ticks(self) -> int:
        """Ticks that the example prints: the move, and two of rest."""
        return self.settings.pieces.ticks + 2

    @property
    def ram_bytes(self) -> int:
        """Upper bound of the size of the C state."""
        real = ST_BYTES[self.st_types.real]
        arrays = self.columns * (1 if self.stop is None else 2)
        words = 3 if self.stop is None else 5
        return (
            real * (arrays + 4 + self.stop_terms) + 4 * words + 12
        )  # seven truths, and what fills eight bytes

    @property
    def table_bytes(self) -> int:
        """Size of the constant tables in C."""
        return sum(table.c_bytes for table in self.tables)

    @property
    def header(self) -> tuple[str, ...]:
        """Lines of the comment at the head of a file, without comment marks."""
        ticks, tick_s = self.settings.pieces.ticks, self.settings.tick_s
        low, high = self.settings.limits
        counted = "1 tick" if self.stop_ticks == 1 else f"{self.stop_ticks} ticks"
        counted = f"{counted}, {self.stop_ticks * tick_s:.6g} s,"
        return (
            f"{self.name}: motion profile. It plays a move computed ahead, from any start to any target.",
            "",
            f"Made by {self.origin.generator} from {self.origin.source or 'settings'}.",
            "This file is yours: use, change and ship it as you like.",
            "",
            f"Tick {tick_s:.6g} s. A move takes {ticks} ticks, {ticks * tick_s:.6g} s, however far it goes.",
            f"At most {counted} after an abort the plant rests:",
            f"{self.how_it_stops}.",
            f"References from {low:.6g} to {high:.6g}; a move that could need more is refused.",
            *self.origin.facts,
            "Each move is that of the design, to scale: reference = hold_ratio * start + travel * shape,",
            "position = start + travel * position of a model of the plant, with travel = target - start.",
            f"Memory: {self.ram_bytes} bytes of state at most, {self.table_bytes} of tables.",
            "",
            "Call it once per tick. The plant rests when a move starts: what swings then swings on.",
            "NOT A SAFETY FUNCTION: limit switches, emergency stop and brakes must work without this block.",
            "Nothing may limit, ramp or filter the reference on its way to the drive: the move is exact.",
        )
