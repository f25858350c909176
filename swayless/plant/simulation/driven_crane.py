"""A planar crane whose speed loop holds the trolley against the pull of the load.

Not for: drives that follow their reference exactly (`hoisting_crane`), current loops and force limits.
"""

from __future__ import annotations

from dataclasses import dataclass
from types import ModuleType

import numpy as np
from numpy.typing import ArrayLike

from swayless.plant.pendulum import STANDARD_GRAVITY_M_S2
from swayless.plant.servo_drive import ServoDrive, servo_drive_poles
from swayless.plant.simulation.crane_ticks import CraneTick, Hold, crane_inputs
from swayless.plant.simulation.hoisting_crane import check_damping
from swayless.plant.simulation.integration import State, integrate, steps_per_tick
from swayless.plant.simulation.trajectory import CraneTrajectory, FloatArray


@dataclass(frozen=True, eq=False)
class DrivenTrajectory(CraneTrajectory):
    """A simulated move of a crane with a driven trolley.

    Parameters
    ----------
    time_s, trolley_m, trolley_m_s, rope_length_m, swing_rad, swing_rad_s : ndarray
        As for `CraneTrajectory`.
    error_m_s, behind_m : ndarray
        Reference less trolley speed, and its integral.
    drive : ServoDrive
        Masses and speed loop.
    damping_ratio : float
        Of the rope itself.
    """

    error_m_s: FloatArray
    behind_m: FloatArray
    drive: ServoDrive
    damping_ratio: float

    @property
    def amplitude_rad(self) -> FloatArray:
        """Angle to which the swing will go in its true mode, if reference and rope stay: decay left out.

        What else is going on, such as a trolley that still brakes, is left out too: a small swing is the sum
        of the modes, a = sum c_i exp(s_i t), and this is 2 |c| of the pair of poles in which the load swings,
        from the state by the left eigenvector of s. It is nan on ropes on which nothing vibrates.
        """
        drive, gravity, length_m = self.drive, STANDARD_GRAVITY_M_S2, self.rope_length_m
        lengths_m, place = np.unique(length_m, return_inverse=True)
        poles = servo_drive_poles(drive, lengths_m, self.damping_ratio)[..., 0]
        vibrates = np.isfinite(poles)[place].reshape(length_m.shape)
        s = np.where(np.isfinite(poles), poles, 1j)[place].reshape(length_m.shape)
        damping_m_s = 2.0 * self.damping_ratio * np.sqrt(gravity * length_m)
        spring = damping_m_s * s + gravity
        force = (1.0 / length_m + s**2 / spring) * drive.trolley_mass_kg / drive.load_mass_kg
        of_behind = drive.integral_gain_n_m / drive.trolley_mass_kg * force / s
        of_speed, of_swing = force + 1.0 / length_m, gravity * s / spring
        state = of_swing * self.swing_rad + self.swing_rad_s
        state = state - of_speed * self.error_m_s + of_behind * self.behind_m
        moved = (length_m * s**2 + spring) / s
        own = of_swing + s - of_speed * moved + of_behind * moved / s
        return np.where(vibrates, 2.0 * abs(state / own), np.nan)


@dataclass(frozen=True)
class DrivenCrane:
    """A trolley of mass M under a speed loop, and a load of mass m on a rope of changing length.

    The swing obeys the equation of `HoistingCrane`, and the trolley

        (M + m sin^2 a) x'' = K (e + q / T)
                              + m sin a (g cos a + L a'^2 + f sin a - L'') + 2 m d sqrt(g L) a' cos a,

    with e = r - x' the error of the speed loop, q its integral, and the damping a moment at the suspension.
    Where the hoist speed jumps by h, the rope jerks the trolley, whose speed jumps by
    -m h sin a / (M + m sin^2 a), and thereby the swing.

    Parameters
    ----------
    drive : ServoDrive
        Masses and speed loop.
    damping_ratio : float
        Of the small swing below a trolley that stands, 0 <= damping_ratio < 1.

    Raises
    ------
    PlantError
        If the damping ratio is out of range.

    References
    ----------
    E. M. Abdel-Rahman, A. H. Nayfeh, Z. N. Masoud, Dynamics and control of cranes: a review, J. Vibration and
    Control 9 (2003): Lagrange's equations of trolley and load, with the swing's put into the trolley's.

    Examples
    --------
    A lag of 0.1 s lets the swing die out, as `servo_drive_mode` says:

    >>> import numpy as np
    >>> crane = DrivenCrane(ServoDrive.from_lag(2000.0, 6000.0, 0.1))
    >>> run = crane.simulate(np.full(3000, 0.5), 4.0, tick_s=0.01)
    >>> np.degrees(run.amplitude_rad[[1000, 2000, 3000]]).round(2)
    array([1.83, 0.73, 0.29])
    """

    drive: ServoDrive
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
    ) -> DrivenTrajectory:
        """Run the crane from a standing trolley through every tick of the reference of its speed loop.

        Parameters and errors are those of `HoistingCrane.simulate`.
        """
        inputs = crane_inputs(reference_m_s, rope_length_m, wind_m_s2, tick_s, hold)
        drive = self.drive
        whole_kg = drive.trolley_mass_kg + drive.load_mass_kg
        free_rad_s = inputs.fastest_swing_rad_s() * (whole_kg / drive.trolley_mass_kg) ** 0.5
        loop_rad_s = (drive.integral_gain_n_m / drive.trolley_mass_kg) ** 0.5
        decay_per_s = drive.gain_n_s_m / drive.trolley_mass_kg
        steps = steps_per_tick(tick_s, max(free_rad_s, loop_rad_s), decay_per_s)
        start = (0.0, 0.0, 0.0, swing_rad, swing_rad_s)
        trolley, speed, behind, swing, rate = integrate(self, start, inputs.ticks, tick_s, steps)
        return DrivenTrajectory(
            time_s=inputs.time_s,
            trolley_m=trolley,
            trolley_m_s=speed,
            rope_length_m=inputs.rope_length_m,
            swing_rad=swing,
            swing_rad_s=rate,
            error_m_s=inputs.reference_m_s - speed,
            behind_m=behind,
            drive=drive,
            damping_ratio=self.damping_ratio,
        )

    def kick(self, xp: ModuleType, tick: CraneTick, state: State) -> State:
        """Step of the hoist speed: an impulse in the rope."""
        trolley_m, speed_m_s, behind_m, swing, rate = state
        load_kg, sine = self.drive.load_mass_kg, xp.sin(swing)
        mass_kg = self.drive.trolley_mass_kg + load_kg * sine * sine
        jump_m_s = -load_kg * tick.hoist_jump_m_s * sine / mass_kg
        return (
            trolley_m,
            speed_m_s + jump_m_s,
            behind_m,
            swing,
            rate - jump_m_s * xp.cos(swing) / tick.rope_length_m,
        )

    def rates(self, xp: ModuleType, tick: CraneTick, time_s: float, state: State) -> State:
        """Rates of trolley position and speed, of the speed error's integral, and of the swing."""
        _, speed_m_s, behind_m, swing, rate = state
        drive, gravity = self.drive, STANDARD_GRAVITY_M_S2
        length_m = tick.rope_length_m + tick.hoist_m_s * time_s
        sine, cosine = xp.sin(swing), xp.cos(swing)
        error_m_s = tick.reference_m_s + tick.slope_m_s2 * time_s - speed_m_s
        force_n = drive.gain_n_s_m * error_m_s + drive.integral_gain_n_m * behind_m
        damping_m_s2 = 2.0 * self.damping_ratio * xp.sqrt(gravity * length_m) * rate
        pull_m_s2 = sine * (gravity * cosine + length_m * rate * rate + tick.wind_m_s2 * sine)
        pull_n = drive.load_mass_kg * (pull_m_s2 + damping_m_s2 * cosine)
        trolley_m_s2 = (force_n + pull_n) / (drive.trolley_mass_kg + drive.load_mass_kg * sine * sine)
        push_m_s2 = gravity * sine + (trolley_m_s2 - tick.wind_m_s2) * cosine
        swing_m_s2 = -2.0 * tick.hoist_m_s * rate - push_m_s2 - damping_m_s2
        return speed_m_s, trolley_m_s2, error_m_s, rate, swing_m_s2 / length_m
