from __future__ import annotations

from pathlib import Path

import pytest

from swayless.cli.init import Example
from swayless.errors import FileError
from swayless.machine import (
    EXAMPLE_NAMES,
    DesignFile,
    example_text,
    examples,
    load_design,
    save_text,
)
from swayless.machine.adaptive_file import load_adaptive
from swayless.machine.designing import design_machine
from swayless.machine.examples import EXAMPLES
from swayless.machine.inversion_file import load_inversion
from swayless.machine.machine_file import load_axes
from swayless.machine.profile_file import load_profile

FOLDER = Path(__file__).parents[3] / "examples"


def test_examples_are_the_files_of_the_source_tree() -> None:
    assert sorted(path.stem for path in FOLDER.rglob("*.toml")) == sorted(EXAMPLES)
    for name in EXAMPLES:
        assert example_text(name) == (FOLDER / f"{name}.toml").read_text(encoding="utf-8")


def test_init_writes_every_example_there_is() -> None:
    assert [example.value for example in Example] == list(EXAMPLES)


def test_each_example_is_read_as_what_it_describes() -> None:
    read = {
        "adaptive": load_adaptive,
        "move": lambda path: load_profile(path, {}),
        "inversion": load_inversion,
    }
    for name, kind in EXAMPLES.items():
        if kind in read:
            assert read[kind](FOLDER / f"{name}.toml").name == name.replace("-", "_")


def test_in_a_wheel_the_folder_inside_the_package_is_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "srtc-gantry.toml").write_text("from the wheel")
    monkeypatch.setattr(examples, "_IN_WHEEL", tmp_path)
    assert example_text("srtc-gantry") == "from the wheel"


def test_an_unknown_example_names_the_nearest() -> None:
    with pytest.raises(
        FileError,
        match="'srtc-gantri': unknown; nearest: srtc-gantry, srtc-gantry-bank, hoisting-gantry; known: ",
    ):
        example_text("srtc-gantri")


@pytest.fixture(scope="module")
def designs() -> dict[str, DesignFile]:
    first = {name: load_axes(FOLDER / f"{name}.toml").machines[0] for name in EXAMPLE_NAMES}
    return {name: design_machine(machine) for name, machine in first.items()}


@pytest.mark.parametrize("name", EXAMPLE_NAMES)
def test_each_example_can_be_designed_stored_and_loaded(
    name: str, designs: dict[str, DesignFile], tmp_path: Path
) -> None:
    text = save_text(designs[name])
    (tmp_path / "design.json").write_text(text)
    assert save_text(load_design(tmp_path / "design.json")) == text


def test_rows_of_the_workshop_crane_hold_what_their_names_and_comments_say(
    designs: dict[str, DesignFile],
) -> None:
    ranges = [
        shaper.taps.guarantee.rope_length_m for shaper in designs["workshop-crane"].shapers if shaper.taps
    ]
    promised = [(2.0, 3.4), (3.2, 7.0), (5.0, 10.0), (2.0, 10.0)]
    for (low_m, high_m), (shortest_m, longest_m) in zip(ranges, promised, strict=True):
        assert low_m <= shortest_m
        assert high_m >= longest_m


def test_robust_rows_of_the_flexible_arm_hold_its_range(designs: dict[str, DesignFile]) -> None:
    low_hz, high_hz = designs["flexible-arm"].plant.frequency_hz
    for shaper in designs["flexible-arm"].shapers[1:]:
        assert shaper.taps is not None
        assert shaper.taps.guarantee.frequency_hz[0] <= low_hz
        assert shaper.taps.guarantee.frequency_hz[1] >= high_hz
