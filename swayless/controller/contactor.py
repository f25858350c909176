"""Two-speed and on-off pendants: a drive behind contactors knows 0, perhaps slow, and fast, and nothing else.

Commands count as the largest of these speeds that is not above them; row changes and new commands wait for
rest as for every row with negative amplitudes. Not for: the search for such rows (`design`).
"""

from __future__ import annotations

from typing import Any

import numpy as np

from swayless.controller.limits import CommandLimits
from swayless.controller.operator_settings import OperatorSettings
from swayless.controller.taps import Bank
from swayless.errors import ControllerError


def quantised(magnitude: Any, commands: tuple[Any, ...], zero: Any) -> Any:
    """Largest of the commands that is not above a magnitude; `zero` below all of them.

    Examples
    --------
    >>> quantised(0.4, (0.25, 0.5), 0.0), quantised(0.5, (0.25, 0.5), 0.0), quantised(0.1, (0.25, 0.5), 0.0)
    (0.25, 0.5, 0.0)
    """
    found = zero
    for command in commands:
        if command <= magnitude:
            found = command
    return found


def check_contactor(operator: OperatorSettings, bank: Bank, limits: CommandLimits) -> None:
    """Refuse rows and limits under which the reference would be anything else than 0 and these commands.

    Parameters
    ----------
    operator : OperatorSettings
        With contactor commands.
    bank : Bank
        The rows.
    limits : CommandLimits
        Ramps and small commands.

    Raises
    ------
    ControllerError
        If an amplitude is not +1 or -1 in turn, a command is ramped, or a speed is not one of the drive's.
    """
    commands = operator.contactor_commands
    for row in bank.rows:
        signs = np.resize([1.0, -1.0], row.taps.amplitudes.size)
        if not np.array_equal(row.taps.amplitudes, signs) or row.taps.amplitudes.size % 2 == 0:
            raise ControllerError(
                f'row "{row.name}": a contactor drive takes amplitudes +1, -1, ..., +1 on whole ticks, '
                f"got {row.taps.amplitudes.tolist()}"
            )
    if min(limits.acceleration_step, limits.deceleration_step, limits.quick_stop_step) < (
        limits.max_command + limits.max_command
    ):
        raise ControllerError(
            "a contactor drive gives no ramps: leave out acceleration, deceleration, quick_stop"
        )
    if limits.inching_command != 0 and limits.inching_command not in commands:
        raise ControllerError(
            "inching_speed_m_s: a contactor drive inches at one of its speeds or not at all"
        )
    if operator.slow_command is not None and operator.slow_command not in commands:
        raise ControllerError("slow_speed_m_s: below the slowest of contactor_speeds_m_s nothing moves")
