"""From a controller to text: models, names, literals, provenance and targets. No disk, no subprocess."""

from swayless.codegen.provenance import Provenance
from swayless.codegen.render import GeneratedFile
from swayless.codegen.targets import TARGETS, Target, c_harness, generate

__all__ = ["GeneratedFile", "Provenance", "TARGETS", "Target", "c_harness", "generate"]
