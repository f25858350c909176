from __future__ import annotations

import re
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[2] / "docs"
GOLDEN = Path(__file__).parents[1] / "golden"


def _example_in(page: str, language: str, which: int = 0) -> str:
    found = re.findall(rf"```{language}\n(.*?)```", (DOCS / page).read_text(encoding="utf-8"), re.DOTALL)
    assert found, f"{page} has no {language} example"
    return str(found[which])


@pytest.fixture(scope="session")
def machine_text() -> str:
    """The complete machine file of the documentation."""
    return _example_in("machine-file.md", "toml")


@pytest.fixture(scope="session")
def arm_text() -> str:
    """The machine file of the documentation whose vibration depends on a position."""
    return _example_in("machine-file.md", "toml", 2)


@pytest.fixture(scope="session")
def machine_texts(machine_text: str, arm_text: str) -> tuple[str, ...]:
    """Machine files whose keys are different."""
    return machine_text, arm_text


@pytest.fixture(scope="session")
def design_text() -> str:
    """The complete design file of the documentation."""
    return _example_in("design-file.md", "json")


@pytest.fixture(scope="session")
def design_texts(design_text: str) -> tuple[str, ...]:
    """Design files whose keys are different."""
    return design_text, (GOLDEN / "elbow-arm" / "elbow_arm.design.json").read_text(encoding="utf-8")
