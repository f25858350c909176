"""Everything the Structured Text templates print for a command shaper. Not for: layout."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from swayless.codegen.features import Features, features_of
from swayless.codegen.interface import Pin, input_pins, output_pins
from swayless.codegen.literals import st_literal
from swayless.codegen.names import check_st_names
from swayless.codegen.provenance import Provenance, check_comments, header_lines
from swayless.controller.output_units import OutputUnits, residual_bounds
from swayless.controller.ramp import Glider
from swayless.controller.settings import ShaperSettings
from swayless.controller.status import explain
from swayless.errors import CodegenError

VALUES_A_LINE = 6
"""Table values in one line of source."""

ST_TYPES = {"double": "LREAL", "float": "REAL"}
"""Structured Text type of each number type."""


@dataclass(frozen=True)
class Variable:
    """One declared variable."""

    st_name: str
    st_type: str
    st_doc: str
    st_initial: str = ""
    st_reset: str = ""


@dataclass(frozen=True)
class Constant:
    """One declared constant."""

    st_name: str
    st_type: str
    st_literal: str
    doc: str


@dataclass(frozen=True)
class Table:
    """One table, broken into lines."""

    st_name: str
    st_type: str
    last: int
    st_lines: tuple[str, ...]
    doc: str


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
        if self.settings.number.name not in ST_TYPES:
            raise CodegenError(
                f"number = {self.settings.number.name!r}: Structured Text calculates in "
                "LREAL (double) or REAL (float)"
            )
        names = [pin.st_name for pin in (*input_pins(self.settings), *output_pins(self.settings))]
        names += [item.st_name for group in (self.st_constants, self.st_tables) for item in group]
        names += [item.st_name for group in (self.st_state, self.st_scratch) for item in group]
        check_comments(self.settings, self.origin)
        check_st_names(self.name, [f"FB_{self.name}_Shaper", "Initialized", *names])

    @property
    def name(self) -> str:
        """Machine name."""
        return self.origin.name

    @property
    def st_real(self) -> str:
        """Type of commands and references."""
        return ST_TYPES[self.settings.number.name]

    def literal(self, value: Any) -> str:
        """Literal of the number type."""
        return st_literal(value, self.settings.number)

    @cached_property
    def features(self) -> Features:
        """Parts of the law in use."""
        return features_of(self.settings)

    @property
    def row_count(self) -> int:
        """Rows besides row 0."""
        return len(self.settings.bank.rows)

    @cached_property
    def most_taps(self) -> int:
        """Taps of the longest row, at least 2: one released compiler skips loops of a single trip."""
        return max(2, *(len(table.amplitudes) for table in self.settings.row_tables))

    @property
    def st_last_tap(self) -> int:
        """Upper bound of the loop over taps."""
        return self.most_taps - 1

    @property
    def st_bits(self) -> dict[str, int]:
        """Values of the status bits."""
        return {bit.name or "": bit.value for bit in self.settings.status_bits}

    @cached_property
    def provenance(self) -> list[str]:
        """Head of the file."""
        facts = [
            "Call the block once per tick, in a task of exactly that cycle; declare one instance per axis.",
            f"Work per call: at most {self.most_taps} taps; no division, no functions but ABS and TRUNC.",
            "",
            "Status is the sum of:",
            *(f"  {bit.value} {explain(bit)}" for bit in self.settings.status_bits),
        ]
        return header_lines(self.settings, self.origin, facts)

    @property
    def inputs(self) -> list[Variable]:
        """Inputs of the block."""
        return [self._pin(pin) for pin in input_pins(self.settings)]

    @property
    def outputs(self) -> list[Variable]:
        """Outputs of the block."""
        return [self._pin(pin) for pin in output_pins(self.settings)]

    def _pin(self, pin: Pin) -> Variable:
        types = {"bool": "BOOL", "real": self.st_real, "row": "DINT", "word": "DINT"}
        initial = f" := {pin.st_initial}" if pin.st_initial else ""
        return Variable(pin.st_name, types[pin.kind], pin.text(is_integer=False), initial)

    @cached_property
    def st_constants(self) -> list[Constant]:
        """Scalar constants, each with its origin."""
        settings, limits, units = self.settings, self.settings.limits, OutputUnits(self.settings)
        real, symbol = self.st_real, limits.units
        reals = [("MaxCommand", limits.max_command, f"[{symbol}] max_speed")]
        for used, name, value, key in (
            (self.features.has_minimum, "MinimumCommand", limits.minimum_command, "minimum_speed"),
            (
                self.features.has_resolution,
                "CommandResolution",
                limits.command_resolution,
                "command_resolution",
            ),
            (self.features.has_inching, "InchingCommand", limits.inching_command, "inching_speed"),
        ):
            reals += [(name, value, f"[{symbol}] {key}")] if used else []
        for name, step, key in (
            ("Acceleration", limits.acceleration_step, "acceleration"),
            ("Deceleration", limits.deceleration_step, "deceleration"),
            ("QuickStop", limits.quick_stop_step, "quick_stop"),
        ):
            reals.append((f"{name}Step", step, f"[{symbol} per tick] {key}, on the ramp grid"))
            if name != "Acceleration" or self.features.has_waiting_rows:
                reciprocal = Glider(step, limits, settings.number).reciprocal
                reals.append((f"StepsPer{name}", reciprocal, f"[ticks per {symbol}] 1 / {name}Step"))
        reals += [
            (
                "RampAnchor",
                limits.ramp_anchor,
                "reals next to it are the grid of ramp steps",
            ),
            ("MetresPerUnitTick", units.metres_per_unit_tick, "[m] way per unit of command and tick"),
            ("TickTime", units.tick_s, "[s] tick"),
        ]
        last = Constant(
            "LastTicks", "DINT", str(settings.longest_delay_ticks), "[ticks] longest delay of any row"
        )
        return [last, *(Constant(name, real, self.literal(value), doc) for name, value, doc in reals)]

    @cached_property
    def st_tables(self) -> list[Table]:
        """Tables of taps and rows; row 0 is one tap of amplitude 1 without delay."""
        rows = self.settings.row_tables
        firsts = [sum(len(r.amplitudes) for r in rows[:i]) for i in range(len(rows))]
        moments = [self.literal(self.settings.number.scalar(float(r.moment))) for r in rows]
        bounds = [self.literal(bound) for bound in residual_bounds(self.settings)]
        tables = [
            _table("FirstTaps", "DINT", [[str(first) for first in firsts]], "First tap of each row."),
            _table("TapCounts", "DINT", [[str(len(r.amplitudes)) for r in rows]], "Taps of each row."),
            _table(
                "DelayTicks",
                "DINT",
                [[str(d) for d in r.lags] for r in rows],
                "[ticks] Delay of each tap, by row.",
            ),
            _table(
                "Amplitudes",
                self.st_real,
                [[self.literal(a) for a in r.amplitudes] for r in rows],
                "Amplitude of each tap, by row; each row sums to exactly 1.",
            ),
            _table("TailTicks", "DINT", [[str(r.tail) for r in rows]], "[ticks] Longest delay of each row."),
            _table(
                "MomentTicks",
                self.st_real,
                [moments],
                "[ticks] Sum of amplitude times delay of each row: what a steady command still has to come.",
            ),
            _table("ResidualBounds", self.st_real, [bounds], "Tolerance of each row."),
        ]
        if self.features.has_waiting_rows:
            waits = [["TRUE" if r.waits else "FALSE" for r in rows]]
            tables.append(
                _table("Waits", "BOOL", waits, "Rows with negative amplitudes: commands wait for rest.")
            )
        return tables

    @cached_property
    def st_state(self) -> list[Variable]:
        """What lives from call to call."""
        real = self.st_real
        state = [
            Variable(
                "Ring", f"ARRAY[0..{self.settings.longest_delay_ticks}] OF {real}", "last ramped commands"
            ),
            Variable("Base", real, "command of the last rest", st_reset="0.0"),
            Variable("Target", real, "target of the ramp", st_reset="0.0"),
            Variable("Ramped", real, "ramped command", st_reset="0.0"),
            Variable("Pending", real, "sum of the references still to come", st_reset="0.0"),
            Variable("Fresh", real, "the same from the commands of this lap alone", st_reset="0.0"),
            Variable("Head", "DINT", "cell of the newest command", st_reset="LastTicks"),
            Variable(
                "StillTicks", "DINT", "ticks without change, up to the longest delay", st_reset="LastTicks"
            ),
            Variable("ActiveRow", "DINT", "row in use", st_reset="0"),
            Variable("SelectedRow", "DINT", "last valid selector", st_reset="0"),
            Variable("WantedRow", "DINT", "row that takes over when settled", st_reset="0"),
            Variable("Lapped", "BOOL", "the ring is full of commands since the last rest", st_reset="FALSE"),
            Variable("InvalidLatched", "BOOL", "a command was not finite", st_reset="FALSE"),
            Variable("QuickLatched", "BOOL", "quick stop is latched", st_reset="FALSE"),
            Variable("EmergencyLatched", "BOOL", "emergency stop is latched", st_reset="FALSE"),
        ]
        if self.features.has_resolution:
            held = "command held until it changes by the resolution"
            state.append(Variable("HeldCommand", real, held, st_reset="0.0"))
        if self.features.has_inching:
            state.append(Variable("InchingNow", "BOOL", "a small command passes unshaped", st_reset="FALSE"))
        return state

    @cached_property
    def st_scratch(self) -> list[Variable]:
        """What a call computes on its way."""
        names = [
            (self.st_real, "Accepted", "checked command"),
            (self.st_real, "Goal", "command that the row in use lets pass"),
            (self.st_real, "Before", "ramped command of the last call"),
            (self.st_real, "Reach", "command or reference one tick on"),
            (self.st_real, "Lowest", "least that the reference can be but for rounding"),
            (self.st_real, "Highest", "most that the reference can be but for rounding"),
            (self.st_real, "LapSum", "part of the reference from this lap"),
            (self.st_real, "Start", "command from which the stop ramp starts"),
            (self.st_real, "RampStep", "step of a ramp"),
            (self.st_real, "StepsPerUnit", "1 / RampStep"),
            (self.st_real, "Anchor", "ramp anchor with the sign of the command"),
            (self.st_real, "Steps", "the same as a real"),
            (self.st_real, "DownSum", "sum of the commands of the stop ramp"),
            (self.st_real, "StopSum", "sum of the references to come"),
            ("DINT", "WholeSteps", "whole steps of a ramp before its last"),
            ("DINT", "DownTicks", "ticks of the stop ramp"),
            ("DINT", "StopTicks", "ticks until the reference is 0"),
            ("DINT", "RestRow", "row at the end of the stop"),
            ("DINT", "FirstTap", "first tap of the row"),
            ("DINT", "TapCount", "taps of the row"),
            ("DINT", "Tap", "tap"),
            ("DINT", "Delay", "its delay"),
            ("DINT", "i", "counter"),
            ("DINT", "Bits", "status bits of this call"),
            ("BOOL", "Valid", "the command is finite"),
            ("BOOL", "Landed", "a ramp has landed"),
            ("BOOL", "InRange", "the command is within the maximum"),
            ("BOOL", "ZeroCommanded", "the command is a valid 0"),
            ("BOOL", "Stopped", "a stop is latched"),
            ("BOOL", "IsSettled", "nothing is pending"),
        ]
        if self.features.has_waiting_rows:
            names += [
                (self.st_real, "RiseSum", "sum of the commands of the ramp to the target"),
                ("DINT", "RiseTicks", "its ticks"),
                ("DINT", "HoldTicks", "ticks at the target until settled"),
                ("BOOL", "RowWaits", "the row has negative amplitudes"),
                ("BOOL", "StopWaits", "a stop waits until settled"),
            ]
        return [Variable(name, st_type, doc) for st_type, name, doc in names]


def _table(name: str, st_type: str, rows: Sequence[Sequence[str]], doc: str) -> Table:
    chunks = [list(row[i : i + VALUES_A_LINE]) for row in rows for i in range(0, len(row), VALUES_A_LINE)]
    lines = [", ".join(c) + ("," if i < len(chunks) - 1 else "") for i, c in enumerate(chunks)]
    return Table(name, st_type, sum(len(row) for row in rows) - 1, tuple(lines), doc)
