"""The targets: which files each one is made of. A new language or vendor wrapper is one more entry here.

Not for: what stands in the files (models) or how it is laid out (templates).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from swayless.codegen.c_model import CModel
from swayless.codegen.provenance import Provenance
from swayless.codegen.render import GeneratedFile, render
from swayless.codegen.st_model import StModel
from swayless.controller.settings import ShaperSettings
from swayless.errors import CodegenError


@dataclass(frozen=True)
class Target:
    """One thing that code can be generated for.

    Parameters
    ----------
    name : str
        As on the command line.
    title : str
        What it is, for people.
    number_types : tuple of str
        Number types that it can calculate in.
    make : callable
        From settings and provenance to files.
    """

    name: str
    title: str
    number_types: tuple[str, ...]
    make: Callable[[ShaperSettings, Provenance], tuple[GeneratedFile, ...]]


def _c_files(settings: ShaperSettings, origin: Provenance) -> tuple[GeneratedFile, ...]:
    model = CModel(settings, origin)
    return (
        GeneratedFile(f"{origin.name}_shaper.h", render("c/shaper.h.j2", origin.name, model)),
        GeneratedFile(f"{origin.name}_shaper.c", render("c/shaper.c.j2", origin.name, model)),
        GeneratedFile(f"{origin.name}_example.c", render("c/example.c.j2", origin.name, model)),
    )


def _st_files(settings: ShaperSettings, origin: Provenance) -> tuple[GeneratedFile, ...]:
    model = StModel(settings, origin)
    return (GeneratedFile(f"FB_{origin.name}_Shaper.st", render("st/shaper.st.j2", origin.name, model)),)


TARGETS: Mapping[str, Target] = {
    "c": Target("c", "C99, freestanding", ("double", "float", "int32"), _c_files),
    "st": Target("st", "IEC 61131-3 Structured Text, portable", ("double", "float"), _st_files),
}
"""Every target by name."""


def generate(settings: ShaperSettings, origin: Provenance, target: str) -> tuple[GeneratedFile, ...]:
    """Generate the files of one target.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    origin : Provenance
        Where it comes from; the same settings and provenance give the same bytes.
    target : str
        Name of a target.

    Raises
    ------
    CodegenError
        If there is no such target, it cannot calculate in the number type, or a name is not allowed.
    """
    if target not in TARGETS:
        raise CodegenError(f"target {target!r}: must be one of {', '.join(TARGETS)}")
    known = TARGETS[target].number_types
    if settings.number.name not in known:
        raise CodegenError(
            f"number = {settings.number.name!r}: target {target!r} calculates in {' or '.join(known)}"
        )
    return TARGETS[target].make(settings, origin)


def c_harness(settings: ShaperSettings, origin: Provenance) -> GeneratedFile:
    """Generate the program that runs generated C over recorded inputs, for verification only.

    Parameters
    ----------
    settings, origin
        As for `generate`.
    """
    return GeneratedFile("harness.c", render("c/harness.c.j2", origin.name, CModel(settings, origin)))
