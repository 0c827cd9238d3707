"""Everything by which a client waits: requests, streams, pauses, calls of other libraries."""

import time
from collections.abc import Callable, Iterator
from typing import Any, Protocol, TypeVar

import httpx
from httpx_sse import ServerSentEvent, connect_sse

from jointplay.client.errors import error_from

Answer = TypeVar("Answer")


class Network(Protocol):
    """The ways in which a client waits; one blocks its thread, one is awaited.

    Requests and streams raise what httpx raises.
    """

    def request(self, method: str, path: str, **arguments: Any) -> httpx.Response:
        """Send a request and return its whole answer."""

    def events(self, path: str, silence: float) -> Iterator[ServerSentEvent]:
        """Yield the events of a stream, which fails after `silence` seconds without a byte."""

    def sleep(self, seconds: float) -> None:
        """Pause."""

    def call(self, function: Callable[[], Answer]) -> Answer:
        """Call what blocks its thread, such as a library with a network of its own."""

    def close(self) -> None:
        """Close the open sockets."""


class BlockingNetwork:
    """A `Network` that blocks the thread; `settings` are those of `httpx.Client`."""

    def __init__(self, **settings: Any) -> None:
        self._http = httpx.Client(**settings)
        self.close = self._http.close

    def request(self, method: str, path: str, **arguments: Any) -> httpx.Response:
        """Send a request and return its whole answer."""
        return self._http.request(method, path, **arguments)

    def events(self, path: str, silence: float) -> Iterator[ServerSentEvent]:
        """Yield the events of a stream."""
        timeout = httpx.Timeout(self._http.timeout.connect, read=silence)
        with connect_sse(self._http, "GET", path, timeout=timeout) as source:
            if not source.response.is_success:
                source.response.read()
                raise error_from(source.response)
            yield from source.iter_sse()

    def sleep(self, seconds: float) -> None:
        """Pause."""
        time.sleep(seconds)

    def call(self, function: Callable[[], Answer]) -> Answer:
        """Call the function."""
        return function()
