"""One case of a simulated move: who moved, on which rope, and what became of it.

Not for: simulating (`swayless.cli.simulation`), nor for printing.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from swayless.plant.simulation import Trajectory

if TYPE_CHECKING:
    from swayless.machine.move_section import Hoist, MoveSection
    from swayless.plant.simulation.trajectory import FloatArray


@dataclass(frozen=True, eq=False)
class Contender:
    """One way to move.

    Parameters
    ----------
    name : str
        For tables.
    knob : int or None
        Position of the selector; None for a ramp without the block.
    reference_m_s : ndarray, shape (ticks,)
        For the drive; 0 from there on.
    status : int
        Every status bit that the block showed; 0 for a ramp without one.
    for_pendulum : bool
        Whether the row was designed as if the drive did not feel the load, which it does.
    """

    name: str
    knob: int | None
    reference_m_s: FloatArray
    status: int = 0
    for_pendulum: bool = False


@dataclass(frozen=True)
class Site:
    """Where a move is made: a rope that stands, or one that is hoisted.

    Of an arm with positions these take the place of ropes, of another arm the pendulums that are as fast.
    """

    hoist: Hoist | None
    length_m: float


@dataclass(frozen=True, eq=False)
class Case:
    """What became of one contender on one rope.

    Parameters
    ----------
    site : Site
        The rope.
    contender : Contender
        What moved.
    run : Trajectory
        What the plant did, until a while after everything stands.
    left : Trajectory
        The same, until reference and hoist stand.
    pressed_s : float
        When the button was pressed.
    speed_m_s : float
        The command.
    """

    site: Site
    contender: Contender
    run: Trajectory
    left: Trajectory
    pressed_s: float
    speed_m_s: float

    @property
    def residual_m(self) -> float:
        """Amplitude of the sway when reference and hoist stand: what damping takes from then on left out."""
        return float(self.left.amplitude_m[-1])

    @property
    def residual_ratio(self) -> float:
        """The same, against the sway of an unshaped step to the speed, v / sqrt(g L)."""
        return float(self.left.residual_ratio(self.speed_m_s))

    @property
    def peak_sway_m(self) -> float:
        """Largest sway at any tick; below `residual_m` if that decays before the load turns."""
        return float(self.run.peak_sway_m)

    @property
    def travel_m(self) -> float:
        """Way of the trolley."""
        return float(self.run.trolley_m[-1])

    @property
    def stands_s(self) -> float:
        """Time from the press to the end of the reference."""
        reference_s = self.contender.reference_m_s.size * float(self.run.time_s[1])
        return reference_s - self.pressed_s

    def rests_s(self, within_m: float) -> float | None:
        """Time from the press until the load stays so near to its end; None if it does not."""
        if self.run.amplitude_m[-1] > within_m:
            return None
        away = np.flatnonzero(abs(self.run.load_m - self.run.trolley_m[-1]) > within_m)
        rests = int(away[-1]) + 1 if away.size else 0
        return max(0.0, float(self.run.time_s[rests]) - self.pressed_s)


@dataclass(frozen=True, eq=False)
class Simulation:
    """A move, and what became of it: cases rope by rope.

    Parameters
    ----------
    move : MoveSection
        As asked for.
    speed_m_s : float
        Its command.
    pressed_s, held_s : float
        When the button was pressed, and for how long.
    cases : tuple of Case
        Rope by rope, in each the contenders.
    remarks : tuple of str
        Where the move leaves what the machine file allows, and what the block said of it.
    """

    move: MoveSection
    speed_m_s: float
    pressed_s: float
    held_s: float
    cases: tuple[Case, ...]
    remarks: tuple[str, ...] = ()

    def sites(self) -> Iterator[tuple[Site, list[Case]]]:
        """Give each rope with its cases."""
        for site in dict.fromkeys(case.site for case in self.cases):
            yield site, [case for case in self.cases if case.site == site]
