"""The body of a request, bounded and parsed strictly."""

from typing import Annotated

from fastapi import Depends, Request

from jointplay.strict_json import parse
from service.problems import RequestRefused, kinds

LARGEST_BODY = 1024 * 1024  # bytes; a scene of 12 bodies takes about 10 000
MOST_DROPPED = 64 * LARGEST_BODY


async def _bounded(request: Request) -> bytes:
    """Read the body without ever holding more than the limit.

    What is beyond the limit is read and dropped, up to `MOST_DROPPED`: a client that is still
    sending when the connection closes never sees why.
    """
    body = bytearray()
    received = 0
    async for chunk in request.stream():
        received += len(chunk)
        if received <= LARGEST_BODY:
            body += chunk
        if received > MOST_DROPPED:
            break
    if received > LARGEST_BODY:
        raise RequestRefused(
            kinds.BODY_TOO_LARGE,
            f"The body is larger than {LARGEST_BODY} bytes; a job is a few kilobytes.",
            headers={"Connection": "close"},
        )
    return bytes(body)


async def _json_document(request: Request) -> object:
    """Parse the body.

    The media type is insisted on: a browser sends a foreign page's ``text/plain`` here without
    asking, but not its ``application/json``.
    """
    media_type = request.headers.get("content-type", "").partition(";")[0].strip().lower()
    body = await _bounded(request)
    if media_type != "application/json":
        raise RequestRefused(
            kinds.NOT_JSON,
            f"The body was sent as {media_type or 'nothing'!r}; send it as application/json "
            "(curl: --json @job.json).",
        )
    return parse(body)


JsonDocument = Annotated[object, Depends(_json_document)]
