"""`AsyncClient`: jobs, batches and scenes of one service, for event loops."""

from collections.abc import Callable, Coroutine
from functools import partial
from typing import TYPE_CHECKING, Any, Self

import httpx

from jointplay import jobs as documents
from jointplay.client.asynchronous.batch import AsyncBatch
from jointplay.client.asynchronous.job import AsyncJob
from jointplay.client.asynchronous.network import AwaitedNetwork
from jointplay.client.asynchronous.verbs import awaited, each, iterated
from jointplay.client.client import Client
from jointplay.client.connection import LONGEST_ANSWER, Connection


class AsyncClient:
    """A connection to one service from an event loop of asyncio.

    It has the verbs of `Client` with the same arguments; what they return has those of `Job` and
    `Batch`.  What asks the service is awaited, and what yields is for ``async for``:

        async with AsyncClient("http://127.0.0.1:8000") as client:
            job = await client.simulate("slider-crank", duration=1.0)
            await job.wait()
            print(await job.peaks)

    Any number of jobs can be waited for at once.  Use it in the loop in which it was first used.

    Parameters
    ----------
    url, key, timeout
        As of `Client`.
    transport
        Another httpx transport.
    """

    def __init__(
        self,
        url: str | None = None,
        *,
        key: str | None = None,
        timeout: float = LONGEST_ANSWER,
        transport: httpx.AsyncBaseTransport | None = None,
    ) -> None:
        network = partial(AwaitedNetwork, transport=transport)
        self._blocking = Client._over(Connection(url, key, timeout, network))

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(self, *error: object) -> None:
        await self.close()

    def __repr__(self) -> str:
        return f"Async{self._blocking!r}"

    close = awaited(Client.close)

    if TYPE_CHECKING:  # a method of each kind, see below

        def __getattr__(self, kind: str) -> Callable[..., Coroutine[Any, Any, AsyncJob]]: ...

    submit = awaited(Client.submit, AsyncJob)
    submit_batch = awaited(Client.submit_batch, AsyncBatch)
    map = awaited(Client.map, lambda jobs: each(jobs, AsyncJob))
    estimate = awaited(Client.estimate)

    job = awaited(Client.job, AsyncJob)
    jobs = iterated(Client.jobs, AsyncJob)
    batch = awaited(Client.batch, AsyncBatch)
    batches = iterated(Client.batches, AsyncBatch)

    check_scene = awaited(Client.check_scene)
    poses = awaited(Client.poses)
    drag = awaited(Client.drag)
    scenes = awaited(Client.scenes)
    scene = awaited(Client.scene)
    laws = awaited(Client.laws)


for _name in documents.functions():
    setattr(AsyncClient, _name, awaited(getattr(Client, _name), AsyncJob))
