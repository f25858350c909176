"""What the C of a block prints because of its clock or a measured rope. Not for: constants, nor for state."""

from __future__ import annotations

from swayless.codegen.c_phase_int32 import integer_hoist
from swayless.codegen.c_phase_state import ring_length
from swayless.codegen.c_types import CTypes
from swayless.codegen.clock_names import clock_names
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

    @property
    def c_tail_ticks(self) -> str:
        """Ticks in which the last lag of a row passes."""
        return self._c_ticks("tail")

    @property
    def c_left_ticks(self) -> str:
        """Ticks in which what is left of it passes."""
        return self._c_ticks(f"tail - s->{clock_names(self._settings).c_still}")

    def _c_ticks(self, lag: str) -> str:
        return f"{self._name}_ticks_of(s, {lag})" if self._is_phase else lag

    @property
    def c_count_still(self) -> str:
        """One tick more without change."""
        return f"{self._name}_count_still(s)" if self._is_phase else "s->still_ticks += 1u"

    @property
    def c_lap_argument(self) -> str:
        """Whether a cell belongs to this lap; whole numbers do not ask."""
        return "" if self._is_integer else ", s->next[later] <= s->head"

    @property
    def filter_templates(self) -> list[str]:
        """Templates of the taps for the clock and number type, and of the rope."""
        number = "int32" if self._is_integer else "float"
        rope = ["c/rope.c.j2"] if self._has_rope else []
        if not self._is_phase:
            return [f"c/filter_{number}.c.j2", *rope]
        parts = (f"phase_hoist_{number}", "phase_clock", f"phase_sums_{number}", "phase_filter")
        return ["c/phase_state.c.j2", *rope, *(f"c/{part}.c.j2" for part in parts)]

    @property
    def c_rope_length(self) -> str:
        """Pin of the rope length."""
        return "rope_length_mm" if self._is_integer else "rope_length_m"

    @property
    def c_hoist_speed(self) -> str:
        """Pin of the hoist speed."""
        return "hoist_speed_mm_s" if self._is_integer else "hoist_speed_m_s"

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
        return "the longest delay of any row, in ticks, and one"

    @property
    def later_taps(self) -> int:
        """Taps of the longest row, but for the first."""
        return max(len(table.lags) for table in self._settings.row_tables) - 1

    @property
    def most_cells(self) -> int:
        """Cells that a tap passes in a tick at most: on the shortest rope, written on the longest."""
        clock = self._settings.clock
        return 1 if clock is None else -(-clock.most_quanta // clock.fewest_quanta) + 1

    @property
    def c_command(self) -> str:
        """The checked command as it is, for the phase clock on the grid, where its parts add exactly."""
        return f"{self._name}_on_grid(command)" if self._is_phase and not self._is_integer else "command"
