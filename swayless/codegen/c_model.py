"""Everything the C templates print for a command shaper. Not for: layout."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from swayless.codegen.features import Features, features_of
from swayless.codegen.interface import Pin, input_pins, output_pins
from swayless.codegen.literals import c_literal
from swayless.codegen.names import check_c_names
from swayless.codegen.provenance import Provenance, check_comments, header_lines
from swayless.controller.output_units import OutputUnits, residual_bounds
from swayless.controller.ramp import Glider
from swayless.controller.settings import ShaperSettings
from swayless.controller.status import ERROR_BITS, Status, explain

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

VALUES_A_LINE = 6
"""Table values in one line of source."""


@dataclass(frozen=True)
class CField:
    """One member of a generated structure."""

    c_type: str
    c_name: str
    c_doc: str
    c_array: str = ""
    c_initial: str = ""


@dataclass(frozen=True)
class CConstant:
    """One constant, or one ramp."""

    c_type: str
    name: str
    c_literal: str
    doc: str


@dataclass(frozen=True)
class CTable:
    """One constant table, broken into lines."""

    c_type: str
    name: str
    length: int
    c_lines: tuple[str, ...]
    doc: str


@dataclass(frozen=True)
class StatusBit:
    """One bit of the status word."""

    name: str
    position: int
    meaning: str


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

    # ---- names, types and literals ---------------------------------------------------------------

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
    def c_real(self) -> str:
        """C type of commands and references."""
        return "int32_t" if self.is_integer else self.settings.number.name

    @property
    def c_sum(self) -> str:
        """C type of sums of references."""
        return "int64_t" if self.is_integer else f"{self.name}_real_t"

    @property
    def real_doc(self) -> str:
        """What the number type holds."""
        if self.is_integer:
            return "whole counts; lengths in mm, times in whole seconds, ratios in millionths"
        return f"{self.c_real}, IEEE 754"

    def literal(self, value: Any) -> str:
        """Literal of the number type."""
        return c_literal(value, self.settings.number)

    @property
    def zero(self) -> str:
        """Literal 0."""
        return self.literal(0)

    @property
    def one(self) -> str:
        """Literal 1."""
        return self.literal(1)

    @property
    def half(self) -> str:
        """Literal 1/2, float types only."""
        return self.literal(0.5)

    @cached_property
    def features(self) -> Features:
        """Parts of the law in use."""
        return features_of(self.settings)

    @property
    def filter_template(self) -> str:
        """Template of the tap filter for the number type."""
        return "c/filter_int32.c.j2" if self.is_integer else "c/filter_float.c.j2"

    @property
    def glide_template(self) -> str:
        """Template of the closed form of a ramp for the number type."""
        return "c/glide_int32.c.j2" if self.is_integer else "c/glide_float.c.j2"

    @property
    def tick_s_literal(self) -> str:
        """Length of a tick, for people."""
        return repr(self.settings.tick_s)

    @property
    def row_count(self) -> int:
        """Rows besides row 0."""
        return len(self.settings.bank.rows)

    @property
    def ring_length(self) -> int:
        """Cells of the ring."""
        return self.settings.longest_delay_ticks + 1

    @property
    def design_id(self) -> str:
        """First 32 bits of the design's SHA-256."""
        return self.origin.design_sha256[:8]

    @property
    def error_mask(self) -> str:
        """Bits that raise `error`."""
        names = [bit.name for bit in Status if bit & ERROR_BITS]
        return "(" + " | ".join(f"{self.macro}_SHAPER_{name}" for name in names) + ")"

    @property
    def step_rounding_doc(self) -> str:
        """How ramp steps are rounded."""
        return "rounded down to whole counts" if self.is_integer else "rounded up to the grid"

    @property
    def c_command_on_grid(self) -> str:
        """The command on the grid of the ramp steps, where whole counts are already."""
        return "command" if self.is_integer else f"{self.name}_on_grid(command)"

    # ---- comments --------------------------------------------------------------------------------

    @cached_property
    def provenance(self) -> list[str]:
        """Head of the header."""
        facts = [
            f"Call {self.name}_shaper_init() once, then {self.name}_shaper_step() once per tick.",
            f"State: at most {self.ram_bytes} bytes, owned by the caller; no heap, no globals, no libm.",
            f"Work per tick: the taps of the row in use, at most {self.most_taps}; none when settled.",
        ]
        if not self.is_integer:
            facts += ["Bit equality with the reference needs -ffp-contract=off, and no -ffast-math."]
        return [f" {line}".rstrip() for line in header_lines(self.settings, self.origin, facts)]

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
    def status_bits(self) -> list[StatusBit]:
        """The status word."""
        return [StatusBit(bit.name or "", bit.value.bit_length() - 1, explain(bit)) for bit in Status]

    @property
    def target_argument(self) -> str:
        """Argument of the row at rest, when inching makes it matter."""
        return ", target" if self.features.has_inching else ""

    @property
    def command_argument(self) -> str:
        """The same, for a stop at once."""
        return ", s->command" if self.features.has_inching else ""

    # ---- example ---------------------------------------------------------------------------------

    @property
    def example_press_ticks(self) -> int:
        """Ticks of the example's jog: until the reference has arrived at the command."""
        limits = self.settings.limits
        ramp_ticks = int(limits.max_command / limits.acceleration_step) + 1
        return ramp_ticks + self.settings.longest_delay_ticks

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

    # ---- structures ------------------------------------------------------------------------------

    @property
    def inputs(self) -> list[CField]:
        """Members of the input structure."""
        return [self._member(pin) for pin in input_pins(self.settings)]

    @property
    def outputs(self) -> list[CField]:
        """Members of the output structure."""
        return [self._member(pin) for pin in output_pins(self.settings)]

    def _member(self, pin: Pin) -> CField:
        types = {"bool": "bool", "real": f"{self.name}_real_t", "row": "uint8_t", "word": "uint32_t"}
        return CField(types[pin.kind], pin.c_name, pin.text(is_integer=self.is_integer))

    @cached_property
    def state(self) -> list[CField]:
        """Members of the state, the widest first."""
        real, wide = f"{self.name}_real_t", "int64_t" if self.is_integer else f"{self.name}_real_t"
        last = str(self.settings.longest_delay_ticks) + "u"
        members = [CField(wide, "pending", "sum of the references still to come", "", self.zero)]
        if self.is_integer:
            members.append(CField(wide, "carry", "what rounding owes the next reference, over 2^30", "", "0"))
        else:
            members.append(
                CField(wide, "fresh", "the same from the commands of this lap alone", "", self.zero)
            )
        members += [
            CField(real, "base", "command of the last rest", "", self.zero),
            CField(real, "target", "target of the ramp", "", self.zero),
            CField(real, "command", "ramped command", "", self.zero),
            CField(real, "reference", "last reference", "", self.zero),
            CField(real, "stop_distance", "last stop distance; it stays when settled", "", self.zero),
            CField(real, "stop_time_s", "last stop time, likewise", "", self.zero),
        ]
        if self.features.has_resolution:
            members.append(
                CField(real, "held", "command held until it changes by the resolution", "", self.zero)
            )
        members += [
            CField(f"{self.name}_shaper_input_t", "input", "last inputs"),
            CField(f"{self.name}_shaper_output_t", "output", "last outputs"),
            CField(real, "ring", "last ramped commands", f"[{self.macro}_SHAPER_RING]"),
            CField("uint32_t", "head", "cell of the newest command", "", last),
            CField("uint32_t", "still_ticks", "ticks without change, up to the longest delay", "", last),
            CField("uint32_t", "stop_time_ticks", "last stop time, likewise", "", "0u"),
            CField("uint32_t", "status", "status bits of this tick", "", "0u"),
            CField("uint8_t", "row", "row in use", "", "0u"),
            CField("uint8_t", "selected_row", "last valid selector", "", "0u"),
            CField("uint8_t", "wanted_row", "row that takes over when settled", "", "0u"),
            CField("bool", "lapped", "the ring is full of commands since the last rest", "", "false"),
            CField("bool", "foretold", "settled, and the stop is foretold", "", "false"),
            CField("bool", "idle", "the last tick began and ended settled", "", "false"),
            CField("bool", "zero_commanded", "the command is a valid 0", "", "false"),
            CField("bool", "invalid", "a command was not finite", "", "false"),
            CField("bool", "quick", "quick stop is latched", "", "false"),
            CField("bool", "emergency", "emergency stop is latched", "", "false"),
        ]
        if self.features.has_inching:
            members.append(CField("bool", "inching", "a small command passes unshaped", "", "false"))
        return members

    @cached_property
    def ram_bytes(self) -> int:
        """Upper bound of the size of the state, with natural alignment."""
        return self._layout(self.state)[0]

    def _layout(self, members: Sequence[CField]) -> tuple[int, int]:
        """Size and alignment of a structure, with natural alignment of its members."""
        size, widest = 0, 1
        for member in members:
            width, alignment = self._size_of(member.c_type)
            size = -(-size // alignment) * alignment + width * (self.ring_length if member.c_array else 1)
            widest = max(widest, alignment)
        return -(-size // widest) * widest, widest

    def _size_of(self, c_type: str) -> tuple[int, int]:
        if c_type.endswith("_input_t"):
            return self._layout(self.inputs)
        if c_type.endswith("_output_t"):
            return self._layout(self.outputs)
        width = SIZES_BYTES[self.c_real if c_type.endswith("_real_t") else c_type]
        return width, width

    # ---- constants and tables --------------------------------------------------------------------

    @cached_property
    def constants(self) -> list[CConstant]:
        """Scalar constants, each with its origin."""
        settings, limits, units = self.settings, self.settings.limits, OutputUnits(self.settings)
        real, symbol = f"{self.name}_real_t", limits.units
        constants = [
            CConstant(
                "uint32_t", "LAST_TICKS", f"{settings.longest_delay_ticks}u", "longest delay of any row"
            ),
            CConstant(real, "MAX_COMMAND", self.literal(limits.max_command), f"{symbol}: max_speed"),
        ]
        for used, name, value, key in (
            (self.features.has_minimum, "MINIMUM_COMMAND", limits.minimum_command, "minimum_speed"),
            (
                self.features.has_resolution,
                "COMMAND_RESOLUTION",
                limits.command_resolution,
                "command_resolution",
            ),
            (self.features.has_inching, "INCHING_COMMAND", limits.inching_command, "inching_speed"),
        ):
            constants += [CConstant(real, name, self.literal(value), f"{symbol}: {key}")] if used else []
        return constants + (
            self._integer_constants(units) if self.is_integer else self._float_constants(units)
        )

    def _float_constants(self, units: OutputUnits) -> list[CConstant]:
        real = f"{self.name}_real_t"
        anchor = self.literal(self.settings.limits.ramp_anchor)
        return [
            CConstant(real, "RAMP_ANCHOR", anchor, "floats next to it are the grid of ramp steps"),
            CConstant(
                real,
                "METRES_PER_UNIT_TICK",
                self.literal(units.metres_per_unit_tick),
                "m of way per unit and tick",
            ),
            CConstant(real, "TICK_S", self.literal(units.tick_s), "s: tick"),
        ]

    def _integer_constants(self, units: OutputUnits) -> list[CConstant]:
        half = (1 << units.distance_shift) >> 1
        return [
            CConstant("int64_t", "ONE", f"INT64_C({1 << 30})", "amplitude 1, over 2^30"),
            CConstant(
                "int64_t", "ROUNDING", f"INT64_C({(1 << 62) + (1 << 29)})", "2^62 makes positive, 2^29 rounds"
            ),
            CConstant("int64_t", "ROUNDING_WHOLE", f"INT64_C({1 << 32})", "2^62 over 2^30"),
            CConstant(
                "uint64_t",
                "DISTANCE_SCALE",
                f"UINT64_C({units.distance_scale})",
                "mm of way per count and tick, scaled",
            ),
            CConstant("uint64_t", "DISTANCE_HALF", f"UINT64_C({half})", "rounds to the nearest"),
            CConstant(
                "uint32_t", "DISTANCE_SHIFT", f"{units.distance_shift}u", "the scale is 2 to this power"
            ),
            CConstant("uint64_t", "TIME_SCALE", f"UINT64_C({units.time_scale})", "s per tick, over 2^32"),
        ]

    @property
    def ramp_fields(self) -> list[CField]:
        """What a ramp holds besides its step."""
        if self.is_integer:
            return [
                CField("uint32_t", "shift", "the reciprocal is 2 to this power too large"),
                CField("uint64_t", "reciprocal", "steps per count, scaled"),
            ]
        return [CField(f"{self.name}_real_t", "steps_per_unit", "1 / step")]

    @cached_property
    def ramps(self) -> list[CConstant]:
        """The three ramps."""
        limits, number = self.settings.limits, self.settings.number
        ramps = []
        for name, step in (
            ("ACCELERATION", limits.acceleration_step),
            ("DECELERATION", limits.deceleration_step),
            ("QUICK_STOP", limits.quick_stop_step),
        ):
            glider = Glider(step, limits, number)
            rest = (
                f"{glider.shift}u, UINT64_C({glider.reciprocal})"
                if self.is_integer
                else self.literal(glider.reciprocal)
            )
            doc = f"{limits.units} per tick: {name.lower()}"
            ramps.append(CConstant("", name, f"{self.literal(step)}, {rest}", doc))
        return ramps

    @cached_property
    def tables(self) -> list[CTable]:
        """Tables of taps and rows; row 0 is one tap of amplitude 1 without delay."""
        rows = self.settings.row_tables
        real, scale = f"{self.name}_real_t", " over 2^30" if self.is_integer else ""
        firsts = [sum(len(r.amplitudes) for r in rows[:i]) for i in range(len(rows) + 1)]
        by_row = [[self.literal(a) for a in r.amplitudes] for r in rows]
        tables = [
            self._table(
                "uint32_t", "FIRST_TAP", [[f"{f}u" for f in firsts]], "first tap of each row, and the end"
            ),
            self._table(
                "uint32_t",
                "DELAY_TICKS",
                [[f"{d}u" for d in r.delays_ticks] for r in rows],
                "delay of each tap, by row",
            ),
            self._table(
                real, "AMPLITUDE", by_row, f"amplitude of each tap, by row; each row sums to exactly 1{scale}"
            ),
            self._table(
                "uint32_t", "TAIL_TICKS", [[f"{r.tail_ticks}u" for r in rows]], "longest delay of each row"
            ),
            *self._moment_tables(),
            self._table(
                real,
                "RESIDUAL_BOUND",
                [[self.literal(b) for b in residual_bounds(self.settings)]],
                "tolerance of each row" + (", in millionths" if self.is_integer else ""),
            ),
        ]
        if self.features.has_waiting_rows:
            waits = [["true" if r.waits else "false" for r in rows]]
            tables.append(
                self._table("bool", "WAITS", waits, "rows with negative amplitudes: commands wait for rest")
            )
        return tables

    def _moment_tables(self) -> list[CTable]:
        doc = "sum of amplitude times delay of each row: references to come per unit of a steady command"
        moments = [row.moment_ticks for row in self.settings.row_tables]
        if not self.is_integer:
            values = [self.literal(self.settings.number.scalar(float(m))) for m in moments]
            return [self._table(f"{self.name}_real_t", "MOMENT_TICKS", [values], doc)]
        split = [divmod(int(m * (1 << 30)), 1 << 30) for m in moments]
        return [
            self._table("int32_t", "MOMENT_TICKS", [[str(w) for w, _ in split]], doc + ", whole ticks"),
            self._table(
                "int32_t", "MOMENT_Q30", [[str(f) for _, f in split]], "what is left of each, over 2^30"
            ),
        ]

    def _table(self, c_type: str, name: str, rows: Sequence[Sequence[str]], doc: str) -> CTable:
        length = sum(len(row) for row in rows)
        return CTable(c_type, name, length, tuple(_lines(rows)), doc)


def _lines(rows: Sequence[Sequence[str]]) -> Iterable[str]:
    """Break a table into lines; every row of the bank starts a line of its own."""
    chunks = [list(row[i : i + VALUES_A_LINE]) for row in rows for i in range(0, len(row), VALUES_A_LINE)]
    for position, chunk in enumerate(chunks):
        yield ", ".join(chunk) + ("," if position < len(chunks) - 1 else "")
