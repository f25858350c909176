"""From a design file to the functions of its block: what the operator touches, and what the block says.

Not for: taps and limits (`swayless.machine.running`).
"""

from __future__ import annotations

from dataclasses import replace

from swayless.controller import ShaperInput, ShaperSettings, operator_settings
from swayless.controller.diagnostics import Diagnostics
from swayless.controller.rope_bound import rope_bounds
from swayless.controller.sway import sway_settings
from swayless.controller.tables import design_facts
from swayless.controller.tracking import TrackingSettings, tracking_settings
from swayless.errors import ControllerError
from swayless.machine.design_document import DesignFile
from swayless.machine.design_id import design_id
from swayless.machine.operator_record import DiagnosticsRecord, TrackingRecord, operator_options


def with_functions(settings: ShaperSettings, design: DesignFile) -> ShaperSettings:
    """Add to a block what its design asks for; a design that asks for nothing leaves it as it is.

    Parameters
    ----------
    settings : ShaperSettings
        Taps and limits.
    design : DesignFile
        The design.

    Raises
    ------
    ControllerError
        If a function does not go with the block, or its number type cannot hold it.
    """
    if design.operator is not None:
        options = operator_options(design.operator)
        operator = operator_settings(options, settings.bank, settings.limits)
        settings = replace(settings, operator=operator)
    if design.diagnostics is None:
        return settings
    settings = replace(settings, diagnostics=_diagnostics(settings, design.diagnostics))
    if not design.diagnostics.design_check:
        return settings
    facts = design_facts(settings, design_id(design))  # of every table, so after all the others
    return replace(settings, diagnostics=replace(settings.diagnostics, facts=facts))


def undisturbed(settings: ShaperSettings) -> ShaperInput:
    """Give inputs at which only the command moves the machine: far from every end, on the longest rope.

    A block that waits for a command of 0 has seen one after a tick of these.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    """
    zero, way = settings.number.scalar(0), settings.operator.way
    far = zero if way is None else way.farthest + way.margin
    return ShaperInput(
        command=zero,
        rope_length=zero if settings.rope is None else settings.rope.longest,
        hoist_speed=zero,
        distance_forward=far,
        distance_reverse=far,
        actual_speed=zero,
        speed_limit=settings.limits.max_command,
        rope_offset=zero,
    )


def _diagnostics(settings: ShaperSettings, record: DiagnosticsRecord) -> Diagnostics:
    bank, limits, rope = settings.bank, settings.limits, settings.rope
    sway = sway_settings(bank, limits, rope) if record.predicted_sway else None
    bounds = None
    if record.residual_bound_at_rope:
        if rope is None:
            raise ControllerError("diagnostics.residual_bound_at_rope: needs a measured rope")
        bounds = rope_bounds(bank, rope)
    return Diagnostics(sway=sway, rope_bounds=bounds, tracking=_tracking(settings, record.tracking))


def _tracking(settings: ShaperSettings, record: TrackingRecord | None) -> TrackingSettings | None:
    if record is None:
        return None
    return tracking_settings(
        record.tolerance_m_s,
        time_s=record.time_s,
        delay_s=record.delay_s,
        tick_s=settings.tick_s,
        limits=settings.limits,
        number=settings.number,
    )
