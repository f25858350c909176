"""The identifier by which a machine names its design. Not for: proof of its content (SHA-256)."""

from __future__ import annotations

import zlib

from swayless.machine.design_document import DesignFile
from swayless.machine.design_file import save_text


def design_id(design: DesignFile) -> int:
    """Give the CRC-32 of the design file as `save_text` writes it: what any CRC tool says of that file.

    Parameters
    ----------
    design : DesignFile
        Any design.

    Returns
    -------
    int
        32 bits, without a sign.
    """
    return zlib.crc32(save_text(design).encode("ascii"))
