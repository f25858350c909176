"""swayless: from a crane's rope lengths to proven controller code.

The rooms, in the direction in which data flows: :mod:`swayless.plant` (physics), :mod:`swayless.design`
(shapers as mathematics), :mod:`swayless.controller` (what runs, tick by tick), :mod:`swayless.machine`
(machine and design files), :mod:`swayless.codegen` (C and Structured Text), :mod:`swayless.verify` (proof),
:mod:`swayless.report` (figures) and :mod:`swayless.cli`.
"""

__version__ = "0.1.0"
