"""Compilers: found or said to be missing, strict, and their messages handed on."""

import pytest

from swayless.errors import ToolMissingError, VerificationError
from swayless.verify import COMPILERS, find_compiler, toolchain


def test_zig_is_always_there_because_the_verify_extra_brings_it():
    assert find_compiler("zig").is_installed()


def test_an_unknown_compiler_is_refused_with_the_known_ones():
    with pytest.raises(ToolMissingError, match="choose gcc, clang, zig"):
        find_compiler("msvc")


def test_no_compiler_says_what_to_install(monkeypatch):
    monkeypatch.setattr(toolchain.Compiler, "is_installed", lambda self: False)
    with pytest.raises(ToolMissingError, match=r"pip install 'swayless\[verify\]'"):
        find_compiler()


def test_the_compiler_s_own_message_is_handed_on(tmp_path):
    source = tmp_path / "bad.c"
    source.write_text("int main(void) { int unused; return 0; }\n")
    with pytest.raises(VerificationError, match=r"does not accept bad\.c:(.|\n)*unused"):
        find_compiler().build([], [source], tmp_path / "bad.exe")


def test_a_compiler_that_hangs_is_stopped(tmp_path, monkeypatch):
    monkeypatch.setattr(toolchain, "COMPILE_TIMEOUT_S", 0.2)
    slow = toolchain.Compiler("slow", ("sleep", "5"), ())
    with pytest.raises(VerificationError):
        slow._run([], "x.c", tmp_path)


@pytest.mark.parametrize("compiler", COMPILERS, ids=lambda compiler: compiler.name)
def test_every_compiler_forbids_contraction_and_turns_warnings_into_errors(compiler):
    assert {"-std=c99", "-ffp-contract=off", "-Werror"} <= set(compiler.strict)
