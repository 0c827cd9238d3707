"""Sound documents, each changed so that it is refused at one place."""

import copy
from collections.abc import Callable
from typing import Any

import pytest

from jointplay.records.failure import InvalidInput, LimitExceeded
from jointplay.solver.kinds import admit

Change = Callable[[dict[str, Any]], None]
Refused = tuple[Change, str, str]
"""A change, the pointer at which the document is refused then, and words of the sentence."""


def at(path: str, value: Any) -> Change:
    """Return a change: put a value at a path."""

    def change(document: dict[str, Any]) -> None:
        *parents, last = path.strip("/").split("/")
        place: Any = document
        for key in parents:
            place = place[int(key)] if isinstance(place, list) else place[key]
        place[int(last) if isinstance(place, list) else last] = value

    return change


def without(path: str) -> Change:
    """Return a change: take away what is at a path."""

    def change(document: dict[str, Any]) -> None:
        *parents, last = path.strip("/").split("/")
        for key in parents:
            document = document[key]
        del document[last]

    return change


def both(*changes: Change) -> Change:
    """Return a change: make some others."""

    def change(document: dict[str, Any]) -> None:
        for one in changes:
            one(document)

    return change


def changed(sound: dict[str, Any], change: Change) -> dict[str, Any]:
    """Return a changed copy of a document."""
    document = copy.deepcopy(sound)
    change(document)
    return document


def assert_refused(document: dict[str, Any], pointer: str, words: str) -> None:
    with pytest.raises(InvalidInput) as refused:
        admit(document)
    assert not isinstance(refused.value, LimitExceeded)
    assert_points(refused.value, pointer, words)


def assert_points(error: InvalidInput, pointer: str, words: str) -> None:
    found = {problem.pointer: problem.detail for problem in error.problems}
    assert pointer in found, found
    assert words in found[pointer], found[pointer]
    for problem in error.problems:
        assert problem.detail.endswith((".", "?")), problem
        assert "\n" not in problem.detail
