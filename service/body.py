"""The body of a request, bounded and of the right media type; all bodies together are bounded, too.

A short one is kept in memory while it arrives, a longer one on disk; one that arrives too slowly is
given up. Longer ones share `MOST_TOGETHER` bytes until their requests are answered.
"""

import asyncio
import tempfile
import time
from collections.abc import Awaitable, Callable
from typing import Annotated, Final

from fastapi import Depends, Request
from fastapi.concurrency import run_in_threadpool

from jointplay.service.byte_budget import RETRY, ByteBudget
from jointplay.service.problems import RequestRefused, kinds, unavailable
from jointplay.worker.transient_faults import is_full

LARGEST_BODY = 8 * 1024 * 1024  # bytes; a job of 100 000 points, each with three parameters
LARGEST_BATCH = 32 * 1024 * 1024  # 10 000 jobs of 3 kilobytes
LARGEST_WORD = 64 * 1024  # of a worker
MOST_DROPPED = 64 * 1024 * 1024
SHORT: Final = 64 * 1024
"""Bytes of a body that is bounded by the number of requests alone."""
MOST_TOGETHER: Final = 128 * 1024 * 1024
"""Bytes of all longer bodies."""
PATIENCE: Final = 15.0
"""Seconds that any body may take, and by which one that arrives may be behind."""
PATIENCE_OF_WORD: Final = 5.0
"""Seconds that one of a worker may take: those that hold its block have few turns."""
SLOWEST: Final = 100_000.0
"""Bytes a second that a longer one must arrive with, however long it is said to be: 1 Mbit/s."""
BUDGET: Final = ByteBudget(MOST_TOGETHER, "Many large bodies are arriving; send this one again.")


async def _bounded(request: Request, largest: int, patience: float) -> bytes:
    """Read the body without ever holding more than the limit.

    What is beyond the limit is read and dropped, up to `MOST_DROPPED`: a client that is still
    sending when the connection closes never sees why.
    """
    begun, loop = time.monotonic(), asyncio.get_running_loop()
    try:
        async with asyncio.timeout(patience) as limit:
            until = loop.time() + patience

            def keeps_up(received: int) -> None:
                limit.reschedule(until + received / SLOWEST)

            return await _arrived(request, largest, keeps_up)
    except TimeoutError:
        raise RequestRefused(
            kinds.BODY_TOO_SLOW,
            f"The body did not arrive within {time.monotonic() - begun:.0f} s.",
            headers={"Connection": "close"},
        ) from None
    except OSError as fault:
        raise _not_kept(fault) from fault


def _not_kept(fault: OSError) -> RequestRefused:
    """Return the refusal of a body that could not be written to the disk for passing bodies."""
    if is_full(fault):
        sentence = "The disk on which the service keeps bodies that arrive is full."
        again = {"Retry-After": "30", "Connection": "close"}
        return RequestRefused(kinds.DISK_FULL, sentence, headers=again)
    return unavailable("The body could not be kept while it arrived.", RETRY)


async def _arrived(request: Request, largest: int, keeps_up: Callable[[int], None]) -> bytes:
    """Return the body; `keeps_up` is told how many bytes are here whenever some came."""
    received = 0
    with tempfile.SpooledTemporaryFile(SHORT) as body:
        async for chunk in request.stream():
            received += len(chunk)
            keeps_up(min(received, largest))
            if received <= largest:
                if received > SHORT:
                    BUDGET.take(request.scope, len(chunk))
                    await run_in_threadpool(body.write, chunk)
                else:
                    body.write(chunk)
            if received > MOST_DROPPED:
                break
        if received > largest:
            raise RequestRefused(
                kinds.BODY_TOO_LARGE,
                f"The body is larger than {largest} bytes; a job is a few kilobytes.",
                headers={"Connection": "close"},
            )
        body.seek(0)
        return await run_in_threadpool(body.read) if received > SHORT else body.read()


def _json_body(largest: int, patience: float = PATIENCE) -> Callable[[Request], Awaitable[bytes]]:
    """Return a reader of bodies of at most `largest` bytes.

    The media type is insisted on: a browser sends a foreign page's ``text/plain`` here without
    asking, but not its ``application/json``.
    """

    async def read(request: Request) -> bytes:
        media_type = request.headers.get("content-type", "").partition(";")[0].strip().lower()
        body = await _bounded(request, largest, patience)
        if media_type != "application/json":
            sent = f"as {media_type!r}" if media_type else "without a Content-Type"
            raise RequestRefused(
                kinds.NOT_JSON,
                f"The body was sent {sent}; send it as application/json (curl: --json @job.json).",
            )
        coding = request.headers.get("content-encoding", "identity").strip().lower()
        if coding not in ("", "identity"):
            raise RequestRefused(
                kinds.NOT_JSON,
                f"The body was sent as {coding!r}; send it without a Content-Encoding.",
                headers={"Accept-Encoding": "identity"},
            )
        return body

    return read


JobBody = Annotated[bytes, Depends(_json_body(LARGEST_BODY))]
WordBody = Annotated[bytes, Depends(_json_body(LARGEST_WORD, PATIENCE_OF_WORD))]
BatchBody = Annotated[bytes, Depends(_json_body(LARGEST_BATCH))]
