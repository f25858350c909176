"""The motion profile: a command computed ahead, played from a table between any two positions.

Not for: commands that an operator gives as it goes; those are the command shaper's.
"""

from swayless.controller.profile.enumeration import (
    Extremes,
    PlayedMove,
    PlayedStops,
    played_move,
    played_stops,
)
from swayless.controller.profile.model import ProfileModel, StopLaw
from swayless.controller.profile.pieces import Pieces
from swayless.controller.profile.pins import ProfileInput, ProfileOutput
from swayless.controller.profile.profile import MotionProfile
from swayless.controller.profile.settings import ProfileSettings
from swayless.controller.profile.status import ProfileStatus, explain_profile

__all__ = [
    "Extremes",
    "MotionProfile",
    "Pieces",
    "PlayedMove",
    "PlayedStops",
    "ProfileInput",
    "ProfileModel",
    "ProfileOutput",
    "ProfileSettings",
    "ProfileStatus",
    "StopLaw",
    "explain_profile",
    "played_move",
    "played_stops",
]
