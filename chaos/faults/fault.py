"""The form of a fault."""

from contextlib import AbstractContextManager
from random import Random
from typing import Protocol

from jointplay.chaos.installation import Installation


class Fault(Protocol):
    """Something that happens to a service, and is over after a while."""

    @property
    def lasts(self) -> tuple[float, float]:
        """Shortest and longest time that it may last [s]."""
        ...

    def hindrance(self, installation: Installation) -> str | None:
        """Return why it cannot be done here, if it cannot."""
        ...

    def strike(self, installation: Installation, drawn: Random) -> AbstractContextManager[None]:
        """Let it happen; it is undone at the end, and the service is what it has made of it."""
        ...
