"""Diagnostics under any history: beside the law, bounded, and without false alarms."""

from dataclasses import replace

from hypothesis import given
from hypothesis import strategies as st

from swayless.controller import CommandShaper
from swayless.controller.checksum import checksum, real_table, whole_table
from swayless.controller.diagnostics import Diagnostics
from swayless.controller.number import number_type
from swayless.controller.status import Status
from swayless.controller.sway import sway_settings
from swayless.controller.tables import design_facts
from swayless.controller.tracking import TrackingSettings
from tests.properties.phase_histories import phase_blocks, travelling
from tests.properties.strategies import blocks, examples, segments
from tests.unit.controller.test_checksum import (
    changed,
    doubles_with_one_bit_changed,
    wholes_with_one_bit_changed,
)


def diagnosed(settings, tracking):
    """The block with a model of its load, a monitor and its facts."""
    asked = Diagnostics(sway=sway_settings(settings.bank, settings.limits, settings.rope), tracking=tracking)
    settings = replace(settings, diagnostics=asked)
    return replace(settings, diagnostics=replace(asked, facts=design_facts(settings, 7)))


def farthest_sway(sway):
    """Where the model ends, in m, in int32 in mm."""
    if sway.rope is None:
        metres = max(turn.metres for turn in sway.turns)
    elif sway.number.is_integer:
        metres = sway.rope.metres // sway.rope.clock.fewest_quanta
    else:
        metres = sway.rope.metres * (1 / sway.number.scalar(sway.rope.clock.fewest_quanta))
    if not sway.number.is_integer:
        return sway.largest * metres
    return ((sway.largest * metres) + ((1 << sway.metres_shift) >> 1)) >> sway.metres_shift


@st.composite
def blocks_with_histories(draw):
    """A block of either clock, and a history with stops."""
    if draw(st.booleans()):
        settings = draw(blocks(optional=True))
        return settings, draw(segments(settings, stops=True))
    settings = draw(phase_blocks())
    return settings, draw(travelling(settings, stops=True, selectors=True))


@examples(60)
@given(blocks_with_histories(), st.integers(1, 30), st.integers(0, 9))
def test_they_change_nothing_keep_their_bounds_and_tell_of_no_drive_that_is_late_by_the_delay(
    made, late, time_ticks
):
    settings, inputs = made
    tolerance = settings.number.scalar(settings.limits.max_command / 8)
    told = diagnosed(settings, TrackingSettings(tolerance, time_ticks, window_ticks=late + 1))
    plain, full = CommandShaper(settings), CommandShaper(told)
    farthest = farthest_sway(told.diagnostics.sway)
    references = [settings.number.scalar(0)] * late
    for each in inputs:
        bare = plain.step(each)
        out = full.step(each._replace(actual_speed=references[-late]))
        references.append(out.reference)
        assert out._replace(predicted_sway=0, design_id=0) == bare
        assert -farthest <= out.predicted_sway <= farthest
        assert not out.status & Status.TRACKING


@examples(30)
@given(st.lists(st.floats(-50.0, 50.0).map(lambda x: round(x, 6)), min_size=1, max_size=6), st.data())
def test_a_changed_bit_is_seen_in_any_table(reals, data):
    table = real_table("any", reals, number_type("double"))
    for other in changed(table, doubles_with_one_bit_changed):
        assert checksum([other]) != checksum([table]) or other.numbers == table.numbers
    wholes = whole_table("any", data.draw(st.lists(st.integers(-(2**31), 2**31 - 1), min_size=1, max_size=6)))
    for other in changed(wholes, wholes_with_one_bit_changed):
        assert checksum([other]) != checksum([wholes])
