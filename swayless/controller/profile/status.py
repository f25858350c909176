"""The status word of the motion profile: one bit for each reason.

Not for: what plays; the pins busy, done and aborted say that.
"""

from __future__ import annotations

from enum import IntFlag


class ProfileStatus(IntFlag):
    """Bits of the status word; :func:`explain_profile` says what each means."""

    EXECUTE_IGNORED = 1 << 0
    ABORT_HELD = 1 << 1
    INPUT_NOT_FINITE = 1 << 2
    LIMIT_EXCEEDED = 1 << 3
    TRAVEL_TOO_LONG = 1 << 4
    START_ELSEWHERE = 1 << 5
    START_INVALID = 1 << 6
    STOPPING = 1 << 7


_MEANINGS: dict[ProfileStatus, str] = {
    ProfileStatus.EXECUTE_IGNORED: "execute rose while a move or a stop played, which goes on",
    ProfileStatus.ABORT_HELD: "refused: abort was true when execute rose",
    ProfileStatus.INPUT_NOT_FINITE: "refused: start or target is not finite, or beyond 2**50",
    ProfileStatus.LIMIT_EXCEEDED: "refused: the move, or a stop of it, would exceed the limits",
    ProfileStatus.TRAVEL_TOO_LONG: "refused: target less start is beyond the longest travel",
    ProfileStatus.START_ELSEWHERE: "refused: start is not where the block rests, the reference would jump",
    ProfileStatus.START_INVALID: "start is not finite or beyond the limits: the last good one holds",
    ProfileStatus.STOPPING: "abort was true: a stop, or the end of the move, plays",
}


def explain_profile(bit: ProfileStatus) -> str:
    """Say what one status bit means, in one line; refusals stay until execute is false.

    Examples
    --------
    >>> explain_profile(ProfileStatus.STOPPING)
    'abort was true: a stop, or the end of the move, plays'
    """
    return _MEANINGS[bit]
