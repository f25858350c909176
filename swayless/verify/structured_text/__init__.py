"""Runs generated Structured Text in Python, and refuses what is not portable between controllers.

`load` a file, `FunctionBlock.instantiate` a block, `Instance.step` it. LREAL and REAL are computed as IEEE
754 double and single, every operation rounded once; integer overflow, an index outside its array and an
integer divided by zero are errors, where a controller wraps or stops. The sign and payload of a NaN are not
defined.

Not for: Structured Text in general. Only the portable subset of the generator is taken, on purpose.

References
----------
IEC 61131-3:2013, clauses 6.4 (data types), 6.6.2.5 (standard functions), 7.3 (Structured Text).
"""

from swayless.verify.structured_text.faults import (
    ExecutionError,
    InputError,
    StructuredTextError,
    SubsetError,
)
from swayless.verify.structured_text.program import FunctionBlock, Instance, load

__all__ = [
    "ExecutionError",
    "FunctionBlock",
    "InputError",
    "Instance",
    "StructuredTextError",
    "SubsetError",
    "load",
]
