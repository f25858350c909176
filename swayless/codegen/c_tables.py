"""Constants, ramps and tables of the C block. Not for: its structures."""

from __future__ import annotations

from swayless.codegen.c_diagnostics import diagnostic_constants, diagnostic_tables
from swayless.codegen.c_operator import operator_constants
from swayless.codegen.c_phase_tables import phase_constants, phase_tables
from swayless.codegen.c_rope import rope_constants, rope_row_tables
from swayless.codegen.c_spacing import spacing_constants, spacing_tables
from swayless.codegen.c_types import CConstant, CField, CTable, CTypes, c_table
from swayless.codegen.clock_names import clock_names
from swayless.codegen.features import Features
from swayless.controller.output_units import OutputUnits, residual_bounds
from swayless.controller.ramp import Glider
from swayless.controller.settings import ShaperSettings


class CTables:
    """The constant data of one block.

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
        self._settings, self._types, self._features = settings, types, features
        self._is_integer = types.number.is_integer

    @property
    def constants(self) -> list[CConstant]:
        """Scalar constants, each with its origin."""
        settings, limits = self._settings, self._settings.limits
        real, symbol, units = self._types.real, limits.units, OutputUnits(self._settings)
        clock = clock_names(settings)
        constants = [
            CConstant(
                "uint32_t", clock.c_last, f"{settings.longest_lag}u", f"longest {clock.lag} of any row"
            ),
            CConstant(real, "MAX_COMMAND", self._types.literal(limits.max_command), f"{symbol}: max_speed"),
        ]
        for used, name, value, key in (
            (self._features.has_minimum, "MINIMUM_COMMAND", limits.minimum_command, "minimum_speed"),
            (
                self._features.has_resolution,
                "COMMAND_RESOLUTION",
                limits.command_resolution,
                "command_resolution",
            ),
            (self._features.has_inching, "INCHING_COMMAND", limits.inching_command, "inching_speed"),
        ):
            constants += (
                [CConstant(real, name, self._types.literal(value), f"{symbol}: {key}")] if used else []
            )
        constants += self._integer_constants(units) if self._is_integer else self._float_constants(units)
        constants += rope_constants(settings.rope, self._types) if settings.rope is not None else []
        constants += spacing_constants(settings) if self._features.has_spacing else []
        constants += phase_constants(settings, self._types) if settings.clock is not None else []
        constants += operator_constants(settings, self._types, self._features)
        return constants + diagnostic_constants(settings, self._types)

    def _float_constants(self, units: OutputUnits) -> list[CConstant]:
        real = self._types.real
        anchor = self._types.literal(self._settings.limits.ramp_anchor)
        return [
            CConstant(real, "RAMP_ANCHOR", anchor, "floats next to it are the grid of ramp steps"),
            CConstant(
                real,
                "METRES_PER_UNIT_TICK",
                self._types.literal(units.metres_per_unit_tick),
                "m of way per unit and tick",
            ),
            CConstant(real, "TICK_S", self._types.literal(units.tick_s), "s: tick"),
        ]

    def _integer_constants(self, units: OutputUnits) -> list[CConstant]:
        half = (1 << units.distance_shift) >> 1
        return [
            CConstant("int64_t", "ONE", f"INT64_C({1 << 30})", "amplitude 1, over 2^30"),
            *(self._rounding_constants() if self._settings.clock is None else []),
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

    def _rounding_constants(self) -> list[CConstant]:
        rounding = (1 << 62) + (1 << 29)
        return [
            CConstant("int64_t", "ROUNDING", f"INT64_C({rounding})", "2^62 makes positive, 2^29 rounds"),
            CConstant("int64_t", "ROUNDING_WHOLE", f"INT64_C({1 << 32})", "2^62 over 2^30"),
        ]

    @property
    def ramp_fields(self) -> list[CField]:
        """What a ramp holds besides its step."""
        if self._is_integer:
            return [
                CField("uint32_t", "shift", "the reciprocal is 2 to this power too large"),
                CField("uint64_t", "reciprocal", "steps per count, scaled"),
            ]
        return [CField(self._types.real, "steps_per_unit", "1 / step")]

    @property
    def ramps(self) -> list[CConstant]:
        """The three ramps."""
        limits, number = self._settings.limits, self._settings.number
        ramps = []
        for name, step in (
            ("ACCELERATION", limits.acceleration_step),
            ("DECELERATION", limits.deceleration_step),
            ("QUICK_STOP", limits.quick_stop_step),
        ):
            glider = Glider(step, limits, number)
            rest = (
                f"{glider.shift}u, UINT64_C({glider.reciprocal})"
                if self._is_integer
                else self._types.literal(glider.reciprocal)
            )
            doc = f"{limits.units} per tick: {name.lower()}"
            ramps.append(CConstant("", name, f"{self._types.literal(step)}, {rest}", doc))
        return ramps

    @property
    def tables(self) -> list[CTable]:
        """Tables of taps and rows; row 0 is one tap of amplitude 1 without delay."""
        rows, clock = self._settings.row_tables, clock_names(self._settings)
        real, scale = self._types.real, " over 2^30" if self._is_integer else ""
        firsts = [sum(len(r.amplitudes) for r in rows[:i]) for i in range(len(rows) + 1)]
        by_row = [[self._types.literal(a) for a in r.amplitudes] for r in rows]
        tables = [
            c_table(
                "uint32_t", "FIRST_TAP", [[f"{f}u" for f in firsts]], "first tap of each row, and the end"
            ),
            *self._lag_tables(),
            c_table(
                real, "AMPLITUDE", by_row, f"amplitude of each tap, by row; each row sums to exactly 1{scale}"
            ),
            c_table(
                "uint32_t", clock.c_tails, [[f"{r.tail}u" for r in rows]], f"longest {clock.lag} of each row"
            ),
            *self._moment_tables(),
            c_table(
                real,
                "RESIDUAL_BOUND",
                [[self._types.literal(b) for b in residual_bounds(self._settings)]],
                "tolerance of each row" + (", in millionths" if self._is_integer else ""),
            ),
        ]
        if self._features.has_waiting_rows:
            waits = [["true" if r.waits else "false" for r in rows]]
            tables.append(
                c_table("bool", "WAITS", waits, "rows with negative amplitudes: commands wait for rest")
            )
        if self._features.has_rope_rows:
            tables += rope_row_tables(self._settings.bank.by_rope, self._types)
        tables += spacing_tables(self._settings, self._types) if self._features.has_spacing else []
        tables += phase_tables(self._settings, self._types) if self._settings.clock is not None else []
        return tables + diagnostic_tables(self._settings, self._types)

    def _lag_tables(self) -> list[CTable]:
        """List the lag of each tap; multiples of a spacing need no table."""
        clock, rows = clock_names(self._settings), self._settings.row_tables
        if self._features.has_spacing:
            return []
        lags = [[f"{lag}u" for lag in row.lags] for row in rows]
        return [c_table("uint32_t", clock.c_lags, lags, f"{clock.lag} of each tap, by row")]

    def _moment_tables(self) -> list[CTable]:
        if self._features.has_spacing:
            return []
        clock = clock_names(self._settings)
        doc = (
            f"sum of amplitude times {clock.lag} of each row: references to come per unit of a steady command"
        )
        moments = [row.moment for row in self._settings.row_tables]
        if not self._is_integer:
            values = [self._types.literal(self._settings.number.scalar(float(m))) for m in moments]
            return [c_table(self._types.real, clock.c_moments, [values], doc)]
        split = [divmod(int(m * (1 << 30)), 1 << 30) for m in moments]
        return [
            c_table("int32_t", clock.c_moments, [[str(w) for w, _ in split]], f"{doc}, whole {clock.unit}"),
            c_table("int32_t", "MOMENT_Q30", [[str(f) for _, f in split]], "what is left of each, over 2^30"),
        ]
