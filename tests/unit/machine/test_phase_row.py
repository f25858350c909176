"""Machine files with `law = "phase"`: read, designed, stored and run, or refused with every reason."""

from pathlib import Path

import numpy as np
import pytest

from swayless.controller.phase_taps import worst_still_residual
from swayless.errors import DesignError, FileError
from swayless.machine import example_text, load_design, load_machine, save_text
from swayless.machine.designing import design_machine
from swayless.machine.running import shaper_settings, stored_taps

GOOD = example_text("hoisting-gantry")


def made(folder: Path, *changes: tuple[str, str]):
    text = GOOD
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    path = folder / "crane.toml"
    path.write_text(text)
    return design_machine(load_machine(path))


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        ('hoist_speed = "0.4 m/s"', "", "[crane] hoist_speed: missing"),
        ("rope_length = [3, 9]", "rope_length = 5", "needs two lengths"),
        ("rope_length = [3, 9]", "frequency = [0.2, 0.3]", "it needs a [crane] with its shortest and"),
        ("[crane]", "[crane]\nsling_length = 1\nhook_mass = 1\nload_mass = 1", "without a sling"),
        ('family = "zvd"', 'family = "um-zv"', 'unknown family for law = "phase"'),
        ('family = "zvd"', 'family = "si"', 'unknown family for law = "phase"'),
        ('family = "zvd"', 'family = "zvd"\nrope_length = 5', "the phase clock follows the rope"),
        ("[controller]", "[drive]\ncontactor = true\n[controller]", "contactor"),
    ],
)
def test_what_the_phase_clock_cannot_follow_is_refused(tmp_path, old, new, reason):
    with pytest.raises(FileError) as caught:
        made(tmp_path, (old, new))
    assert any(reason in problem for problem in caught.value.problems)


@pytest.mark.parametrize("family", ["zv", "zvd", "zvdd", "ei", "ei2", "ei3"])
@pytest.mark.parametrize(("tick", "damping"), [("10 ms", 0.0), ("40 ms", 0.05)])
def test_every_positive_family_holds_its_tolerance_on_any_still_rope(tmp_path, family, tick, damping):
    design = made(
        tmp_path,
        ('"zvd"', f'"{family}"'),
        ('"10 ms"', f'"{tick}"'),
        ("damping_ratio = 0.0", f"damping_ratio = {damping}"),
    )
    settings = shaper_settings(design)
    taps = settings.bank.rows[0].taps
    assert worst_still_residual(taps) <= 0.05
    for shaper in design.shapers:
        assert shaper.taps.guarantee.rope_length_m == (3.0, 9.0)


def test_a_stored_design_gives_the_same_block_in_every_number_type(tmp_path):
    design = made(tmp_path, ("[controller]", "[drive]\ncounts_per_m_s = 20000\n[controller]"))
    path = tmp_path / "stored.json"
    path.write_text(save_text(design))
    assert load_design(path) == design
    for number in ("double", "float", "int32"):
        fresh, stored = (shaper_settings(each, number=number) for each in (design, load_design(path)))
        assert fresh.clock.nodes == stored.clock.nodes
        assert np.array_equal(fresh.bank.rows[0].taps.lags, stored.bank.rows[0].taps.lags)


def test_on_a_still_rope_the_taps_lie_on_neighbouring_ticks(tmp_path):
    (taps,) = stored_taps(made(tmp_path))
    assert taps.delays_ticks.tolist() == [0, 300, 301, 601, 602]
    assert taps.amplitudes.sum() == pytest.approx(1.0, abs=1e-15)


def test_a_tick_longer_than_a_tap_is_refused(tmp_path):
    with pytest.raises(DesignError, match="a finer tick, or a longer shortest rope, does"):
        made(tmp_path, ("rope_length = [3, 9]", "rope_length = [0.01, 0.02]"), ('"10 ms"', '"200 ms"'))
