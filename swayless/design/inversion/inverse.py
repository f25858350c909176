"""The command that makes the load of a linear plant move as a polynomial: input-output inversion.

Not for: limits of the actuator, which a longer motion keeps, and plants that have to be moved in advance.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from swayless.design.inversion.motion import LARGEST_ORDER, PolynomialMotion
from swayless.design.inversion.response import ComplexArray, MotionResponse, motion_response
from swayless.design.optimal.command import Command
from swayless.design.optimal.linear_plant import LinearPlant, shown
from swayless.design.optimal.sampling import output_at_ticks, sampled
from swayless.design.optimal.task import LARGEST_TICKS
from swayless.design.shaper import FloatArray
from swayless.errors import DesignError

FEWEST_TICKS = 10
"""Shortest motion: below, what is held for a tick is no polynomial."""

DEFAULT_TRUNCATION = 1e-9
"""Of the command's largest change: what is left of its exponentials where it ends."""

_DECAYS = 1e-9  # of a zero's size: the least damping that is one
_SPREAD = 1e7  # between the fastest and the slowest rate: beyond it less than ten digits are left
_ROUNDS = 3


@dataclass(frozen=True, eq=False)
class InvertedCommand:
    """A command, the motion that it makes, and how far the two are from each other.

    Parameters
    ----------
    plant : LinearPlant
        From command to load.
    motion : PolynomialMotion
        What the load shall do.
    command : Command
        Zero-order: the mean of the closed form over each tick, changed so that the plant rests at the end.
    exact : ndarray, shape (n + 1,)
        The closed form itself at ticks 0 .. n, before it is held and cut.
    truncation_bound : float
        Most by which the closed form ever differs from the final value after the command's end.
    correction : float
        Largest change by which the held and cut command was made to end at rest.
    deviation : float
        Most by which the plant's output, under the command as it is held, is off the motion at a tick.
    final_error_ratio : float
        How far the plant's state misses rest at the end, of its largest one there.
    """

    plant: LinearPlant
    motion: PolynomialMotion
    command: Command
    exact: FloatArray
    truncation_bound: float
    correction: float
    deviation: float
    final_error_ratio: float

    @property
    def post_action_s(self) -> float:
        """How long the command goes on after the load has arrived."""
        return self.command.duration_s - self.motion.duration_s


def invert(
    numerator: FloatArray,
    denominator: FloatArray,
    motion: PolynomialMotion,
    tick_s: float,
    *,
    truncation_ratio: float = DEFAULT_TRUNCATION,
) -> InvertedCommand:
    """Find the command under which the output of a plant is a polynomial motion.

    Parameters
    ----------
    numerator, denominator : ndarray
        Transfer function of the plant, falling powers of s.
    motion : PolynomialMotion
        A whole number of ticks, ten at least.
    tick_s : float
        Tick of the controller, > 0.
    truncation_ratio : float
        Where the command ends: what is left of its exponentials, of its largest change; above 0, below 1.

    Raises
    ------
    DesignError
        If the plant is unstable or not controllable, or has a zero on the imaginary axis or right of it; if
        the motion is too short or not smooth enough, or the command would be too long: with the cause.

    References
    ----------
    Visioli and Piazzi (2008), section 2; Piazzi and Visioli (2001), "Point-to-point motion planning for
    servosystems with elastic transmission via optimal dynamic inversion".

    Examples
    --------
    >>> plant = np.array([0.2, 1.0]), np.array([0.01, 0.02, 1.0])
    >>> found = invert(*plant, PolynomialMotion(1.0, 2.0), 0.01)
    >>> round(found.post_action_s, 2), round(found.command.final_value, 12), found.final_error_ratio < 1e-12
    (3.77, 2.0, True)
    """
    if not 0.0 < truncation_ratio < 1.0:
        raise DesignError(f"truncation_ratio = {truncation_ratio!r}: must be above 0 and below 1")
    plant = LinearPlant.from_transfer_function(numerator.tolist(), denominator.tolist())
    plant.check()
    moving = whole_ticks(motion.duration_s, tick_s)
    top = np.trim_zeros(numerator, "f")
    _check_smoothness(motion, plant.order + 1 - top.size)
    _check_zeros(np.roots(top).astype(np.complex128), motion.duration_s)
    # From the coefficients: of a plant with gain 1 it is the position itself, to the last digit.
    initial, final = (each * denominator[-1] / numerator[-1] for each in (motion.start, motion.target))
    response = motion_response(denominator, numerator, motion)
    change = float(np.abs(response.on_grid(0.0, tick_s, moving + 1)).max())
    after, bound = _post_action(response, tick_s, LARGEST_TICKS - moving, truncation_ratio * change)
    ticks = moving + after
    held = response.averages(tick_s, ticks)
    corrected = _at_rest(plant, held, motion.travel, tick_s)
    command = Command(tick_s, initial + corrected, float(final), initial_value=float(initial))
    output = output_at_ticks(plant, command, start=motion.start)
    return InvertedCommand(
        plant,
        motion,
        command,
        initial + response.on_grid(0.0, tick_s, ticks + 1),
        bound,
        float(np.abs(corrected - held).max()),
        float(np.abs(output - motion.at(tick_s * np.arange(ticks + 1))).max()),
        _missed(plant, corrected, motion.travel, tick_s),
    )


def whole_ticks(duration_s: float, tick_s: float) -> int:
    """Give the ticks of a motion.

    Raises
    ------
    DesignError
        If they are too few or too many, or no whole number.
    """
    ticks = round(duration_s / tick_s)
    if not FEWEST_TICKS <= ticks <= LARGEST_TICKS:
        raise DesignError(
            f"duration = {duration_s:g} s, {duration_s / tick_s:.6g} ticks of {tick_s:g} s: must be"
            f" {FEWEST_TICKS} to {LARGEST_TICKS} ticks"
        )
    if abs(ticks * tick_s - duration_s) > 1e-9 * duration_s:
        raise DesignError(
            f"duration = {duration_s:g} s: must be a whole number of ticks of {tick_s:g} s; nearest:"
            f" {ticks * tick_s:.9g} s"
        )
    return ticks


def _check_smoothness(motion: PolynomialMotion, degree: int) -> None:
    """Refuse a motion whose command would jump."""
    if motion.smoothness >= degree:
        return
    needed = 2 * degree + 1
    way = f"needs order {needed}" if needed <= LARGEST_ORDER else f"is more than order {LARGEST_ORDER} can do"
    raise DesignError(
        f"order = {motion.order}: is continuous to derivative {motion.smoothness}, and a plant of relative"
        f" degree {degree} {way}"
    )


def _check_zeros(zeros: ComplexArray, duration_s: float) -> None:
    """Refuse zeros for which there is no command that begins with the motion and comes to an end."""
    wrong = zeros[zeros.real >= -_DECAYS * np.abs(zeros)]
    if wrong.size:
        side = "right of" if wrong[0].real > _DECAYS * abs(wrong[0]) else "on"
        raise DesignError(
            f"plant: zero at {shown(complex(wrong[0]))} rad/s, {side} the imaginary axis: the command that"
            " makes this motion grows or swings for ever, unless it begins before the motion does; use"
            " 'swayless profile optimal' for this plant"
        )
    rates = np.append(np.abs(zeros), 1.0 / duration_s)
    if rates.max() > _SPREAD * rates.min():
        raise DesignError(
            f"plant: zeros and 1 / duration from {rates.min():.3g} to {rates.max():.3g} rad/s: more than"
            f" {_SPREAD:g} apart, which a double does not resolve; leave the fastest zero out"
        )


def _post_action(response: MotionResponse, tick_s: float, most: int, allowed: float) -> tuple[int, float]:
    """Give after how many ticks all that follows is within `allowed`, and the bound that proves it.

    With A^H P + P A = -1, v^H P v falls along v' = A v, so that |c v| stays within |c|_(P^-1) |v|_P.
    """
    from scipy.linalg import solve_continuous_lyapunov  # here, because it is heavy

    order = response.order
    if not order:
        return 0, 0.0
    own, last = response.generator[:order, :order], np.eye(order)[-1]
    weight = solve_continuous_lyapunov(own.conj().T, -np.eye(order))
    reach = float(np.sqrt((last @ np.linalg.solve(weight, last)).real))
    lags = response.lags(tick_s, most + 1)
    bounds = reach * np.sqrt(np.einsum("ik,ij,jk->k", lags.conj(), weight, lags).real)
    within = np.flatnonzero(bounds <= allowed)
    if not within.size:
        slowest = float(-own.diagonal().real.max()) / response.motion.duration_s
        raise DesignError(
            f"duration = {response.motion.duration_s:g} s: with its post-action the command has more than"
            f" {LARGEST_TICKS} ticks of {tick_s:g} s, as a zero at {-slowest:.4g} rad/s dies out slowly: take"
            " a longer tick or a larger truncation"
        )
    return int(within[0]), float(bounds[within[0]])


def _at_rest(plant: LinearPlant, inputs: FloatArray, travel: float, tick_s: float) -> FloatArray:
    """Change inputs as little as makes the plant rest after them: least squares, refined."""
    reach = sampled(plant.a, plant.b, tick_s).reach(inputs.size)
    across, triangle = np.linalg.qr(reach.T)
    state = plant.equilibrium(travel)[0]
    for _ in range(_ROUNDS):
        inputs = inputs + across @ np.linalg.solve(triangle.T, state - reach @ inputs)
    return inputs


def _missed(plant: LinearPlant, inputs: FloatArray, travel: float, tick_s: float) -> float:
    """Give how far the state misses rest, of the largest one."""
    state = plant.equilibrium(travel)[0]
    reach = sampled(plant.a, plant.b, tick_s).reach(inputs.size)
    return float(np.abs(reach @ inputs - state).max() / np.abs(state).max())
