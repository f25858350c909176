"""A plant, and the chains that robustness adds, from tick to tick; of a move by 1 from rest at 0.

Not for: its sampled form in the search for a command; that one has states more than once, for its proofs.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from swayless.design.optimal import LinearPlant, Robustness
from swayless.design.optimal.command import Hold
from swayless.design.optimal.linear_plant import ComplexArray, mode_vectors
from swayless.design.optimal.robustification import jordan_chain, rest_conditions
from swayless.design.optimal.sampling import Sampled, sampled
from swayless.design.shaper import FloatArray

_AT_0 = 1e-6  # of the fastest pole: what a double pole at 0 is moved by rounding, and more


@dataclass(frozen=True, eq=False)
class ShapeModel:
    """States from tick to tick, z(k+1) = A z(k) + B s(k), and the position C z + D s.

    Under a first-order hold z is the state less what the last input has made of it, so that the form stays.

    Parameters
    ----------
    system : Sampled
        A and B.
    output : ndarray, shape (states,)
        C.
    feedthrough : float
        D.
    kept : ndarray, shape (r, states)
        Which combinations of states must rest.
    at_rest : ndarray, shape (states,)
        States at rest at position 1.
    hold_ratio : float
        Input that holds the plant at position 1.
    swings : ndarray of complex, shape (modes, states)
        Amplitude of the position, by each mode that need not rest: the plant's own, where poles are split.
    """

    system: Sampled
    output: FloatArray
    feedthrough: float
    kept: FloatArray
    at_rest: FloatArray
    hold_ratio: float
    swings: ComplexArray

    @property
    def order(self) -> int:
        """Number of states."""
        return self.output.size

    @cached_property
    def final(self) -> FloatArray:
        """Kept combinations at rest at position 1, shape (r,)."""
        return np.asarray(self.kept @ self.at_rest)

    def sizes(self, shape: FloatArray) -> FloatArray:
        """Give the largest value of each kept combination of states during a move, shape (r,)."""
        return np.asarray(np.abs(self.states(shape) @ self.kept.T).max(axis=0))

    @cached_property
    def change(self) -> FloatArray:
        """A less the identity."""
        return np.asarray(self.system.a - np.eye(self.order))

    def states(self, shape: FloatArray) -> FloatArray:
        """Give the states before ticks 0 .. n of an input from rest, shape (n + 1, states)."""
        states = np.zeros((shape.size + 1, self.order))
        for tick, value in enumerate(shape):
            states[tick + 1] = states[tick] + (self.change @ states[tick] + self.system.b * value)
        return states

    def in_units_of(self, sizes: FloatArray) -> ShapeModel:
        """Give the same model with states in other units, shape (states,)."""
        system = Sampled(self.system.a * sizes / sizes[:, np.newaxis], self.system.b / sizes)
        return ShapeModel(
            system,
            self.output * sizes,
            self.feedthrough,
            self.kept * sizes,
            self.at_rest / sizes,
            self.hold_ratio,
            self.swings * sizes,
        )


def shape_model(
    plant: LinearPlant, tick_s: float, hold: Hold = "zero-order", robustness: Robustness | None = None
) -> ShapeModel:
    """Make the model of a plant, of its ringing poles repeated or split as the command was designed for.

    Parameters
    ----------
    plant : LinearPlant
        Stable but for poles at 0 and on the imaginary axis, and controllable.
    tick_s : float
        > 0.
    hold : {"zero-order", "first-order"}
        What the drive does between ticks. First-order: it goes straight from the value before to this one.
    robustness : Robustness
        Of the command; a stop is as robust.

    Raises
    ------
    DesignError
        If the plant cannot be brought to rest, or has nothing that robustness could be against.

    References
    ----------
    Xu and Meckl (2005), eqs 21-24 and 36: the augmented plant. Franklin, Powell and Workman (1998), "Digital
    control of dynamic systems", section 4.3.3: the first-order hold.

    Examples
    --------
    A mass of 1 kg, with a force that rises and falls in straight lines:

    >>> mass = LinearPlant([[0.0, 1.0], [0.0, 0.0]], [0.0, 1.0], [1.0, 0.0])
    >>> model = shape_model(mass, 1.0, "first-order")
    >>> model.states(np.array([1.0, -1.0, 0.0]))[-1].tolist(), model.final.tolist()
    ([1.0, 0.0], [1.0, 0.0])
    """
    robustness = robustness or Robustness()
    plant.check()
    rest_conditions(plant, tick_s, 1.0, robustness)  # refuses what robustness, or this tick, cannot do
    plant = plant.balanced
    at_rest, held = plant.equilibrium(1.0)
    speeds = np.abs(plant.poles_rad_s)
    held = 0.0 if speeds.min() <= _AT_0 * speeds.max() else held  # what is left there is rounding
    a, b, at_rest = _with_chains(plant, robustness, at_rest, held)
    kept, swings = np.eye(b.size), np.zeros((0, b.size), dtype=np.complex128)
    if robustness.split_ratio is not None:
        kept, swings = _all_but_the_modes(plant, b.size), _swings(plant, b.size)
    output = np.append(plant.c, np.zeros(b.size - plant.order))
    system = sampled(a, b, tick_s)
    if hold == "zero-order":
        return ShapeModel(system, output, plant.d, kept, at_rest, held, swings)
    last = _made_by_a_slope(a, b, tick_s)
    return ShapeModel(
        Sampled(system.a, system.a @ last + system.b - last),
        output,
        plant.d + float(output @ last),
        kept,
        at_rest - held * last,
        held,
        swings,
    )


def _with_chains(
    plant: LinearPlant, robustness: Robustness, at_rest: FloatArray, held: float
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Give A, B and the state at rest of the plant with a chain for each repetition or split of a pole."""
    a, b = plant.a, plant.b
    for chain, into, from_plant in _chains(plant, robustness):
        driven = np.zeros((into.size, b.size))
        driven[:, : plant.order] = from_plant
        at_rest = np.append(at_rest, -np.linalg.solve(chain, driven @ at_rest + into * held))
        a = np.block([[a, np.zeros((b.size, into.size))], [driven, chain]])
        b = np.append(b, into)
    return a, b, at_rest


def _chains(
    plant: LinearPlant, robustness: Robustness
) -> Iterator[tuple[FloatArray, FloatArray, FloatArray]]:
    """Give the matrix of each chain, what the input adds to it, and what the plant's state adds.

    A repeated pole needs one link less than the command's design has: the last one is the plant's own mode.
    """
    order, split = robustness.order, robustness.split_ratio
    for pole in plant.ringing_poles_rad_s:
        for factor in () if split is None else (1.0 - split, 1.0 + split):
            chain, into = jordan_chain(complex(pole) * factor, 1)
            yield chain, into, np.zeros((2, plant.order))
        if order:
            chain, into = jordan_chain(complex(pole), order)
            link = _last_link(plant, complex(pole))
            yield chain, 0.0 * into, np.vstack([np.zeros((2 * order - 2, plant.order)), abs(pole) * link])


def _last_link(plant: LinearPlant, pole: complex) -> FloatArray:
    """Give rows, shape (2, n), whose products with the plant's state are q of q' = p q + |p| u."""
    poles, vectors = np.linalg.eig(plant.a.T)
    left: ComplexArray = vectors[:, np.abs(poles - pole).argmin()].astype(np.complex128)
    left = left * (abs(pole) / (left @ plant.b))
    return np.array([left.real, left.imag])


def _all_but_the_modes(plant: LinearPlant, states: int) -> FloatArray:
    """Give rows whose products are all states but those of the ringing poles, which split ones stand for."""
    from scipy.linalg import block_diag, null_space

    poles, vectors = np.linalg.eig(plant.a)
    ringing = [vectors[:, np.abs(poles - pole).argmin()] for pole in plant.ringing_poles_rad_s]
    rows = null_space(np.array([part for vector in ringing for part in (vector.real, vector.imag)])).T
    return np.asarray(block_diag(rows, np.eye(states - plant.order)))


def _swings(plant: LinearPlant, states: int) -> ComplexArray:
    """Give rows whose products with the states are amplitudes of the position, one for each ringing mode."""
    rows = np.zeros((plant.ringing_poles_rad_s.size, states), dtype=np.complex128)
    for row, pole in zip(rows, plant.ringing_poles_rad_s, strict=True):
        after, before = mode_vectors(plant, complex(pole))
        row[: plant.order] = 2.0 * (plant.c @ after) * before  # of the pole and its conjugate
    return rows


def _made_by_a_slope(a: FloatArray, b: FloatArray, tick_s: float) -> FloatArray:
    """Give the state after a tick in which the input went from 0 to 1, by one more state: the input."""
    order = b.size
    with_input = np.block([[a, b[:, np.newaxis]], [np.zeros((1, order + 1))]])
    return sampled(with_input, np.append(np.zeros(order), 1.0 / tick_s), tick_s).b[:order]
