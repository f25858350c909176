"""Blocks that have files of their own beside those of command shapers. Not for: making them."""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TypeAlias

from swayless.cli.block_build import Block

Make: TypeAlias = "Callable[[Callable[[str], None]], Block]"
"""Makes a block; it is given a callable that shows progress."""

ENDINGS = ("*.adaptive.json", "*.profile.json")
"""How the names of stored files end."""


def described_block(path: Path, directory: Path) -> Make | None:
    """Tell whether a TOML file describes a block of its own, and how to make it.

    Parameters
    ----------
    path : Path
        As given to `build`.
    directory : Path
        Where an earlier build may have stored the same block.
    """
    from swayless.machine.adaptive_file import is_adaptive
    from swayless.machine.inversion import asks_for_inversion
    from swayless.machine.profile_file import is_profile

    if is_adaptive(path):
        from swayless.cli.adaptive import adaptive_block

        return partial(adaptive_block, path)
    if asks_for_inversion(_toml(path)):
        from swayless.cli.profile_block import inverted_block

        return partial(inverted_block, path, directory)
    if is_profile(path):
        from swayless.cli.profile_block import optimal_block

        return partial(optimal_block, path, directory)
    return None


def stored_block(path: Path) -> Make | None:
    """Tell whether a JSON file stores a block of its own, and how to make it again.

    Parameters
    ----------
    path : Path
        As given to `generate` and `verify`; whatever else is wrong with it is for others to report.
    """
    from swayless.machine import adaptive_file, profile_design_record

    schema = _schema(path)
    if schema == adaptive_file.SCHEMA:
        from swayless.cli.adaptive import adaptive_block

        return partial(adaptive_block, path)
    if schema == profile_design_record.SCHEMA:
        from swayless.cli.profile_block import stored_profile_block

        return partial(stored_profile_block, path)
    return None


def _toml(path: Path) -> dict[str, object]:
    """Parse a file; whatever is wrong with it is for others to report."""
    from swayless.errors import FileError
    from swayless.machine.toml_source import read_toml

    try:
        return read_toml(path)
    except FileError:
        return {}


def _schema(path: Path) -> object:
    """Read what a JSON file says it is."""
    try:
        document = json.loads(path.read_bytes())
    except (OSError, ValueError, RecursionError):
        return None
    return document.get("schema") if isinstance(document, dict) else None


def stored_in(directory: Path) -> Path | None:
    """Find the stored file of a block of its own, if `build` wrote one here."""
    return next((path for ending in ENDINGS for path in sorted(directory.glob(ending))), None)
