"""Variables of the adaptive shaper in Structured Text. Not for: pins and constants, which C has too."""

from __future__ import annotations

from swayless.codegen.st_types import Variable

SUMS = ("Ee", "Eu", "Ew", "Uu", "Uw", "Ww")

ST_WINDOW_SUMS = tuple(f"Window{name}" for name in (*SUMS, "E", "U", "W"))
"""Sums of the window, as in the C structure."""

ST_FIRST_SUMS = tuple(
    zip(
        (f"Past{name}" for name in SUMS),
        (
            "(((Learned0 * Learned0) + (Learned1 * Learned1)) + (Learned2 * Learned2)) * WhiteAtFirst",
            "(Learned0 - Learned1) * WhiteAtFirst",
            "(Learned2 - Learned1) * WhiteAtFirst",
            "WhiteAtFirst + WhiteAtFirst",
            "WhiteAtFirst",
            "WhiteAtFirst + WhiteAtFirst",
        ),
        strict=True,
    )
)
"""P(0)."""


def _real(name: str, doc: str, reset: str = "") -> Variable:
    return Variable(name, "real", doc, st_reset=reset)


_SCRATCH = (
    "Wanted",
    "DiffU",
    "DiffW",
    "LeftNow",
    "PlainEe",
    "PlainEu",
    "PlainEw",
    "Energy",
    "FirstSum",
    "LastSum",
    "Across",
    "Middle",
    "Minors",
    "Determinant",
    "Noise",
    "NewtonValue",
    "NewtonSlope",
    "Weight",
    "Size",
    "Allowed",
    "Excess",
    "Rounding",
    "PastEnergy",
    "Product",
    "Found0",
    "Found1",
    "Found2",
    "Negative",
)

ST_REALS = (
    _real("Learned0", "coefficient learned", "FirstOuter"),
    _real("Learned1", "coefficient learned", "FirstMiddle"),
    _real("Learned2", "coefficient learned", "FirstOuter"),
    _real("Used0", "coefficient in use", "FirstOuter"),
    _real("Used1", "coefficient in use", "FirstMiddle"),
    _real("Used2", "coefficient in use", "FirstOuter"),
    *(_real(name, "sum over the window", "0.0") for name in ST_WINDOW_SUMS),
    *(_real(name, "sum of all that was learned", first) for name, first in ST_FIRST_SUMS),
    _real("HeldCommand", "last valid command", "0.0"),
    _real("HeldVibration", "last valid reading, scaled", "0.0"),
    _real("LeftRecently", "left by the coefficients, over recent windows", "0.0"),
    _real("NoiseRecently", "noise over recent windows", "0.0"),
    _real("SamplesRecently", "samples of recent windows", "0.0"),
    *(_real(name, "intermediate result of one call") for name in _SCRATCH),
)
"""Variables of the number type."""

ST_COUNTERS = (
    Variable("Head", "DINT", "cell of the present sample", st_reset="0"),
    Variable("RestTicks", "DINT", "since the command has changed", st_reset="0"),
    Variable("QuietTicks", "DINT", "since it has changed or a reading was bad", st_reset="0"),
    Variable("MovedTicks", "DINT", "since the command has first moved", st_reset="0"),
    Variable("WindowTicks", "DINT", "samples in the window", st_reset="0"),
    Variable("FirstCell", "DINT", "cell of one delay ago"),
    Variable("SecondCell", "DINT", "cell of two delays ago"),
    Variable("Cell", "DINT", "loop"),
    Variable("Bits", "DINT", "status of this call"),
)
"""Counters."""

ST_FLAGS = (
    Variable("Shaping", "BOOL", "the coefficients are in use", st_reset="FALSE"),
    Variable("Learned", "BOOL", "at least one window has taught", st_reset="FALSE"),
    Variable("HasConverged", "BOOL", "as the output", st_reset="FALSE"),
    Variable("IsFrozen", "BOOL", "as the output", st_reset="FALSE"),
    Variable("Again", "BOOL", "learning again", st_reset="FALSE"),
    Variable("Refused", "BOOL", "the last set was refused", st_reset="FALSE"),
    Variable("Rough", "BOOL", "the last window was summed up around a misfit", st_reset="FALSE"),
    Variable("Trusted", "BOOL", "converged when the command last moved", st_reset="FALSE"),
    Variable("Fresh", "BOOL", "the window holds beginnings of rests, nothing else", st_reset="FALSE"),
    *(
        Variable(name, "BOOL", "intermediate result of one call")
        for name in (
            "InRange",
            "Drop",
            "Settled",
            "Shape",
            "Sampled",
            "Complete",
            "Teaches",
            "Misfits",
            "WasRough",
            "Tells",
            "Steady",
        )
    ),
)
"""Flags."""
