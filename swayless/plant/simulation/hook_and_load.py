"""A planar crane with a heavy hook: two pendulums, one below the other, while trolley and hoist move.

Not for: the two modes as a design needs them, nor for slings that fall slack.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from types import ModuleType

from numpy.typing import ArrayLike

from swayless.errors import PlantError
from swayless.plant.pendulum import STANDARD_GRAVITY_M_S2
from swayless.plant.simulation.crane_ticks import CraneTick, Hold, crane_inputs
from swayless.plant.simulation.hoisting_crane import check_damping
from swayless.plant.simulation.hook_and_load_trajectory import HookAndLoadTrajectory
from swayless.plant.simulation.integration import State, Value, integrate, steps_per_tick


@dataclass(frozen=True)
class HookAndLoad:
    """A hook on a rope of changing length L, and a load below it on a sling of length S.

    With the angles a of the rope and b of the sling from the vertical, their difference c = a - b, and the
    load's share u of the mass of both, the accelerations across rope and sling A = L a'' and B = S b'' obey

        A + u cos(c) B = -x'' cos(a) - 2 L' a' - g sin(a) - u S b'^2 sin(c) + u f cos(a),
        cos(c) A + B   = -x'' cos(b) - 2 L' a' cos(c) - g sin(b) + (L a'^2 - L'') sin(c) + f cos(b),

    plus damping. Unlike in the simple pendulum the acceleration L'' of the hoist acts, on the sling: a hoist
    that starts with a jerk kicks. The same two equations hold for impulses of trolley and hoist. The damping
    is the one that gives both small vibrations the same ratio at every rope length: a'' and b'' are less by
    2 d times the rates, times the square root of the matrix of w^2.

    Parameters
    ----------
    sling_length_m : float
        From the hook to the load's centre of gravity, > 0.
    hook_mass_kg, load_mass_kg : float
        > 0.
    damping_ratio : float
        Of both small vibrations, 0 <= damping_ratio < 1.

    Raises
    ------
    PlantError
        If a value is out of range.

    References
    ----------
    Lagrange's equations of two masses whose positions are (x + L sin a, -L cos a) and
    (x + L sin a + S sin b, -L cos a - S cos b); in their linear form, W. Singhose, D. Kim, M. Kenison, Input
    shaping control of double-pendulum bridge crane oscillations, J. Dynamic Systems, Measurement, and Control
    130 (2008).

    Examples
    --------
    >>> import numpy as np
    >>> crane = HookAndLoad(2.0, 500.0, 1000.0)
    >>> start = crane.simulate(np.full(1000, 0.5), 6.0, tick_s=0.01)
    >>> start.mode_amplitudes_m[:, -1].round(3)
    array([0.47 , 0.009])
    """

    sling_length_m: float
    hook_mass_kg: float
    load_mass_kg: float
    damping_ratio: float = 0.0

    def __post_init__(self) -> None:
        for name in ("sling_length_m", "hook_mass_kg", "load_mass_kg"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0.0):
                raise PlantError(f"{name} = {value!r}: must be finite and > 0")
        check_damping(self.damping_ratio)

    @cached_property
    def load_share_ratio(self) -> float:
        """Load mass over the mass of hook and load."""
        return self.load_mass_kg / (self.hook_mass_kg + self.load_mass_kg)

    @cached_property
    def _pull_m_s2(self) -> float:
        """Gravity over the hook's share of the mass: what straightens a bent rope."""
        return STANDARD_GRAVITY_M_S2 / (1.0 - self.load_share_ratio)

    def simulate(
        self,
        reference_m_s: ArrayLike,
        rope_length_m: ArrayLike,
        *,
        tick_s: float,
        hold: Hold = "step",
        wind_m_s2: ArrayLike = 0.0,
        hook_rad: float = 0.0,
        sling_rad: float = 0.0,
    ) -> HookAndLoadTrajectory:
        """Run the crane from a standing trolley through every tick of the reference, as it is told.

        Parameters
        ----------
        reference_m_s, rope_length_m, tick_s, hold, wind_m_s2
            As for `HoistingCrane.simulate`; the rope goes to the hook, and the wind blows at the load.
        hook_rad, sling_rad : float
            Angles of rope and sling at the beginning, where both stand still.

        Raises
        ------
        PlantError
            If an input is out of range, or rope or sling would swing to the horizontal.
        """
        inputs = crane_inputs(reference_m_s, rope_length_m, wind_m_s2, tick_s, hold)
        trace_s2 = self._stiffness_s2(float(inputs.rope_length_m.min()))[0]
        start = (hook_rad, sling_rad, 0.0, 0.0)
        states = integrate(self, start, inputs.ticks, tick_s, steps_per_tick(tick_s, math.sqrt(trace_s2)))
        return HookAndLoadTrajectory(
            time_s=inputs.time_s,
            trolley_m=inputs.travel_m,
            trolley_m_s=inputs.reference_m_s,
            rope_length_m=inputs.rope_length_m,
            sling_length_m=self.sling_length_m,
            load_share_ratio=self.load_share_ratio,
            angles_rad=states[:2],
            angles_rad_s=states[2:],
        )

    def kick(self, xp: ModuleType, tick: CraneTick, state: State) -> State:
        """Give hook and load the impulses that steps of trolley and hoist speed are."""
        hook, sling, hook_rate, sling_rate = state
        hook_m_s, sling_m_s = self._across(
            xp,
            hook - sling,
            -tick.jump_m_s * xp.cos(hook),
            -tick.jump_m_s * xp.cos(sling) - tick.hoist_jump_m_s * xp.sin(hook - sling),
        )
        return (
            hook,
            sling,
            hook_rate + hook_m_s / tick.rope_length_m,
            sling_rate + sling_m_s / self.sling_length_m,
        )

    def rates(self, xp: ModuleType, tick: CraneTick, time_s: float, state: State) -> State:
        """Rates and accelerations of both angles."""
        hook, sling, hook_rate, sling_rate = state
        share, sling_m, gravity = self.load_share_ratio, self.sling_length_m, STANDARD_GRAVITY_M_S2
        length_m = tick.rope_length_m + tick.hoist_m_s * time_s
        sine, cosine = xp.sin(hook - sling), xp.cos(hook - sling)
        turn_m_s2 = 2.0 * tick.hoist_m_s * hook_rate
        hook_m_s2, sling_m_s2 = self._across(
            xp,
            hook - sling,
            (share * tick.wind_m_s2 - tick.slope_m_s2) * xp.cos(hook)
            - turn_m_s2
            - gravity * xp.sin(hook)
            - share * sling_m * sling_rate * sling_rate * sine,
            (tick.wind_m_s2 - tick.slope_m_s2) * xp.cos(sling)
            - turn_m_s2 * cosine
            - gravity * xp.sin(sling)
            + length_m * hook_rate * hook_rate * sine,
        )
        hook_drag, sling_drag = self._drag(xp, length_m, hook_rate, sling_rate)
        return (
            hook_rate,
            sling_rate,
            hook_m_s2 / length_m - hook_drag,
            sling_m_s2 / sling_m - sling_drag,
        )

    def _across(self, xp: ModuleType, between: Value, rope: Value, sling: Value) -> tuple[Value, Value]:
        """Solve the two equations of the class for A and B, the right sides given."""
        cosine = xp.cos(between)
        share = self.load_share_ratio
        scale = 1.0 / (1.0 - share * cosine * cosine)
        return (rope - share * cosine * sling) * scale, (sling - cosine * rope) * scale

    def _stiffness_s2(self, length_m: Value) -> tuple[Value, Value]:
        """Trace and determinant (in s-4) of the matrix of w^2 of the small vibrations."""
        per_m2 = 1.0 / (length_m * self.sling_length_m)
        trace = self._pull_m_s2 * per_m2 * (length_m + self.sling_length_m)
        return trace, self._pull_m_s2 * STANDARD_GRAVITY_M_S2 * per_m2

    def _drag(
        self, xp: ModuleType, length_m: Value, hook_rate: Value, sling_rate: Value
    ) -> tuple[Value, Value]:
        """2 d sqrt(W) times the rates, where W is the matrix of w^2.

        A matrix of two rows has the square root (W + sqrt(det W)) / sqrt(trace W + 2 sqrt(det W)).
        """
        trace, determinant = self._stiffness_s2(length_m)
        root = xp.sqrt(determinant)
        factor = 2.0 * self.damping_ratio / xp.sqrt(trace + 2.0 * root)
        hook = self._pull_m_s2 * (hook_rate - self.load_share_ratio * sling_rate) / length_m
        sling = self._pull_m_s2 * (sling_rate - hook_rate) / self.sling_length_m
        return factor * (hook + root * hook_rate), factor * (sling + root * sling_rate)
