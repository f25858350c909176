"""What a controller needs to play a command computed ahead: the plant from tick to tick, and how to stop it.

Not for: finding the command (`swayless.design.optimal`), or number types.
"""

from swayless.design.playing.proof import (
    error_ratio,
    largest_step,
    missed_by_move,
    missed_by_stops,
    noise_gain,
    swing_ratio,
)
from swayless.design.playing.shape_model import ShapeModel, shape_model
from swayless.design.playing.stopping import ShapeLimits, Stop, quickest_stop
from swayless.design.playing.waiting import fewer_ranges, ranges_of, ticks_of, ticks_to_rest

__all__ = [
    "ShapeLimits",
    "ShapeModel",
    "Stop",
    "error_ratio",
    "fewer_ranges",
    "largest_step",
    "missed_by_move",
    "missed_by_stops",
    "noise_gain",
    "quickest_stop",
    "ranges_of",
    "shape_model",
    "swing_ratio",
    "ticks_of",
    "ticks_to_rest",
]
