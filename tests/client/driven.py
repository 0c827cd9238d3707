"""An `AsyncClient` driven from blocking tests, so that one specification holds for both clients."""

import asyncio
from collections.abc import AsyncIterator, Awaitable, Iterator
from inspect import isawaitable
from typing import Any, Self

from jointplay.client import AsyncBatch, AsyncClient, AsyncJob
from jointplay.client.asynchronous.picture import AsyncPicture

FACES = (AsyncBatch, AsyncClient, AsyncJob, AsyncPicture)


class Driven:
    """Answers of an `AsyncClient`: whatever is to be awaited is awaited in the runner's loop."""

    def __init__(self, face: Any, runner: asyncio.Runner) -> None:
        self._face, self._runner = face, runner

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def __getattr__(self, name: str) -> Any:
        return self._driven(getattr(self._face, name))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Driven) and self._face == other._face

    def __hash__(self) -> int:
        return hash(self._face)

    def __repr__(self) -> str:
        return repr(self._face)

    def _driven(self, found: Any) -> Any:
        if isinstance(found, FACES):
            return Driven(found, self._runner)
        if isawaitable(found):
            return self._driven(self._runner.run(_answer(found)))
        if isinstance(found, AsyncIterator):
            return self._each(found)
        if callable(found):
            return lambda *args, **kwargs: self._driven(found(*args, **kwargs))
        return found

    def _each(self, found: AsyncIterator[Any]) -> Iterator[Any]:
        while items := self._runner.run(_next(found)):
            yield self._driven(items[0])


async def _answer(found: Awaitable[Any]) -> Any:
    return await found


async def _next(found: AsyncIterator[Any]) -> list[Any]:
    try:
        return [await anext(found)]
    except StopAsyncIteration:
        return []
