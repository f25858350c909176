"""Which machine names can prefix a symbol in every language that is generated.

The name of a machine starts every emitted symbol, so it must be an identifier in C, C++ and IEC 61131-3
Structured Text, whose keywords are compared without regard to case.

Not for: the symbols of one target; each target owns the words that it reserves.
"""

from __future__ import annotations

import re

MAX_NAME_LENGTH = 24
"""Longest machine name: portable Structured Text allows 40 characters, and the longest suffix must fit behind
it."""

_NAME = re.compile(r"[a-z][a-z0-9_]*")

_C = """
    auto break case char const continue default do double else enum extern float for goto if inline int
    long register restrict return short signed sizeof static struct switch typedef union unsigned void
    volatile while alignas alignof atomic bool complex generic imaginary noreturn static_assert
    thread_local constexpr nullptr typeof typeof_unqual true false null offsetof size_t ptrdiff_t
    max_align_t wchar_t char16_t char32_t nullptr_t va_list va_arg va_copy va_end va_start intptr_t
    uintptr_t intmax_t uintmax_t char_bit schar_max uchar_max shrt_max ushrt_max int_max uint_max long_max
    ulong_max llong_max ullong_max flt_max dbl_max flt_epsilon dbl_epsilon ndebug assert errno main asm
    fortran far near interrupt
"""
_CPP = """
    and and_eq bitand bitor catch char8_t class co_await co_return co_yield compl concept const_cast
    consteval constinit decltype delete dynamic_cast explicit export final friend import module mutable
    namespace new noexcept not not_eq operator or or_eq override private protected public reinterpret_cast
    requires static_cast std template this throw try typeid typename using virtual xor xor_eq
"""
_IEC_KEYWORDS = """
    abstract action any any_bit any_date any_derived any_elementary any_int any_magnitude any_num any_real
    any_string array at bool by byte case char class configuration constant continue date date_and_time
    dint do dt dword else elsif en end_action end_case end_class end_configuration end_for end_function
    end_function_block end_if end_interface end_method end_namespace end_program end_repeat end_resource
    end_step end_struct end_transition end_type end_var end_while eno exit extends f_edge false final for
    from function function_block if implements initial_step int interface internal interval ldate ldt lint
    lreal ltime ltod lword method mod namespace non_retain not null of on or overlap override pointer
    priority private program property protected public r_edge read_only read_write real ref ref_to
    reference repeat resource retain return single sint step string struct super task then this time
    time_of_day to tod transition true type udint uint ulint until using usint var var_access var_config
    var_external var_global var_in_out var_input var_output var_temp wchar while with word wstring xor
"""
_IEC_FUNCTIONS = """
    abs acos add add_time and asin atan atan2 bcd_to_int concat concat_date_tod cos ctd ctu ctud
    cycle_exec day_of_week delete div divide eq exp expt f_trig find floor ge get gt insert is_valid le
    left len limit ln log lower_bound lt max mid min mod move mul mul_time mux ne not or r_trig replace
    right rol ror round rs rtc sel sema shl shr sin split_date sqrt sr sub tan tof ton tp trunc
    upper_bound xor adr bitadr sizeof ini day hour minute month second year
"""
_SIZED = {
    f"{sign}int{kind}{bits}_{what}"
    for sign in ("", "u")
    for kind in ("", "_least", "_fast")
    for bits in (8, 16, 32, 64)
    for what in ("t", "max", "min", "c")
}

_ELEMENTARY = """
    bool byte word dword lword sint int dint lint usint uint udint ulint real lreal time date string
"""
_CONVERSIONS = {f"{one}_to_{other}" for one in _ELEMENTARY.split() for other in _ELEMENTARY.split()}

RESERVED_WORDS = frozenset(f"{_C} {_CPP} {_IEC_KEYWORDS} {_IEC_FUNCTIONS}".split()) | _SIZED | _CONVERSIONS
"""Words that C, C++, their freestanding headers or IEC 61131-3 reserve, in lower case."""


def name_problem(name: str) -> str | None:
    """Say why `name` cannot name a machine, or give None when it can.

    Examples
    --------
    >>> name_problem("srtc_gantry")
    >>> name_problem("Gantry 2")
    'must be lower-case letters, digits and underscores, and start with a letter'
    >>> name_problem("double")
    'is a reserved word of C, C++ or Structured Text; for instance "double_crane" is free'
    """
    if len(name) > MAX_NAME_LENGTH:
        return f"has {len(name)} characters; at most {MAX_NAME_LENGTH} are allowed"
    if not _NAME.fullmatch(name):
        return "must be lower-case letters, digits and underscores, and start with a letter"
    if "__" in name or name.endswith("_"):
        return "must not contain a double underscore or end with an underscore"
    if name in RESERVED_WORDS:
        return f'is a reserved word of C, C++ or Structured Text; for instance "{name}_crane" is free'
    return None
