"""The adaptive command shaper: three impulses whose amplitudes are learned from what still vibrates.

Not for: machines whose frequency is known; a designed row knows from the first move what this one must learn.
"""

from swayless.controller.adaptive.pins import AdaptiveInput, AdaptiveOutput
from swayless.controller.adaptive.settings import AdaptiveSettings
from swayless.controller.adaptive.shaper import AdaptiveShaper
from swayless.controller.adaptive.status import AdaptiveStatus, explain_adaptive

__all__ = [
    "AdaptiveInput",
    "AdaptiveOutput",
    "AdaptiveSettings",
    "AdaptiveShaper",
    "AdaptiveStatus",
    "explain_adaptive",
]
