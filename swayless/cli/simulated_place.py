"""Where a simulated machine stands, as a plant takes it and as a table has it: ropes, positions, frequencies.

Not for: choosing places (`swayless.cli.simulation`).
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from swayless.plant import pendulum_frequency_hz, pendulum_rope_length_m

if TYPE_CHECKING:
    from swayless.cli.simulated_case import Site
    from swayless.machine import DesignFile
    from swayless.machine.design_document import PlantRecord
    from swayless.plant.simulation.trajectory import FloatArray

_WITHIN_M = 0.05
_SETTLED = 0.02


def pendulums_m(plant: PlantRecord, places: FloatArray) -> FloatArray:
    """Give the ropes at places, or for an arm with positions the pendulums that are as fast.

    Parameters
    ----------
    plant : PlantRecord
        From the design file.
    places : ndarray
        Ropes in m, or positions in their unit.

    Returns
    -------
    ndarray, of the shape of `places`
        In m.
    """
    if plant.position is None:
        return places
    frequency_hz = np.interp(places, plant.position.places, plant.position.frequency_hz)
    return np.asarray(pendulum_rope_length_m(1.0) / frequency_hz**2)


def usual_within_m(design: DesignFile) -> float:
    """How near to its end a load rests unless the user says so.

    Below a crane 50 mm, which is what tenders ask for; of an arm 2 % of v / w, its sway after an unshaped
    step to full speed where it is slowest, as settling times are measured.

    Parameters
    ----------
    design : DesignFile
        Of the machine.
    """
    if not is_arm(design.plant):
        return _WITHIN_M
    return _SETTLED * design.drive.max_speed_m_s / (2.0 * math.pi * design.plant.frequency_hz[0])


def is_arm(plant: PlantRecord) -> bool:
    """Whether a plant has no ropes."""
    return plant.kind not in {"crane", "double_pendulum"}


def shown(plant: PlantRecord, place: float) -> float:
    """Give a position as people read it: angles, and how fast they change, in degrees; all else as it is.

    Parameters
    ----------
    plant : PlantRecord
        From the design file.
    place : float
        A rope, a position or its speed, as the design has it.
    """
    return math.degrees(place) if shown_unit(plant) == "deg" else place


def shown_unit(plant: PlantRecord) -> str:
    """Give the unit of what `shown` gives: m of a rope or a position, or degrees.

    Parameters
    ----------
    plant : PlantRecord
        From the design file.
    """
    return "m" if plant.position is None or plant.position.unit == "m" else "deg"


def place_head(plant: PlantRecord) -> str:
    """Give the head of the column with the places.

    Parameters
    ----------
    plant : PlantRecord
        From the design file.
    """
    if plant.position is not None:
        return f"position [{shown_unit(plant)}]"
    return "frequency [Hz]" if is_arm(plant) else "rope [m]"


def place_text(plant: PlantRecord, site: Site) -> str:
    """Write a rope, the position of an arm, or its frequency.

    Parameters
    ----------
    plant : PlantRecord
        From the design file.
    site : Site
        Where it stands, or from where to where it goes.
    """
    if site.hoist is not None:
        return f"{shown(plant, site.hoist.from_m):.4g} to {shown(plant, site.hoist.to_m):.4g}"
    as_given = plant.position is not None or not is_arm(plant)
    return f"{shown(plant, site.length_m) if as_given else pendulum_frequency_hz(site.length_m):.4g}"


def place_unit(plant: PlantRecord) -> str:
    """Give the unit behind a place in a title.

    Parameters
    ----------
    plant : PlantRecord
        From the design file.
    """
    if plant.position is not None:
        return shown_unit(plant)
    return "Hz" if is_arm(plant) else "m of rope"
