"""From a profile request to the command that it asks for. Not for: printing it."""

from __future__ import annotations

import math
from collections.abc import Callable

from swayless.cli.console import progress
from swayless.design.optimal import OptimalCommand, least_energy, time_optimal, track
from swayless.machine.profile_file import ProfileRequest


def found_for(request: ProfileRequest) -> OptimalCommand:
    """Find the command of a request.

    Parameters
    ----------
    request : ProfileRequest

    Raises
    ------
    DesignError
        If no command can do it: the message names the cause.
    """
    with progress() as show:
        return found_with(request, show)


def found_with(request: ProfileRequest, show: Callable[[str], None]) -> OptimalCommand:
    """Find the command of a request, as `found_for` does.

    Parameters
    ----------
    request : ProfileRequest
    show : callable
        Shows progress.
    """
    if request.wanted is not None and request.tolerance is not None:
        show(f"following {request.wanted.size} outputs")
        return track(request.task, request.wanted, request.tolerance)
    show("the fewest ticks")
    fastest = time_optimal(request.task)
    if request.relax_ratio is None:
        return fastest
    show("the least energy")
    return least_energy(request.task, math.ceil(fastest.ticks * request.relax_ratio * (1.0 - 1e-12)))
