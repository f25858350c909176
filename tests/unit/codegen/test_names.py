"""Names that a target reserves or that collide are errors, never renamings."""

import re

import pytest

from swayless.codegen.names import C_RESERVED, ST_LONGEST, ST_RESERVED, check_c_names, check_st_names
from swayless.errors import CodegenError


@pytest.mark.parametrize("word", sorted(C_RESERVED))
def test_words_of_c_are_refused_in_any_case(word):
    for spelled in (word, word.upper(), word.capitalize()):
        with pytest.raises(
            CodegenError, match=f"name '{spelled}' is reserved in C: choose another machine name"
        ):
            check_c_names(spelled)


@pytest.mark.parametrize("word", sorted(ST_RESERVED))
def test_words_of_structured_text_are_refused_in_any_case(word):
    for spelled in (word, word.upper(), word.capitalize()):
        with pytest.raises(CodegenError, match=f"name '{spelled}' is reserved in Structured Text"):
            check_st_names(spelled, [])


@pytest.mark.parametrize("name", ["", "1a", "_a", "a_", "a__b", "a-b", "a b", "a.b", "é", "a\n"])
def test_what_is_no_identifier_is_refused(name):
    for check in (check_c_names, lambda prefix: check_st_names(prefix, [])):
        with pytest.raises(CodegenError, match=rf"^name {re.escape(repr(name))}: must start with a letter"):
            check(name)


@pytest.mark.parametrize("name", ["srtc_gantry", "a", "Crane7", "x_1_y"])
def test_plain_names_are_allowed(name):
    check_c_names(name)
    check_st_names(name, [f"FB_{name}_Shaper"])


def test_names_that_differ_in_case_only_collide_in_structured_text():
    with pytest.raises(CodegenError, match="names 'Head' and 'HEAD' collide: Structured Text ignores case"):
        check_st_names("crane", ["Head", "Tail", "HEAD"])


def test_a_declared_name_must_not_be_reserved_or_too_long():
    with pytest.raises(CodegenError, match="name 'Step' is reserved in Structured Text"):
        check_st_names("crane", ["Step"])
    check_st_names("crane", ["x" * ST_LONGEST])
    with pytest.raises(
        CodegenError, match=f"has {ST_LONGEST + 1} characters: Structured Text allows {ST_LONGEST}"
    ):
        check_st_names("crane", ["x" * (ST_LONGEST + 1)])
