"""Results larger than one answer: their window is halved until the parts fit."""

from collections.abc import Callable, Iterator
from typing import TypeVar

from jointplay.client.errors import Refused

_TOO_LARGE = "response-too-large"
Window = TypeVar("Window")
Answer = TypeVar("Answer")


def parts_that_fit(
    fetch: Callable[[Window], Answer],
    window: Window,
    halves: Callable[[Window], tuple[Window, Window] | None],
) -> Iterator[tuple[Window, Answer]]:
    """Yield consecutive parts of a window with their answers.

    ``fetch`` asks the service for a window, ``halves`` cuts one in two, or says None if it cannot
    be cut; then, and where the service refuses for another reason, its `Refused` is raised.
    """
    try:
        answer = fetch(window)
    except Refused as refusal:
        halved = halves(window) if refusal.problem == _TOO_LARGE else None
        if halved is None:
            raise
        for half in halved:
            yield from parts_that_fit(fetch, half, halves)
    else:
        yield window, answer
