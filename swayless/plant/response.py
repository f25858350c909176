"""How a mode answers a moving suspension: states exact at any time, without time steps.

Not for: large angles, hoisting while travelling or drives that do not follow their reference.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from swayless.errors import PlantError
from swayless.plant.mode import Mode


@dataclass(frozen=True, eq=False)
class VelocityProfile:
    """A velocity of straight pieces that starts from rest: what jumps, and what bends, when.

    Parameters
    ----------
    times_s : ndarray, shape (n,)
        When something changes, in seconds, finite; n >= 1. Kept in rising order; equal times are allowed.
    jumps_m_s : ndarray, shape (n,)
        Change of the velocity at each time, in m/s.
    acceleration_steps_m_s2 : ndarray, shape (n,)
        Change of the acceleration at each time, in m/s2.

    Raises
    ------
    PlantError
        If the arrays are empty, differ in shape or hold a value that is not finite.

    Examples
    --------
    A ramp to 0.5 m/s within 2 s:

    >>> ramp = VelocityProfile(np.array([0.0, 2.0]), np.zeros(2), np.array([0.25, -0.25]))
    >>> ramp.vertices()
    (array([0., 0., 2., 2.]), array([0. , 0. , 0.5, 0.5]))
    """

    times_s: NDArray[np.float64]
    jumps_m_s: NDArray[np.float64]
    acceleration_steps_m_s2: NDArray[np.float64]

    def __post_init__(self) -> None:
        columns = {name: np.array(column, dtype=np.float64) for name, column in vars(self).items()}
        shapes = {name: column.shape for name, column in columns.items()}
        if columns["times_s"].ndim != 1 or columns["times_s"].size == 0 or len(set(shapes.values())) != 1:
            raise PlantError(f"velocity profile {shapes}: the shapes must all be one (n,), n >= 1")
        for name, column in columns.items():
            if not np.isfinite(column).all():
                raise PlantError(f"{name} = {float(column[~np.isfinite(column)][0])!r}: must be finite")
        order = np.argsort(columns["times_s"], kind="stable")
        for name, column in columns.items():
            object.__setattr__(self, name, column[order])
            getattr(self, name).flags.writeable = False

    def vertices(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Corners of the velocity over time: before and after each change, both of shape (2 n,).

        Returns
        -------
        times_s, velocity_m_s : ndarray
            The profile is the straight lines between them; it is 0 before and straight after.
        """
        slopes_m_s2 = np.cumsum(self.acceleration_steps_m_s2)
        climbs_m_s = np.concatenate([[0.0], slopes_m_s2[:-1] * np.diff(self.times_s)])
        after_m_s = np.cumsum(climbs_m_s + self.jumps_m_s)
        velocity_m_s = np.column_stack([after_m_s - self.jumps_m_s, after_m_s])
        return np.repeat(self.times_s, 2), velocity_m_s.ravel()


def swing_state(mode: Mode, velocity: VelocityProfile, time_s: ArrayLike) -> NDArray[np.complex128]:
    """State of a mode at rest until the suspension moves, as one complex number z for each time.

    z' = (-d w + j w sqrt(1 - d^2)) z + v', with w = 2 pi f and d the damping ratio, solved exactly over
    every straight piece of the velocity v. The imaginary part is the swing and the magnitude its
    envelope, both in m/s: one jump of 1 m/s makes an envelope of 1. A pendulum of length L stands at the
    angle -Im(z) / (L w sqrt(1 - d^2)).

    Parameters
    ----------
    mode : Mode
        What swings.
    velocity : VelocityProfile
        How the suspension moves.
    time_s : array_like
        Times to look at, in seconds, in any order.

    Returns
    -------
    ndarray
        z, of the shape of `time_s`; 0 before the first change of the velocity.

    Examples
    --------
    A jump of 1 m/s, and half a period later a second one, leave nothing:

    >>> two = VelocityProfile(np.array([0.0, 1.0]), np.ones(2), np.zeros(2))
    >>> abs(swing_state(Mode(0.5), two, [-1.0, 0.5, 1.5])).round(12)
    array([0., 1., 0.])
    """
    pole_rad_s = mode.angular_frequency_rad_s * complex(
        -mode.damping_ratio, math.sqrt(1.0 - mode.damping_ratio**2)
    )
    times_s = velocity.times_s
    slopes_m_s2 = np.cumsum(velocity.acceleration_steps_m_s2)
    phases = pole_rad_s * np.diff(times_s)
    inputs = velocity.jumps_m_s.astype(np.complex128)
    inputs[1:] += np.expm1(phases) / pole_rad_s * slopes_m_s2[:-1]
    states = _scan(np.exp(np.concatenate([[0.0], phases])), inputs)

    looked_s = np.asarray(time_s, dtype=np.float64)
    piece = np.searchsorted(times_s, looked_s, side="right") - 1
    # What has not begun is looked at when it begins, and then counts as 0: no exponent of a negative time.
    phase = pole_rad_s * np.maximum(looked_s - times_s[piece], 0.0)
    state = np.exp(phase) * states[piece] + np.expm1(phase) / pole_rad_s * slopes_m_s2[piece]
    return np.where(piece >= 0, state, 0.0)


def _scan(factors: NDArray[np.complex128], inputs: NDArray[np.complex128]) -> NDArray[np.complex128]:
    """z_k = factors_k z_(k-1) + inputs_k from z_(-1) = 0, by doubling: log2(n) passes, no growing terms."""
    factors, states = factors.copy(), inputs.copy()
    reach = 1
    while reach < states.size:
        states[reach:] += factors[reach:] * states[:-reach]
        factors[reach:] = factors[reach:] * factors[:-reach]
        reach *= 2
    return states
