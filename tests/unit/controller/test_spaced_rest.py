"""When a block whose taps follow a spacing has settled: a spacing that trembles takes back rest, not more."""

import pytest

from swayless.controller import CommandShaper, ShaperInput
from tests.unit.controller.blocks import command_of, run
from tests.unit.controller.spaced_blocks import position_of, spaced_block


@pytest.mark.parametrize("number", ["double", "float", "int32"])
@pytest.mark.parametrize("law", ["original", "modified"])
def test_a_block_settles_within_the_longest_delay_however_long_the_spacing_has_trembled(law, number):
    settings = spaced_block(number, law, amplitudes=[0.25, 0.5, 0.25], ticks=[5, 6])
    held = [ShaperInput(command_of(settings, 1.0), rope_length=position_of(settings, t)) for t in (5, 6)]
    shaper = CommandShaper(settings)
    run(shaper, held * 1000)
    last = settings.longest_delay_ticks
    assert [out.settled for out in run(shaper, held[1:] * (last + 1))][-1]


@pytest.mark.parametrize("number", ["double", "float", "int32"])
def test_a_tremble_before_rest_takes_back_all_of_it_and_no_more(number):
    settings = spaced_block(number, "original", amplitudes=[0.25, 0.5, 0.25], ticks=[5, 6])
    near, far = (ShaperInput(command_of(settings, 1.0), rope_length=position_of(settings, t)) for t in (5, 6))
    shaper, last = CommandShaper(settings), settings.longest_delay_ticks
    while not shaper.step(near).settled:
        pass
    run(shaper, [far])
    for _ in range(4):
        run(shaper, [far] * (last // 2) + [near] * (last // 2))
    settled = [out.settled for out in run(shaper, [near] * (last + 1))]
    # The last change of the spacing is half a delay ago.
    assert settled.index(True) == last - last // 2
