"""Which names a target allows. Reserved words are data; a collision is an error, never a renaming.

Not for: the pattern of machine names, which the machine file checks.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from swayless.errors import CodegenError

C_RESERVED = frozenset(
    """
    alignas alignof and and_eq asm atomic_cancel atomic_commit atomic_noexcept auto bitand bitor bool
    break case catch char char8_t char16_t char32_t class compl complex concept const consteval constexpr
    constinit const_cast continue co_await co_return co_yield decltype default delete do double
    dynamic_cast else enum explicit export extern false float for friend goto if imaginary inline int long
    mutable namespace new noexcept noreturn not not_eq nullptr operator or or_eq private protected public
    reflexpr register reinterpret_cast requires restrict return short signed sizeof static static_assert
    static_cast struct switch synchronized template this thread_local throw true try typedef typeid
    typename typeof typeof_unqual union unsigned using virtual void volatile wchar_t while xor xor_eq
    int8_t int16_t int32_t int64_t uint8_t uint16_t uint32_t uint64_t size_t ptrdiff_t null main errno
    signal index linux unix
    """.split()  # noqa: SIM905 - one word a line would fill pages
)
"""Keywords of C99 to C23 and C++, and names that the headers or common compilers take."""

ST_RESERVED = frozenset(
    """
    abs abstract acos action add adr adrinst and any any_bit any_date any_derived any_elementary any_int
    any_magnitude any_num any_real any_string array asin at atan atan2 begin bitadr bool by byte cal
    calc calcn case char class concat configuration constant continue cos ctd ctu ctud date
    date_and_time delete dint div do dt dword else elsif en end_action end_case end_class
    end_configuration end_for end_function end_function_block end_if end_interface end_method
    end_namespace end_program end_repeat end_resource end_step end_struct end_transition end_type
    end_var end_while eno eq exit exp expt extends f_edge f_trig false final find for from function
    function_block ge gt if implements indexof ini initial_step insert int interface internal interval
    jmp jmpc jmpcn ld ldn le left len limit lint ln log lreal lt ltime lword max method mid min mod move
    mul mux namespace ne non_retain not null of on or overlap override params persistent pointer
    priority private program protected public queryinterface querypointer r_edge r_trig read_only
    read_write real ref ref_to reference repeat replace resource ret retain retc retcn return right rol
    ror rs sel shl shr sin single sint sizeof sqrt sr step stn string struct sub super tan task
    testandset then this time time_of_day to tod tof ton tp transition true trunc trunc_int type udint
    uint ulint until using usint var var_access var_config var_external var_global var_in_out var_input
    var_output var_temp wchar while with word wstring xor xsizeof
    """.split()  # noqa: SIM905 - one word a line would fill pages
)
"""Keywords, types and standard functions of IEC 61131-3 and of IDEs that take more, in lower case."""

ST_MANDATED = frozenset({"reference"})
"""Pins that the block's interface fixes although an IDE has a keyword beginning with the same word."""

ST_LONGEST = 40
"""Longest identifier that every IDE keeps apart."""


def check_c_names(prefix: str) -> None:
    """Refuse a machine name that cannot prefix C symbols.

    Raises
    ------
    CodegenError
        If the name is reserved in C or C++ or is no identifier.

    Examples
    --------
    >>> check_c_names("int")
    Traceback (most recent call last):
    ...
    swayless.errors.CodegenError: name 'int' is reserved in C: choose another machine name
    """
    _check_identifier(prefix)
    if prefix.lower() in C_RESERVED:
        raise CodegenError(f"name {prefix!r} is reserved in C: choose another machine name")


def check_st_names(prefix: str, identifiers: Iterable[str]) -> None:
    """Refuse reserved, too long or colliding names of a function block.

    Parameters
    ----------
    prefix : str
        Machine name.
    identifiers : iterable of str
        Every name that the block declares, its own included.

    Raises
    ------
    CodegenError
        If a name is reserved or too long, or two differ in case only.
    """
    _check_identifier(prefix)
    if prefix.lower() in ST_RESERVED:
        raise CodegenError(f"name {prefix!r} is reserved in Structured Text: choose another machine name")
    seen: dict[str, str] = {}
    for name in identifiers:
        key = name.lower()
        if key in ST_RESERVED - ST_MANDATED:
            raise CodegenError(f"name {name!r} is reserved in Structured Text")
        if len(name) > ST_LONGEST:
            raise CodegenError(
                f"name {name!r} has {len(name)} characters: Structured Text allows {ST_LONGEST}"
            )
        if key in seen:
            raise CodegenError(f"names {seen[key]!r} and {name!r} collide: Structured Text ignores case")
        seen[key] = name


def _check_identifier(name: str) -> None:
    if not re.fullmatch(r"[A-Za-z](_?[A-Za-z0-9])*", name):
        raise CodegenError(
            f"name {name!r}: must start with a letter and hold letters, digits and single underscores inside"
        )
