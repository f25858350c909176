"""Nothing drifts, and the hand-worked examples of the design come out."""

import numpy as np
import pytest

from swayless.controller import CommandShaper, ShaperInput, Status, explain
from swayless.controller.command_shaper import ShaperOutput
from tests.unit.controller.blocks import EI, TICK_S, ZVD, block, press, run

TICKS = 300_000


def test_stop_distance_in_float_does_not_drift_under_a_command_that_never_rests():
    settings = block(EI, number="float", acceleration_m_s2=None)
    shaper, scalar = CommandShaper(settings), settings.number.scalar
    commands = np.random.default_rng(5).uniform(-0.5, 0.5, TICKS).astype(np.float32)
    distances = np.array([shaper.step(ShaperInput(scalar(command))).stop_distance for command in commands])
    # Each command still has to come by the amplitudes that it has not met: exact in float64 to 1e-15.
    delays = np.array([delay for delay, _ in EI])
    amplitudes = np.array(settings.row_tables[1].amplitudes, dtype=np.float64)
    left = np.array([amplitudes[delays > age].sum() for age in range(settings.longest_delay_ticks)])
    exact_m = np.convolve(commands.astype(np.float64), left)[:TICKS] * TICK_S
    # Two laps of 7 ticks: 28 sums below 4 m/s x ticks, each rounded by 2**-23 at most.
    assert np.abs(distances - exact_m).max() <= 28 * 2.0**-23 * TICK_S


def test_a_full_step_of_zvd_comes_in_quarters():
    settings = block(ZVD, acceleration_m_s2=None)
    outs = run(CommandShaper(settings), press(settings, 1.0, 10))
    assert [out.reference for out in outs] == [0.125] * 4 + [0.375] * 4 + [0.5] * 2
    # Half a metre per second for the mean delay of 4 ticks is still to come once the way is clear.
    assert outs[-1].stop_distance == pytest.approx(0.5 * 4 * TICK_S, rel=1e-15)
    assert outs[-1].stop_time_ticks == 8 + 1
    assert outs[-1].stop_time_s == pytest.approx(9 * TICK_S, rel=1e-15)


def test_every_status_bit_is_explained_in_one_line():
    assert all(explain(bit) and "\n" not in explain(bit) for bit in Status)


def test_outputs_are_the_fields_of_the_generated_block():
    assert ShaperOutput._fields[:3] == ("reference", "stop_distance", "stop_time_s")
