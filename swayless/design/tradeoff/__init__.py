"""What robustness costs: candidates for a machine side by side, a recommendation, and the frontier of it all.

Not for: designing one shaper (`families`, `robust`), nor for files of machines (`swayless.machine`).
"""

from swayless.design.tradeoff.candidates import PLACED_FAMILIES, Candidate, Refusal, candidates
from swayless.design.tradeoff.frontier import Frontier, frontier
from swayless.design.tradeoff.need import Need
from swayless.design.tradeoff.placing import (
    anchored_shaper,
    placed_shaper,
    positions_needed,
    relative_band,
)
from swayless.design.tradeoff.ramp import (
    held_by_ramp,
    jog_residual,
    ramp_residual,
    shortest_ramp_s,
    worst_ramp_residual,
)
from swayless.design.tradeoff.recommending import Recommendation, recommend

__all__ = [
    "Candidate",
    "Frontier",
    "Need",
    "PLACED_FAMILIES",
    "Recommendation",
    "Refusal",
    "anchored_shaper",
    "candidates",
    "frontier",
    "held_by_ramp",
    "jog_residual",
    "placed_shaper",
    "positions_needed",
    "ramp_residual",
    "recommend",
    "relative_band",
    "shortest_ramp_s",
    "worst_ramp_residual",
]
