"""Which identifiers every Structured Text compiler accepts. Not for: C names, or making names up."""

from __future__ import annotations

MAX_LENGTH = 40
"""Longest identifier that the compilers checked keep apart."""

KEYWORDS = """
    ABSTRACT ACTION AND ARRAY AT BEGIN BY CASE CLASS CONFIGURATION CONSTANT CONTINUE DO ELSE ELSIF
    END_ACTION END_CASE END_CLASS END_CONFIGURATION END_FOR END_FUNCTION END_FUNCTION_BLOCK END_IF
    END_INTERFACE END_METHOD END_NAMESPACE END_PROGRAM END_PROPERTY END_REPEAT END_RESOURCE END_STEP
    END_STRUCT END_TRANSITION END_TYPE END_UNION END_VAR END_WHILE EXIT EXTENDS FALSE FINAL FOR FROM
    FUNCTION FUNCTION_BLOCK F_EDGE GET IF IMPLEMENTS INITIAL_STEP INTERFACE INTERNAL INTERVAL METHOD MOD
    NAMESPACE NON_RETAIN NOT NULL OF ON OR OVERLAP OVERRIDE PERSISTENT POINTER PRIORITY PRIVATE PROGRAM
    PROPERTY PROTECTED PUBLIC READ_ONLY READ_WRITE REF REFERENCE_TO REF_TO REPEAT RESOURCE RETAIN RETURN
    R_EDGE SET SINGLE STEP STRUCT SUPER TASK THEN THIS TO TRANSITION TRUE TYPE UNION UNTIL USING VAR
    VAR_ACCESS VAR_CONFIG VAR_EXTERNAL VAR_GLOBAL VAR_INPUT VAR_INST VAR_IN_OUT VAR_OUTPUT VAR_STAT
    VAR_TEMP WHILE WITH XOR
"""
TYPES = """
    ANY ANY_BIT ANY_DATE ANY_DERIVED ANY_ELEMENTARY ANY_INT ANY_MAGNITUDE ANY_NUM ANY_REAL ANY_STRING BOOL
    BYTE CHAR DATE DATE_AND_TIME DINT DT DWORD INT LDATE LDT LINT LREAL LTIME LTOD LWORD REAL SINT STRING
    TIME TIME_OF_DAY TOD UDINT UINT ULINT USINT WCHAR WORD WSTRING
"""
STANDARD_FUNCTIONS = """
    ABS ACOS ADD ADR ASIN ATAN ATAN2 CONCAT COS DELETE DIV EQ EXP EXPT FIND GE GT INSERT LE LEFT LEN LIMIT
    LN LOG LT MAX MID MIN MOVE MUL MUX NE REPLACE RIGHT ROL ROR ROUND SEL SHL SHR SIN SIZEOF SQRT SUB TAN
    TRUNC
    DINT_TO_INT DINT_TO_LREAL DINT_TO_REAL INT_TO_DINT INT_TO_LREAL INT_TO_REAL LREAL_TO_DINT LREAL_TO_INT
    LREAL_TO_REAL REAL_TO_DINT REAL_TO_INT REAL_TO_LREAL
"""
STANDARD_BLOCKS = "CTD CTU CTUD F_TRIG RS RTC R_TRIG SEMA SR TOF TON TP"
RESERVED_SOMEWHERE = "EN ENO"

RESERVED = frozenset(
    f"{KEYWORDS} {TYPES} {STANDARD_FUNCTIONS} {STANDARD_BLOCKS} {RESERVED_SOMEWHERE}".split()
)
"""Words, in upper case, that some compiler takes for its own.

Kept apart from the generator's list, so that a word forgotten there is found here.
"""


def why_not_portable(word: str) -> str | None:
    """Say what is wrong with a word of the source, or None if nothing is.

    Keywords must be written in upper case; any other spelling of a reserved word is refused.

    Examples
    --------
    >>> why_not_portable("RopeLength"), why_not_portable("FUNCTION_BLOCK")
    (None, None)
    >>> why_not_portable("Rope__Length")
    'Rope__Length holds two underscores in a row'
    >>> why_not_portable("Step")
    'Step is reserved: as a keyword it is written STEP, as a name choose another'
    """
    if len(word) > MAX_LENGTH:
        return f"{word} has {len(word)} characters, at most {MAX_LENGTH} are allowed"
    if "__" in word:
        return f"{word} holds two underscores in a row"
    if word.endswith("_"):
        return f"{word} ends in an underscore"
    if word != word.upper() and word.upper() in RESERVED:
        return f"{word} is reserved: as a keyword it is written {word.upper()}, as a name choose another"
    return None
