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

__all__ = [
    "Band",
    "Mode",
    "Participation",
    "STANDARD_GRAVITY_M_S2",
    "double_pendulum_modes",
    "double_pendulum_participation",
    "pendulum_frequency_hz",
    "pendulum_mode",
    "pendulum_rope_length_m",
]
