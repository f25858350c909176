"""Frozen dataclasses that are the schema of a JSON document: reading and storing follow from their fields.

A field of a `Record` is annotated with the `Member` that says how its value is checked and how it is stored:
``tick_s: Annotated[float, POSITIVE]``.

Not for: what one document holds (`swayless.machine.design_document`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Annotated, Any, TypeVar, get_args, get_origin, get_type_hints

from swayless.machine.problems import Check, Place, Table

R = TypeVar("R", bound="Record")


def _as_is(value: Any) -> Any:
    return value


@dataclass(frozen=True)
class Member:
    """How one value of a document is read and stored.

    Parameters
    ----------
    check : Check
        Turns the parsed JSON value into the value of the field, or reports what is wrong.
    stored : callable
        Turns the value of the field into what is stored: rounded, and made of JSON types.
    stands_always : bool
        Whether the key is there in every document. One that is not stands only where it has a value: a
        document that does not need it knows nothing of it.
    """

    check: Check[Any]
    stored: Callable[[Any], Any] = _as_is
    stands_always: bool = True


@dataclass(frozen=True)
class Record:
    """Base of the dataclasses that a document is made of."""

    def disagreements(self) -> Iterator[tuple[str, str]]:
        """Give the key and the reason of everything that does not fit together in this record."""
        return iter(())


def members(cls: type[Record]) -> dict[str, Member]:
    """Member of each field of a record, in the order in which they are stored."""
    hints = get_type_hints(cls, include_extras=True)
    return {key: get_args(hint)[1] for key, hint in hints.items() if get_origin(hint) is Annotated}


def read_record(cls: type[R], value: object, place: Place) -> R | None:
    """Read one record from parsed JSON; None if anything in it is wrong."""
    if not isinstance(value, dict):
        place.wrong(value, "must be an object")
        return None
    found_before = len(place.report.problems)
    table = Table(value, place.report, f"{place.path}." if place.path else "")
    values = {
        key: table.need(key, member.check) if member.stands_always else table.take(key, member.check, None)
        for key, member in members(cls).items()
    }
    table.close()
    if len(place.report.problems) > found_before:
        return None
    record = cls(**values)
    for key, reason in record.disagreements():
        table.place(key).problem(reason)
    return record


def document_of(record: Record) -> dict[str, Any]:
    """Give what is stored of a record: rounded numbers in JSON types, keys in the order of the fields."""
    values = {key: (member, getattr(record, key)) for key, member in members(type(record)).items()}
    return {
        key: member.stored(value)
        for key, (member, value) in values.items()
        if member.stands_always or value is not None
    }


def one(cls: type[Record]) -> Member:
    """Member that is itself a record."""
    return Member(lambda value, place: read_record(cls, value, place), document_of)


def one_of(known: dict[str, type[Record]]) -> Member:
    """Member that is one of several records, told apart by a key that only one of them has."""

    def check(value: object, place: Place) -> Record | None:
        found = [cls for key, cls in known.items() if isinstance(value, dict) and key in value]
        if len(found) != 1:
            place.wrong(value, f"must be an object with exactly one of {', '.join(known)}")
            return None
        return read_record(found[0], value, place)

    return Member(check, document_of)


def optional(member: Member) -> Member:
    """Member that may be null."""
    return Member(
        lambda value, place: None if value is None else member.check(value, place),
        lambda value: None if value is None else member.stored(value),
    )


def where_needed(member: Member) -> Member:
    """Member whose key stands only where there is a value; its field is None elsewhere."""
    return replace(member, stands_always=False)


def several(member: Member, *, at_least: int, at_most: int) -> Member:
    """Member that is an array, kept as a tuple."""

    def check(value: object, place: Place) -> tuple[Any, ...] | None:
        if not isinstance(value, list) or not at_least <= len(value) <= at_most:
            size = f"{at_least}" if at_least == at_most else f"{at_least} to {at_most}"
            place.wrong(value, f"must be an array of {size}")
            return None
        return tuple(member.check(item, place.item(index)) for index, item in enumerate(value))

    return Member(check, lambda items: [member.stored(item) for item in items])
