"""Answers in words and JSON are compressed for clients that take gzip.

Files of numbers are not: theirs are compressed already, or read by ranges, or gain little.
"""

import gzip
from typing import Final, Protocol
from zlib import compressobj

from anyio import to_thread
from starlette.datastructures import Headers, MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from jointplay.service.results.forms import weights_of

LEAST: Final = 1000
"""Bytes: shorter answers fit one packet as they are."""
_ASIDE: Final = 32_000
"""Bytes that other requests wait for; longer answers are compressed in a thread."""
_GZIP: Final = 31  # window of 32 KiB, and the form that HTTP calls gzip
_LEVEL: Final = 4  # of nine: a third of the time of the sixth, for 5 % more bytes
_TYPES: Final = ("text/", "application/json", "application/problem+json", "image/svg+xml")
_STREAM: Final = "text/event-stream"


class Compressor(Protocol):
    """An object of zlib, whose class has no name."""

    def compress(self, data: bytes, /) -> bytes:
        """Take a piece, and return what is ready."""
        ...

    def flush(self) -> bytes:
        """Return the end."""
        ...


class Compression:
    """Compresses an answer that is 200, of a type above and not encoded otherwise."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on, and its answer when its body is known."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        accepts = takes_gzip(Headers(scope=scope).get("accept-encoding", ""))
        start: Message | None = None
        packer: Compressor | None = None  # of an answer in pieces

        async def compressed(message: Message) -> None:
            nonlocal start, packer
            if message["type"] == "http.response.start" and _is_fit(message):
                start = message  # goes with the body, whose length it tells
                return
            if packer is not None:
                await send({**message, "body": await _packed_piece(packer, message)})
                return
            if start is not None:
                headers = MutableHeaders(raw=start["headers"])
                if "accept-encoding" not in headers.get("vary", "").lower():
                    headers.add_vary_header("Accept-Encoding")
                body = message.get("body", b"")
                if accepts and not message.get("more_body") and len(body) >= LEAST:
                    message = {**message, "body": await _packed(body, headers)}
                elif accepts and message.get("more_body"):
                    _say_so(headers)
                    packer = compressobj(_LEVEL, wbits=_GZIP)
                    message = {**message, "body": await _packed_piece(packer, message)}
                await send(start)
                start = None
            await send(message)

        await self._app(scope, receive, compressed)


def takes_gzip(accepted: str) -> bool:
    """Tell whether an Accept-Encoding header names gzip, or anything."""
    weights = weights_of(accepted)
    return weights.get("gzip", weights.get("*", 0.0)) > 0.0


def _is_fit(start: Message) -> bool:
    headers = Headers(raw=start["headers"])
    media_type = headers.get("content-type", "")
    plain = "content-encoding" not in headers and not media_type.startswith(_STREAM)
    return start["status"] == 200 and plain and media_type.startswith(_TYPES)


async def _packed(body: bytes, headers: MutableHeaders) -> bytes:
    """Compress a body, and say so in its headers."""
    packed = _compress(body) if len(body) < _ASIDE else await to_thread.run_sync(_compress, body)
    _say_so(headers)
    headers["Content-Length"] = str(len(packed))
    return packed


def _say_so(headers: MutableHeaders) -> None:
    headers["Content-Encoding"] = "gzip"
    del headers["Content-Length"]
    tag = headers.get("etag", "")
    if tag.startswith('"'):
        headers["ETag"] = f"W/{tag}"  # the bytes are others, what they mean is not


async def _packed_piece(packer: Compressor, message: Message) -> bytes:
    """Compress a piece of a body, or its end; what comes out may wait for further ones."""
    body = message.get("body", b"")
    pack = packer.compress
    packed = pack(body) if len(body) < _ASIDE else await to_thread.run_sync(pack, body)
    return packed if message.get("more_body") else packed + packer.flush()


def _compress(body: bytes) -> bytes:
    return gzip.compress(body, _LEVEL, mtime=0)
