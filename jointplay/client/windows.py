"""Results larger than one answer: fetched window by window."""

import math
from collections.abc import Callable, Iterator
from typing import Any

from jointplay.client.errors import Refused

_TOO_LARGE = "response-too-large"


def pieces(
    fetch: Callable[[float | None, float | None], dict[str, Any]],
    start: float | None,
    stop: float | None,
    end: Callable[[], float],
) -> Iterator[dict[str, Any]]:
    """Yield the documents of consecutive windows that together cover ``start`` to ``stop``.

    Parameters
    ----------
    fetch
        Returns the document of a window, both ends included, s.
    start, stop
        The whole window, s; None is unbounded.
    end
        Returns the last time there can be, s; asked for only if one answer cannot hold all.

    Raises
    ------
    Refused
        The service refuses for another reason, or a window cannot be halved any more.
    """
    try:
        document = fetch(start, stop)
    except Refused as refusal:
        if refusal.problem != _TOO_LARGE:
            raise
        first = 0.0 if start is None else start
        last = end() if stop is None else stop
        middle = first + (last - first) / 2.0
        following = math.nextafter(middle, math.inf)
        if not first <= middle < following <= last:
            raise
        yield from pieces(fetch, start, middle, end)
        yield from pieces(fetch, following, stop, end)
    else:
        yield document
