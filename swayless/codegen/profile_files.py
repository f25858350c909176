"""The files of a motion profile. Not for: the command shaper's; those are the targets'."""

from __future__ import annotations

from swayless.codegen.profile_model import ProfileCode
from swayless.codegen.render import GeneratedFile, render, render_files

FILES = {
    "c": {
        "{}_profile.h": "c/profile.h.j2",
        "{}_profile.c": "c/profile.c.j2",
        "{}_example.c": "c/profile_example.c.j2",
    },
    "st": {"FB_{}_Profile.st": "st/profile.st.j2"},
}
"""Templates by the names of the files, by target."""


def generate_profile(code: ProfileCode, target: str) -> tuple[GeneratedFile, ...]:
    """Generate the files of one target.

    Parameters
    ----------
    code : ProfileCode
        The block; the same model gives the same bytes.
    target : str
        ``"c"`` or ``"st"``.

    Raises
    ------
    CodegenError
        If there is no such target.
    """
    return render_files(FILES, target, code)


def profile_harness(code: ProfileCode) -> GeneratedFile:
    """Generate the program that runs generated C over recorded inputs, for verification only."""
    return GeneratedFile("harness.c", render("c/profile_harness.c.j2", code.name, code))
