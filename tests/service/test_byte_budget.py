"""Bytes that many requests have at once: owners have what they can, and leave room to others."""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager

import pytest

from jointplay.service.byte_budget import ByteBudget
from jointplay.service.owners import OWNER, UNTIL_ANSWERED
from jointplay.service.problems import RequestRefused


@pytest.fixture
def budget() -> ByteBudget:
    return ByteBudget(16, "full")


@contextmanager
def asked(budget: ByteBudget, owner: str, *sizes: int) -> Iterator[None]:
    """Take room for requests of one byte after the other until these are answered."""
    with ExitStack() as held:
        before = OWNER.set(owner)
        try:
            for size in sizes:
                budget.take({UNTIL_ANSWERED: held}, size)
        finally:
            OWNER.reset(before)
        yield


def test_all_of_one_owner_is_half_of_what_there_is(budget: ByteBudget) -> None:
    with asked(budget, "ada", *[1] * 8):
        with pytest.raises(RequestRefused), asked(budget, "ada", 1):
            pass
        with asked(budget, "bob", *[1] * 4):
            with pytest.raises(RequestRefused), asked(budget, "bob", 1):
                pass
            with asked(budget, "eve", 2, 0):
                assert budget.held == 14
    assert budget.held == 0


def test_where_no_key_is_asked_for_all_is_for_everybody(budget: ByteBudget) -> None:
    with asked(budget, "", *[1] * 16):
        with pytest.raises(RequestRefused), asked(budget, "", 1):
            pass
        with asked(budget, "", 0):
            assert budget.held == 16


def test_one_request_alone_has_what_it_needs(budget: ByteBudget) -> None:
    with asked(budget, "ada", 100):
        with asked(budget, "eve", 0):
            pass
        with pytest.raises(RequestRefused), asked(budget, "bob", 1):
            pass
    with asked(budget, "bob", 1):
        pass


def test_a_request_that_grows_gives_all_of_it_back(budget: ByteBudget) -> None:
    with ExitStack() as held:
        scope = {UNTIL_ANSWERED: held}
        for _ in range(16):
            budget.take(scope, 1)
        with pytest.raises(RequestRefused):
            budget.take(scope, 1)
    assert budget.held == 0
