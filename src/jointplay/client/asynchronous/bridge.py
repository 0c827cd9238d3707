"""Blocking code inside an event loop: a greenlet, and the coroutine that awaits for it.

The way in which SQLAlchemy's asyncio extension runs its own blocking code.
"""

from collections.abc import Awaitable, Callable, Coroutine
from typing import Any, ParamSpec, TypeVar

from greenlet import getcurrent, greenlet

from jointplay.client.errors import ClientError

Given = ParamSpec("Given")
Answer = TypeVar("Answer")


class _Bridge(greenlet):  # type: ignore[misc]  # it ships no types
    """A greenlet that `bridged` runs."""


async def bridged(
    function: Callable[Given, Answer], *args: Given.args, **kwargs: Given.kwargs
) -> Answer:
    """Call a function that waits by `waited`, and await what it waits for."""
    bridge = _Bridge(function)
    bridge.gr_context = getcurrent().gr_context
    given: Any = bridge.switch(*args, **kwargs)
    while not bridge.dead:
        try:
            answer = await given
        except BaseException as error:  # noqa: BLE001  (cancellation, too, is for the function)
            given = bridge.throw(error)
        else:
            given = bridge.switch(answer)
    found: Answer = given
    return found


def waited(awaitable: Awaitable[Answer]) -> Answer:
    """Return what an awaitable gives, in a function that `bridged` has called.

    Raises
    ------
    ClientError
        Nobody awaits here: a blocking method of what an `AsyncClient` gave was called.
    """
    bridge = getcurrent()
    if not isinstance(bridge, _Bridge) or bridge.parent is None:
        if isinstance(awaitable, Coroutine):
            awaitable.close()
        raise ClientError("What an AsyncClient gave asks the service only where it is awaited.")
    found: Answer = bridge.parent.switch(awaitable)
    return found
