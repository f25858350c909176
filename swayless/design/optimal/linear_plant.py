"""A linear plant with one input and one output, in state space. Not for: ticks (`sampling`), or commands."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from swayless.design.shaper import FloatArray
from swayless.errors import DesignError

ComplexArray = NDArray[np.complex128]

LARGEST_ORDER = 20
"""Most states of a plant: beyond it, poles from coefficients in double are noise."""

_ON_AXIS = 1e-6  # of the fastest pole: what a double pole at 0 is moved by rounding, and more
_FASTEST_RAD_S = 1e12  # of coefficients: beyond it their powers leave the range of double
_LARGEST = 1e100  # canonical forms of 20 states and 1e5 rad/s
_APART = 1e-4  # of their size: nearer ringing poles cannot be told apart
_ROUNDED = 1e-12  # of the fastest pole: more than a single pole is off by rounding
_RINGS = 0.1  # sine of a pole's angle above which it rings: below a damping ratio of 0.995
_LOST = 1e-9  # of the largest singular value: below it a direction is not there
_BLOCKED = 1e-12  # of the outputs of a state of size 1: below it an output at rest is rounding


@dataclass(frozen=True, eq=False)
class LinearPlant:
    """A plant x' = A x + B u, y = C x + D u.

    Parameters
    ----------
    a : ndarray, shape (n, n)
        In 1/s; 1 <= n <= 20.
    b, c : ndarray, shape (n,)
        Input and output of the states.
    d : float
        What the input adds to the output at once.

    Raises
    ------
    DesignError
        If shapes do not fit or a value is not finite.

    Examples
    --------
    A frictionless mass of 2 kg, a force in and its position out:

    >>> LinearPlant([[0.0, 1.0], [0.0, 0.0]], [0.0, 0.5], [1.0, 0.0]).equilibrium(3.0)
    (array([3., 0.]), 0.0)
    """

    a: FloatArray
    b: FloatArray
    c: FloatArray
    d: float = 0.0

    def __post_init__(self) -> None:
        for name in ("a", "b", "c"):
            object.__setattr__(self, name, _finite(name, getattr(self, name)))
        order = self.b.size
        if not 1 <= order <= LARGEST_ORDER:
            raise DesignError(f"plant of {order} states: must have 1 to {LARGEST_ORDER}")
        shapes = {"a": self.a.shape, "b": self.b.shape, "c": self.c.shape}
        if list(shapes.values()) != [(order, order), (order,), (order,)]:
            raise DesignError(f"plant of shapes {shapes}: must be a (n, n), b (n,) and c (n,)")
        object.__setattr__(self, "d", float(_finite("d", self.d)))

    @classmethod
    def from_transfer_function(cls, numerator: Sequence[float], denominator: Sequence[float]) -> LinearPlant:
        """Make the plant of a transfer function; coefficients fall in powers of s.

        Parameters
        ----------
        numerator, denominator : sequence of float
            Finite; the numerator has no higher power than the denominator, which has one of s at least.

        Raises
        ------
        DesignError
            If they are no transfer function of a plant with memory, or have a root in common: they do not say
            whether the input moves it, and the output does not show it.

        Examples
        --------
        >>> plant = LinearPlant.from_transfer_function([1.0], [0.01, 0.0, 1.0])
        >>> abs(plant.poles_rad_s)
        array([10., 10.])
        """
        top, bottom = (
            np.trim_zeros(np.atleast_1d(_finite(name, value)), "f")
            for name, value in (("numerator", numerator), ("denominator", denominator))
        )
        if bottom.size < 2 or top.size == 0 or top.size > bottom.size:
            raise DesignError(
                f"transfer function {list(numerator)!r} / {list(denominator)!r}: must have a numerator"
                " that is not 0 and of no higher power of s than the denominator, and that one s at least"
            )
        _check_speed(bottom)
        # In units of the poles' own speed, so that coefficients, and states, are of order 1; a power of two,
        # so that nothing is rounded.
        speed_rad_s = _speed_rad_s(np.roots(bottom))
        powers = speed_rad_s ** np.arange(bottom.size - 1, -1, -1, dtype=np.float64)
        monic = bottom * powers / (bottom[0] * powers[0])
        padded = np.concatenate([np.zeros(bottom.size - top.size), top]) * powers / (bottom[0] * powers[0])
        order = monic.size - 1
        a = np.eye(order, k=-1)
        a[0] = -monic[1:]
        b, c = np.eye(order)[0], padded[1:] - padded[0] * monic[1:]
        plant = cls(a * speed_rad_s, b * speed_rad_s, c, padded[0])
        shared = plant.poles_rad_s[uncontrolled(plant.balanced.a.T, plant.balanced.c, plant.poles_rad_s)]
        if shared.size:
            raise DesignError(
                "transfer function: numerator and denominator both have the root"
                f" {shown(shared[0])} rad/s: it is not controllable or not observable; cancel it, or give the"
                " plant as a state space"
            )
        return plant

    @property
    def order(self) -> int:
        """Number of states."""
        return self.b.size

    @cached_property
    def state_units(self) -> FloatArray:
        """Units, powers of two, in which all states are of about one size, shape (n,).

        References
        ----------
        Parlett and Reinsch (1969), "Balancing a matrix for calculation of eigenvalues and eigenvectors"; here
        of the loop from input to output, so that states that feed no other are in it. The loop is closed with
        the gain at which it is as fast as the poles are, so that units do not hang on those of the input.
        """
        from scipy.linalg.lapack import dgebal  # here, because it is heavy and only a design needs it

        speed_rad_s = _speed_rad_s(np.linalg.eigvals(self.a))
        answer = np.linalg.lstsq(speed_rad_s * np.eye(self.order) - self.a, self.b)[0]  # a pole may be there
        seen = abs(float(self.c @ answer))
        gain = speed_rad_s / (seen if seen > 1.0 / _LARGEST else 1.0)
        loop = np.block([[self.a, gain * self.b[:, np.newaxis]], [self.c, np.zeros(1)]])
        units = dgebal(loop, scale=1)[3]
        return np.asarray(units[:-1] / units[-1], dtype=np.float64)

    @cached_property
    def balanced(self) -> LinearPlant:
        """The same plant with its states in `state_units`: nothing is rounded, and less is lost later.

        Examples
        --------
        An oscillator of 1000 rad/s, whose speed is a thousand times its position:

        >>> plant = LinearPlant([[0.0, 1.0], [-1e6, 0.0]], [0.0, 1e6], [1.0, 0.0])
        >>> plant.balanced.a.round().tolist()
        [[0.0, 1024.0], [-977.0, 0.0]]
        """
        units = self.state_units
        return LinearPlant(self.a * units / units[:, np.newaxis], self.b / units, self.c * units, self.d)

    @property
    def poles_rad_s(self) -> ComplexArray:
        """All poles, shape (n,), the eigenvalues of A."""
        return np.asarray(np.linalg.eigvals(self.balanced.a), dtype=np.complex128)

    @property
    def ringing_poles_rad_s(self) -> ComplexArray:
        """Poles above the real axis that ring: not at 0, and with a damping ratio up to 0.995."""
        poles = self.poles_rad_s
        rings = (poles.imag > _RINGS * np.abs(poles)) & (np.abs(poles) > _ON_AXIS * np.abs(poles).max())
        return np.sort_complex(poles[rings])

    @property
    def can_be_off(self) -> bool:
        """Whether there are modes whose frequencies can be off, each on its own."""
        return self.ringing_poles_rad_s.size > 0 and self.merged_pole_rad_s is None

    @property
    def merged_pole_rad_s(self) -> complex | None:
        """A ringing pole that cannot be told apart from another one; None where there is none."""
        poles = self.ringing_poles_rad_s
        apart = np.abs(poles[:, np.newaxis] - poles) + np.diag(np.full(poles.size, np.inf))
        if poles.size < 2 or apart.min() >= _APART * np.abs(poles).max():
            return None
        return complex(poles[apart.argmin() // poles.size])

    @property
    def zeros_rad_s(self) -> ComplexArray:
        """All finite zeros: where [[A - s I, B], [C, D]] loses rank."""
        from scipy.linalg import eig

        plant = self.balanced
        pencil = np.block([[plant.a, plant.b[:, np.newaxis]], [plant.c, np.array([plant.d])]])
        top, bottom = eig(pencil, np.diag([*np.ones(self.order), 0.0]), right=False, homogeneous_eigvals=True)
        fastest = max(1e-300, float(np.abs(self.poles_rad_s).max()))
        finite = np.abs(bottom) * fastest > _LOST * np.abs(top)
        return np.asarray(top[finite] / bottom[finite], dtype=np.complex128)

    def equilibrium(self, output: float) -> tuple[FloatArray, float]:
        """Give state and input in which the plant rests with an output.

        Raises
        ------
        DesignError
            If it cannot rest there: a zero at 0, or states that the input does not hold.
        """
        plant = self.balanced
        moving, driven = (float(np.linalg.norm(part)) or 1.0 for part in (plant.a, plant.b))
        held = np.column_stack([plant.a / moving, plant.b / driven])
        seen = np.append(plant.c / moving, plant.d / driven)
        _, sizes, directions = np.linalg.svd(held)
        if sizes[-1] <= _LOST * sizes[0]:
            raise DesignError("plant: a pole at 0 is not moved by the input: it is not controllable")
        if abs(seen @ directions[-1]) <= _BLOCKED * float(np.linalg.norm(seen)):
            raise DesignError("plant: a zero at 0: no input holds its output anywhere but at 0")
        rest = np.linalg.solve(np.vstack([held, seen]), output * np.eye(self.order + 1)[-1]) + 0.0
        with np.errstate(over="ignore"):  # infinite: out of reach of any limit
            return self.state_units * rest[:-1] / moving, float(rest[-1]) / driven

    def check(self) -> None:
        """Refuse a plant that no command computed ahead can bring to rest.

        Raises
        ------
        DesignError
            If a pole is unstable, or the input does not move it.
        """
        poles = self.poles_rad_s
        unstable = poles[poles.real > _off_axis(np.abs(poles))]
        if unstable.size:
            raise DesignError(
                f"plant: unstable, pole at {shown(unstable[0])} rad/s: a command computed ahead cannot hold"
                " it; close a loop first and give the plant with its loop"
            )
        lost = poles[uncontrolled(self.balanced.a, self.balanced.b, poles)]
        if lost.size:
            raise DesignError(
                f"plant: not controllable, the input does not move the pole at {shown(lost[0])} rad/s"
            )


def _off_axis(speeds: FloatArray) -> FloatArray:
    """Give how far right of the imaginary axis poles of these sizes may be by rounding.

    Two and more at 0 are moved by its root, of the fastest pole; any other one by a part of its own size.
    """
    fastest = float(speeds.max())
    at_0 = speeds <= _ON_AXIS * fastest
    moved = np.where(at_0 & (at_0.sum() > 1), fastest, speeds)
    return np.asarray(np.maximum(_ON_AXIS * moved, _ROUNDED * fastest))


def mode_vectors(plant: LinearPlant, pole: complex) -> tuple[ComplexArray, ComplexArray]:
    """Give the right and the left eigenvector of one pole, w v = 1.

    Each from its own side: beside a double integrator the vectors of all poles are no basis.
    """
    after, before = (
        vectors[:, np.abs(poles - pole).argmin()]
        for poles, vectors in (np.linalg.eig(plant.a), np.linalg.eig(plant.a.T))
    )
    return after, before / (before @ after)


def check_apart(plant: LinearPlant) -> None:
    """Refuse a plant two of whose ringing poles cannot be told apart, where each is looked at on its own.

    Raises
    ------
    DesignError
        Naming the pole.
    """
    merged = plant.merged_pole_rad_s
    if merged is not None:
        raise DesignError(f"plant: two ringing poles near {shown(merged)} rad/s cannot be told apart")


def uncontrolled(a: FloatArray, b: FloatArray, poles: ComplexArray) -> NDArray[np.bool_]:
    """Which poles the input does not move: where [A - p I, B] loses rank (Popov, Belevitch, Hautus)."""
    pencils = a - poles[:, np.newaxis, np.newaxis] * np.eye(b.size)
    unit = b[:, np.newaxis] / max(float(np.linalg.norm(b)), 1e-300)
    inputs = np.broadcast_to(unit, (poles.size, b.size, 1))
    scale = max(float(np.linalg.norm(a, 2)), 1e-300)
    sizes = np.linalg.svd(np.concatenate([pencils / scale, inputs], axis=2), compute_uv=False)
    return np.asarray(sizes[:, -1] <= _LOST)


def _speed_rad_s(poles: ArrayLike) -> float:
    """Give a power of two near the mean speed, geometrically, of the poles that move; 1 if none does."""
    speeds = np.abs(poles)
    moving = speeds[speeds > _ON_AXIS * speeds.max()]
    return float(2.0 ** np.round(np.log2(moving).mean())) if moving.size else 1.0


def _check_speed(denominator: FloatArray) -> None:
    """Refuse coefficients whose roots are faster than numbers reach."""
    powers = np.arange(1, denominator.size)
    with np.errstate(over="ignore"):
        speeds = np.abs(denominator[1:] / denominator[0]) ** (1.0 / powers)
    if not speeds.max() <= _FASTEST_RAD_S:
        raise DesignError(
            f"denominator {denominator.tolist()!r}: its roots must be up to {_FASTEST_RAD_S:g} rad/s: choose"
            " another unit of time"
        )


def shown(pole: complex) -> str:
    """Print a pole.

    Examples
    --------
    >>> shown(2.0 + 0.0j), shown(-0.1 + 3.0j), shown(-1e-15 + 3.0j)
    ('2', '-0.1+3j', '3j')
    """
    if abs(pole.real) <= _LOST * abs(pole) and pole.imag != 0.0:
        return f"{pole.imag:.6g}j"
    return f"{pole.real:.6g}" if pole.imag == 0.0 else f"{pole.real:.6g}{pole.imag:+.6g}j"


def _finite(name: str, value: ArrayLike) -> FloatArray:
    """Give an array that nobody can change, of numbers that can be multiplied."""
    array = np.array(value, dtype=np.float64)
    if not (np.abs(array) <= _LARGEST).all():
        raise DesignError(f"plant: {name} = {array.tolist()!r}: must be finite, up to {_LARGEST:g}")
    array.flags.writeable = False
    return array
