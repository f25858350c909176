"""Commands computed ahead for linear plants: time-optimal, of least energy, and along a trajectory.

Not for: shapers, which change a command as it comes.
"""

from swayless.design.optimal.command import Command
from swayless.design.optimal.detuning import detuned
from swayless.design.optimal.energy import least_energy, track
from swayless.design.optimal.feedback import Feedback, input_with_feedback, output_with_feedback
from swayless.design.optimal.linear_plant import LinearPlant
from swayless.design.optimal.moves import OptimalCommand
from swayless.design.optimal.robustification import Robustness
from swayless.design.optimal.sampling import output_at_ticks
from swayless.design.optimal.sensitivity import residual_amplitude, swing_left, transform_derivatives
from swayless.design.optimal.task import MoveTask
from swayless.design.optimal.time_optimal import time_optimal

__all__ = [
    "Command",
    "Feedback",
    "LinearPlant",
    "MoveTask",
    "OptimalCommand",
    "Robustness",
    "detuned",
    "input_with_feedback",
    "least_energy",
    "output_at_ticks",
    "output_with_feedback",
    "residual_amplitude",
    "swing_left",
    "time_optimal",
    "track",
    "transform_derivatives",
]
