"""Some moves under an adaptive shaper, simulated for a figure. Not for: proving the block."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from swayless.controller.adaptive import AdaptiveSettings
    from swayless.machine.adaptive_file import AdaptiveMachine
    from swayless.plant import Mode
    from swayless.report.adaptive import PlottedLearning

MOVES, UNSHAPED_MOVES = 12, 2
"""Moves that are drawn; the block begins to shape after the first two, there and back."""

NOISE_RATIO = 0.05
"""Rms of the noise, relative to what an unshaped move leaves."""

PERIODS_PER_DELAY, DAMPING_RATIO = 0.4, 0.01
"""The vibration where the file knows none, and its damping where it knows none."""

_WINDOWS_PER_REST = 3
_MOST_DELAY_TICKS = 50


def simulated_learning(machine: AdaptiveMachine) -> PlottedLearning:
    """Let the block learn the file's vibration, or one that suits its delay, from steps there and back.

    A delay of many ticks is simulated with fewer: the figure is the same, and soon there.

    Parameters
    ----------
    machine : AdaptiveMachine
        As its file describes it.
    """
    import numpy as np

    from swayless.controller.adaptive import AdaptiveInput, AdaptiveShaper, AdaptiveStatus
    from swayless.design.families.closed_form import delay_filter
    from swayless.plant.simulation.flexible_robot import FlexibleRobot
    from swayless.report.adaptive import PlottedLearning

    mode, settings = _mode(machine.settings), _coarse(machine.settings)
    scalar, scale = settings.number.scalar, settings.vibration_scale
    move_ticks = settings.cycle_ticks // UNSHAPED_MOVES
    commands = np.repeat(np.arange(1, MOVES + 1) % 2, move_ticks).tolist()
    noise = NOISE_RATIO * np.random.default_rng(1).standard_normal(len(commands))
    shaper, robot, vibration = AdaptiveShaper(settings), FlexibleRobot(mode, settings.tick_s), 0.0
    vibrations, coefficients, in_use = [], [], []
    for command, error in zip(commands, noise.tolist(), strict=True):
        pins = AdaptiveInput(scalar(command * settings.max_command), scalar((vibration + error) * scale))
        output = shaper.step(pins)
        reference = float(output.reference) / settings.max_command
        vibration = robot.step(reference) / mode.angular_frequency_rad_s
        vibrations.append(vibration)
        coefficients.append(output.coefficient)
        in_use.append(not output.status & AdaptiveStatus.UNSHAPED)
    delay_s = settings.delay_ticks * settings.tick_s
    what = f"{machine.name}: learning {_vibration(machine.settings, mode)}"
    return PlottedLearning(
        f"{what}, simulated, noise of {NOISE_RATIO:.0%} rms",
        np.linspace(0.0, settings.tick_s * len(commands), len(commands), endpoint=False),
        np.array(vibrations) + noise,
        np.array(vibrations),
        np.array(coefficients, dtype=np.float64),
        np.array(delay_filter(mode, delay_s=delay_s)[1]),
        settings.tick_s * in_use.index(True) if any(in_use) else None,
    )


def _mode(settings: AdaptiveSettings) -> Mode:
    """Give the vibration to learn."""
    from swayless.plant import Mode

    if settings.mode is None:
        return Mode(PERIODS_PER_DELAY / (settings.delay_ticks * settings.tick_s), DAMPING_RATIO)
    return Mode(settings.mode.frequency_hz, settings.mode.damping_ratio or DAMPING_RATIO)


def _vibration(settings: AdaptiveSettings, mode: Mode) -> str:
    """Name the vibration, and whose it is."""
    if settings.mode is not None:
        damping = "" if settings.mode.damping_ratio else f", damping ratio {DAMPING_RATIO:g}"
        return f"the file's vibration of {mode.frequency_hz:.4g} Hz{damping}"
    return f"a vibration of {mode.frequency_hz:.4g} Hz ({PERIODS_PER_DELAY:g} periods in a delay)"


def _coarse(settings: AdaptiveSettings) -> AdaptiveSettings:
    """Give the block with few ticks in a delay, a first cycle just long enough, and a drive without lag."""
    delay_ticks = min(settings.delay_ticks, _MOST_DELAY_TICKS)
    tick_s = settings.tick_s * settings.delay_ticks / delay_ticks
    coarse = replace(settings, delay_ticks=delay_ticks, tick_s=tick_s, lag_ticks=0)
    move_ticks = coarse.quiet_ticks + _WINDOWS_PER_REST * coarse.window_ticks
    return replace(coarse, cycle_ticks=UNSHAPED_MOVES * move_ticks)
