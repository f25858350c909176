"""Compile, run, compare: the proof that generated code does what its reference does, bit for bit."""

from swayless.verify.comparison import Comparison, compare
from swayless.verify.toolchain import COMPILERS, Compiler, find_compiler
from swayless.verify.verification import SOAK_TICKS, Verdict, verify_block

__all__ = [
    "COMPILERS",
    "Comparison",
    "Compiler",
    "SOAK_TICKS",
    "Verdict",
    "compare",
    "find_compiler",
    "verify_block",
]
