"""Repetition of exchanges: which are repeated, and after which pause."""

import random
import time
from datetime import UTC, datetime
from email.utils import parsedate_to_datetime
from typing import Final

import httpx

ATTEMPTS: Final = 5
FIRST_PAUSE: Final = 0.1  # s, doubled from attempt to attempt
LONGEST_PAUSE: Final = 60.0
"""Seconds: a service that asks for more patience than this is an error that the caller decides."""

LOST: Final = (httpx.NetworkError, httpx.RemoteProtocolError)
"""A connection that broke or was refused; one that is silent for long is another thing."""
_BUSY: Final = frozenset({429, 503})


def is_worth_repeating(response: httpx.Response) -> bool:
    """Tell whether the service asks for the same request once more.

    Besides 429 and 503 it does while it still answers an earlier request of the same key, which is
    what happens if only the connection was lost.
    """
    in_flight = response.request.method == "POST" and response.status_code == 409
    return response.status_code in _BUSY or (in_flight and "retry-after" in response.headers)


def pause_before(repetition: int, response: httpx.Response | None) -> float:
    """Return how long to wait before a repetition, 1 for the first, s; infinite: too long.

    Without a response the connection was lost.  Clients that were turned away together do not come
    back in the same moment: what they wait is spread over half of the pause.
    """
    pause = FIRST_PAUSE * 2.0 ** (repetition - 1)
    asked = 0.0 if response is None else _asked_for(response.headers.get("retry-after", ""))
    if asked > LONGEST_PAUSE:
        return float("inf")
    jitter = random.uniform(0.5, 1.0)  # noqa: S311
    return asked + pause * jitter


def _asked_for(retry_after: str) -> float:
    """Return the seconds of a Retry-After header: a number, or a date (RFC 9110, 10.2.3)."""
    if retry_after.isdigit():
        return float(retry_after)
    try:
        moment = parsedate_to_datetime(retry_after)
    except ValueError:
        return 0.0
    zoned = moment if moment.tzinfo else moment.replace(tzinfo=UTC)
    return max((zoned - datetime.now(UTC)).total_seconds(), 0.0)


def sleep(seconds: float) -> None:
    """Wait; here so that tests can see how long."""
    time.sleep(seconds)
