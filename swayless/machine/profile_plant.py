"""The plant of a profile file: a transfer function, a state space, or the load below a crane's trolley.

Not for: what it shall do (`swayless.machine.profile_file`).
"""

from __future__ import annotations

import numpy as np

from swayless.design.optimal import LinearPlant
from swayless.design.optimal.linear_plant import LARGEST_ORDER
from swayless.errors import DesignError
from swayless.machine.checks import number, some
from swayless.machine.problems import Check, Place, Table
from swayless.plant import Mode

COEFFICIENT = number(-1e300, 1e300)
_MODELS = (("numerator", "denominator"), ("a", "b", "c"))


def coefficients(value: object, place: Place) -> tuple[float, ...] | None:
    """Check for an array of numbers, or a text of them as on a command line: ``"0.01 0 1"``.

    Examples
    --------
    >>> from swayless.machine.problems import Report
    >>> coefficients("0.01, 0 1", Place(Report(""), "--denominator"))
    (0.01, 0.0, 1.0)
    """
    check: Check[tuple[float, ...]] = some(COEFFICIENT, at_most=LARGEST_ORDER + 1)
    if isinstance(value, str):
        words = value.replace(",", " ").split()
        try:
            return check([float(word) for word in words], place)
        except ValueError:
            place.wrong(value, "must be numbers, such as '0.01 0 1'")
            return None
    return check(value if isinstance(value, list) else [value], place)


def read_plant_model(table: Table) -> LinearPlant | None:
    """Read a plant; None where a value is missing or wrong."""
    given = [model for model in _MODELS if any(key in table.raw for key in model)]
    if len(given) != 1:
        found = "both are there" if given else "none is there"
        table.place("numerator and denominator, or a, b and c").problem(f"exactly one is needed, {found}")
        table.asked.extend([key for model in _MODELS for key in model] + ["d"])
        return None
    try:
        return _transfer_function(table) if given[0] == _MODELS[0] else _state_space(table)
    except DesignError as error:
        table.place(given[0][0]).problem(str(error))
        return None


def _transfer_function(table: Table) -> LinearPlant | None:
    top, bottom = table.need("numerator", coefficients), table.need("denominator", coefficients)
    return None if top is None or bottom is None else LinearPlant.from_transfer_function(top, bottom)


def _state_space(table: Table) -> LinearPlant | None:
    row: Check[tuple[float, ...]] = some(COEFFICIENT, at_most=LARGEST_ORDER)
    a = table.need("a", some(row, at_most=LARGEST_ORDER))
    b, c = table.need("b", row), table.need("c", row)
    d = table.take("d", COEFFICIENT, 0.0)
    if a is None or b is None or c is None or d is None:
        return None
    if any(len(line) != len(a) for line in a) or {len(b), len(c)} != {len(a)}:
        sizes = f"rows of {', '.join(str(len(line)) for line in a)}, b of {len(b)}, c of {len(c)}"
        table.place("a").problem(f"must be square, b and c as long: has {len(a)} {sizes}")
        return None
    return LinearPlant(np.array(a), np.array(b), np.array(c), d)


def load_below_trolley(mode: Mode) -> LinearPlant:
    """Give the plant of a crane that follows its speed: the trolley's speed in, the load's position out.

    Parameters
    ----------
    mode : Mode
        Of the load, for small swings; its damping is in the rope, against the trolley.

    References
    ----------
    (2 d w s + w^2) / (s (s^2 + 2 d w s + w^2)): Newton's law of a load on a rope below a trolley that moves.

    Examples
    --------
    >>> load_below_trolley(Mode(0.25)).equilibrium(10.0)[1]
    0.0
    """
    w, damping = mode.angular_frequency_rad_s, 2.0 * mode.damping_ratio * mode.angular_frequency_rad_s
    return LinearPlant.from_transfer_function([damping, w**2], [1.0, damping, w**2, 0.0])
