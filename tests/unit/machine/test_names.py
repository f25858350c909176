from __future__ import annotations

import keyword

import pytest

from swayless.machine.names import MAX_NAME_LENGTH, RESERVED_WORDS, name_problem


@pytest.mark.parametrize(
    "name", ["srtc_gantry", "a", "crane2", "x_1_y", "a" * MAX_NAME_LENGTH, "integer_crane"]
)
def test_identifiers_are_names(name: str) -> None:
    assert name_problem(name) is None


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("", "must be lower-case letters"),
        ("Crane", "must be lower-case letters"),
        ("2crane", "must be lower-case letters"),
        ("_crane", "must be lower-case letters"),
        ("crane-2", "must be lower-case letters"),
        ("cr\u00e4ne", "must be lower-case letters"),
        ("crane\n", "must be lower-case letters"),
        ("crane_", "must not contain a double underscore or end with an underscore"),
        ("my__crane", "must not contain a double underscore"),
        ("a" * (MAX_NAME_LENGTH + 1), "has 25 characters; at most 24 are allowed"),
    ],
)
def test_what_is_not_a_portable_identifier_is_refused(name: str, reason: str) -> None:
    assert (name_problem(name) or "").startswith(reason)


KEYWORDS = """double restrict constexpr class bool true null int32_t uint_fast16_max size_t main
function_block var_input lreal step on en limit ton sqrt end_if method mod"""


@pytest.mark.parametrize("name", KEYWORDS.replace("\n", " ").split(" "))
def test_words_that_a_target_reserves_are_refused_with_a_free_one(name: str) -> None:
    assert f'for instance "{name}_crane" is free' in (name_problem(name) or "")
    assert name_problem(f"{name}_crane") is None


def test_reserved_words_are_lower_case_so_that_the_comparison_ignores_case() -> None:
    assert all(word == word.lower() and word.isidentifier() for word in RESERVED_WORDS)


def test_every_c_like_word_that_python_shares_is_reserved() -> None:
    shared = {"and", "break", "class", "continue", "else", "for", "if", "not", "or", "return", "while"}
    assert shared <= RESERVED_WORDS & set(keyword.kwlist)
