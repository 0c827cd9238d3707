"""A file of a worker whose disk stalls keeps nobody else waiting."""

import asyncio
import io
import threading
from hashlib import sha256

from starlette.requests import Request

from jointplay.service.workers.file_body import GATHERED, _received
from jointplay.service.workers.uploads import Kept

PIECE = bytes(range(256)) * 1024
PIECES = 2 * GATHERED // len(PIECE) + 1


class Stalled(io.BytesIO):
    """A file whose writing goes on once somebody else has had a turn."""

    def __init__(self) -> None:
        super().__init__()
        self.asked, self.released = threading.Event(), threading.Event()

    def write(self, content: bytes) -> int:  # type: ignore[override]
        self.asked.set()
        assert self.released.wait(60.0), "nobody else had a turn"
        return super().write(content)


def test_the_loop_goes_on_while_a_file_waits_for_its_disk() -> None:
    content, left = Stalled(), iter([PIECE] * PIECES)

    async def receive() -> dict[str, object]:
        piece = next(left, None)
        return {"type": "http.request", "body": piece or b"", "more_body": piece is not None}

    async def release() -> None:
        while not content.asked.is_set():
            await asyncio.sleep(0.01)
        content.released.set()

    async def both() -> bytes:
        async with asyncio.timeout(120.0) as limit, asyncio.TaskGroup() as tasks:
            request = Request({"type": "http", "method": "PUT", "headers": []}, receive)
            kept = Kept(PIECES * len(PIECE))
            found = tasks.create_task(_received(request, content, kept, limit))
            tasks.create_task(release())
        assert kept.size == 0
        return found.result()

    assert asyncio.run(both()) == sha256(PIECE * PIECES).digest()
    assert content.getvalue() == PIECE * PIECES
