"""Simulated plants: what a reference, tick by tick, makes trolley and load do. Knows nothing of shapers.

A plant is told a reference a tick and a rope length (or reach), and returns a trajectory of every tick:
`HoistingCrane` follows exactly, `DrivenCrane` through a speed loop that the load disturbs, `HookAndLoad`
swings twice, `FlexibleArm` vibrates with its reach. Arrays of shape (cases, ticks) are many moves at once.

Not for: the linear response in closed form (`swayless.plant.response`), slack ropes, swing across the travel.
"""

from swayless.plant.simulation.crane_ticks import Hold
from swayless.plant.simulation.driven_crane import DrivenCrane
from swayless.plant.simulation.flexible_arm import ArmTrajectory, FlexibleArm
from swayless.plant.simulation.hoisting_crane import HoistingCrane
from swayless.plant.simulation.hook_and_load import HookAndLoad
from swayless.plant.simulation.hook_and_load_trajectory import HookAndLoadTrajectory
from swayless.plant.simulation.trajectory import CraneTrajectory, Trajectory
from swayless.plant.simulation.wind import drag_m_s2, dryden_gusts, one_cosine_gust

__all__ = [
    "HoistingCrane",
    "DrivenCrane",
    "HookAndLoad",
    "FlexibleArm",
    "Trajectory",
    "CraneTrajectory",
    "HookAndLoadTrajectory",
    "ArmTrajectory",
    "Hold",
    "drag_m_s2",
    "dryden_gusts",
    "one_cosine_gust",
]
