"""Constants and tables of a Structured Text block. Not for: those of the phase clock, see `st_phase`."""

from __future__ import annotations

from swayless.codegen.features import Features
from swayless.codegen.st_diagnostics import diagnostic_constants, diagnostic_tables
from swayless.codegen.st_operator import operator_constants, operator_tables
from swayless.codegen.st_parts import parts_in_use
from swayless.codegen.st_phase import phase_constants, phase_tables
from swayless.codegen.st_rope import rope_constants
from swayless.codegen.st_spacing import spacing_constants, spacing_tables
from swayless.codegen.st_status import status_constants
from swayless.codegen.st_types import Constant, RealConstant, StTypes, Table, st_table
from swayless.controller.output_units import OutputUnits, residual_bounds
from swayless.controller.ramp import Glider
from swayless.controller.settings import ShaperSettings
from swayless.controller.taps import RopeRows


class StTables:
    """The constant data of one block.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    types : StTypes
        Its types.
    features : Features
        Parts of the law in use.
    """

    def __init__(self, settings: ShaperSettings, types: StTypes, features: Features) -> None:
        self._settings, self._types, self._features = settings, types, features
        self._used = parts_in_use(settings)

    @property
    def constants(self) -> list[Constant]:
        """Scalar constants, each with its origin."""
        settings, types = self._settings, self._types
        if settings.clock is None:
            last = [("LastTicks", settings.longest_delay_ticks, "[ticks] longest delay of any row")]
        else:
            last = [("LastQuanta", settings.longest_lag, "[quanta] largest lag of any row")]
        whole = [Constant(name, "DINT", str(value), doc) for name, value, doc in last]
        reals = [*self._commands(), *self._ramps(), *self._units()]
        return [
            *whole,
            *types.constants(reals),
            *status_constants(settings),
            *rope_constants(settings, types),
            *spacing_constants(settings),
            *phase_constants(settings, types),
            *operator_constants(settings, types),
            *diagnostic_constants(settings, types),
        ]

    def _commands(self) -> list[RealConstant]:
        limits, features = self._settings.limits, self._features
        names = (
            (True, "MaxCommand", limits.max_command, "max_speed"),
            (features.has_minimum, "MinimumCommand", limits.minimum_command, "minimum_speed"),
            (features.has_resolution, "CommandResolution", limits.command_resolution, "command_resolution"),
            (features.has_inching, "InchingCommand", limits.inching_command, "inching_speed"),
        )
        return [(name, value, f"[{limits.units}] {key}") for used, name, value, key in names if used]

    def _ramps(self) -> list[RealConstant]:
        limits, number = self._settings.limits, self._settings.number
        reals: list[RealConstant] = []
        for name, step, key in (
            ("Acceleration", limits.acceleration_step, "acceleration"),
            ("Deceleration", limits.deceleration_step, "deceleration"),
            ("QuickStop", limits.quick_stop_step, "quick_stop"),
        ):
            reals.append((f"{name}Step", step, f"[{limits.units} per tick] {key}, on the ramp grid"))
            if name != "Acceleration" or self._features.has_waiting_rows:
                reciprocal = Glider(step, limits, number).reciprocal
                reals.append((f"StepsPer{name}", reciprocal, f"[ticks per {limits.units}] 1 / {name}Step"))
        return reals

    def _units(self) -> list[RealConstant]:
        units, anchor = OutputUnits(self._settings), self._settings.limits.ramp_anchor
        return [
            ("RampAnchor", anchor, "reals next to it are the grid of ramp steps"),
            ("MetresPerUnitTick", units.metres_per_unit_tick, "[m] way per unit of command and tick"),
            ("TickTime", units.tick_s, "[s] tick"),
        ]

    @property
    def tables(self) -> list[Table]:
        """Tables of taps and rows; row 0 is one tap of amplitude 1 without delay."""
        rows, types = self._settings.row_tables, self._types
        firsts = [sum(len(r.amplitudes) for r in rows[:i]) for i in range(len(rows))]
        lags = [[str(lag) for lag in r.lags] for r in rows]
        tails = [[str(r.tail) for r in rows]]
        moments = [[types.literal(float(r.moment)) for r in rows]]
        bounds = [[types.literal(bound) for bound in residual_bounds(self._settings)]]
        waits = [["TRUE" if r.waits else "FALSE" for r in rows]]
        amplitudes = [[types.literal(a) for a in r.amplitudes] for r in rows]
        ropes = RopeRows((), ()) if self._settings.bank.by_rope is None else self._settings.bank.by_rope
        shortest, longest = (
            [[types.literal(value) for value in (0, *ends)]] for ends in (ropes.lower, ropes.upper)
        )
        tables = (
            ("FirstTaps", "row", [[str(first) for first in firsts]], "First tap of each row.", "all"),
            ("TapCounts", "row", [[str(len(r.amplitudes)) for r in rows]], "Taps of each row.", "all"),
            ("DelayTicks", "word", lags, "[ticks] Delay of each tap, by row.", "delays"),
            ("LagQuanta", "word", lags, "[quanta] Phase that each tap waits for, by row.", "phase"),
            ("Amplitudes", "real", amplitudes, AMPLITUDES, "all"),
            ("TailTicks", "word", tails, "[ticks] Longest delay of each row.", "ticks"),
            ("TailQuanta", "word", tails, "[quanta] Largest lag of each row.", "phase"),
            ("MomentTicks", "real", moments, f"[ticks] Sum of amplitude times delay{OF_EACH_ROW}", "delays"),
            ("MomentQuanta", "real", moments, f"[quanta] Sum of amplitude times lag{OF_EACH_ROW}", "phase"),
            ("ResidualBounds", "real", bounds, "Tolerance of each row.", "all"),
            ("Waits", "bool", waits, WAITS, "waiting"),
            ("RowShortest", "real", shortest, "[m] Rope below which the next row is wanted.", "row ends"),
            ("RowLongest", "real", longest, "[m] Rope above which the row before is wanted.", "row ends"),
        )
        made = [
            st_table(name, types.type_of(kind), values, doc)
            for name, kind, values, doc, part in tables
            if part in self._used
        ]
        others = (spacing_tables, phase_tables, operator_tables, diagnostic_tables)
        return [*made, *(table for made_by in others for table in made_by(self._settings, types))]


AMPLITUDES = "Amplitude of each tap, by row; each row sums to exactly 1."
OF_EACH_ROW = " of each row: what a steady command still has to come."
WAITS = "Rows with negative amplitudes: commands wait for rest."
