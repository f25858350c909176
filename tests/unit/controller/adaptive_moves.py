"""A robot with a flexible link that repeats a move of 4 s under an adaptive shaper, in a closed loop."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from swayless.controller import number_type
from swayless.controller.adaptive import AdaptiveInput, AdaptiveOutput, AdaptiveSettings, AdaptiveShaper
from swayless.design import design_shaper
from swayless.plant import Mode
from swayless.plant.simulation.flexible_robot import FlexibleRobot

CYCLE_S, RAMP_S, REST_S = 4.0, 0.3, 1.7
LEFT = Mode(16.0, 0.01)
"""The test bed's mode; its damping is an assumption."""


def trapezoids(tick_s: float) -> NDArray[np.float64]:
    """Speeds of one cycle: ramp up, travel, ramp down and rest, and the same back, 2 s each."""
    times_s = np.arange(round(0.5 * CYCLE_S / tick_s)) * tick_s
    one = np.interp(times_s, [0.0, RAMP_S, RAMP_S + 0.9, 2.0 * RAMP_S + 0.9], [0.0, 1.0, 1.0, 0.0])
    return np.concatenate([one, -one])


def free_amplitude(mode: Mode, tick_s: float) -> float:
    """Acceleration of the tip that an unshaped ramp leaves at most."""
    robot = FlexibleRobot(mode, tick_s)
    record = [robot.step(speed) for speed in trapezoids(tick_s)[: round((RAMP_S + 0.5) / tick_s)].tolist()]
    return max(map(abs, record[round(RAMP_S / tick_s) + 2 :]))


@dataclass
class Experiment:
    """Many cycles; noise and vibration are relative to the amplitude that an unshaped ramp leaves."""

    delay_ticks: int = 25
    tick_s: float = 0.001
    mode: Mode = LEFT
    noise: float = 0.0
    number: str = "double"
    max_reference: float = 8.0
    seed: int = 1
    vibration_scale: float = 1.0
    offset: float = 0.0
    disturbance: Any = 0.0
    inputs: list[tuple[Any, Any]] = field(default_factory=list)
    coefficients: list[NDArray[np.float64]] = field(default_factory=list)
    status: list[int] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.scale = self.vibration_scale * free_amplitude(self.mode, self.tick_s)
        self.cycle = trapezoids(self.tick_s).tolist()
        self.settings = AdaptiveSettings(
            self.delay_ticks,
            self.tick_s,
            max_command=1.0,
            vibration_scale=self.scale,
            cycle_ticks=len(self.cycle),
            max_reference=self.max_reference,
            number=number_type(self.number),
        )
        self.robot = FlexibleRobot(self.mode, self.tick_s)
        self.shaper = AdaptiveShaper(self.settings)
        self.vibration = 0.0
        self.random = np.random.default_rng(self.seed)

    def run(self, cycles: int) -> NDArray[np.float64]:
        """Run cycles; give the rms of the true vibration while it is learned from, for each."""
        return np.array([self._cycle() for _ in range(cycles)])

    def _cycle(self) -> float:
        scalar = self.settings.number.scalar
        noise = self.noise * self.random.standard_normal(len(self.cycle))
        errors = (self.scale * (noise + self.offset + self.disturbance)).tolist()
        squares, ticks, bits = 0.0, 0, 0
        for speed, error in zip(self.cycle, errors, strict=True):
            pins = AdaptiveInput(scalar(speed), scalar(self.vibration + error))
            output: AdaptiveOutput = self.shaper.step(pins)
            self.inputs.append((pins.command, pins.vibration))
            self.vibration = self.robot.step(float(output.reference))
            bits |= output.status
            if output.adapting:
                squares, ticks = squares + self.vibration**2, ticks + 1
        self.coefficients.append(np.array(output.coefficient, dtype=np.float64))
        self.status.append(bits)
        return float((squares / ticks) ** 0.5 / self.scale)

    def error(self, mode: Mode | None = None) -> float:
        """How far the coefficients are from the analytic ones, eq 4."""
        delay_s = self.delay_ticks * self.tick_s
        wanted = design_shaper("oatf", mode or self.mode, delay_s=delay_s).amplitudes
        return float(np.abs(self.coefficients[-1] - wanted).max())
