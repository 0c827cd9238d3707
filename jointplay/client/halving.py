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

    Parameters
    ----------
    fetch
        Asks the service for a window.
    window
        The whole window.
    halves
        Cuts a window in two; None if it cannot be cut.

    Raises
    ------
    Refused
        The service refuses for another reason, or a window cannot be cut any more.
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
