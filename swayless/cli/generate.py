"""`swayless generate`: code from a design file."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from swayless.cli.options import CheckOption, DesignArgument, JsonOption, NumberOption

if TYPE_CHECKING:
    from swayless.codegen import GeneratedFile, Provenance
    from swayless.controller import ShaperSettings
    from swayless.machine import DesignFile


class TargetName(StrEnum):
    """Targets of code generation."""

    c = "c"
    st = "st"


LANGUAGES = {TargetName.c.value: "C", TargetName.st.value: "Structured Text"}
"""What people call each target."""


def generate(
    target: Annotated[TargetName, typer.Argument(metavar="LANGUAGE", help="c or st.", show_default=False)],
    file: DesignArgument,
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="DIR", help="Directory; it belongs to the generator.")
    ],
    number: NumberOption = None,
    check: CheckOption = False,
    json: JsonOption = False,
) -> None:
    """Generate C or Structured Text from a design file.

    The same design file gives the same bytes, on every machine and for ever. Structured Text is generated in
    LREAL (double) or REAL (float), C in int32 too. The stored file of an adaptive shaper or of a motion
    profile is a design file too, in its own number type.

    Examples
    --------
    swayless generate st crane.json -o st
    swayless generate c crane.json -o src/crane --number float
    swayless generate c crane.json -o src/crane --number float --check
    """
    from swayless.cli.block_build import refuse_number
    from swayless.cli.block_kinds import stored_block
    from swayless.cli.console import print_json
    from swayless.cli.output_directory import differences, write_files

    if (make := stored_block(file)) is not None:
        refuse_number(file, number)
        made = make(lambda _: None).generate(target.value)
    else:
        made = _of_design(file, number and number.value, target.value)
    files = {item.path: item.text.encode("ascii") for item in made}
    found = differences(output, files) if check else []
    if not check:
        write_files(output, files)
    if json:
        print_json({"directory": str(output), "checked": check, "files": list(files), "differences": found})
    else:
        for line in found or [f"{output / path}: {'as generated' if check else 'written'}" for path in files]:
            typer.echo(line)
    if found:
        raise typer.Exit(1)


def _of_design(path: Path, number: str | None, target: str) -> tuple[GeneratedFile, ...]:
    """Generate the code of a command shaper."""
    from swayless.codegen import generate as generate_files
    from swayless.machine import load_design
    from swayless.machine.running import shaper_settings

    design = load_design(path)
    return generate_files(shaper_settings(design, number=number), provenance(design), target)


def provenance(design: DesignFile) -> Provenance:
    """Say where generated code comes from.

    Parameters
    ----------
    design : DesignFile
        The design that it is made of.
    """
    from swayless.codegen import Provenance
    from swayless.machine import design_sha256

    return Provenance(
        name=design.name,
        generator=design.generator,
        source=design.source,
        design_sha256=design_sha256(design),
        hangs_on_rope=design.plant.kind == "crane",
        is_arm=design.plant.kind == "arm",
    )


def left_out(settings: ShaperSettings) -> dict[str, str]:
    """Say which languages cannot be generated, and why: reasons by target.

    Parameters
    ----------
    settings : ShaperSettings
        The block.
    """
    from swayless.codegen import TARGETS

    number = settings.number.name
    able = ", ".join(LANGUAGES[name] for name, target in TARGETS.items() if number in target.number_types)
    return {
        name: f"not generated, {number} is for {able} only"
        for name, target in TARGETS.items()
        if number not in target.number_types
    }
