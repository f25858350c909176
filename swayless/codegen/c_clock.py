"""What the C of a block prints because of its clock or a measured rope. Not for: constants, nor for state."""

from __future__ import annotations

from swayless.codegen.c_phase_int32 import integer_hoist
from swayless.codegen.c_phase_state import ring_length
from swayless.codegen.c_spacing import spacing_look_ups
from swayless.codegen.c_types import CTypes
from swayless.codegen.clock_names import clock_names
from swayless.codegen.law_text import spacing_law
from swayless.codegen.phase_work import most_cells_a_tick
from swayless.controller.measured import ROPE
from swayless.controller.settings import ShaperSettings


class CClock:
    """Templates, expressions and sizes of one clock.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    types : CTypes
        Its types.
    """

    def __init__(self, settings: ShaperSettings, types: CTypes) -> None:
        self._settings, self._types, self._name = settings, types, types.name
        self._is_integer = types.number.is_integer
        self._is_phase, self._has_rope = settings.clock is not None, settings.rope is not None
        self._law = spacing_law(settings)
        self._measured = ROPE if settings.rope is None else settings.rope.measured

    @property
    def c_tail_ticks(self) -> str:
        """Ticks in which the last lag of a row passes."""
        return self._c_ticks("tail")

    @property
    def c_left_ticks(self) -> str:
        """Ticks in which what is left of it passes."""
        return self._c_ticks(f"tail - s->{clock_names(self._settings).c_still}")

    def _c_ticks(self, lag: str) -> str:
        if self._law is not None:
            return f"{self._name}_ticks_of(s, row, {lag})"
        return f"{self._name}_ticks_of(s, {lag})" if self._is_phase else lag

    @property
    def c_count_still(self) -> str:
        """One tick more without change."""
        return f"{self._name}_count_still(s)" if self._is_phase else "s->still_ticks += 1u"

    @property
    def c_or_disturbed(self) -> str:
        """What else than a new command ends a rest: under the original law a new spacing."""
        return " || s->disturbed" if self._law == "original" else ""

    @property
    def look_ups(self) -> int:
        """Looks into the table of the spacing in a tick, at most."""
        return spacing_look_ups(self._settings)

    @property
    def c_amplitude(self) -> str:
        """Amplitude of tap i, wide enough for a product."""
        return f"{'(int64_t)' if self._is_integer else ''}{self._name}_AMPLITUDE[i]"

    @property
    def c_carry_argument(self) -> str:
        """The state, where a reference leaves a carry."""
        return "s, " if self._is_integer else ""

    @property
    def c_delay(self) -> str:
        """Ticks that tap i lags while the spacing stays."""
        return "s->delays[i - first]" if self._law == "modified" else "(i - first) * s->spacing"

    @property
    def c_total(self) -> str:
        """Sum of references, from a sum of amplitudes times commands."""
        return f"{self._name}_nearest(total + s->carry)" if self._is_integer else "total"

    @property
    def c_lap_argument(self) -> str:
        """Whether a cell belongs to this lap; whole numbers do not ask."""
        return "" if self._is_integer else ", s->next[later] <= s->head"

    @property
    def filter_templates(self) -> list[str]:
        """Templates of the taps for the clock and number type, and of the rope."""
        number = "int32" if self._is_integer else "float"
        rope = ["c/rope.c.j2"] if self._has_rope else []
        if self._law is not None:
            parts = ("spacing_state", f"spacing_output_{number}", f"spacing_{self._law}", "spacing_filter")
            return [f"c/{parts[0]}.c.j2", *rope, *(f"c/{part}.c.j2" for part in parts[1:])]
        if not self._is_phase:
            return [f"c/filter_{number}.c.j2", *rope]
        parts = (f"phase_hoist_{number}", "phase_clock", f"phase_sums_{number}", "phase_filter")
        return ["c/phase_state.c.j2", *rope, *(f"c/{part}.c.j2" for part in parts)]

    @property
    def c_rope_length(self) -> str:
        """Pin of the rope length."""
        return self._measured.c_value(is_integer=self._is_integer)

    @property
    def c_hoist_speed(self) -> str:
        """Pin of the hoist speed."""
        return self._measured.c_speed(is_integer=self._is_integer)

    @property
    def c_rope_valid(self) -> str:
        """Pin that says whether the rope length is to be believed."""
        return self._measured.c_valid

    @property
    def c_angle(self) -> str:
        """Phase of a tick in rad over 2^30, int32 only: a quantum is a power of two."""
        shift = integer_hoist(self._settings).angle_shift
        return f"s->quanta {'*' if shift >= 0 else '/'} INT64_C({1 << abs(shift)})"

    @property
    def ring_length(self) -> int:
        """Cells of the ring."""
        return ring_length(self._settings)

    @property
    def ring_doc(self) -> str:
        """How long the ring is."""
        if self._is_phase:
            return "the longest delay of any row on the longest rope, in ticks, and two"
        if self._law is not None:
            return "the longest delay of any row at the widest spacing, in ticks, and one"
        return "the longest delay of any row, in ticks, and one"

    @property
    def later_taps(self) -> int:
        """Taps of the longest row, but for the first."""
        return max(len(table.lags) for table in self._settings.row_tables) - 1

    @property
    def most_cells(self) -> int:
        """Cells that a tap passes in a tick at most; phase clock only."""
        clock = self._settings.clock
        assert clock is not None  # noqa: S101 - only templates of the phase clock ask
        return most_cells_a_tick(clock)

    @property
    def c_command(self) -> str:
        """The checked command; see `c_on_grid`."""
        return self.c_on_grid("command")

    def c_on_grid(self, command: str) -> str:
        """Take a command as it is, for the phase clock on the grid, where its parts add exactly."""
        return f"{self._name}_on_grid({command})" if self._is_phase and not self._is_integer else command
