"""The status word of the adaptive shaper. What it shares with the command shaper has the same bit there.

Not for: the command shaper's own reasons; they are in `controller.status`.
"""

from __future__ import annotations

from enum import IntFlag


class AdaptiveStatus(IntFlag):
    """Bits of the status word; :func:`explain_adaptive` says what each means."""

    DISABLED = 1 << 0
    UNSHAPED = 1 << 1
    ADAPTING = 1 << 2
    CONVERGED = 1 << 3
    COMMAND_CLAMPED = 1 << 4
    COMMAND_INVALID = 1 << 5
    FROZEN = 1 << 6
    LEARNING_AGAIN = 1 << 7
    SET_REFUSED = 1 << 8
    VIBRATION_INVALID = 1 << 9


_MEANINGS: dict[AdaptiveStatus, str] = {
    AdaptiveStatus.DISABLED: "enable is false: nothing is learned; from rest on the command is not shaped",
    AdaptiveStatus.UNSHAPED: "the reference is the command: nothing learned yet, or in the first cycle",
    AdaptiveStatus.ADAPTING: "the command rests, and the vibration that is left is being learned from",
    AdaptiveStatus.CONVERGED: "the coefficients fit what was last measured, or left nothing but noise",
    AdaptiveStatus.COMMAND_CLAMPED: "the command is beyond the maximum and was clamped to it",
    AdaptiveStatus.COMMAND_INVALID: "the command is not finite: the last one holds",
    AdaptiveStatus.FROZEN: "the vibration has sunk into noise or the dead zone: the coefficients stay",
    AdaptiveStatus.LEARNING_AGAIN: "the coefficients did not fit the vibration: the past counts less now",
    AdaptiveStatus.SET_REFUSED: "the coefficients found would exceed the drive's limit: the old ones stay",
    AdaptiveStatus.VIBRATION_INVALID: "the vibration is not finite or too large: nothing is learned from it",
}


def explain_adaptive(bit: AdaptiveStatus) -> str:
    """Say what one status bit means, in one line.

    Examples
    --------
    >>> explain_adaptive(AdaptiveStatus.COMMAND_INVALID)
    'the command is not finite: the last one holds'
    """
    return _MEANINGS[bit]
