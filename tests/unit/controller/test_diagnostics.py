"""Diagnostics of a block at work: optional, beside the law, and refusing tables of another design."""

from dataclasses import replace

import numpy as np
import pytest

from swayless.controller import Bank, CommandShaper, ShaperInput, Status
from swayless.controller.checksum import checksum
from swayless.controller.diagnostics import DesignFacts, Diagnostics
from swayless.controller.rope_bound import rope_bounds
from swayless.controller.status import ERROR_BITS
from swayless.controller.sway import sway_settings
from swayless.controller.sway_model import sway_model
from swayless.controller.tables import design_facts, tables_of
from swayless.controller.tracking import TrackingSettings
from swayless.errors import ControllerError
from tests.compiled.phase_blocks import chosen_by_rope
from tests.properties.strategies import NUMBERS
from tests.unit.controller.blocks import EI, UM_ZV, ZVD, block, command_of, phase_block, press, run
from tests.unit.controller.spaced_blocks import rope_block
from tests.unit.controller.test_checksum import (
    changed,
    doubles_with_one_bit_changed,
    floats_with_one_bit_changed,
    wholes_with_one_bit_changed,
)

DESIGN_ID = 0xCAFE_F00D


def diagnosed(settings, *, tracking=False):
    """The block with every diagnostic that it can have."""
    limits = settings.limits
    asked = Diagnostics(
        sway=sway_settings(settings.bank, limits, settings.rope),
        rope_bounds=None if settings.rope is None else rope_bounds(settings.bank, settings.rope),
        tracking=TrackingSettings(limits.max_command / 10, 5, 3) if tracking else None,
    )
    settings = replace(settings, diagnostics=asked)
    return replace(settings, diagnostics=replace(asked, facts=design_facts(settings, DESIGN_ID)))


BLOCKS = {
    "ticks": lambda number: block(ZVD, UM_ZV, number=number),
    "phase": phase_block,
    "modified": rope_block,
}


def moves(settings, seed=1):
    """Moves with a knob that turns, on a rope that changes where one is measured."""
    generator = np.random.default_rng(seed)
    inputs = []
    for _ in range(12):
        piece = press(settings, generator.uniform(-1.0, 1.0), 40, selector=int(generator.integers(0, 3)))
        inputs += piece
    if settings.rope is None:
        return inputs
    ropes = np.linspace(float(settings.rope.longest), float(settings.rope.shortest), len(inputs))
    scalar = settings.number.scalar
    lengths = [scalar(round(each)) if settings.number.is_integer else scalar(each) for each in ropes]
    zero = scalar(0)
    return [
        each._replace(rope_length=length, hoist_speed=zero)
        for each, length in zip(inputs, lengths, strict=True)
    ]


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("kind", BLOCKS)
def test_diagnostics_change_nothing_of_what_a_block_does(kind, number):
    plain = BLOCKS[kind](number)
    told = diagnosed(plain)
    for bare, full in zip(
        run(CommandShaper(plain), moves(plain)), run(CommandShaper(told), moves(told)), strict=True
    ):
        same = {"residual_bound": 0, "predicted_sway": 0, "design_id": 0}
        assert bare._replace(**same) == full._replace(**same)
        assert (bare.predicted_sway, bare.design_id) == (0, 0)


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("kind", BLOCKS)
def test_predicted_sway_is_that_of_the_reference_that_the_block_puts_out(kind, number):
    settings = diagnosed(BLOCKS[kind](number))
    model = sway_model(settings.diagnostics.sway)
    inputs = moves(settings)
    found = run(CommandShaper(settings), inputs)
    assert any(out.predicted_sway != 0 for out in found)
    for given, out in zip(inputs, found, strict=True):
        assert out.predicted_sway == model.step(out.reference, out.row, given.rope_length)


@pytest.mark.parametrize("number", NUMBERS)
def test_the_residual_bound_is_that_of_the_rope_of_now_and_all_of_it_where_the_rope_is_not_known(number):
    settings = diagnosed(rope_block(number))
    bounds = settings.diagnostics.rope_bounds
    shaper, everything = CommandShaper(settings), 1_000_000 if number == "int32" else 1.0
    scalar = settings.number.scalar
    units_per_m = 1000 if number == "int32" else 1
    still = ShaperInput(scalar(0), hoist_speed=scalar(0))
    for length_m in (3.0, 4.0, 8.9):
        length = scalar(round(length_m * units_per_m) if number == "int32" else length_m)
        out = shaper.step(still._replace(rope_length=length))
        assert out.residual_bound == bounds.at(1, length)
        unknown = shaper.step(still._replace(rope_length=length, rope_length_valid=False))
        assert unknown.residual_bound == everything
        far = shaper.step(still._replace(rope_length=scalar(99 * units_per_m)))
        assert far.residual_bound == everything
    assert shaper.step(still._replace(rope_length=length, selector=0)).residual_bound == everything
    stopped = shaper.step(still._replace(rope_length=length, emergency_stop=True))
    assert stopped.residual_bound == everything


def test_the_phase_clock_keeps_the_bound_of_its_row():
    settings = diagnosed(phase_block())
    out = CommandShaper(settings).step(ShaperInput(0.0, rope_length=5.0))
    assert out.residual_bound == settings.row_tables[1].residual_bound_ratio


def test_a_drive_that_does_not_follow_is_an_error_but_not_in_an_emergency_stop():
    settings = diagnosed(block(ZVD), tracking=True)
    shaper = CommandShaper(settings)
    full = ShaperInput(command_of(settings, 1.0))
    outs = [shaper.step(full._replace(actual_speed=0.0)) for _ in range(60)]
    assert [bool(out.status & Status.TRACKING) for out in outs].index(True) < 40
    assert outs[-1].error
    stopped = shaper.step(full._replace(emergency_stop=True, actual_speed=0.4))
    assert not stopped.status & Status.TRACKING
    follows = CommandShaper(settings)
    actual = 0.0
    for _ in range(60):
        out = follows.step(full._replace(actual_speed=actual))
        actual = out.reference
        assert not out.status & Status.TRACKING


def test_the_bits_of_diagnostics_are_errors_and_belong_to_blocks_that_have_them():
    assert Status.TRACKING in ERROR_BITS
    assert Status.TABLES_INVALID in ERROR_BITS
    plain = block(ZVD)
    assert not {Status.TRACKING, Status.TABLES_INVALID} & set(plain.status_bits)
    assert {Status.TRACKING, Status.TABLES_INVALID} < set(diagnosed(plain, tracking=True).status_bits)


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("kind", BLOCKS)
def test_tables_of_another_design_are_refused_for_ever(kind, number):
    settings = diagnosed(BLOCKS[kind](number))
    facts = settings.diagnostics.facts
    other = DesignFacts(facts.design_id, facts.checksum._replace(second=(facts.checksum.second + 1) % 65537))
    shaper = CommandShaper(replace(settings, diagnostics=replace(settings.diagnostics, facts=other)))
    for _ in range(2):
        for given in moves(settings):
            out = shaper.step(given)
            assert out.reference == out.stop_distance == out.predicted_sway == 0
            assert out.error
            assert not out.active
            assert out.status == Status.TABLES_INVALID | Status.UNSHAPED
            assert out.design_id == DESIGN_ID
        shaper.init()
    assert CommandShaper(settings).step(moves(settings)[0]).status & Status.TABLES_INVALID == 0


FLIPS = {
    "double": doubles_with_one_bit_changed,
    "float": floats_with_one_bit_changed,
    "int32": wholes_with_one_bit_changed,
}


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("kind", [*BLOCKS, "rope rows"])
def test_no_single_bit_of_any_table_of_a_block_changes_unseen(kind, number):
    settings = diagnosed(chosen_by_rope(number) if kind == "rope rows" else BLOCKS[kind](number))
    for table in tables_of(settings):
        flips = wholes_with_one_bit_changed if table.limit is None else FLIPS[number]
        for each in table.numbers:
            # Both sums are linear: what a number changes in its own, it changes in those of all tables.
            alone = replace(table, numbers=(each,))
            found = checksum([alone])
            assert found is not None
            for other in changed(alone, flips):
                assert checksum([other]) != found or other.numbers == (each,), table.name


def test_facts_of_more_than_32_bits_are_refused():
    settings = block(ZVD)
    with pytest.raises(ControllerError, match="design_id = 4294967296: must be 0 to 4294967295"):
        design_facts(settings, 1 << 32)


def test_diagnostics_of_another_block_are_refused():
    one, two, rope = block(ZVD), block(ZVD, EI), rope_block()
    sway, bounds = sway_settings(one.bank, one.limits), rope_bounds(rope.bank, rope.rope)
    with pytest.raises(ControllerError, match="1 turns for 2 rows"):
        replace(two, diagnostics=Diagnostics(sway=sway))
    with pytest.raises(ControllerError, match="in double: the block runs in float"):
        replace(block(ZVD, number="float"), diagnostics=Diagnostics(sway=sway))
    with pytest.raises(ControllerError, match="follows the measured rope exactly where there is one"):
        replace(rope, diagnostics=Diagnostics(sway=sway))
    with pytest.raises(ControllerError, match="need a measured rope"):
        replace(one, diagnostics=Diagnostics(rope_bounds=bounds))
    with pytest.raises(ControllerError, match="and 2 rows"):
        replace(rope, bank=Bank(rope.bank.rows * 2), diagnostics=Diagnostics(rope_bounds=bounds))
