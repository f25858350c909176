"""One move on its ropes, by every row, unshaped and with plain ramps: controller and plant put together.

Not for: printing what came of it, nor for how plants and controllers work.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from swayless.cli.simulated_case import Case, Contender, Simulation, Site
from swayless.cli.simulated_control import (
    Press,
    hoist_end_s,
    plain_ramp,
    press_of,
    rope_of,
    shaped_reference,
)
from swayless.cli.simulated_place import pendulums_m
from swayless.cli.simulated_plant import case_until, simulated_plant
from swayless.cli.simulated_remarks import remarks
from swayless.errors import ControllerError
from swayless.plant import pendulum_frequency_hz, pendulum_rope_length_m
from swayless.plant.simulation import Trajectory, one_cosine_gust

if TYPE_CHECKING:
    from swayless.controller import ShaperSettings
    from swayless.machine import DesignFile
    from swayless.machine.move_section import Hoist, MoveSection, Wind
    from swayless.plant.simulation.trajectory import FloatArray


FOR_PENDULUM = "for a pendulum"
"""What is said of rows that were designed as if the drive did not feel the load."""

MOST_ONE_BY_ONE = 10
"""Cases up to which plants run faster one by one, in plain floats, than together in arrays."""

_BETWEEN = 101  # places of a way at which its slowest one is sought: for how long to watch


def simulate_move(
    design: DesignFile, settings: ShaperSettings, move: MoveSection, pendulum: ShaperSettings | None = None
) -> Simulation:
    """Run one move.

    Parameters
    ----------
    design : DesignFile
        With taps.
    settings : ShaperSettings
        Its block.
    move : MoveSection
        What is asked for.
    pendulum : ShaperSettings or None
        Of a driven crane: the block that it would have without a speed loop, to run beside.

    Raises
    ------
    ControllerError
        If the move is too long, or at a speed that a contactor drive does not have.
    PlantError
        If the load would swing to the horizontal.
    """
    tick_s, speed_m_s = settings.tick_s, move.speed_m_s or design.drive.max_speed_m_s
    if design.drive.contactor and speed_m_s < design.drive.max_speed_m_s:
        raise ControllerError(
            f"a move at {speed_m_s:g} m/s: a contactor drive gives 0 or full speed,"
            f" {design.drive.max_speed_m_s:g} m/s"
        )
    sites = _sites(design, move)
    slowest_s = 1.0 / pendulum_frequency_hz(_longest_m(design, sites))
    ramp_s = speed_m_s / (design.drive.acceleration_m_s2 or math.inf)
    settle_s = math.ceil(ramp_s + settings.longest_delay_ticks * tick_s + slowest_s)
    press = press_of(move, speed_m_s, design.drive, settle_s, tick_s)
    fields = [
        (site, contender)
        for site, contenders in _contenders(design, settings, pendulum, move, speed_m_s, press, sites)
        for contender in contenders
    ]
    cases = _run(design, settings, fields, move, slowest_s)
    pressed_s = press.first * tick_s
    return Simulation(
        move,
        speed_m_s,
        pressed_s,
        press.ticks * tick_s,
        tuple(
            Case(site, contender, run, left, pressed_s, speed_m_s)
            for (site, contender), (run, left) in zip(fields, cases, strict=True)
        ),
        remarks(design, settings, move, fields),
    )


def _sites(design: DesignFile, move: MoveSection) -> list[Site]:
    """Places to move at: those asked for, or the ends of the machine's range and their middle."""
    if move.hoist is not None:
        return [Site(move.hoist, move.hoist.from_m)]
    plant = design.plant
    on_rope = plant.kind in {"crane", "double_pendulum"}
    as_given = on_rope or plant.position is not None
    if move.places is not None:
        return [Site(None, place if as_given else pendulum_rope_length_m(place)) for place in move.places]
    if plant.position is not None:
        first, last = plant.position.places[0], plant.position.places[-1]
        return [Site(None, place) for place in (first, 0.5 * (first + last), last)]
    low_hz, high_hz = plant.frequency_hz
    frequencies_hz = [low_hz, 0.5 * (low_hz + high_hz), high_hz]
    lengths = [pendulum_rope_length_m(frequency_hz) for frequency_hz in frequencies_hz]
    if on_rope:
        low_m, high_m = plant.rope_length_m or (lengths[-1], lengths[0])
        lengths = [low_m, 0.5 * (low_m + high_m), high_m]
    return [Site(None, length_m) for length_m in dict.fromkeys(lengths)]


def _longest_m(design: DesignFile, sites: list[Site]) -> float:
    """Longest rope, or pendulum as fast as an arm, at the ends of all sites and between."""
    ends = [[site.length_m] if site.hoist is None else [site.hoist.from_m, site.hoist.to_m] for site in sites]
    places = np.concatenate([np.linspace(each[0], each[-1], _BETWEEN) for each in ends])
    return float(pendulums_m(design.plant, places).max())


def _contenders(
    design: DesignFile,
    settings: ShaperSettings,
    pendulum: ShaperSettings | None,
    move: MoveSection,
    speed_m_s: float,
    press: Press,
    sites: list[Site],
) -> Iterator[tuple[Site, list[Contender]]]:
    """Give the ways to move on each rope; without a measured rope they are the same on all."""
    known: list[Contender] = []
    for site in sites:
        if settings.rope is not None or not known:
            known = _on_site(design, settings, pendulum, move, speed_m_s, press, site)
        yield site, known


def _on_site(
    design: DesignFile,
    settings: ShaperSettings,
    pendulum: ShaperSettings | None,
    move: MoveSection,
    speed_m_s: float,
    press: Press,
    site: Site,
) -> list[Contender]:
    knobs = move.rows or tuple(range(1, settings.last_selector + 1))
    names = ["unshaped", *(_row_name(design, settings, knob) for knob in knobs)]

    def by_block(block: ShaperSettings, name: str, knob: int) -> Contender:
        reference_m_s, status = shaped_reference(block, knob, press, speed_m_s, _rope(site))
        return Contender(name, knob, _to_rest(reference_m_s), status)

    shaped = [by_block(settings, name, knob) for knob, name in zip((0, *knobs), names, strict=True)]
    naive = [
        replace(by_block(pendulum, f"{name} {FOR_PENDULUM}", knob), for_pendulum=True)
        for knob, name in zip(knobs, names[1:], strict=True)
        if pendulum is not None
    ]
    if design.drive.contactor:
        return [*shaped, *naive]
    way_ticks = round(float(shaped[0].reference_m_s.sum()) / speed_m_s)
    held = Press(press.first, press.first + way_ticks)
    ramps = {max(1, item.reference_m_s.size - press.last): None for item in shaped[1:]}
    plain = [
        Contender(f"ramp of {ticks * settings.tick_s:.4g} s", None, plain_ramp(held, ticks, speed_m_s))
        for ticks in ramps
    ]
    ramped = design.drive.acceleration_m_s2 is not None or design.drive.deceleration_m_s2 is not None
    jump = [Contender("jump, no ramp", None, plain_ramp(held, 1, speed_m_s))] if ramped else []
    return [*jump, *shaped, *naive, *plain]


def _row_name(design: DesignFile, settings: ShaperSettings, knob: int) -> str:
    """Name a position of the knob; where the rope chooses the row, the one position has them all."""
    if settings.last_selector < len(design.shapers):
        return f"{knob} row by the rope"
    return f"{knob} {design.shapers[knob - 1].name}"


def _rope(site: Site) -> tuple[Hoist | None, float]:
    return site.hoist, site.length_m


def _to_rest(reference_m_s: FloatArray) -> FloatArray:
    """Leave out the zeros at the end."""
    moving = np.flatnonzero(reference_m_s)
    return reference_m_s[: moving[-1] + 1] if moving.size else reference_m_s[:1]


def _run(
    design: DesignFile,
    settings: ShaperSettings,
    fields: list[tuple[Site, Contender]],
    move: MoveSection,
    slowest_s: float,
) -> list[tuple[Trajectory, Trajectory]]:
    """Simulate all cases at once; give each as a whole, and until reference and hoist stand."""
    tick_s = settings.tick_s
    hoisted = math.ceil(hoist_end_s(move.hoist) / tick_s)
    # A trajectory is at the end of its ticks: one more, and the last change has acted.
    stands = [max(contender.reference_m_s.size, hoisted) + 1 for _, contender in fields]
    ticks = max(stands) + math.ceil(slowest_s / tick_s)
    references = np.zeros((len(fields), ticks))
    for row, (_, contender) in zip(references, fields, strict=True):
        row[: contender.reference_m_s.size] = contender.reference_m_s
    time_s = tick_s * np.arange(ticks + 1.0)
    ropes = pendulums_m(design.plant, np.array([rope_of(*_rope(site), time_s) for site, _ in fields]))
    simulate, wind = simulated_plant(design, tick_s), _push(move.wind, ticks, tick_s)
    if len(fields) > MOST_ONE_BY_ONE:
        together = simulate(references, ropes, wind)
        runs = [case_until(together, case, ticks) for case in range(len(fields))]
    else:
        runs = [simulate(reference, rope, wind) for reference, rope in zip(references, ropes, strict=True)]
    return [(run, case_until(run, None, stand)) for run, stand in zip(runs, stands, strict=True)]


def _push(wind: Wind | None, ticks: int, tick_s: float) -> FloatArray:
    """Force of the wind per load mass, a value a tick."""
    if wind is None:
        return np.zeros(ticks)
    if wind.duration_s is None:
        return np.where(tick_s * np.arange(ticks) >= wind.start_s, wind.push_m_s2, 0.0)
    shape = one_cosine_gust(
        ticks, tick_s=tick_s, start_s=wind.start_s, duration_s=wind.duration_s, peak_m_s=1.0
    )
    return wind.push_m_s2 * shape
