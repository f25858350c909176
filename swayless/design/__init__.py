"""Shapers as pure mathematics: what they leave swinging, what they guarantee, and how they are found.

Not for: ticks and number types (`swayless.controller`), nor for cranes and their files (`swayless.machine`).
"""

from swayless.design.convolution import convolve
from swayless.design.families import FAMILIES, Family, design_shaper
from swayless.design.grid import solve_on_grid
from swayless.design.grid_shaper import GridShaper
from swayless.design.residual import residual_vibration, residual_vibration_and_slope, vibration_error
from swayless.design.robustness import (
    DEFAULT_TOLERANCE,
    guarantee_of,
    held_band,
    insensitivity_width,
    overtravel_s,
    partial_sums,
    peak_factor,
    proven_shaper,
    rope_length_interval_m,
    worst_residual,
    worst_residual_promised,
)
from swayless.design.shaper import FloatArray, Guarantee, Impulses, Shaper

__all__ = [
    "DEFAULT_TOLERANCE",
    "FAMILIES",
    "Family",
    "FloatArray",
    "GridShaper",
    "Guarantee",
    "Impulses",
    "Shaper",
    "convolve",
    "design_shaper",
    "guarantee_of",
    "held_band",
    "insensitivity_width",
    "overtravel_s",
    "partial_sums",
    "peak_factor",
    "proven_shaper",
    "residual_vibration",
    "residual_vibration_and_slope",
    "rope_length_interval_m",
    "solve_on_grid",
    "vibration_error",
    "worst_residual",
    "worst_residual_promised",
]
