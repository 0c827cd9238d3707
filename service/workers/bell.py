"""The bell of one API: workers that wait for a block hear of new ones at once."""

import asyncio
from collections import deque
from typing import Annotated

from jointplay.service.dependencies import of_the_application


class Bell:
    """Wakes as many of those who wait as there are new blocks, who waited longest first.

    Nothing depends on it: what other APIs accepted is found by looking now and then.
    """

    def __init__(self) -> None:
        self._loop = asyncio.get_running_loop()
        self._waiting: deque[asyncio.Future[None]] = deque()

    async def wait(self, seconds: float) -> bool:
        """Wait until it rings, at most for some seconds. Returns whether it did."""
        rung = self._loop.create_future()
        self._waiting.append(rung)
        try:
            await asyncio.wait([rung], timeout=seconds)
        finally:
            if not rung.done():
                self._waiting.remove(rung)
        return rung.done()

    def ring(self, blocks: int) -> None:
        """Tell of new blocks; from any thread."""
        self._loop.call_soon_threadsafe(self._wake, blocks)

    def _wake(self, blocks: int) -> None:
        for _ in range(min(blocks, len(self._waiting))):
            self._waiting.popleft().set_result(None)


BellDependency = Annotated[Bell, of_the_application("bell")]
