"""The simulated plant of a design, and what became of one of its moves.

Not for: the equations (`swayless.plant.simulation`), nor for what the controller asks of the plant.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from swayless.plant.pendulum import STANDARD_GRAVITY_M_S2
from swayless.plant.servo_drive import ServoDrive
from swayless.plant.simulation import DrivenCrane, FlexibleArm, HoistingCrane, HookAndLoad, Trajectory
from swayless.plant.simulation.trajectory import FloatArray

if TYPE_CHECKING:
    from swayless.machine import DesignFile
    from swayless.machine.design_document import PlantRecord, SpeedLoopRecord

Simulate: TypeAlias = Callable[[FloatArray, FloatArray, FloatArray], Trajectory]
"""Takes references in m/s, (cases, ticks), ropes in m, one longer, and the push of the wind, (ticks,)."""


@dataclass(frozen=True, eq=False)
class ArmMove(Trajectory):
    """A simulated move of an arm: the tip about the position asked for.

    Parameters
    ----------
    time_s, trolley_m, trolley_m_s, rope_length_m : ndarray
        As for `Trajectory`: the position asked for, its speed, and the pendulum of the arm's frequency.
    ahead_m, ahead_m_s : ndarray
        How far the tip is ahead, and its rate.
    """

    ahead_m: FloatArray
    ahead_m_s: FloatArray

    @property
    def sway_m(self) -> FloatArray:
        """How far the tip is ahead of the position asked for."""
        return self.ahead_m

    @property
    def amplitude_m(self) -> FloatArray:
        """How far the tip will swing if the speed stays."""
        return np.asarray(np.hypot(self.ahead_m, self.ahead_m_s / self._rad_s))

    def residual_ratio(self, speed_m_s: float) -> FloatArray:
        """Amplitude at the end, against v / w: that after one step of the speed by `speed_m_s`."""
        return np.asarray(self.amplitude_m[..., -1] * self._rad_s[..., -1] / speed_m_s)

    @property
    def _rad_s(self) -> FloatArray:
        return np.asarray(np.sqrt(STANDARD_GRAVITY_M_S2 / self.rope_length_m))


def simulated_plant(design: DesignFile, tick_s: float) -> Simulate:
    """Choose the plant that a design is for, and fix its tick.

    Parameters
    ----------
    design : DesignFile
        Of a machine or of one mode.
    tick_s : float
        Of the controller, > 0.
    """
    plant = design.plant
    if plant.kind in {"crane", "double_pendulum"}:
        crane = _crane(plant, design.drive.speed_loop)
        return lambda reference, rope, wind: crane.simulate(reference, rope, tick_s=tick_s, wind_m_s2=wind)
    return lambda reference, rope, _: _arm(reference, rope, plant.damping_ratio, tick_s)


def _crane(
    plant: PlantRecord, speed_loop: SpeedLoopRecord | None
) -> HoistingCrane | HookAndLoad | DrivenCrane:
    """Choose a crane: with hook and sling, below a driven trolley, or below one that follows exactly."""
    pendulum = plant.double_pendulum
    if pendulum is not None:
        return HookAndLoad(
            pendulum.sling_length_m, pendulum.hook_mass_kg, pendulum.load_mass_kg, plant.damping_ratio
        )
    if speed_loop is not None:
        return DrivenCrane(servo_drive(speed_loop), plant.damping_ratio)
    return HoistingCrane(plant.damping_ratio)


def servo_drive(speed_loop: SpeedLoopRecord) -> ServoDrive:
    """Give the drive of a speed loop in a design file."""
    integral_time_s = math.inf if speed_loop.integral_time_s is None else speed_loop.integral_time_s
    return ServoDrive(
        speed_loop.trolley_mass_kg, speed_loop.load_mass_kg, speed_loop.gain_n_s_m, integral_time_s
    )


def _arm(
    reference_m_s: FloatArray, rope_length_m: FloatArray, damping_ratio: float, tick_s: float
) -> ArmMove:
    """Run an arm whose frequencies are those of pendulums of these lengths."""
    shortest_m = float(rope_length_m.min())
    highest_hz = math.sqrt(STANDARD_GRAVITY_M_S2 / shortest_m) / (2.0 * math.pi)
    reach = np.cbrt(rope_length_m / shortest_m)
    arm = FlexibleArm(highest_hz, 1.0, damping_ratio)
    asked_m = np.cumsum(reference_m_s, axis=-1) * tick_s
    run = arm.simulate(asked_m, reach, tick_s=tick_s, hold="line")
    rest = np.zeros_like(asked_m[..., :1])
    asked_m, asked_m_s = (np.concatenate([rest, values], axis=-1) for values in (asked_m, reference_m_s))
    return ArmMove(
        time_s=run.time_s,
        trolley_m=asked_m,
        trolley_m_s=asked_m_s,
        rope_length_m=rope_length_m,
        ahead_m=run.tip_m - asked_m,
        ahead_m_s=run.tip_m_s - asked_m_s,
    )


def case_until(trajectory: Trajectory, case: int | None, tick: int) -> Trajectory:
    """Cut one case out of a simulation, up to a tick.

    Parameters
    ----------
    trajectory : Trajectory
        Of one case or of many.
    case : int or None
        Which one; None where there is but one.
    tick : int
        At whose beginning the cut ends.

    Examples
    --------
    >>> run = HoistingCrane().simulate(np.full((2, 50), [[0.1], [0.2]]), 4.0, tick_s=0.01)
    >>> cut = case_until(run, 1, 20)
    >>> cut.time_s.size, round(float(cut.residual_ratio(0.2)), 3)
    (21, 1.0)
    """
    values = {item.name: getattr(trajectory, item.name) for item in fields(trajectory)}
    arrays = {name: value for name, value in values.items() if isinstance(value, np.ndarray)}
    return replace(
        trajectory,
        **{
            name: value[..., : tick + 1] if case is None or value.ndim == 1 else value[..., case, : tick + 1]
            for name, value in arrays.items()
        },
    )
