"""The body of a file that a worker sends: it arrives in a file without a name, and in time."""

import asyncio
import tempfile
import time
from base64 import b64encode
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from hashlib import sha256
from pathlib import Path
from typing import IO, TYPE_CHECKING, Final

from fastapi import Request
from fastapi.concurrency import run_in_threadpool

from jointplay.service.problems import RequestRefused, kinds
from jointplay.service.workers.uploads import Kept
from jointplay.worker.transient_faults import is_full

if TYPE_CHECKING:
    from hashlib import _Hash

LARGEST_FILE: Final = 2**34
PATIENCE: Final = 30.0
"""Seconds that any file may take, and by which one that arrives may be behind: when a machine is
lost, nobody closes its connection."""
GATHERED: Final = 2**20
"""Bytes that are written at once."""
SLOWEST: Final = 20_000.0
"""Bytes a second that it must arrive with beyond them."""


def length_of(request: Request) -> int:
    """Return the bytes that a request says its body has; refused if it does not."""
    length = request.headers.get("content-length", "")
    if not length.isdecimal() or int(length) > LARGEST_FILE:
        sentence = f"Content-Length is missing, or more than {LARGEST_FILE} bytes."
        raise RequestRefused.of_parameter("Content-Length", sentence)
    return int(length)


@asynccontextmanager
async def arrived(request: Request, folder: Path, kept: Kept) -> AsyncIterator[IO[bytes]]:
    """Give the body, once its digest was found right, in a file at its beginning.

    Parameters
    ----------
    folder
        On whose disk it is.
    kept
        Room that was kept for it.
    """
    length_of(request)
    begun = time.monotonic()
    with tempfile.TemporaryFile(dir=folder) as content:
        try:
            async with asyncio.timeout(PATIENCE) as limit:
                digest = await _received(request, content, kept, limit)
        except TimeoutError:
            raise RequestRefused(
                kinds.BODY_TOO_SLOW,
                f"The file did not arrive within {time.monotonic() - begun:.0f} s.",
                headers={"Connection": "close"},
            ) from None
        except OSError as fault:
            if not is_full(fault):
                raise
            sentence = "The disk of the service is full."
            raise RequestRefused(
                kinds.DISK_FULL, sentence, headers={"Retry-After": "30", "Connection": "close"}
            ) from fault
        expected = f"sha-256=:{b64encode(digest).decode()}:"
        if request.headers.get("content-digest") != expected:
            sentence = "Content-Digest, sha-256, is missing, or not that of the bytes that arrived."
            raise RequestRefused.of_parameter("Content-Digest", sentence)
        content.seek(0)
        yield content


async def _received(
    request: Request, content: IO[bytes], kept: Kept, limit: asyncio.Timeout
) -> bytes:
    digest, received, gathered = sha256(), 0, bytearray()
    until = asyncio.get_running_loop().time() + PATIENCE

    async def write() -> None:  # in a thread: a disk may stall, and other requests shall not
        await run_in_threadpool(_write, content, digest, bytes(gathered))
        kept.wrote(len(gathered))
        gathered.clear()

    async for piece in request.stream():  # no more than its length: see `service.targets`
        received += len(piece)
        limit.reschedule(until + received / SLOWEST)
        gathered += piece
        if len(gathered) >= GATHERED:
            await write()
    await write()
    return digest.digest()


def _write(content: IO[bytes], digest: "_Hash", piece: bytes) -> None:
    digest.update(piece)
    content.write(piece)
    content.flush()
