"""The files of a machine: the machine file that a person writes, the design file that code is made from.

Both are loaded with every problem reported at once, and every file is written in one step or not at all.

Not for: designing shapers (`swayless.design`) or generating code (`swayless.codegen`).
"""

from swayless.machine.comparison import same_design
from swayless.machine.controller_section import LAWS, ControllerSection
from swayless.machine.design_document import (
    SCHEMA,
    AnyTapsRecord,
    DesignFile,
    DriveRecord,
    GuaranteeRecord,
    ModeRecord,
    PhaseTapsRecord,
    PlantRecord,
    ShaperRecord,
    SpacedTapsRecord,
    TapsRecord,
)
from swayless.machine.design_file import design_sha256, load_design, save_text
from swayless.machine.drive_section import DriveSection
from swayless.machine.examples import EXAMPLE_NAMES, example_text
from swayless.machine.machine_file import Machine, load_machine
from swayless.machine.names import RESERVED_WORDS, name_problem
from swayless.machine.plant_section import PlantSection
from swayless.machine.quantity import QuantityError, parse_quantity
from swayless.machine.row_section import RowSection
from swayless.machine.writing import write_text_atomically

__all__ = [
    "Machine",
    "load_machine",
    "PlantSection",
    "DriveSection",
    "ControllerSection",
    "RowSection",
    "LAWS",
    "DesignFile",
    "PlantRecord",
    "DriveRecord",
    "ShaperRecord",
    "ModeRecord",
    "GuaranteeRecord",
    "AnyTapsRecord",
    "PhaseTapsRecord",
    "SpacedTapsRecord",
    "TapsRecord",
    "SCHEMA",
    "load_design",
    "save_text",
    "design_sha256",
    "same_design",
    "EXAMPLE_NAMES",
    "example_text",
    "QuantityError",
    "parse_quantity",
    "RESERVED_WORDS",
    "name_problem",
    "write_text_atomically",
]
