"""Who hears of what a store has taken, of objects that are gathered before they are sent.

That the pieces of such an object were given tells nothing of the time that it takes to send them.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Final


def _nobody() -> None:
    """Hear nothing."""


TAKEN: Final[ContextVar[Callable[[], None]]] = ContextVar("taken", default=_nobody)
"""Called, in the thread that puts an object, whenever the store has taken a piece of it."""


@contextmanager
def heard(taken: Callable[[], None]) -> Iterator[None]:
    """Have `taken` called for each piece that a store takes of what is put meanwhile."""
    before = TAKEN.set(taken)
    try:
        yield
    finally:
        TAKEN.reset(before)
