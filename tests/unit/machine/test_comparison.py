from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from swayless.machine import DesignFile, load_design, same_design


@pytest.fixture
def compare(tmp_path: Path, design_text: str):
    def against(change: Any) -> list[str]:
        """Compare the documented design with a changed one."""
        document = json.loads(design_text)
        change(document)
        return same_design(_load(tmp_path, design_text), _load(tmp_path, json.dumps(document)))

    return against


def _load(folder: Path, text: str) -> DesignFile:
    path = folder / "gantry.json"
    path.write_text(text)
    return load_design(path)


def test_a_design_is_the_same_as_itself(compare) -> None:
    assert compare(lambda document: None) == []


def test_the_version_of_the_generator_is_no_difference(compare) -> None:
    assert compare(lambda document: document.update(generator="swayless 9.9.9")) == []


@pytest.mark.parametrize(("factor", "differs"), [(1 + 9e-10, False), (1 + 1.1e-9, True), (1 - 1.1e-9, True)])
def test_numbers_may_differ_by_1e_9_and_no_more(compare, factor: float, differs: bool) -> None:
    def change(document: Any) -> None:
        document["plant"]["frequency_hz"][1] *= factor

    assert bool(compare(change)) is differs


def test_a_tiny_number_is_weighed_against_the_largest_of_its_array(compare) -> None:
    def change(document: Any) -> None:
        guarantee = document["shapers"][0]["guarantee"]
        guarantee["frequency_hz"][0] += 2e-10  # 8e-10 of itself and of its neighbour
        guarantee["rope_length_m"][0] += 4e-9  # 1.1e-9 of itself, 9.4e-10 of its larger neighbour

    assert compare(change) == []


def test_each_difference_is_one_line_with_its_path(compare) -> None:
    def change(document: Any) -> None:
        document["name"] = "other"
        document["tick_s"] = 0.02
        document["drive"]["quick_stop_m_s2"] = None
        document["shapers"][0]["mode"]["frequency_hz"] = 0.25
        document["shapers"][0]["taps"].update(delays_ticks=[0, 100], amplitudes=[0.5, 0.5])
        document["shapers"][0]["taps"].update(duration_s=2.0, overtravel_s=1.0)

    assert compare(change) == [
        'name: stored "yard_crane", fresh "other"',
        "tick_s: stored 0.01, fresh 0.02",
        "drive.quick_stop_m_s2: stored 0.5, fresh null",
        "shapers[0].mode.frequency_hz: stored 0.249201397664, fresh 0.25",
        "shapers[0].taps.delays_ticks: stored 3 items, fresh 2",
        "shapers[0].taps.amplitudes: stored 3 items, fresh 2",
        "shapers[0].taps.duration_s: stored 2.01, fresh 2.0",
        "shapers[0].taps.overtravel_s: stored 1.00321878398, fresh 1.0",
    ]


def test_a_delay_that_moved_by_one_tick_is_a_difference(compare) -> None:
    def change(document: Any) -> None:
        taps = document["shapers"][0]["taps"]
        taps["delays_ticks"][1] -= 1
        taps["overtravel_s"] -= taps["amplitudes"][1] * 0.01

    assert "shapers[0].taps.delays_ticks[1]: stored 200, fresh 199" in compare(change)


def test_another_number_of_rows_is_a_difference(compare) -> None:
    def change(document: Any) -> None:
        document["shapers"].append({**document["shapers"][0], "name": "second"})

    assert compare(change) == ["shapers: stored 1 items, fresh 2"]
