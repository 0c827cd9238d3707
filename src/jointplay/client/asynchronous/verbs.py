"""Awaited methods made of blocking ones, with the same arguments.

A verb is looked up by its name when it is called: the object may be of a class below that of the
verb, as a job of a service is below `Job`.
"""

from collections.abc import AsyncGenerator, AsyncIterator, Callable, Coroutine, Generator, Iterator
from contextlib import aclosing
from functools import wraps
from itertools import islice
from typing import Any, Concatenate, Generic, ParamSpec, Protocol, Self, TypeVar, overload

from jointplay.client.asynchronous.bridge import bridged

Given = ParamSpec("Given")
Blocking = TypeVar("Blocking")
Answer = TypeVar("Answer")
Shown = TypeVar("Shown")
Kept = TypeVar("Kept", covariant=True)


class Face(Protocol[Kept]):
    """The awaited face of a blocking object."""

    @property
    def _blocking(self) -> Kept: ...


Same = TypeVar("Same", bound=Face[Any])


@overload
def awaited(
    verb: Callable[Concatenate[Blocking, Given], Answer],
) -> Callable[Concatenate[Face[Blocking], Given], Coroutine[Any, Any, Answer]]: ...
@overload
def awaited(
    verb: Callable[Concatenate[Blocking, Given], Answer], shown: Callable[[Answer], Shown]
) -> Callable[Concatenate[Face[Blocking], Given], Coroutine[Any, Any, Shown]]: ...
def awaited(verb: Callable[..., Any], shown: Callable[[Any], Any] | None = None) -> Any:
    """Return a method that awaits the answer of `verb`, given as `shown` makes it."""
    name = verb.__name__

    @wraps(verb)
    async def method(self: Face[Any], /, *args: Any, **kwargs: Any) -> Any:
        answer = await bridged(getattr(self._blocking, name), *args, **kwargs)
        return answer if shown is None else shown(answer)

    return method


def changing(
    verb: Callable[Concatenate[Blocking, Given], Blocking],
) -> Callable[Concatenate[Same, Given], Coroutine[Any, Any, Same]]:
    """Return a method that awaits `verb`, which changes its object, and returns its own."""
    name = verb.__name__

    @wraps(verb)
    async def method(self: Same, /, *args: Given.args, **kwargs: Given.kwargs) -> Same:
        await bridged(getattr(self._blocking, name), *args, **kwargs)
        return self

    return method


def iterated(
    verb: Callable[Concatenate[Blocking, Given], Iterator[Answer]], shown: Callable[[Answer], Shown]
) -> Callable[Concatenate[Face[Blocking], Given], AsyncIterator[Shown]]:
    """Return a method for ``async for``: what `verb` yields, as `shown` makes it."""
    name = verb.__name__

    @wraps(verb)
    async def method(
        self: Face[Blocking], /, *args: Given.args, **kwargs: Given.kwargs
    ) -> AsyncIterator[Shown]:
        answers = await bridged(getattr(self._blocking, name), *args, **kwargs)
        async with aclosing(each(answers, shown)) as found:
            async for one in found:
                yield one

    return method


async def each(
    answers: Iterator[Answer], shown: Callable[[Answer], Shown]
) -> AsyncGenerator[Shown, None]:
    """Yield what blocking code yields, as `shown` makes it."""
    try:
        while found := await bridged(list, islice(answers, 1)):
            yield shown(found[0])
    finally:
        if isinstance(answers, Generator):
            await bridged(answers.close)


class Attribute(Generic[Blocking, Answer]):
    """An attribute whose value is awaited: ``await job.peaks``."""

    def __init__(self, asked: Callable[[Blocking], Answer]) -> None:
        self._asked = asked

    @overload
    def __get__(self, face: None, owner: type) -> Self: ...
    @overload
    def __get__(self, face: Face[Blocking], owner: type) -> Coroutine[Any, Any, Answer]: ...
    def __get__(self, face: Face[Blocking] | None, owner: type) -> Any:
        return self if face is None else bridged(self._asked, face._blocking)
