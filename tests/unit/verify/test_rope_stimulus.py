"""Ropes and positions of the stimuli: within the range, through every spacing, over each place of change."""

from itertools import pairwise

import numpy as np
import pytest

from swayless.controller.spacing_filter import spacing_of
from swayless.verify.builder import Builder
from swayless.verify.rope_stimulus import wandering
from swayless.verify.stimulus import stimuli
from tests.compiled.spacing_blocks import BLOCKS


@pytest.mark.parametrize("number", ["double", "float", "int32"])
@pytest.mark.parametrize("name", BLOCKS)
def test_a_position_wanders_through_every_spacing_and_to_and_fro_where_it_changes(name, number):
    settings = BLOCKS[name]("modified", number)
    build = Builder(settings, 1)
    inputs = wandering(build, build.blank(5000))
    lengths, starts = inputs["rope_length"], np.array(spacing_of(settings).starts)
    assert settings.rope.shortest <= lengths.min() <= lengths.max() <= settings.rope.longest
    assert set(starts.tolist()) <= set(lengths.tolist())
    pieces = np.searchsorted(starts, lengths, side="right")
    changes = {(a, b) for a, b in pairwise(pieces.tolist()) if a != b}
    ups = {(k, k + 1) for k in range(1, len(starts))}
    assert changes == ups | {(b, a) for a, b in ups}


def test_only_blocks_whose_taps_follow_a_spacing_wander():
    names = [stimulus.name for stimulus in stimuli(BLOCKS["jumping"]("original", "double"), ticks=50)]
    assert names[-1] == "steps, every spacing"
