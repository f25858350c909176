"""The page of the adaptive shaper lists the bits and pins that there are."""

from pathlib import Path

from swayless.codegen.adaptive_model import INPUTS, OUTPUTS
from swayless.controller.adaptive import AdaptiveStatus, explain_adaptive

PAGE = (Path(__file__).parents[3] / "docs" / "adaptive.md").read_text(encoding="utf-8")


def test_every_bit_is_on_the_page_with_its_meaning():
    for bit in AdaptiveStatus:
        assert f"| {int(bit)} | `{bit.name}` | {explain_adaptive(bit)} |" in PAGE


def test_every_pin_is_on_the_page():
    for pin in (*INPUTS, *OUTPUTS):
        if pin.kind == "real" and pin.c_name.startswith("coefficient"):
            continue
        assert f"| `{pin.c_name}` | `{pin.st_name}` |" in PAGE
    assert "| `coefficient[3]` | `Coefficient0` to `Coefficient2` |" in PAGE
