"""What the C of a block prints because of functions that only some blocks have. Not for: constants, state."""

from __future__ import annotations

from swayless.codegen.c_operator import CONTACTOR_NAMES
from swayless.codegen.c_types import CTypes
from swayless.codegen.features import Features
from swayless.codegen.interface import input_pins, output_pins
from swayless.codegen.pin import Pin
from swayless.controller.diagnosis import ROPE_UNKNOWN
from swayless.controller.measured import ROPE
from swayless.controller.rope_bound import RESIDUAL_PPM
from swayless.controller.settings import ShaperSettings
from swayless.controller.status import Status

SAME_FIELDS = ("stop_", "slow_", "drive_ready", "speed_limit", "rope_offset")
"""How inputs begin that must be the same as in the last tick for nothing to change at rest."""

IDLE_FIELDS = ("distance_", "drive_ready", "speed_limit", "step_size")
"""How inputs begin that are not 0 when nothing is touched."""


class COptions:
    """Expressions, parameters and arguments of one block.

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
        self._name, self._is_integer = types.name, types.number.is_integer
        self._inputs = {pin.field: pin for pin in input_pins(settings)}
        self._outputs = {pin.field: pin for pin in output_pins(settings)}

    def c_pin(self, field: str) -> str:
        """Name of an input."""
        return self._inputs[field].c_name

    def c_out(self, field: str) -> str:
        """Name of an output."""
        return self._outputs[field].c_name

    def c_narrow(self, name: str) -> str:
        """Take a sum that fits a command as one."""
        return f"({self._types.real}){name}" if self._is_integer else name

    @property
    def c_halted(self) -> str:
        """Whether the reference is 0 at once."""
        return "s->emergency || s->drive_off" if self._features.has_feedback else "s->emergency"

    @property
    def c_stopped(self) -> str:
        """Whether a stop is latched."""
        return "s->emergency || s->quick" + (" || s->drive_off" if self._features.has_feedback else "")

    @property
    def _says_at_once(self) -> bool:
        return self._features.has_feedback or self._features.has_stop_switches

    @property
    def stop_parameter(self) -> str:
        """Whether to stop at once, where not only an emergency stop does."""
        return ", bool at_once" if self._says_at_once else ""

    @property
    def stop_argument(self) -> str:
        """The same, for the stops that are latched."""
        return f", {self.c_halted}" if self._says_at_once else ""

    @property
    def c_at_once(self) -> str:
        """The same, in the stop itself."""
        return "at_once" if self._says_at_once else "s->emergency"

    @property
    def c_quick_stop(self) -> str:
        """What asks for a quick stop."""
        hits = f" || {self._name}_hit(s)" if self._features.has_stop_switches else ""
        return f"input->quick_stop{hits}"

    @property
    def c_command_is_0(self) -> str:
        """When a command counts as 0."""
        return f"s->invalid || {'s->locked || ' if self._features.has_lock else ''}s->zero_commanded"

    @property
    def contactor_names(self) -> tuple[str, ...]:
        """Constants of the commands that a contactor drive knows."""
        return CONTACTOR_NAMES[: len(self._settings.operator.contactor_commands)]

    @property
    def c_tuning(self) -> list[str]:
        """Calls that read what is set on site."""
        features, name = self._features, self._name
        limit = [f"{name}_read_speed_limit(s, input);"] if features.has_speed_limit else []
        return limit + ([f"{name}_read_rope_offset(s, input);"] if features.has_rope_offset else [])

    @property
    def c_limiting(self) -> list[str]:
        """Calls that leave of a command what it may be."""
        features, name = self._features, self._name
        limit = [f"command = {name}_limited(s, command);"] if features.has_speed_limit else []
        return limit + ([f"command = {name}_switched(s, input, command);"] if features.has_switches else [])

    @property
    def c_rope_reading(self) -> str:
        """The rope length that is read."""
        if self._features.has_rope_offset:
            return "reading"
        rope = self._settings.rope
        return f"input->{(ROPE if rope is None else rope.measured).c_value(is_integer=self._is_integer)}"

    @property
    def offset_doc(self) -> str:
        """What happens to a length that no number of the type holds."""
        return ", as far as the type goes" if self._is_integer else ""

    @property
    def c_sum_within(self) -> str:
        """Function that keeps a sum within bounds."""
        if not self._is_integer:
            return "within"
        return "sum_within" if self._settings.clock is None else "clamped"

    @property
    def c_sum_abs(self) -> str:
        """Function for the size of a sum."""
        return "sum_abs" if self._is_integer else "abs"

    @property
    def c_way_divided(self) -> str:
        """Division that ends a product with the scale of ways."""
        way = self._settings.operator.way
        return f" / {self._name}_WAY_UNIT" if way is not None and way.shift else ""

    def c_and_number(self, field: str) -> str:
        """Whether an input is a number; whole numbers are."""
        return "" if self._is_integer else f" && {self._name}_is_number(input->{self.c_pin(field)})"

    @property
    def c_row_may_change(self) -> str:
        """When a row may change."""
        settled = f"{self._name}_settled(s)"
        return f"!s->row_locked && {settled}" if self._features.has_steps else settled

    @property
    def c_row_to_come(self) -> str:
        """The row that takes over at rest."""
        return "s->next_row" if self._features.has_way else "s->wanted_row"

    @property
    def c_and_may_move(self) -> str:
        """Whether the speed limit lets steps move."""
        return f" && (s->speed_limit > {self._types.literal(0)})" if self._features.has_speed_limit else ""

    @property
    def c_most_step_parameters(self) -> str:
        """What the largest command of a step depends on."""
        features = self._features
        if not (features.has_speed_limit or features.has_slow_switches):
            return "void"
        direction = ", bool forward" if features.has_slow_switches else ""
        return f"const {self._name}_shaper_t *s{direction}"

    @property
    def c_most_step_arguments(self) -> str:
        """The same, where it is asked for."""
        features = self._features
        if not (features.has_speed_limit or features.has_slow_switches):
            return ""
        return "s, forward" if features.has_slow_switches else "s"

    @property
    def c_step_limit_parameters(self) -> str:
        """What limits the way of steps."""
        first, last = (
            (f"{self._name}_shaper_t *s, ", ", bool forward") if self._features.has_way else ("", "")
        )
        real, wide = self._types.real, self._types.sum
        return f"{first}{real} command, {wide} left, {real} most{last}"

    @property
    def c_step_limit_arguments(self) -> str:
        """The same, where it is asked for."""
        return "s, command, way, most, forward" if self._features.has_way else "command, way, most"

    @property
    def c_step_ends(self) -> str:
        """Whether at rest what is left of steps is rounding."""
        name, zero = self._name, self._types.literal(0)
        rests = f"{name}_equal(command, {zero})"
        if self._is_integer:
            return rests
        return f"({rests} || ({name}_abs(way) <= {name}_STEP_ROUNDING))"

    @property
    def c_nothing_left(self) -> str:
        """Whether all steps are travelled."""
        if self._is_integer:
            return "(s->left == 0) && (s->queued == 0)"
        zero = self._types.literal(0)
        return f"{self._name}_equal(s->left, {zero}) && {self._name}_equal(s->queued, {zero})"

    @property
    def c_acceptable(self) -> str:
        """The command that may be accepted."""
        has_way = self._features.has_way and self._features.has_waiting_rows
        return f"{self._name}_acceptable(s, command)" if has_way else "command"

    @property
    def c_next(self) -> str:
        """The next command on the ramp."""
        name = self._name
        ramped, ended = f"{name}_ramped(s->command, s->target)", f"{name}_before_end(s)"
        if not self._features.has_way:
            return ramped
        return f"{name}_WAITS[s->row] ? {ramped} : {ended}" if self._features.has_waiting_rows else ended

    @property
    def c_to_foretell(self) -> str:
        """Whether the stop is to be foretold."""
        return "s->stepping || !s->foretold" if self._features.has_steps else "!s->foretold"

    @property
    def c_and_no_steps(self) -> str:
        """Whether what is foretold stays."""
        return " && !s->stepping" if self._features.has_steps else ""

    @property
    def c_residual_bound(self) -> str:
        """Bound of the row that shapes."""
        by_rope = self._features.has_rope_bounds
        return f"{self._name}_bound_on_rope(s, row)" if by_rope else f"{self._name}_RESIDUAL_BOUND[row]"

    @property
    def c_rope_unknown(self) -> str:
        """Bits that say that the rope length in use is not the one that hangs on the crane."""
        names = [bit.name for bit in Status if bit & ROPE_UNKNOWN]
        return "(" + "\n        | ".join(f"{self._name.upper()}_SHAPER_{name}" for name in names) + ")"

    @property
    def c_everything(self) -> str:
        """Residual bound of a block that shapes nothing."""
        return self._types.literal(RESIDUAL_PPM if self._is_integer else 1)

    @property
    def c_quanta_of_now(self) -> str:
        """Quanta of a tick on the rope of now."""
        looked_up = f"{self._name}_tick_quanta(s->rope_length)"
        return looked_up if self._settings.clock is None else "s->quanta"

    @property
    def c_sway_quanta(self) -> str:
        """The same after power-on."""
        sway = self._settings.diagnostics.sway
        return "" if sway is None or sway.rope is None else f"{sway.rope.clock.fewest_quanta}u"

    @property
    def c_runs(self) -> str:
        """Whether a tick has anything to do; empty if always."""
        parts = ["shaper->tables_match"] if self._features.has_facts else []
        parts += [f"!{self._name}_idles(shaper, input)"] if self._features.can_idle else []
        return " && ".join(parts)

    @property
    def c_same_pins(self) -> list[str]:
        """Comparisons of inputs with those of the last tick."""
        pins = [pin for field, pin in self._inputs.items() if field.startswith(SAME_FIELDS)]
        return [self._same(pin) for pin in pins]

    def _same(self, pin: Pin) -> str:
        now, last = f"input->{pin.c_name}", f"s->input.{pin.c_name}"
        return f"{self._name}_equal({now}, {last})" if pin.kind == "real" else f"({now} == {last})"

    @property
    def design_id(self) -> str:
        """CRC-32 of the design file."""
        facts = self._settings.diagnostics.facts
        return "" if facts is None else f"0x{facts.design_id:08X}u"

    @property
    def example_inputs(self) -> list[tuple[str, str]]:
        """Inputs of the example that are not 0 when nothing is touched: names and values."""
        operator, limits = self._settings.operator, self._settings.limits
        far = 0 if operator.way is None else operator.way.margin + operator.way.farthest
        values = {
            "distance_forward": self._types.literal(far),
            "distance_reverse": self._types.literal(far),
            "speed_limit": self._types.literal(limits.max_command),
            "step_size": "1u",
        }
        pins = [pin for field, pin in self._inputs.items() if field.startswith(IDLE_FIELDS)]
        return [(pin.c_name, values.get(pin.field, "true")) for pin in pins]
