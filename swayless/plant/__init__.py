"""Physics of what swings: modes, bands and the pendulum. Knows nothing of shapers or code."""

from swayless.plant.double_pendulum import (
    Participation,
    double_pendulum_modes,
    double_pendulum_participation,
)
from swayless.plant.mode import Band, Mode
from swayless.plant.pendulum import (
    STANDARD_GRAVITY_M_S2,
    pendulum_frequency_hz,
    pendulum_mode,
    pendulum_rope_length_m,
)
from swayless.plant.ropes import DrivenRopes, FreeRopes, Ropes
from swayless.plant.servo_drive import ServoDrive, servo_drive_mode, servo_drive_modes

__all__ = [
    "Band",
    "DrivenRopes",
    "FreeRopes",
    "Mode",
    "Participation",
    "Ropes",
    "STANDARD_GRAVITY_M_S2",
    "ServoDrive",
    "double_pendulum_modes",
    "double_pendulum_participation",
    "pendulum_frequency_hz",
    "pendulum_mode",
    "pendulum_rope_length_m",
    "servo_drive_mode",
    "servo_drive_modes",
]
