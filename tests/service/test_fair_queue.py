"""Owners take turns at what few can have at a time, and none of them takes all threads."""

import threading
from collections.abc import Callable
from contextlib import suppress

import pytest

from jointplay.service.fair_queue import OF_ONE, FairQueue, Full
from tests.waiting import until


def waiting(queue: FairQueue, owner: str, count: int, act: Callable[[], object]) -> None:
    """Have threads of an owner wait for a place, one after the other, and do something there."""

    def ask() -> None:
        with queue.slot(owner):
            act()

    for _ in range(count):
        before = queue.waiting()
        threading.Thread(target=ask, daemon=True).start()
        until(lambda before=before: queue.waiting() == before + 1)


def test_an_owner_who_waits_often_is_told_so_and_no_other() -> None:
    queue, served = FairQueue(2), []
    with queue.slot("x"), queue.slot("y"):
        waiting(queue, "ada", OF_ONE, lambda: served.append("ada"))
        with pytest.raises(Full), queue.slot("ada"):
            pass
        waiting(queue, "bob", 1, lambda: served.append("bob"))
    until(lambda: len(served) == OF_ONE + 1)


def test_an_owner_has_one_place_at_a_time() -> None:
    queue = FairQueue(2)
    with queue.slot("ada") as first:
        waiting(queue, "ada", 1, lambda: None)
        with queue.slot("bob") as second:
            assert {first, second} == {0, 1}
            assert queue.waiting() == 1
    until(lambda: not queue.waiting())


def test_one_place_goes_round() -> None:
    queue, served = FairQueue(1), []
    with queue.slot("x"):
        waiting(queue, "ada", 3, lambda: served.append("ada"))
        waiting(queue, "bob", 2, lambda: served.append("bob"))
        waiting(queue, "eve", 1, lambda: served.append("eve"))
    until(lambda: len(served) == 6)
    assert served == ["ada", "bob", "eve", "ada", "bob", "ada"]


def test_owners_leave_threads_of_all_queues_to_others() -> None:
    queues, go = [FairQueue(2) for _ in range(3)], threading.Event()

    def ask(queue: FairQueue, owner: str) -> None:
        with suppress(Full), queue.slot(owner):
            go.wait()

    def taken(owner: str) -> int:
        """Return how many threads an owner has who asks as often as he may."""
        for queue in queues * OF_ONE:
            before = FairQueue._everywhere[owner]
            thread = threading.Thread(target=ask, args=(queue, owner), daemon=True)
            thread.start()
            until(
                lambda before=before, thread=thread: (
                    FairQueue._everywhere[owner] > before or not thread.is_alive()
                )
            )
        return FairQueue._everywhere[owner]

    assert [taken(owner) for owner in ("ada", "bob", "eve", "joe", "max")] == [16, 8, 4, 2, 1]
    go.set()
    until(lambda: not FairQueue._everywhere.total())
