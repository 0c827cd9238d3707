"""The body of a request, bounded and of the right media type."""

from collections.abc import Awaitable, Callable
from typing import Annotated

from fastapi import Depends, Request

from jointplay.service.problems import RequestRefused, kinds

LARGEST_BODY = 8 * 1024 * 1024  # bytes; a job of 100 000 points, each with three parameters
LARGEST_BATCH = 32 * 1024 * 1024  # 10 000 jobs of 3 kilobytes
LARGEST_WORD = 64 * 1024  # of a worker
MOST_DROPPED = 64 * 1024 * 1024


async def _bounded(request: Request, largest: int) -> bytes:
    """Read the body without ever holding more than the limit.

    What is beyond the limit is read and dropped, up to `MOST_DROPPED`: a client that is still
    sending when the connection closes never sees why.
    """
    body = bytearray()
    received = 0
    async for chunk in request.stream():
        received += len(chunk)
        if received <= largest:
            body += chunk
        if received > MOST_DROPPED:
            break
    if received > largest:
        raise RequestRefused(
            kinds.BODY_TOO_LARGE,
            f"The body is larger than {largest} bytes; a job is a few kilobytes.",
            headers={"Connection": "close"},
        )
    return bytes(body)


def _json_body(largest: int) -> Callable[[Request], Awaitable[bytes]]:
    """Return a reader of bodies of at most `largest` bytes.

    The media type is insisted on: a browser sends a foreign page's ``text/plain`` here without
    asking, but not its ``application/json``.
    """

    async def read(request: Request) -> bytes:
        media_type = request.headers.get("content-type", "").partition(";")[0].strip().lower()
        body = await _bounded(request, largest)
        if media_type != "application/json":
            raise RequestRefused(
                kinds.NOT_JSON,
                f"The body was sent as {media_type or 'nothing'!r}; send it as application/json "
                "(curl: --json @job.json).",
            )
        return body

    return read


JobBody = Annotated[bytes, Depends(_json_body(LARGEST_BODY))]
WordBody = Annotated[bytes, Depends(_json_body(LARGEST_WORD))]
BatchBody = Annotated[bytes, Depends(_json_body(LARGEST_BATCH))]
