from __future__ import annotations

import math
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from swayless.errors import PlantError
from swayless.machine.quantity import UNITS, parse_quantity


@pytest.mark.parametrize(
    ("value", "dimension", "si"),
    [
        ("29 ft", "length", 8.8392),
        ("3 in", "length", 0.0762),
        ("80 mm", "length", 0.08),
        ("10 ms", "time", 0.01),
        ("1 min", "time", 60.0),
        ("0.5 m/s", "speed", 0.5),
        ("100 ft/min", "speed", 0.508),
        ("40m/min", "speed", 2.0 / 3.0),
        ("0.4 m/s2", "acceleration", 0.4),
        ("0.4 m/s^2", "acceleration", 0.4),
        ("10 ft/s2", "acceleration", 3.048),
        ("0.2 Hz", "frequency", 0.2),
        ("12 rpm", "frequency", 0.2),
        ("5 %", "ratio", 0.05),
        ("5%", "ratio", 0.05),
        ("-1e3 mm", "length", -1.0),
        ("0.25", "length", 0.25),
        ("180 deg", "angle", math.pi),
        ("-30 deg", "angle", -0.5235987755982989),  # pi / 6 = 0.52359877559829887...
        ("500 mrad", "angle", 0.5),
        ("90deg/s", "turning speed", math.pi / 2.0),
        (2, "time", 2.0),
        (0.05, "ratio", 0.05),
    ],
)
def test_quantity_is_the_double_nearest_to_its_exact_value(value: object, dimension: str, si: float) -> None:
    assert parse_quantity(value, dimension) == si


@pytest.mark.parametrize(
    ("value", "dimension", "message"),
    [
        ("10 kg", "time", '"10 kg" is not a time: allowed units are s, ms, us, min'),
        ("10 m", "ratio", '"10 m" is not a ratio: allowed units are %'),
        ("ten m", "length", '"ten m" is not a length: allowed units are m, cm, mm, in, ft'),
        ("0,5 m", "length", '"0,5 m" is not a length: allowed units are m, cm, mm, in, ft'),
        ("", "length", '"" is not a length: allowed units are m, cm, mm, in, ft'),
        (
            "1 m/s",
            "acceleration",
            '"1 m/s" is not an acceleration: allowed units are m/s2, cm/s2, mm/s2, in/s2, ft/s2',
        ),
        ("30 m", "angle", '"30 m" is not an angle: allowed units are rad, mrad, deg'),
        ("nan m", "length", '"nan m" is not a length: allowed units are m, cm, mm, in, ft'),
        ("\u0663 m", "length", '"\\u0663 m" is not a length: allowed units are m, cm, mm, in, ft'),
        ("1e9999 m", "length", '"1e9999 m" is not a length: allowed units are m, cm, mm, in, ft'),
        ("1e999 m", "length", '"1e999 m" is not a finite number'),
        (True, "length", "true is not a length: write a number or a text with a unit"),
        (None, "length", "null is not a length: write a number or a text with a unit"),
        (float("nan"), "length", "nan is not a finite number"),
        (float("-inf"), "length", "-inf is not a finite number"),
        (10**400, "length", "(an integer of 1329 bits) is not a finite number"),
    ],
)
def test_what_is_not_a_quantity_is_refused(value: object, dimension: str, message: str) -> None:
    with pytest.raises(PlantError) as caught:
        parse_quantity(value, dimension)
    assert str(caught.value) == message


@settings(derandomize=True, deadline=None)
@given(
    st.sampled_from([(dimension, unit) for dimension, units in UNITS.items() for unit in units]),
    st.decimals(min_value=-10_000, max_value=10_000, allow_nan=False, places=6),
)
def test_every_unit_converts_with_one_rounding(unit: tuple[str, str], number: object) -> None:
    dimension, name = unit
    exact = Fraction(str(number)) * UNITS[dimension][name]
    assert parse_quantity(f"{number} {name}", dimension) == float(exact)
