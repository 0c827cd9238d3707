"""Bytes that many requests have at once: owners have what they can, and leave room to others."""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager

import pytest

from jointplay.service.owners import OWNER, UNTIL_ANSWERED
from jointplay.service.problems import RequestRefused
from jointplay.service.together import Together


@pytest.fixture
def together() -> Together:
    return Together(16, "full")


@contextmanager
def asked(together: Together, owner: str, *sizes: int) -> Iterator[None]:
    """Take room for requests of one byte after the other until these are answered."""
    with ExitStack() as held:
        before = OWNER.set(owner)
        try:
            for size in sizes:
                together.take({UNTIL_ANSWERED: held}, size)
        finally:
            OWNER.reset(before)
        yield


def test_all_of_one_owner_is_half_of_what_there_is(together: Together) -> None:
    with asked(together, "ada", *[1] * 8):
        with pytest.raises(RequestRefused), asked(together, "ada", 1):
            pass
        with asked(together, "bob", *[1] * 4):
            with pytest.raises(RequestRefused), asked(together, "bob", 1):
                pass
            with asked(together, "eve", 2, 0):
                assert together.held == 14
    assert together.held == 0


def test_where_no_key_is_asked_for_all_is_for_everybody(together: Together) -> None:
    with asked(together, "", *[1] * 16):
        with pytest.raises(RequestRefused), asked(together, "", 1):
            pass
        with asked(together, "", 0):
            assert together.held == 16


def test_one_request_alone_has_what_it_needs(together: Together) -> None:
    with asked(together, "ada", 100):
        with asked(together, "eve", 0):
            pass
        with pytest.raises(RequestRefused), asked(together, "bob", 1):
            pass
    with asked(together, "bob", 1):
        pass


def test_a_request_that_grows_gives_all_of_it_back(together: Together) -> None:
    with ExitStack() as held:
        scope = {UNTIL_ANSWERED: held}
        for _ in range(16):
            together.take(scope, 1)
        with pytest.raises(RequestRefused):
            together.take(scope, 1)
    assert together.held == 0
