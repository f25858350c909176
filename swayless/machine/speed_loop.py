"""The speed loop of the ``[drive]`` section, and the ropes of a crane whose trolley it holds.

Not for: what the command is in, and its limits (`swayless.machine.drive_section`).
"""

from __future__ import annotations

from dataclasses import replace

from swayless.errors import PlantError
from swayless.machine.checks import number, quantity
from swayless.machine.plant_section import MASS, PlantSection
from swayless.machine.problems import Table
from swayless.plant import DrivenRopes, ServoDrive

GAIN = number(1e-3, 1e12)
LAG = quantity("time", 1e-5, 1e2)
INTEGRAL_TIME = quantity("time", 1e-4, 1e4)

_MASSES = ("trolley_mass", "load_mass")
_GAINS = ("speed_loop_gain", "speed_loop_lag")
_NEEDS = "a speed loop is trolley_mass, load_mass, and speed_loop_gain or speed_loop_lag"


def read_speed_loop(drive: Table) -> ServoDrive | None:
    """Read masses and speed loop, which stand in ``[drive]`` all together or not at all.

    Parameters
    ----------
    drive : Table
        The section.

    Returns
    -------
    ServoDrive or None
        None where none is given, or a value is missing or wrong.
    """
    masses = [drive.take(key, MASS, None) for key in _MASSES]
    gain_n_s_m, lag_s = drive.take(_GAINS[0], GAIN, None), drive.take(_GAINS[1], LAG, None)
    integral_time_s = drive.take("speed_loop_integral_time", INTEGRAL_TIME, None)
    if not any(key in drive.raw for key in (*_MASSES, *_GAINS, "speed_loop_integral_time")):
        return None
    for key in _MASSES:
        if key not in drive.raw:
            drive.place(key).problem(f"missing: {_NEEDS}")
    drive.need_one_of(*_GAINS)
    without_integral = "speed_loop_integral_time" not in drive.raw
    trolley_kg, load_kg = masses
    if trolley_kg is None or load_kg is None or (integral_time_s is None and not without_integral):
        return None
    integral = {} if integral_time_s is None else {"integral_time_s": integral_time_s}
    if gain_n_s_m is not None:
        return ServoDrive(trolley_kg, load_kg, gain_n_s_m, **integral)
    return None if lag_s is None else ServoDrive.from_lag(trolley_kg, load_kg, lag_s, **integral)


def driven_ropes(
    speed_loop: ServoDrive | None, plant: PlantSection, drive: Table, *, law: str | None
) -> DrivenRopes | None:
    """Give the ropes of a crane below its driven trolley; None, and a problem, where that is not possible.

    Parameters
    ----------
    speed_loop : ServoDrive or None
        Of `read_speed_loop`.
    plant : PlantSection
        What swings.
    drive : Table
        The section, for the places of problems.
    law : str or None
        Of the controller.
    """
    if speed_loop is None:
        return None
    place = drive.place("trolley_mass")
    if plant.rope_length_m is None:
        place.problem("a speed loop is felt by the load of a [crane] given by rope_length; leave it out")
        return None
    if plant.double_pendulum is not None:
        place.problem(
            "with sling_length the load swings as a double pendulum, whose two modes are not worked out for a"
            " speed loop: leave one of the two out"
        )
        return None
    if law not in {None, "fixed"}:
        place.problem(
            f'law = "{law}" follows the frequency of a pendulum at one damping ratio; below a speed loop both'
            ' change otherwise: use law = "fixed", or leave the speed loop out'
        )
        return None
    try:
        return DrivenRopes(speed_loop, plant.rope_length_m, plant.damping_ratio)
    except PlantError as error:
        key = next(key for key in _GAINS if key in drive.raw)
        drive.place(key).wrong(drive.raw[key], f"{error}")
        return None


def plant_below(plant: PlantSection, ropes: DrivenRopes) -> PlantSection:
    """Give a plant the frequencies that its ropes have below the driven trolley.

    Parameters
    ----------
    plant : PlantSection
        As its section describes it; its damping ratio stays the rope's own.
    ropes : DrivenRopes
        Its ropes.
    """
    return replace(plant, frequency_hz=ropes.frequency_range_hz(ropes.range_m))
