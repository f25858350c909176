"""Everything the templates of the adaptive shaper print, for C and Structured Text. Not for: layout."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

from swayless.codegen.adaptive_st_state import (
    ST_COUNTERS,
    ST_FIRST_SUMS,
    ST_FLAGS,
    ST_REALS,
    ST_WINDOW_SUMS,
)
from swayless.codegen.c_types import CTypes
from swayless.codegen.literals import shortest
from swayless.codegen.names import check_c_names, check_st_names
from swayless.codegen.pin import Pin, pin
from swayless.codegen.provenance import comment_text
from swayless.codegen.st_types import StTypes
from swayless.codegen.status_bits import StatusBit, status_bits
from swayless.controller.adaptive import AdaptiveSettings, AdaptiveStatus, explain_adaptive
from swayless.controller.adaptive.information import LEAST_DETERMINANT, NEWTON_STEPS
from swayless.controller.adaptive.lattice import Lattice
from swayless.controller.adaptive.learner import (
    CONVERGED_WITHIN,
    MISFIT_FACTOR,
    MISFIT_RATIO,
    NOISE_FACTOR,
    PAST_WINDOWS,
    RECENT,
    ROUGHNESS,
    SIGNIFICANCE,
    WHITE_AT_FIRST,
    dead_zone_sum,
    first_coefficients,
)
from swayless.controller.adaptive.shaper import LARGEST_VIBRATION
from swayless.controller.number import number_type

INPUTS = (
    pin(
        "enable",
        "bool",
        "false: nothing is learned; from rest on the command is not shaped",
        st_initial="TRUE",
    ),
    pin(
        "command",
        "real",
        "what the reference shall be; clamped to the maximum, and not finite holds the last",
    ),
    pin("vibration", "real", "measured vibration; not finite or too large is not learned from"),
)
"""Pins that the block reads."""

OUTPUTS = (
    pin("reference", "real", "for the drive, in the unit of the command"),
    *(
        Pin(f"coefficient_{n}", f"coefficient[{n}]", f"Coefficient{n}", "real", f"amplitude after {n} delays")
        for n in range(3)
    ),
    pin("adapting", "bool", "the command rests, and this tick is learned from"),
    pin("converged", "bool", "the coefficients fit, or left nothing but noise"),
    pin("frozen", "bool", "there is little but noise: the coefficients stay"),
    pin("status", "word", "sum of the status bits"),
)
"""Pins that it writes."""


@dataclass(frozen=True)
class RealConstant:
    """One constant of the number type, by its name in C and in Structured Text."""

    c_name: str
    st_name: str
    text: str
    doc: str

    @property
    def st_text(self) -> str:
        """Literal in Structured Text: exponents are upper case."""
        return self.text.upper()


@dataclass(frozen=True)
class AdaptiveModel:
    """The code model of an adaptive shaper.

    Parameters
    ----------
    settings : AdaptiveSettings
        Every constant of the block.
    name : str
        Machine name; prefixes every symbol.
    generator : str
        Name and version of what makes the code.
    source : str or None
        Base name of the machine file.

    Raises
    ------
    CodegenError
        If a name is reserved or too long, or a text cannot stand in a comment.
    """

    settings: AdaptiveSettings
    name: str
    generator: str
    source: str | None = None

    def __post_init__(self) -> None:
        check_c_names(self.name)
        pins = [each.st_name for each in (*INPUTS, *OUTPUTS)]
        check_st_names(self.name, [f"FB_{self.name}_Adaptive", *pins, *self._st_names])
        comment_text(f"{self.generator} {self.source or ''}")

    @property
    def _st_names(self) -> list[str]:
        variables = [each.st_name for each in (*ST_REALS, *ST_COUNTERS, *ST_FLAGS)]
        return [*variables, *(constant.st_name for constant in self.constants), "Commands", "Vibrations"]

    @property
    def macro(self) -> str:
        """Prefix of macros."""
        return self.name.upper()

    @cached_property
    def types(self) -> CTypes:
        """C types and literals."""
        return CTypes(self.name, self.settings.number)

    @cached_property
    def st_real(self) -> str:
        """Structured Text type of commands and references."""
        return StTypes(self.settings.number).real

    def literal(self, value: Any) -> str:
        """C literal of the number type."""
        return self.types.literal(value)

    @cached_property
    def tick_s_literal(self) -> str:
        """Length of a tick as a C double."""
        return shortest(self.settings.tick_s, number_type("double"))

    @cached_property
    def constants(self) -> tuple[RealConstant, ...]:
        """Constants of the number type; the text has no C suffix."""
        settings = self.settings
        first, lattice = first_coefficients(settings), Lattice(settings)
        values = (
            ("MAX_COMMAND", "MaxCommand", settings.max_command, "largest command"),
            (
                "MAX_VIBRATION",
                "MaxVibration",
                LARGEST_VIBRATION * settings.vibration_scale,
                "largest reading",
            ),
            ("PER_SCALE", "PerScale", 1.0 / settings.vibration_scale, "brings a reading to order 1"),
            (
                "MOST_NEGATIVE",
                "MostNegative",
                lattice.most_negative,
                "largest sum of negative coefficients; positive ones sum to 1 more",
            ),
            (
                "DEAD_ZONE",
                "DeadZone",
                dead_zone_sum(settings),
                "sum of squares of a window that teaches nothing",
            ),
            ("WHITE_AT_FIRST", "WhiteAtFirst", WHITE_AT_FIRST, "inverse of P(0)"),
            (
                "LEAST_DETERMINANT",
                "LeastDeterminant",
                LEAST_DETERMINANT,
                "below it samples do not tell, relative",
            ),
            (
                "NOISE_FACTOR",
                "NoiseFactor",
                3.0 * NOISE_FACTOR,
                "energy of a window that teaches, by its noise",
            ),
            (
                "MISFIT_FACTOR",
                "MisfitFactor",
                MISFIT_FACTOR,
                "what is left by coefficients that misfit, by noise",
            ),
            ("MISFIT_RATIO", "MisfitRatio", MISFIT_RATIO, "and by energy"),
            ("RECENT", "RecentWeight", RECENT, "weight of the past in the slower test"),
            ("SIGNIFICANCE", "Significance", SIGNIFICANCE, "of the slower test"),
            (
                "PAST_WINDOWS",
                "PastWindows",
                PAST_WINDOWS,
                "windows like the present one that the past is worth",
            ),
            (
                "ROUGHNESS",
                "Roughness",
                ROUGHNESS,
                "power of rounding by energy around coefficients that misfit",
            ),
            (
                "CONVERGED",
                "ConvergedWithin",
                CONVERGED_WITHIN,
                "largest change of a coefficient that has converged",
            ),
            ("ANCHOR", "LatticeAnchor", lattice.anchor, "rounds a coefficient to the lattice"),
            ("WINDOW", "WindowSamples", float(settings.window_ticks), "samples of a window"),
            ("FIRST_OUTER", "FirstOuter", first[0], "first and last coefficient at first"),
            ("FIRST_MIDDLE", "FirstMiddle", first[1], "the middle one, which takes the rest"),
        )
        scalar, number = settings.number.scalar, settings.number
        return tuple(
            RealConstant(c, st, shortest(scalar(value), number), doc) for c, st, value, doc in values
        )

    @property
    def suffix(self) -> str:
        """Suffix of C literals."""
        return "f" if self.settings.number.name == "float" else ""

    @property
    def newton_steps(self) -> int:
        """Steps of Newton's method."""
        return NEWTON_STEPS

    @property
    def status_bits(self) -> tuple[StatusBit, ...]:
        """Bits of the status word."""
        return status_bits(AdaptiveStatus, explain_adaptive)

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

    def st_type(self, field: Pin) -> str:
        """Structured Text type of a pin."""
        return StTypes(self.settings.number).type_of(field.kind)

    def st_initial(self, field: Pin) -> str:
        """Give the initial value of an input that is not wired."""
        return f" := {field.st_initial}" if field.st_initial else ""

    st_reals, st_counters, st_flags = ST_REALS, ST_COUNTERS, ST_FLAGS
    st_first_sums, st_window_sums = ST_FIRST_SUMS, ST_WINDOW_SUMS

    @property
    def last_cell(self) -> int:
        """Index of the last cell of a ring."""
        return self.settings.ring_length - 1

    @property
    def cells_ahead(self) -> int:
        """Cells from the present sample on to that of one delay ago, around the ring."""
        return self.settings.ring_length - self.settings.delay_ticks

    @property
    def example_ticks(self) -> int:
        """Ticks that the example prints: until the command has long settled."""
        return 4 * self.settings.ring_length

    @property
    def ram_bytes(self) -> int:
        """Upper bound of the size of the C state."""
        real = 4 if self.suffix else 8
        return real * (2 * self.settings.ring_length + 2 * 6 + 3 * 3 + 5) + 7 * 4 + 16

    @property
    def header(self) -> tuple[str, ...]:
        """Lines of the comment at the head of a file, without comment marks."""
        settings = self.settings
        return (
            f"{self.name}: adaptive command shaper. It learns to leave no vibration from what it measures.",
            "",
            f"Made by {self.generator} from {self.source or 'settings'}.",
            "This file is yours: use, change and ship it as you like.",
            "",
            f"Three impulses, {settings.delay_ticks} ticks of {settings.tick_s:.6g} s apart. The",
            "coefficients sum to exactly 1 and change only while the command has rested for two delays:",
            "the reference is the command there.",
            f"The command passes unshaped for {settings.cycle_ticks} ticks after it has first moved.",
            f"Commands up to {settings.max_command:.6g}, references to {settings.peak_factor:.6g} times it.",
            f"A vibration of {settings.vibration_scale:.6g} counts as 1: about what an unshaped move leaves.",
            "A constant offset of the measurement does no harm; remove hum before.",
            "After S. Rhim and W. J. Book, Adaptive command shaping, eqs 7-16.",
            "",
            "NOT A SAFETY FUNCTION: limit switches, emergency stop and brakes must work without this block.",
            "Nothing may limit, ramp or filter the reference on its way to the drive: it undoes the shaping.",
        )
