"""What a simulated crane is told, tick by tick: trolley reference, rope length and wind.

Not for: how the references are made; a controller's reference, shaped or not, comes in as an array.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from swayless.errors import PlantError
from swayless.plant.pendulum import STANDARD_GRAVITY_M_S2
from swayless.plant.simulation.integration import Value

Hold: TypeAlias = Literal["step", "line"]
"""How a reference passes through a tick: it steps at the beginning and holds, or it runs straight from the
reference of the tick before."""


class CraneTick(NamedTuple):
    """Inputs of one tick; in a simulation of many cases each is an array, one element a case."""

    jump_m_s: Value
    """What the reference jumps by as the tick begins."""
    reference_m_s: Value
    """Just after the jump."""
    slope_m_s2: Value
    """Rise of the reference within the tick."""
    rope_length_m: Value
    """As the tick begins."""
    hoist_m_s: Value
    """Rise of the rope length within the tick."""
    hoist_jump_m_s: Value
    """What the hoist speed jumps by as the tick begins."""
    wind_m_s2: Value
    """Force of the wind per load mass."""


@dataclass(frozen=True, eq=False)
class CraneInputs:
    """The inputs of a simulation, checked, and of one shape.

    Attributes
    ----------
    ticks : CraneTick
        Each input, shape (ticks,) or (cases, ticks).
    tick_s : float
        Duration of a tick.
    time_s : ndarray, shape (ticks + 1,)
        Beginning of each tick, and the end of the last one.
    rope_length_m, reference_m_s, travel_m : ndarray, shape (ticks + 1,) or (cases, ticks + 1)
        At these times; the reference before it jumps, and its integral.
    """

    ticks: CraneTick
    tick_s: float
    time_s: NDArray[np.float64]
    rope_length_m: NDArray[np.float64]
    reference_m_s: NDArray[np.float64]
    travel_m: NDArray[np.float64]

    def fastest_swing_rad_s(self) -> float:
        """Angular frequency sqrt(g / L) of the shortest rope."""
        return float(np.sqrt(STANDARD_GRAVITY_M_S2 / self.rope_length_m.min()))


def crane_inputs(
    reference_m_s: ArrayLike, rope_length_m: ArrayLike, wind_m_s2: ArrayLike, tick_s: float, hold: Hold
) -> CraneInputs:
    """Check the inputs of a simulation, give them one shape, and take them apart into jumps and slopes.

    Parameters
    ----------
    reference_m_s : array_like, shape (ticks,) or (cases, ticks)
        Trolley speed; before the first tick it is 0.
    rope_length_m : array_like, broadcast to (ticks + 1,) or (cases, ticks + 1)
        At the beginning of each tick and at the end of the last one, > 0; straight between. Before the first
        tick the hoist stands.
    wind_m_s2 : array_like, broadcast to (ticks,) or (cases, ticks)
        Force of the wind per load mass, held for a tick.
    tick_s : float
        Duration of a tick, > 0.
    hold : "step" or "line"
        How the reference passes through a tick.

    Raises
    ------
    PlantError
        If a value is not finite, a rope length not positive, or a shape does not fit.
    """
    check_tick(tick_s)
    reference, rope, wind = _of_one_shape(reference_m_s, rope_length_m, wind_m_s2)
    begins_m_s, ends_m_s = reference_ends(reference, hold)
    hoist_m_s = np.diff(rope) / tick_s
    parts = CraneTick(
        jump_m_s=begins_m_s - _before(ends_m_s),
        reference_m_s=begins_m_s,
        slope_m_s2=(ends_m_s - begins_m_s) / tick_s,
        rope_length_m=rope[..., :-1],
        hoist_m_s=hoist_m_s,
        hoist_jump_m_s=hoist_m_s - _before(hoist_m_s),
        wind_m_s2=wind,
    )
    return CraneInputs(
        ticks=parts,
        tick_s=tick_s,
        time_s=tick_s * np.arange(rope.shape[-1], dtype=np.float64),
        rope_length_m=rope,
        reference_m_s=_after_rest(ends_m_s),
        travel_m=_after_rest(np.cumsum(0.5 * tick_s * (begins_m_s + ends_m_s), axis=-1)),
    )


def check_tick(tick_s: float) -> None:
    """Refuse a tick that is not finite and positive."""
    if not (np.isfinite(tick_s) and tick_s > 0.0):
        raise PlantError(f"tick_s = {tick_s!r}: must be finite and > 0")


def finite(name: str, values: ArrayLike) -> NDArray[np.float64]:
    """Make an array of values that must be finite."""
    array = np.asarray(values, dtype=np.float64)
    if not np.isfinite(array).all():
        raise PlantError(f"{name} = {float(array[~np.isfinite(array)][0])!r}: must be finite")
    return array


def reference_ends(
    reference: NDArray[np.float64], hold: Hold
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Give a reference just after each tick begins, and as it ends."""
    if hold == "step":
        return reference, reference
    if hold == "line":
        return _before(reference), reference
    raise PlantError(f"hold = {hold!r}: must be 'step' or 'line'")


def _before(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Give each tick the value of the one before it, and the first one 0."""
    return _after_rest(values)[..., :-1]


def _after_rest(values: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.concatenate([np.zeros_like(values[..., :1]), values], axis=-1)


def _of_one_shape(
    reference_m_s: ArrayLike, rope_length_m: ArrayLike, wind_m_s2: ArrayLike
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Give reference, rope and wind as many cases and ticks each; the rope has one value more a case."""
    reference = finite("reference_m_s", reference_m_s)
    if reference.ndim not in {1, 2} or reference.size == 0:
        raise PlantError(f"reference_m_s of shape {reference.shape}: must be (ticks,) or (cases, ticks)")
    ticks = reference.shape[-1]
    rope = _of_length("rope_length_m", finite("rope_length_m", rope_length_m), ticks + 1)
    if not (rope > 0.0).all():
        raise PlantError(f"rope_length_m = {float(rope.min())!r}: must be > 0 at every tick")
    wind = _of_length("wind_m_s2", finite("wind_m_s2", wind_m_s2), ticks)
    cases = _cases(reference, wind, rope)
    return (
        np.broadcast_to(reference, (*cases, ticks)),
        np.broadcast_to(rope, (*cases, ticks + 1)),
        np.broadcast_to(wind, (*cases, ticks)),
    )


def _of_length(name: str, values: NDArray[np.float64], length: int) -> NDArray[np.float64]:
    if values.ndim > 2 or (values.ndim and values.shape[-1] not in {1, length}):
        raise PlantError(
            f"{name} of shape {values.shape}: must be one number, or end in {length}, beside the reference"
        )
    return values


def _cases(*arrays: NDArray[np.float64]) -> tuple[int, ...]:
    try:
        return np.broadcast_shapes(*(array.shape[:-1] for array in arrays))
    except ValueError:
        shapes = ", ".join(str(array.shape) for array in arrays)
        raise PlantError(f"reference, wind and rope of shapes {shapes}: must have as many cases") from None
