"""Caches of the API are emptied when nobody asks them any more."""

import weakref
from functools import lru_cache

import pytest

from jointplay.service import memory
from jointplay.service.memory import empty_unused_caches, let_go_when_unused


def test_a_cache_is_emptied_when_it_was_not_asked_between_two_looks(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(memory, "_caches", {})

    @let_go_when_unused
    @lru_cache(maxsize=4)
    def squared(number: int) -> int:
        return number * number

    for number in (2, 3, 3):
        squared(number)
        empty_unused_caches()
        assert squared.cache_info().currsize == min(number - 1, 2)
    empty_unused_caches()
    assert squared.cache_info().currsize == 0
    assert squared(3) == 9
    empty_unused_caches()
    assert squared.cache_info().currsize == 1


class Cyclic:
    """Refers to itself, as readers of results do."""

    def __init__(self) -> None:
        self.myself = self


def test_what_refers_to_itself_is_given_back_too(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(memory, "_caches", {})
    opened = let_go_when_unused(lru_cache(maxsize=4)(Cyclic))
    left = weakref.ref(opened())
    empty_unused_caches()
    assert left() is not None
    empty_unused_caches()
    assert left() is None
