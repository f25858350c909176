"""The design of a motion profile: a move, the constants of the block that plays it, and what is promised.

Not for: finding the command, or generating code.
"""

from __future__ import annotations

from dataclasses import dataclass

import swayless
from swayless.controller.number import number_type
from swayless.controller.profile import ProfileSettings
from swayless.controller.profile.compression import raw_pieces
from swayless.machine.profile_design_move import ProfileMove
from swayless.machine.profile_design_numbers import NumberedMove
from swayless.machine.profile_design_promise import ProfileGuarantee, guaranteed
from swayless.machine.profile_design_settings import settings_for


@dataclass(frozen=True, eq=False)
class ProfileDesign:
    """A motion profile that is proved.

    Parameters
    ----------
    name : str
        Prefix of every generated symbol.
    source : str
        Base name of the file that asked for it.
    generator : str
        Name and version of what made it.
    move : ProfileMove
        Command, plant and limits.
    settings : ProfileSettings
        Every constant of the block.
    guarantee : ProfileGuarantee
    """

    name: str
    source: str
    generator: str
    move: ProfileMove
    settings: ProfileSettings
    guarantee: ProfileGuarantee

    @property
    def numbered(self) -> NumberedMove:
        """The move in the numbers of the block."""
        return NumberedMove(self.move, self.settings.number, self.settings.hold_ratio)

    @property
    def table_bytes(self) -> tuple[int, int]:
        """Size of the table of the shape: plain, and as it is."""
        pieces, number = self.settings.pieces, self.settings.number
        return raw_pieces(pieces.values(number)).stored_bytes(number), pieces.stored_bytes(number)

    @property
    def stop_bytes(self) -> tuple[int, int]:
        """Size of the gains of the stop: plain, and as they are; 0 where no stop is needed."""
        stop, number = self.settings.stop, self.settings.number
        if stop is None:
            return 0, 0
        plain = raw_pieces(stop.pieces.values(number))
        return plain.stored_bytes(number), stop.pieces.stored_bytes(number)


def make_profile_design(name: str, source: str, move: ProfileMove, number: str = "double") -> ProfileDesign:
    """Make the block that plays a command, and prove it.

    Parameters
    ----------
    name : str
        Prefix of every generated symbol.
    source : str
        Base name of the file that asked for it.
    move : ProfileMove
        Command, plant and limits.
    number : {"double", "float"}

    Raises
    ------
    DesignError
        If the command does not rest, or rounding exceeds a limit; the message names the cause.
    ControllerError
        If there is no such number type, or the block cannot hold a value.

    Examples
    --------
    >>> from swayless.design.optimal import Command, LinearPlant
    >>> mass = LinearPlant([[0.0, 1.0], [0.0, 0.0]], [0.0, 1.0], [1.0, 0.0])
    >>> command = Command(0.5, [1.0, 1.0, -1.0, -1.0], 0.0)
    >>> made = make_profile_design(
    ...     "mass", "mass.toml", ProfileMove(mass, command, (-1.5, 1.5), start=0.0, target=1.0)
    ... )
    >>> made.settings.rest_ticks, made.guarantee.final_error_ratio, made.table_bytes
    (2, 1e-12, (32, 20))
    """
    stored = move.as_stored()
    numbered = NumberedMove(stored, number_type(number))
    settings, proof = settings_for(numbered)
    guarantee = guaranteed(numbered, proof, has_stop=settings.stop is not None)
    return ProfileDesign(name, source, f"swayless {swayless.__version__}", stored, settings, guarantee)
