"""A network that is awaited by the event loop of asyncio."""

import asyncio
from collections.abc import AsyncIterator, Callable, Iterator
from contextlib import AbstractAsyncContextManager, aclosing, contextmanager, suppress
from typing import Any, TypeVar

import httpx
from httpx_sse import ServerSentEvent, aconnect_sse

from jointplay.client.asynchronous.bridge import waited
from jointplay.client.errors import error_from

Answer = TypeVar("Answer")


class AwaitedNetwork:
    """A `Network` for functions that `bridged` calls; `settings` are those of `httpx.AsyncClient`.

    There may be any number of requests at the same time: each job that is waited for is one.
    """

    def __init__(self, **settings: Any) -> None:
        limits = httpx.Limits(max_connections=None, max_keepalive_connections=20)
        self._http = httpx.AsyncClient(limits=limits, **settings)

    def request(self, method: str, path: str, **arguments: Any) -> httpx.Response:
        """Send a request and return its whole answer."""
        return waited(self._http.request(method, path, **arguments))

    def events(self, path: str, silence: float) -> Iterator[ServerSentEvent]:
        """Yield the events of a stream."""
        timeout = httpx.Timeout(self._http.timeout.connect, read=silence)
        with _entered(aconnect_sse(self._http, "GET", path, timeout=timeout)) as source:
            if not source.response.is_success:
                waited(source.response.aread())
                raise error_from(source.response)
            with _entered(aclosing(source.aiter_sse())) as events:
                yield from _iterated(events)

    def sleep(self, seconds: float) -> None:
        """Pause."""
        waited(asyncio.sleep(seconds))

    def call(self, function: Callable[[], Answer]) -> Answer:
        """Call the function in a thread."""
        return waited(asyncio.to_thread(function))

    def close(self) -> None:
        """Close the open sockets."""
        waited(self._http.aclose())


@contextmanager
def _entered(manager: AbstractAsyncContextManager[Answer]) -> Iterator[Answer]:
    entered = waited(manager.__aenter__())
    try:
        yield entered
    except BaseException as error:
        if not waited(manager.__aexit__(type(error), error, error.__traceback__)):
            raise
    else:
        waited(manager.__aexit__(None, None, None))


def _iterated(events: AsyncIterator[Answer]) -> Iterator[Answer]:
    with suppress(StopAsyncIteration):
        while True:
            yield waited(anext(events))
