"""Prove generated adaptive shapers against their reference, bit for bit. Not for: command shapers."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import ExitStack

import numpy as np
from numpy.typing import NDArray

from swayless.codegen.adaptive_files import adaptive_harness
from swayless.codegen.adaptive_model import INPUTS, OUTPUTS, AdaptiveModel
from swayless.codegen.render import GeneratedFile
from swayless.controller.adaptive import AdaptiveInput, AdaptiveSettings, AdaptiveShaper
from swayless.controller.adaptive.shaper import LARGEST_VIBRATION
from swayless.plant.mode import Mode
from swayless.plant.simulation.flexible_robot import FlexibleRobot
from swayless.verify.c_run import CompiledProgram
from swayless.verify.comparison import compare
from swayless.verify.records import record_of
from swayless.verify.st_run import EvaluatedProgram
from swayless.verify.stimulus import Stimulus
from swayless.verify.toolchain import Compiler
from swayless.verify.verification import Verdict

MOVES, FEWEST_MOVES = 40, 4
"""Moves of each stimulus: as many as fit into its ticks."""

LONGEST_TICKS = 100_000
"""Ticks of a stimulus of more than the fewest moves: long delays take long rests."""

NOISE_RATIO = 0.05
"""Measurement noise, relative to the vibration that counts as 1."""


LONGEST_SOAK = 100_000
"""Ticks: the reference runs them in some seconds."""

_MOVES_ALIKE, _SOAK = 6, "soak"


def verify_adaptive(
    model: AdaptiveModel,
    *,
    c_files: Sequence[GeneratedFile] = (),
    st_files: Sequence[GeneratedFile] = (),
    compiler: Compiler | None = None,
    soak_ticks: int = 0,
) -> Iterator[Verdict]:
    """Run generated code and its reference over every stimulus and compare all outputs bit for bit.

    Parameters
    ----------
    model : AdaptiveModel
        The block; the reference of its settings is what generated code is compared with.
    c_files, st_files : sequence of GeneratedFile
        What to verify; an empty sequence leaves the language out.
    compiler : Compiler
        Needed for `c_files`.
    soak_ticks : int
        Length of a long run of the C, up to `LONGEST_SOAK`; 0 leaves it out.

    Yields
    ------
    Verdict
        One for each stimulus and language.

    Raises
    ------
    VerificationError
        If the code does not compile or run at all.
    ToolMissingError
        If the Structured Text parser is missing.
    """
    number, outputs = model.settings.number.name, record_of(OUTPUTS, model.settings.number)
    with ExitStack() as stack:
        runs: list[tuple[str, CompiledProgram | EvaluatedProgram]] = []
        if c_files and compiler is not None:
            program = CompiledProgram(c_files, adaptive_harness(model), compiler, outputs)
            runs.append((f"C by {compiler.name}, {number}", stack.enter_context(program)))
        for file in st_files:
            runs.append((f"ST by evaluator, {model.st_real}", EvaluatedProgram(file.text, outputs)))
        for stimulus in adaptive_stimuli(model.settings, soak_ticks if c_files else 0):
            expected = run_adaptive_reference(model.settings, stimulus.inputs)
            for code, run in runs[:1] if stimulus.name == _SOAK else runs:
                found = compare(expected, run.run(stimulus.inputs))
                yield Verdict(code, stimulus.name, expected.size, found)


def run_adaptive_reference(settings: AdaptiveSettings, inputs: NDArray[np.void]) -> NDArray[np.void]:
    """Run the reference over recorded inputs.

    Parameters
    ----------
    settings : AdaptiveSettings
        The block.
    inputs : structured ndarray, shape (ticks,)
        Fields `enable`, `command` and `vibration`.
    """
    shaper, scalar = AdaptiveShaper(settings), settings.number.scalar
    outputs = np.zeros(inputs.size, dtype=record_of(OUTPUTS, settings.number))
    columns = (inputs[name].tolist() for name in ("command", "vibration", "enable"))
    for tick, (command, vibration, enable) in enumerate(zip(*columns, strict=True)):
        found = shaper.step(AdaptiveInput(scalar(command), scalar(vibration), enable))
        outputs[tick] = (
            found.reference,
            *found.coefficient,
            found.adapting,
            found.converged,
            found.frozen,
            found.status,
        )
    return outputs


def adaptive_stimuli(settings: AdaptiveSettings, soak_ticks: int = 0) -> Iterator[Stimulus]:
    """Make every stimulus: a robot with two payloads under the block, bad readings, and what no robot does.

    Parameters
    ----------
    settings : AdaptiveSettings
        The block.
    soak_ticks : int
        Length of the last one, up to `LONGEST_SOAK`; 0 leaves it out.
    """
    yield Stimulus("moves without noise", _closed_loop(settings, 0.0, seed=1))
    noisy = _closed_loop(settings, NOISE_RATIO, seed=2)
    yield Stimulus("moves with noise", noisy)
    yield Stimulus("bad readings", _spoilt(settings, noisy, seed=3))
    yield Stimulus("noise alone", _noise_alone(settings, seed=4))
    yield Stimulus("any two poles", _any_two_poles(settings, _moves(settings), seed=18))
    if soak_ticks:
        ticks = min(soak_ticks, LONGEST_SOAK)
        moves = -(-ticks // _move_ticks(settings))
        yield Stimulus(_SOAK, _any_two_poles(settings, moves, seed=10)[:ticks])


def _closed_loop(settings: AdaptiveSettings, noise: float, *, seed: int) -> NDArray[np.void]:
    """Let a robot of 0.4 periods a delay move at random, then with another payload."""
    random = np.random.default_rng(seed)
    moves = _moves(settings)
    lasts = np.full(moves, _move_ticks(settings))
    too_short = settings.quiet_ticks + settings.window_ticks
    lasts[2::3] = random.integers(1, too_short, lasts[2::3].size)  # windows are put together
    inputs = _blank(settings, int(lasts.sum()))
    inputs["command"] = np.repeat(random.uniform(-1.0, 1.0, moves) * settings.max_command, lasts)
    delay_s = settings.delay_ticks * settings.tick_s
    robot = FlexibleRobot(Mode(0.4 / delay_s, 0.01), settings.tick_s)
    per_speed = settings.vibration_scale * delay_s / (2.5 * settings.max_command)
    errors = noise * settings.vibration_scale * random.standard_normal(inputs.size)
    shaper, scalar, vibration = AdaptiveShaper(settings), settings.number.scalar, 0.0
    for tick, (command, error) in enumerate(zip(inputs["command"].tolist(), errors.tolist(), strict=True)):
        if tick == inputs.size // 2:
            robot.load(Mode(0.2 / delay_s, 0.05))  # sinks into noise within a rest
        inputs["vibration"][tick] = vibration + error
        pins = AdaptiveInput(scalar(command), scalar(inputs["vibration"][tick]))
        vibration = per_speed * robot.step(float(shaper.step(pins).reference))
    return inputs


def _spoilt(settings: AdaptiveSettings, inputs: NDArray[np.void], *, seed: int) -> NDArray[np.void]:
    """Put values into good inputs that are not finite, too large or tiny, and switch the block off and on."""
    random, spoilt = np.random.default_rng(seed), inputs.copy()
    info = np.finfo(inputs["command"].dtype)
    odd = [np.nan, np.inf, -np.inf, info.max, -info.max, info.tiny, -0.0]
    largest = {"command": settings.max_command, "vibration": LARGEST_VIBRATION * settings.vibration_scale}
    for name, most in largest.items():
        ticks = random.integers(0, inputs.size, 4 * (len(odd) + 1))
        spoilt[name][ticks] = np.resize([*odd, most], ticks.size)
    spoilt["enable"] = np.repeat(random.random(_moves(settings)) > 0.2, _move_ticks(settings))[: inputs.size]
    return spoilt


def _noise_alone(settings: AdaptiveSettings, *, seed: int) -> NDArray[np.void]:
    """Hold the command, and let the measurement be anything from tiny noise to more than it may be."""
    moves, move_ticks = _moves(settings), _move_ticks(settings)
    random, inputs = np.random.default_rng(seed), _blank(settings, moves * move_ticks)
    sizes = np.repeat(np.geomspace(1e-30, 200.0, moves), move_ticks) * settings.vibration_scale
    inputs["vibration"] = sizes * random.standard_normal(inputs.size)
    return inputs


def _any_two_poles(settings: AdaptiveSettings, moves: int, *, seed: int) -> NDArray[np.void]:
    """Let poles, offset and noise of what is measured change from move to move, by little or by much.

    Two real poles of unlike sign, which no robot has, ask for a last amplitude below 0. Sets that hardly fit,
    or are hardly allowed, tell every limit and weight from one that is a little different.
    """
    random, move_ticks = np.random.default_rng(seed), _move_ticks(settings)
    offset, noise = (10.0 ** random.uniform(-6.0, high, (moves, 1)) for high in (0.0, -0.7))
    places = np.repeat(random.uniform([-0.3, -1.5], [1.5, 0.3], (moves, 2)), _MOVES_ALIKE, axis=0)[:moves]
    places += (noise + 0.004) * random.uniform(-6.0, 6.0, (moves, 2))
    product, sine = 0.99 * np.sin(places).T
    total = (1.0 + product) * sine  # both poles within the unit circle
    readings = list(random.standard_normal((2, moves, settings.delay_ticks)))
    for _ in range(2, -(-move_ticks // settings.delay_ticks)):
        readings.append(total[:, None] * readings[-1] - product[:, None] * readings[-2])
    vibration = np.stack(readings, axis=1).reshape(moves, -1)[:, :move_ticks]
    inputs = _blank(settings, vibration.size)
    inputs["command"] = settings.max_command * np.repeat(random.uniform(-1.0, 1.0, moves), move_ticks)
    measured = vibration + offset + noise * random.standard_normal(vibration.shape)
    inputs["vibration"] = settings.vibration_scale * measured.ravel()
    return inputs


def _moves(settings: AdaptiveSettings) -> int:
    """So many moves has a stimulus."""
    return min(MOVES, max(FEWEST_MOVES, LONGEST_TICKS // _move_ticks(settings)))


def _move_ticks(settings: AdaptiveSettings) -> int:
    """So long lasts a move at most: until the vibration is free, and two windows and a half."""
    return settings.quiet_ticks + (5 * settings.window_ticks) // 2


def _blank(settings: AdaptiveSettings, ticks: int) -> NDArray[np.void]:
    inputs = np.zeros(ticks, dtype=record_of(INPUTS, settings.number))
    inputs["enable"] = True
    return inputs
