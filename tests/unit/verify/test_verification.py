"""Verification finds what is wrong: code changed by hand, in C and in Structured Text, is told apart."""

from pathlib import Path

import numpy as np
import pytest

from swayless.cli.generate import provenance
from swayless.codegen import GeneratedFile, generate
from swayless.machine import load_machine
from swayless.machine.designing import design_machine
from swayless.machine.running import shaper_settings
from swayless.verify import find_compiler, verify_block
from swayless.verify.comparison import compare
from swayless.verify.records import input_dtype
from swayless.verify.stimulus import soak, stimuli

EXAMPLES = Path(__file__).parents[3] / "examples"


@pytest.fixture(scope="module")
def block():
    design = design_machine(load_machine(EXAMPLES / "srtc-gantry.toml"))
    return shaper_settings(design), provenance(design)


def changed(files, old, new):
    assert any(old in file.text for file in files)
    return [GeneratedFile(file.path, file.text.replace(old, new)) for file in files]


CHANGES = [
    ("c", "s->fresh + (command - lap)", "s->fresh + (reference - lap)"),
    ("c", "s->still_ticks += 1u;", "s->still_ticks += 2u;"),
    ("c", "if (s->emergency ||", "if ((s->emergency && s->quick) ||"),
    ("c", "status |= SRTC_GANTRY_SHAPER_ROW_WAITS;", "status |= SRTC_GANTRY_SHAPER_UNSHAPED;"),
    ("st", "LapSum := ReferenceNow;", "LapSum := 0.0;"),
    ("st", "StillTicks := StillTicks + 1;", "StillTicks := StillTicks + 2;"),
    ("st", "Status := Bits;", "Status := Bits + 1;"),
]


@pytest.mark.parametrize(("target", "old", "new"), CHANGES, ids=lambda text: text[:24])
def test_a_changed_line_is_found(block, target, old, new):
    settings, origin = block
    files = changed(generate(settings, origin, target), old, new)
    asked = {"c_files": files, "compiler": find_compiler()} if target == "c" else {"st_files": files}
    verdicts = list(verify_block(settings, origin, soak_ticks=0, **asked))
    assert any(not verdict.comparison.is_equal for verdict in verdicts)


def test_stimuli_toggle_every_input_and_repeat_with_their_seed(block):
    settings, _ = block
    made = list(stimuli(settings, ticks=5000))
    again = list(stimuli(settings, ticks=5000))
    everything = np.concatenate([stimulus.inputs for stimulus in made])
    assert everything.dtype == input_dtype(settings)
    for name in ("enable", "emergency_stop", "quick_stop"):
        assert set(everything[name].tolist()) == {False, True}
    assert set(range(6)) - {5} <= set(everything["selector"].tolist())
    commands = everything["command"]
    assert np.isnan(commands).any()
    assert np.isinf(commands).any()
    assert (np.abs(commands[np.isfinite(commands)]) > settings.limits.max_command).any()
    assert all(compare(one.inputs, other.inputs).is_equal for one, other in zip(made, again, strict=True))
    assert soak(settings, ticks=1234).inputs.size == 1234
