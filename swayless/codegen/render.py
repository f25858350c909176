"""From a code model to text through the Jinja templates. Not for: deciding anything."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any

from swayless.errors import CodegenError

if TYPE_CHECKING:
    from jinja2 import Environment


@dataclass(frozen=True)
class GeneratedFile:
    """One generated file.

    Parameters
    ----------
    path : str
        Relative path with forward slashes.
    text : str
        ASCII, lines ending in LF, no clock, path or host in it.

    Raises
    ------
    CodegenError
        If the text is not plain ASCII with LF.
    """

    path: str
    text: str

    def __post_init__(self) -> None:
        if not self.text.isascii() or "\r" in self.text or "\t" in self.text or not self.text.endswith("\n"):
            raise CodegenError(f"{self.path}: generated text must be ASCII without tabs, with LF line ends")


def render(template: str, prefix: str, model: Any) -> str:
    """Fill one template.

    Parameters
    ----------
    template : str
        Path below ``swayless/templates``.
    prefix : str
        Machine name, `P` in the templates.
    model : CModel or StModel
        Everything that is printed, `m` in the templates.
    """
    return _environment().get_template(template).render(P=prefix, m=model)


def render_files(
    templates: Mapping[str, Mapping[str, str]], target: str, model: Any
) -> tuple[GeneratedFile, ...]:
    """Fill the templates of one target.

    Parameters
    ----------
    templates : mapping
        By target: templates by the names of their files, in which ``{}`` stands for the machine's name.
    target : str
        One of them.
    model
        Everything that is printed; it has the machine's `name`.

    Raises
    ------
    CodegenError
        If there is no such target.
    """
    if target not in templates:
        raise CodegenError(f"target {target!r}: must be one of {', '.join(templates)}")
    return tuple(
        GeneratedFile(path.format(model.name), render(template, model.name, model))
        for path, template in templates[target].items()
    )


@cache
def _environment() -> Environment:
    from jinja2 import Environment, PackageLoader, StrictUndefined

    return Environment(
        loader=PackageLoader("swayless", "templates"),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,  # C and Structured Text, not HTML  # noqa: S701
    )
