"""A planar crane that hoists while its trolley travels exactly as it is told.

Not for: a trolley that the load pulls at (`driven_crane`), a heavy hook (`hook_and_load`), or slack ropes.
"""

from __future__ import annotations

from dataclasses import dataclass
from types import ModuleType

from numpy.typing import ArrayLike

from swayless.errors import PlantError
from swayless.plant.pendulum import STANDARD_GRAVITY_M_S2
from swayless.plant.simulation.crane_ticks import CraneTick, Hold, crane_inputs
from swayless.plant.simulation.integration import State, integrate, steps_per_tick
from swayless.plant.simulation.trajectory import CraneTrajectory


@dataclass(frozen=True)
class HoistingCrane:
    """A load on a rope of changing length, at any angle below 90 degrees.

    L a'' = -2 L' a' - g sin(a) - (x'' - f) cos(a) - 2 d sqrt(g L) a', with the swing a, the rope length L,
    the trolley x, the wind's force per mass f and the damping ratio d of the small swing. The acceleration
    L'' of the hoist pulls along the rope, through the suspension, and has no moment: a hoist that starts with
    a jerk kicks nothing here. A step of the trolley speed by v is an impulse: a' jumps by -v cos(a) / L.

    Parameters
    ----------
    damping_ratio : float
        Of the small swing, 0 <= damping_ratio < 1.

    Raises
    ------
    PlantError
        If the damping ratio is out of range.

    References
    ----------
    E. M. Abdel-Rahman, A. H. Nayfeh, Z. N. Masoud, Dynamics and control of cranes: a review, J. Vibration and
    Control 9 (2003), planar crane with hoisting. It is Lagrange's equation of a for the kinetic energy
    ((x' + (L sin a)')^2 + ((L cos a)')^2) / 2 and the potential energy -g L cos a, per load mass.

    Examples
    --------
    A trolley that starts at once to 0.5 m/s, on 4 m of rope, leaves a swing of v / sqrt(g L):

    >>> import numpy as np
    >>> crane = HoistingCrane()
    >>> start = crane.simulate(np.full(1000, 0.5), 4.0, tick_s=0.01)
    >>> round(float(np.degrees(start.amplitude_rad[-1])), 3)
    4.575
    """

    damping_ratio: float = 0.0

    def __post_init__(self) -> None:
        check_damping(self.damping_ratio)

    def simulate(
        self,
        reference_m_s: ArrayLike,
        rope_length_m: ArrayLike,
        *,
        tick_s: float,
        hold: Hold = "step",
        wind_m_s2: ArrayLike = 0.0,
        swing_rad: float = 0.0,
        swing_rad_s: float = 0.0,
    ) -> CraneTrajectory:
        """Run the crane from a standing trolley through every tick of the reference.

        Parameters
        ----------
        reference_m_s : array_like, shape (ticks,) or (cases, ticks)
            Trolley speed, a value a tick.
        rope_length_m : array_like, broadcast to (ticks + 1,) or (cases, ticks + 1)
            At the beginning of each tick and the end of the last one, > 0; straight between.
        tick_s : float
            Duration of a tick, > 0.
        hold : "step" or "line"
            Whether the speed steps as a tick begins and holds, or runs straight to it within the tick.
        wind_m_s2 : array_like, broadcast to the shape of the reference
            Force of the wind per load mass.
        swing_rad, swing_rad_s : float
            Swing of the load at the beginning.

        Raises
        ------
        PlantError
            If an input is out of range, or the rope would swing to the horizontal.
        """
        inputs = crane_inputs(reference_m_s, rope_length_m, wind_m_s2, tick_s, hold)
        steps = steps_per_tick(tick_s, inputs.fastest_swing_rad_s())
        swing, rate = integrate(self, (swing_rad, swing_rad_s), inputs.ticks, tick_s, steps)
        return CraneTrajectory(
            time_s=inputs.time_s,
            trolley_m=inputs.travel_m,
            trolley_m_s=inputs.reference_m_s,
            rope_length_m=inputs.rope_length_m,
            swing_rad=swing,
            swing_rad_s=rate,
        )

    def kick(self, xp: ModuleType, tick: CraneTick, state: State) -> State:
        """Step of the trolley speed: an impulse on the load."""
        swing, rate = state
        return swing, rate - tick.jump_m_s * xp.cos(swing) / tick.rope_length_m

    def rates(self, xp: ModuleType, tick: CraneTick, time_s: float, state: State) -> State:
        """Rate and acceleration of the swing."""
        swing, rate = state
        length_m = tick.rope_length_m + tick.hoist_m_s * time_s
        drag_m_s = 2.0 * (tick.hoist_m_s + self.damping_ratio * xp.sqrt(STANDARD_GRAVITY_M_S2 * length_m))
        push_m_s2 = STANDARD_GRAVITY_M_S2 * xp.sin(swing) + (tick.slope_m_s2 - tick.wind_m_s2) * xp.cos(swing)
        return rate, -(drag_m_s * rate + push_m_s2) / length_m


def check_damping(damping_ratio: float) -> None:
    """Refuse a damping ratio outside [0, 1)."""
    if not 0.0 <= damping_ratio < 1.0:
        raise PlantError(f"damping_ratio = {damping_ratio!r}: must be at least 0 and below 1")
