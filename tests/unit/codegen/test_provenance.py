"""What the head of a file says, and which texts of the user's may stand in a comment."""

import dataclasses

import pytest

from swayless.codegen import GeneratedFile, Provenance, generate
from swayless.codegen.provenance import NOT_IN_COMMENTS, comment_text, header_lines
from swayless.controller import Bank, Row, ShaperSettings
from swayless.errors import CodegenError
from tests.unit.controller.blocks import UM_ZV, ZVD, block

ORIGIN = Provenance("crane", "swayless 0.1.0", "crane.toml", "0123456789abcdef" * 4, True)
ENDS_A_COMMENT = ["*/", "a */ b", "*)", "(*", "/*", "{pragma}", "$N", "back\\slash"]
NOT_PLAIN = ["tab\t", "line\n", "ä", "\x7f"]


def renamed(settings, **fields):
    row = settings.bank.rows[0]
    changed = Row(fields.get("name", row.name), fields.get("family", row.family), row.taps)
    limits = dataclasses.replace(settings.limits, units=fields.get("units", settings.limits.units))
    return ShaperSettings(Bank((changed, *settings.bank.rows[1:])), limits)


@pytest.mark.parametrize("text", ENDS_A_COMMENT + NOT_PLAIN)
def test_text_that_could_end_a_comment_is_refused(text):
    with pytest.raises(
        CodegenError, match=r"cannot stand in a comment: use printable ASCII without \* { } \$ \\"
    ):
        comment_text(text)


@pytest.mark.parametrize("text", ENDS_A_COMMENT + NOT_PLAIN)
@pytest.mark.parametrize("target", ["c", "st"])
@pytest.mark.parametrize("field", ["name", "family", "units"])
def test_text_of_the_user_that_could_end_a_comment_is_refused_by_every_target(text, target, field):
    with pytest.raises(CodegenError, match="cannot stand in a comment"):
        generate(renamed(block(ZVD), **{field: text}), ORIGIN, target)


@pytest.mark.parametrize("target", ["c", "st"])
@pytest.mark.parametrize("field", ["source", "generator"])
def test_provenance_that_could_end_a_comment_is_refused(target, field):
    with pytest.raises(CodegenError, match="cannot stand in a comment"):
        generate(block(ZVD), dataclasses.replace(ORIGIN, **{field: "x*/y"}), target)


def test_any_other_printable_text_stands_in_the_head():
    text = "".join(chr(code) for code in range(32, 127) if chr(code) not in NOT_IN_COMMENTS)
    for target in ("c", "st"):
        assert text in generate(renamed(block(ZVD), name=text), ORIGIN, target)[0].text


@pytest.mark.parametrize("digest", ["", "ab", "g" * 64, "A" * 64, "0" * 63])
def test_a_digest_must_be_a_sha_256(digest):
    with pytest.raises(CodegenError, match="must be 64 hexadecimal digits"):
        dataclasses.replace(ORIGIN, design_sha256=digest)


def test_the_head_says_what_each_row_guarantees_and_that_it_is_no_safety_function():
    head = "\n".join(header_lines(block(ZVD, UM_ZV), ORIGIN, ["a fact"]))
    for said in (
        "Made by swayless 0.1.0 from crane.toml.",
        f"Design SHA-256 {ORIGIN.design_sha256}.",
        "This file is yours",
        "1 row 1: test for 0.5 Hz, damping ratio 0, duration 0.4 s",
        "at most 5 % from 0.49 to 0.51 Hz (rope 0.955",
        "negative amplitudes: a new command waits until the block has settled",
        "a fact",
        "NOT A SAFETY FUNCTION",
    ):
        assert said in head
    stiff = header_lines(block(ZVD), dataclasses.replace(ORIGIN, hangs_on_rope=False), [])
    assert not any("(rope" in line for line in stiff)


@pytest.mark.parametrize("text", ["a\tb\n", "a\r\n", "ä\n", "no end of line", ""])
def test_a_generated_file_is_ascii_with_lf_and_without_tabs(text):
    with pytest.raises(
        CodegenError, match=r"x\.c: generated text must be ASCII without tabs, with LF line ends"
    ):
        GeneratedFile("x.c", text)
