"""Threads for what workers hold their blocks with: no other request keeps these busy."""

from collections.abc import Callable
from functools import partial
from typing import Annotated, Any, Final, TypeVar

from anyio import CapacityLimiter, to_thread

from jointplay.service.dependencies import of_the_application

Answer = TypeVar("Answer")
_THREADS: Final = 8


class VitalThreads:
    """Some threads, for short questions to the catalogue; used by one event loop."""

    def __init__(self) -> None:
        self._limiter = CapacityLimiter(_THREADS)

    async def run(self, function: Callable[..., Answer], *given: Any, **named: Any) -> Answer:
        """Call a function in one of them, and return what it returns."""
        return await to_thread.run_sync(partial(function, *given, **named), limiter=self._limiter)


VitalDependency = Annotated[VitalThreads, of_the_application("vital")]
