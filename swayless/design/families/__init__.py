"""The families of shapers: closed forms where they are exact, solved constraint equations elsewhere.

Not for: what impulses guarantee (`robustness`), nor for impulses on a tick grid (`grid`).
"""

from swayless.design.families.family import Family
from swayless.design.families.registry import FAMILIES, design_shaper

__all__ = ["FAMILIES", "Family", "design_shaper"]
