"""What a simulated move asks beyond its machine, and what the block says of it.

Not for: refusing such a move: what happens out there is what a study asks for.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from swayless.cli.simulated_place import is_arm, place_text, place_unit, shown, shown_unit
from swayless.controller.status import Status, explain
from swayless.plant import pendulum_rope_length_m

if TYPE_CHECKING:
    from swayless.cli.simulated_case import Contender, Site
    from swayless.controller import ShaperSettings
    from swayless.machine import DesignFile, PlantRecord
    from swayless.machine.move_section import MoveSection

_USUAL = (
    Status.DISABLED
    | Status.UNSHAPED
    | Status.ROW_WAITS
    | Status.COMMAND_WAITS
    | Status.TRACKING  # no simulated drive tells the block how fast it goes
)
_ROUNDING = 1e-9  # of the largest place: what a design file rounds to 12 digits is no other place


def notable(status: int) -> list[Status]:
    """Give the bits of a status word that a simulated move should not show.

    Parameters
    ----------
    status : int
        What the block said in any tick.

    Examples
    --------
    >>> [bit.name for bit in notable(int(Status.UNSHAPED | Status.ROPE_OUT_OF_RANGE))]
    ['ROPE_OUT_OF_RANGE']
    """
    return [bit for bit in Status if bit & status & ~_USUAL]


def remarks(
    design: DesignFile,
    settings: ShaperSettings,
    move: MoveSection,
    fields: Sequence[tuple[Site, Contender]],
) -> tuple[str, ...]:
    """Say where a move leaves what its machine file allows, and which status bits its blocks showed.

    Parameters
    ----------
    design : DesignFile
        Whose machine moves.
    settings : ShaperSettings
        Its block.
    move : MoveSection
        What is asked for.
    fields : sequence of Site and Contender
        Who moved where.
    """
    return (*_beyond(design.plant, move), *_said(design.plant, settings, fields))


def _beyond(plant: PlantRecord, move: MoveSection) -> Iterator[str]:
    """Compare the move with the machine; a design of one mode has none."""
    if plant.kind == "mode":
        return
    low, high = _range(plant)
    slack = _ROUNDING * max(abs(low), abs(high))
    way, places = move.hoist, move.places or ()
    for place in places if way is None else (way.from_m, way.to_m):
        if not low - slack <= place <= high + slack:
            noun, unit = _noun(plant), _unit(plant)
            own = " to ".join(f"{shown(plant, end):g}" for end in dict.fromkeys((low, high)))
            yield f"{noun} of {shown(plant, place):g} {unit}: outside the machine's, {own} {unit}"
    if way is None:
        return
    what, fastest, key = "hoist", plant.hoist_speed_m_s, "hoist_speed"
    if plant.position is not None:
        what, fastest, key = "sweep", plant.position.speed_per_s, "position_speed"
    if fastest is not None and way.rate_m_s > fastest * (1.0 + _ROUNDING):
        rates = [f"{shown(plant, rate):g} {_unit(plant)}/s" for rate in (way.rate_m_s, fastest)]
        yield f"a {what} at {rates[0]}: faster than the machine's {key}, {rates[1]}"


def _range(plant: PlantRecord) -> tuple[float, float]:
    """Give the ends of the machine's ropes, positions or frequencies."""
    if plant.position is not None:
        return plant.position.places[0], plant.position.places[-1]
    if is_arm(plant):
        return plant.frequency_hz
    low_hz, high_hz = plant.frequency_hz
    return plant.rope_length_m or (pendulum_rope_length_m(high_hz), pendulum_rope_length_m(low_hz))


def _noun(plant: PlantRecord) -> str:
    return "a position" if plant.position is not None else "a frequency" if is_arm(plant) else "a rope"


def _unit(plant: PlantRecord) -> str:
    return "Hz" if plant.position is None and is_arm(plant) else shown_unit(plant)


def _said(
    plant: PlantRecord, settings: ShaperSettings, fields: Sequence[tuple[Site, Contender]]
) -> Iterator[str]:
    """Give one line for each bit at each place, with the names of all who showed it."""
    named: dict[tuple[Site, Status], list[str]] = {}
    for site, contender in fields:
        for bit in notable(contender.status):
            named.setdefault((site, bit), []).append(contender.name)
    for (site, bit), names in named.items():
        meaning = explain(bit) if settings.rope is None else settings.rope.measured.explain(bit)
        where = f"{place_text(plant, site)} {place_unit(plant)}"
        yield f"on {where}, by {', '.join(names)}: {bit.name}, {meaning}"
