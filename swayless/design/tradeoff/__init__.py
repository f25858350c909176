"""What robustness costs: candidates for a machine side by side, a recommendation, and the frontier of it all.

Not for: designing one shaper (`families`, `robust`), nor for files of machines (`swayless.machine`).
"""

from swayless.design.tradeoff.candidates import Candidate, Refusal, candidates
from swayless.design.tradeoff.frontier import Frontier, frontier
from swayless.design.tradeoff.need import Need
from swayless.design.tradeoff.placing import placed_shaper, positions_needed, relative_band
from swayless.design.tradeoff.ramp import jog_residual, ramp_residual, shortest_ramp_s, worst_ramp_residual
from swayless.design.tradeoff.recommending import Recommendation, recommend

__all__ = [
    "Candidate",
    "Frontier",
    "Need",
    "Recommendation",
    "Refusal",
    "candidates",
    "frontier",
    "jog_residual",
    "placed_shaper",
    "positions_needed",
    "ramp_residual",
    "recommend",
    "relative_band",
    "shortest_ramp_s",
    "worst_ramp_residual",
]
