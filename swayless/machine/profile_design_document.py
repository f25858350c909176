"""A motion profile as the record that is stored, and back. Not for: proving it (`profile_design_check`)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import astuple
from typing import Any, TypeVar

import numpy as np

from swayless.controller.number import number_type
from swayless.controller.profile import Extremes, Pieces, ProfileModel, ProfileSettings, StopLaw
from swayless.design.optimal import Command, LinearPlant, Robustness
from swayless.machine.problems import Place
from swayless.machine.profile_design import ProfileDesign
from swayless.machine.profile_design_move import ProfileMove
from swayless.machine.profile_design_numbers import NumberedMove
from swayless.machine.profile_design_promise import ProfileGuarantee
from swayless.machine.profile_design_record import (
    SCHEMA,
    CommandRecord,
    ExtremesRecord,
    GuaranteeRecord,
    ModelRecord,
    PlantRecord,
    ProfileRecord,
    StopRecord,
    TableRecord,
)

T = TypeVar("T")


def record_of(design: ProfileDesign) -> ProfileRecord:
    """Give what is stored of a design."""
    move, settings = design.move, design.settings
    plant, command, model, stop = move.plant, move.command, settings.model, settings.stop
    values: Any = command.values.tolist()
    robustness = move.robustness
    return ProfileRecord(
        SCHEMA,
        design.name,
        design.source,
        design.generator,
        settings.number.name,
        settings.tick_s,
        move.start,
        move.target,
        move.limits,
        move.rate_limit_per_s,
        robustness.order,
        robustness.split_ratio,
        PlantRecord(_nested(plant.a), _nested(plant.b), _nested(plant.c), plant.d),
        CommandRecord(command.hold, command.initial_value, command.final_value, values),
        GuaranteeRecord(*astuple(design.guarantee)),
        settings.hold_ratio,
        settings.max_travel,
        ExtremesRecord(settings.extremes.shape, settings.extremes.rest),
        TableRecord(_nested(settings.pieces.lengths), _nested(settings.pieces.coefficients)),
        ModelRecord(_nested(model.change), _nested(model.input), _nested(model.output), model.feedthrough),
        None
        if stop is None
        else StopRecord(
            _nested(stop.pieces.lengths),
            _nested(stop.pieces.coefficients),
            _nested(stop.rest),
            _nested(stop.ranges),
        ),
    )


def design_of(record: ProfileRecord, place: Place) -> ProfileDesign | None:
    """Give the design that is stored; None, with the problems reported, where it is none."""
    move = _move(record, place)
    settings = _settings(record, place, move)
    if move is None or settings is None:
        return None
    guarantee = ProfileGuarantee(*astuple(record.guarantee))
    return ProfileDesign(record.name, record.source, record.generator, move, settings, guarantee)


def _move(record: ProfileRecord, place: Place) -> ProfileMove | None:
    stored, given = record.plant, record.command
    plant = _made(
        place, "plant", lambda: LinearPlant(_array(stored.a), _array(stored.b), _array(stored.c), stored.d)
    )
    hold: Any = given.hold
    command = Command(record.tick_s, _array(given.values), given.final_value, hold, given.initial_value)
    robustness = _made(place, "split_ratio", lambda: Robustness(record.robust_order, record.split_ratio))
    if plant is None or robustness is None:
        return None
    low, high = record.limit
    return _made(
        place,
        "command",
        lambda: ProfileMove(
            plant, command, (low, high), record.start, record.target, record.rate_limit_per_s, robustness
        ),
    )


def _settings(record: ProfileRecord, place: Place, move: ProfileMove | None) -> ProfileSettings | None:
    table, model, stop = record.table, record.model, record.stop
    pieces = _made(place, "table", lambda: Pieces(_array(table.lengths), _array(table.coefficients)))
    made_model = _made(
        place,
        "model",
        lambda: ProfileModel(
            _array(model.change), _array(model.input), _array(model.output), model.feedthrough
        ),
    )
    law = None if stop is None else _made(place, "stop", lambda: _stop_law(stop))
    if pieces is None or made_model is None or (law is None and stop is not None) or move is None:
        return None
    numbered = NumberedMove(move, number_type(record.number))
    extremes = Extremes(_pair(record.extremes.shape), _pair(record.extremes.rest))
    return _made(
        place,
        "max_travel",
        lambda: ProfileSettings(
            record.tick_s,
            pieces,
            made_model,
            law,
            extremes,
            numbered.limits,
            record.hold_ratio,
            record.max_travel,
            numbered.start,
            numbered.number,
        ),
    )


def _stop_law(stop: StopRecord) -> StopLaw:
    pieces = Pieces(_array(stop.lengths), _array(stop.coefficients))
    return StopLaw(pieces, _array(stop.rest), _array(stop.ranges))


def _made(place: Place, key: str, make: Callable[[], T]) -> T | None:
    """Make something of what stands under a key; what is wrong with it is a problem of that key."""
    try:
        return make()
    except ValueError as error:  # of ours, or of arrays whose rows differ in length
        reason = "rows must be of one length" if "inhomogeneous" in str(error) else str(error)
        place.report.problems.append(f"{place.report.file}: {key}: {reason}")
        return None


def _array(values: Any) -> Any:
    return np.array(values)


def _pair(values: tuple[float, ...]) -> tuple[float, float]:
    low, high = values
    return low, high


def _nested(values: Any) -> Any:
    return values.tolist()
