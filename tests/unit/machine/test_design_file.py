from __future__ import annotations

import hashlib
import json
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from swayless.errors import FileError
from swayless.machine import DesignFile, design_sha256, load_design, save_text
from swayless.machine.design_file import _layout
from swayless.machine.stored_numbers import inward_12, nearest_12

POSITIVE = st.floats(1e-300, 1e300)
LATTICE = 10**12


@pytest.fixture
def design(tmp_path: Path, design_text: str) -> DesignFile:
    return _load(tmp_path, design_text)


def _load(folder: Path, text: str) -> DesignFile:
    path = folder / "gantry.json"
    path.write_text(text, encoding="utf-8")
    return load_design(path)


def _with_tap_amplitudes(design: DesignFile, amplitudes: tuple[float, ...]) -> DesignFile:
    shaper = design.shapers[0]
    assert shaper.taps is not None
    assert design.tick_s is not None
    delays = tuple(range(len(amplitudes)))
    overtravel_s = sum(a * d * design.tick_s for a, d in zip(amplitudes, delays, strict=True))
    duration_s = delays[-1] * design.tick_s
    taps = replace(
        shaper.taps,
        delays_ticks=delays,
        amplitudes=amplitudes,
        duration_s=duration_s,
        overtravel_s=overtravel_s,
    )
    return replace(design, shapers=(replace(shaper, taps=taps),))


def test_the_documented_file_is_saved_as_the_same_text(design: DesignFile, design_text: str) -> None:
    assert save_text(design) == design_text


def test_saved_text_is_ascii_with_lf_and_one_final_newline(design: DesignFile) -> None:
    text = save_text(replace(design, source="br\u00fccke.toml"))
    assert text.isascii()
    assert "\r" not in text
    assert text.endswith("}\n")
    assert "br\\u00fccke" in text


def test_saving_what_was_loaded_changes_nothing_even_when_numbers_had_17_digits(
    design: DesignFile, tmp_path: Path
) -> None:
    band = (0.1 + 0.2, 2.0 / 3.0)
    shaper = design.shapers[0]
    raw = replace(design, shapers=(replace(shaper, guarantee=replace(shaper.guarantee, frequency_hz=band)),))
    once = save_text(raw)
    assert save_text(_load(tmp_path, once)) == once


@settings(derandomize=True, deadline=None)
@given(POSITIVE)
def test_rounding_keeps_12_digits_and_a_stored_number_is_left_alone(value: float) -> None:
    stored = nearest_12(value)
    assert (
        abs(stored - value) <= 5.0001e-12 * value
    )  # half a unit in the 12th digit, and the double's own rounding
    assert len(repr(stored).split("e")[0].replace(".", "").strip("0")) <= 12
    assert nearest_12(stored) == stored
    assert inward_12((stored, stored)) == [stored, stored]


@settings(derandomize=True, deadline=None)
@given(POSITIVE, POSITIVE)
def test_a_band_is_stored_within_itself(one: float, other: float) -> None:
    low, high = min(one, other), max(one, other)
    stored_low, stored_high = inward_12((low, high))
    assert stored_low >= low
    assert stored_high <= high
    assert inward_12((stored_low, stored_high)) == [stored_low, stored_high]


def test_minus_zero_is_stored_as_zero() -> None:
    assert str(nearest_12(-0.0)) == "0.0"


@settings(derandomize=True, deadline=None, max_examples=50)
@given(multiples=st.lists(st.integers(-LATTICE, LATTICE), min_size=1, max_size=8))
def test_tap_amplitudes_read_back_bit_for_bit(
    multiples: list[int], design_text: str, tmp_path_factory: pytest.TempPathFactory
) -> None:
    folder = tmp_path_factory.mktemp("design")
    exact = [*multiples, LATTICE - sum(multiples)]
    amplitudes = tuple(multiple / LATTICE for multiple in exact)
    loaded = _load(folder, save_text(_with_tap_amplitudes(_load(folder, design_text), amplitudes)))
    assert loaded.shapers[0].taps is not None
    assert loaded.shapers[0].taps.amplitudes == amplitudes


def test_thirteen_decimals_of_an_amplitude_are_refused(design: DesignFile) -> None:
    wrong = _with_tap_amplitudes(design, (0.5000000000005, 0.4999999999995))
    with pytest.raises(
        FileError, match=r"taps\.amplitudes: must be whole multiples of 1e-12, 0\.5000000000005 is not"
    ):
        save_text(wrong)


def test_long_arrays_are_wrapped_and_short_ones_stay_on_a_line(design: DesignFile) -> None:
    text = save_text(_with_tap_amplitudes(design, (*((round(LATTICE / 31) / LATTICE,) * 31), 4 / LATTICE)))
    assert max(len(line) for line in text.splitlines()) <= 100
    assert re.search(r'"delays_ticks": \[\n +0, 1, 2', text)
    assert '"times_s": [0.0, 2.00640929259],' in text


def test_a_long_array_of_texts_breaks_none_of_them() -> None:
    labels = [f"{row}: {30 - row}-{29 - row}.45 ft" for row in range(1, 9)]
    text = _layout({"labels": labels}, "")
    assert json.loads(text) == {"labels": labels}
    assert max(map(len, text.splitlines())) <= 100


def test_the_hash_is_that_of_the_compact_json_and_ignores_indentation(
    design: DesignFile, design_text: str, tmp_path: Path
) -> None:
    document = json.loads(design_text)
    compact = json.dumps(document, separators=(",", ":"))
    assert design_sha256(design) == hashlib.sha256(compact.encode()).hexdigest()
    assert design_sha256(_load(tmp_path, compact)) == design_sha256(design)
    assert design_sha256(replace(design, name="other")) != design_sha256(design)


def test_the_documented_command_computes_the_hash(design: DesignFile, design_text: str) -> None:
    page = (Path(__file__).parents[3] / "docs" / "design-file.md").read_text(encoding="utf-8")
    program = re.findall(r'python3 -c "(.*)" < ', page)[0]
    done = subprocess.run(
        [sys.executable, "-c", program], input=design_text, capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == design_sha256(design)


def test_a_design_without_a_tick_has_no_taps(design: DesignFile, tmp_path: Path) -> None:
    continuous = replace(design, tick_s=None, shapers=(replace(design.shapers[0], taps=None),))
    assert _load(tmp_path, save_text(continuous)) == continuous


def test_what_could_not_be_loaded_is_not_saved(design: DesignFile) -> None:
    with pytest.raises(
        FileError, match=r"design: shapers\[0\]\.taps: tick_s is null and shapers\[0\]\.taps is not"
    ):
        save_text(replace(design, tick_s=None))
