"""The rules on characters, comments and words of a source. Not for: anything that needs a parse tree."""

from __future__ import annotations

import re

from swayless.verify.structured_text.faults import Problems
from swayless.verify.structured_text.names import why_not_portable

COMMENT = re.compile(r"\(\*(.*?)\*\)", re.DOTALL)
NOT_IN_COMMENTS = re.compile(r"\(\*|[{}$]")
NOT_IN_CODE = re.compile(r"//|/\*|\(\*|\*\)|\*\*|[^\w\n +\-*/()\[\]<>=:;,.]", re.ASCII)
WORD = re.compile(r"(?<!\w)[A-Za-z_]\w*", re.ASCII)

WHY_NOT_IN_CODE = {
    "//": "line comments are not portable: use (* *)",
    "/*": "C comments are not portable: use (* *)",
    "(*": "the comment does not end",
    "*)": "no comment ends here",
    "**": "the power operator is not portable: multiply",
    "{": "pragmas are not portable",
    "&": "write AND",
    "#": "typed and based literals are not portable: write a plain decimal number",
    "\r": "line ends must be LF, found CR",
    "\t": "indent with spaces, found a tab",
}


def code_of(source: str) -> str:
    """Check the characters and words of a source and blank its comments, keeping every line and column.

    Raises
    ------
    SubsetError
        With every character, comment and word that is not portable.

    Examples
    --------
    >>> code_of("X := 1; (* one *)")
    'X := 1;          '
    """
    problems = Problems()

    def note(offset: int, message: str) -> None:
        problems.add(source.count("\n", 0, offset) + 1, message)

    for found in re.finditer(r"[^\x00-\x7f]", source):
        note(found.start(), f"character {found.group()!r} is not ASCII")
    for comment in COMMENT.finditer(source):
        for found in NOT_IN_COMMENTS.finditer(comment.group(), 2):
            note(comment.start() + found.start(), f"a comment must not hold {found.group()}")
    code = COMMENT.sub(lambda comment: re.sub(r"[^\n]", " ", comment.group()), source)
    for found in NOT_IN_CODE.finditer(code):
        if found.group().isascii():
            note(
                found.start(),
                WHY_NOT_IN_CODE.get(found.group(), f"character {found.group()!r} is not portable"),
            )
    for found in WORD.finditer(code):
        if message := why_not_portable(found.group()):
            note(found.start(), message)
    problems.raise_if_any()
    return code
