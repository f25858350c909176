"""Commands by inversion of the plant, and their tuning by measured moves (Visioli and Piazzi).

Not for: commands within limits (`swayless.design.optimal`), and plants with zeros in the right half plane.
"""

from swayless.design.inversion.closed_form import ClosedForm, closed_form
from swayless.design.inversion.doubt import Doubt, check_explained
from swayless.design.inversion.inverse import DEFAULT_TRUNCATION, InvertedCommand, invert
from swayless.design.inversion.misfit import MeasuredMove, Misfit, cost
from swayless.design.inversion.motion import PolynomialMotion
from swayless.design.inversion.response import MotionResponse, motion_response
from swayless.design.inversion.tuning import (
    PAPER_GAIN,
    PAPER_WEIGHTS,
    Step,
    gradient,
    paper_step,
    scaled_step,
)

__all__ = [
    "ClosedForm",
    "DEFAULT_TRUNCATION",
    "Doubt",
    "InvertedCommand",
    "MeasuredMove",
    "Misfit",
    "MotionResponse",
    "PAPER_GAIN",
    "PAPER_WEIGHTS",
    "PolynomialMotion",
    "Step",
    "check_explained",
    "closed_form",
    "cost",
    "gradient",
    "invert",
    "motion_response",
    "paper_step",
    "scaled_step",
]
