"""What measured swings tell of a machine: frequency, damping, their uncertainty, and what stays unseen.

Sampled swings (`identify_swing`), peak heights (`identify_peaks`), stopwatch readings
(`identify_periods`), and the rope offset from several of them (`fit_rope_offset`).

Not for: reading files, or designing for what was found.
"""

from swayless.plant.identification.identified_mode import HELD_DEVIATIONS, IdentifiedMode
from swayless.plant.identification.outliers import outliers
from swayless.plant.identification.peaks import Decrement, decrement, identify_peaks, mode_of_period
from swayless.plant.identification.record import Quantity, SwingRecord
from swayless.plant.identification.rope_offset import RopeOffset, fit_rope_offset
from swayless.plant.identification.stopwatch import identify_periods
from swayless.plant.identification.swing import IdentifiedSwing, fitted_values, identify_swing

__all__ = [
    "Quantity",
    "SwingRecord",
    "identify_swing",
    "IdentifiedSwing",
    "fitted_values",
    "IdentifiedMode",
    "HELD_DEVIATIONS",
    "identify_peaks",
    "decrement",
    "Decrement",
    "mode_of_period",
    "identify_periods",
    "fit_rope_offset",
    "RopeOffset",
    "outliers",
]
