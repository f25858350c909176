"""The files of an adaptive shaper. Not for: the command shaper's; those are the targets'."""

from __future__ import annotations

from swayless.codegen.adaptive_model import AdaptiveModel
from swayless.codegen.render import GeneratedFile, render, render_files

FILES = {
    "c": {
        "{}_adaptive.h": "c/adaptive.h.j2",
        "{}_adaptive.c": "c/adaptive.c.j2",
        "{}_example.c": "c/adaptive_example.c.j2",
    },
    "st": {"FB_{}_Adaptive.st": "st/adaptive.st.j2"},
}
"""Templates by the names of the files, by target."""


def generate_adaptive(model: AdaptiveModel, target: str) -> tuple[GeneratedFile, ...]:
    """Generate the files of one target.

    Parameters
    ----------
    model : AdaptiveModel
        The block; the same model gives the same bytes.
    target : str
        ``"c"`` or ``"st"``.

    Raises
    ------
    CodegenError
        If there is no such target.

    Examples
    --------
    >>> from swayless.controller.adaptive import AdaptiveSettings
    >>> model = AdaptiveModel(AdaptiveSettings(25, 0.001, 1.0, 2.0, 4000), "robot", "swayless")
    >>> [file.path for file in generate_adaptive(model, "c")]
    ['robot_adaptive.h', 'robot_adaptive.c', 'robot_example.c']
    """
    return render_files(FILES, target, model)


def adaptive_harness(model: AdaptiveModel) -> GeneratedFile:
    """Generate the program that runs generated C over recorded inputs, for verification only."""
    return GeneratedFile("harness.c", render("c/adaptive_harness.c.j2", model.name, model))
