"""Slots for what keeps a thread for long: owners wait for them in turn, and without a thread."""

import asyncio
from collections import OrderedDict, deque
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Annotated, Any, Final

from fastapi import Depends, Request
from starlette.requests import ClientDisconnect

from jointplay.service.dependencies import of_the_application
from jointplay.service.owners import OWNER

DRAWN_AT_ONCE: Final = 4
"""Figures: of the 40 threads that answer requests the others are left for what takes no time."""
EXPORTED_AT_ONCE: Final = 2
"""Tables in files: a second or two each."""
LISTED_AT_ONCE: Final = 4
"""Pages of jobs, whose documents may be megabytes."""


class FairSemaphore:
    """Gives so many slots, to owners in turn; used by one event loop."""

    def __init__(self, most: int) -> None:
        self._free = most
        self._waiting: OrderedDict[str, deque[asyncio.Future[None]]] = OrderedDict()

    @asynccontextmanager
    async def slot(self, owner: str) -> AsyncIterator[None]:
        """Wait for a slot, and hold it while the block runs."""
        if self._free:
            self._free -= 1
        else:
            await self._turn(owner)
        try:
            yield
        finally:
            self._leave()

    async def _turn(self, owner: str) -> None:
        turn = asyncio.get_running_loop().create_future()
        self._waiting.setdefault(owner, deque()).append(turn)
        try:
            await turn
        except asyncio.CancelledError:
            if not turn.cancelled():  # the slot was given at the same moment
                self._leave()
            raise

    def _leave(self) -> None:
        """Give the slot to the next owner, to the request that waited longest."""
        while self._waiting:
            owner, turns = self._waiting.popitem(last=False)
            turn = turns.popleft()
            if turns:
                self._waiting[owner] = turns  # behind all others
            if not turn.cancelled():
                turn.set_result(None)
                return
        self._free += 1


@asynccontextmanager
async def slot_for(request: Request, slots: FairSemaphore) -> AsyncIterator[None]:
    """Hold a slot for the caller while the block runs; ClientDisconnect: nobody waits any more."""
    async with slots.slot(OWNER.get()):
        if await request.is_disconnected():
            raise ClientDisconnect
        yield


def in_turn(of: str) -> Any:
    """Return the dependency on a slot, of those that the application has under a name.

    It is held until the answer was made, and no longer: a client may take it slowly.
    """

    async def held(
        request: Request, slots: Annotated[FairSemaphore, of_the_application(of)]
    ) -> AsyncIterator[None]:
        async with slot_for(request, slots):
            yield

    return Depends(held, scope="function")
