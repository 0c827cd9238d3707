"""New blocks of one API: workers that wait for a block hear of them at once."""

import asyncio
from collections import deque
from typing import Annotated

from jointplay.service.dependencies import of_the_application


class NewBlocks:
    """Wakes as many of those who wait as there are new blocks, who waited longest first.

    Nothing depends on it: what other APIs accepted is found by looking now and then.
    """

    def __init__(self) -> None:
        self._loop = asyncio.get_running_loop()
        self._waiting: deque[asyncio.Future[None]] = deque()

    async def wait(self, seconds: float) -> bool:
        """Wait for a block, at most for some seconds. Returns whether one was announced."""
        announced = self._loop.create_future()
        self._waiting.append(announced)
        try:
            await asyncio.wait([announced], timeout=seconds)
        finally:
            if not announced.done():
                self._waiting.remove(announced)
        return announced.done()

    def announce(self, blocks: int) -> None:
        """Tell of new blocks; from any thread."""
        self._loop.call_soon_threadsafe(self._wake, blocks)

    def _wake(self, blocks: int) -> None:
        for _ in range(min(blocks, len(self._waiting))):
            self._waiting.popleft().set_result(None)


NewBlocksDependency = Annotated[NewBlocks, of_the_application("new_blocks")]
