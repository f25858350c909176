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

ENDINGS = ("*.adaptive.json",)
"""How the names of stored files end."""


def described_block(path: Path) -> Make | None:
    """Tell whether a TOML file describes a block of its own, and how to make it.

    Parameters
    ----------
    path : Path
        As given to `build`.
    """
    from swayless.machine.adaptive_file import is_adaptive

    if is_adaptive(path):
        from swayless.cli.adaptive import adaptive_block

        return partial(adaptive_block, path)
    return None


def stored_block(path: Path) -> Make | None:
    """Tell whether a JSON file stores a block of its own, and how to make it again.

    Parameters
    ----------
    path : Path
        As given to `generate` and `verify`; whatever else is wrong with it is for others to report.
    """
    from swayless.machine import adaptive_file

    try:
        document = json.loads(path.read_bytes())
    except (OSError, ValueError, RecursionError):
        return None
    schema = document.get("schema") if isinstance(document, dict) else None
    if schema == adaptive_file.SCHEMA:
        from swayless.cli.adaptive import adaptive_block

        return partial(adaptive_block, path)
    return None


def stored_in(directory: Path) -> Path | None:
    """Find the stored file of a block of its own, if `build` wrote one here."""
    return next((path for ending in ENDINGS for path in sorted(directory.glob(ending))), None)
