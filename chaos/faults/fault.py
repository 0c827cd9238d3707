"""The form of a fault."""

from abc import ABC, abstractmethod
from contextlib import AbstractContextManager
from random import Random
from typing import ClassVar

from jointplay.chaos.installation import Installation


class Fault(ABC):
    """Something that happens to a service, and is over after a while."""

    lasts: ClassVar[tuple[float, float]] = (0.0, 0.0)
    """Shortest and longest time that it may last [s]."""

    def hindrance(self, installation: Installation) -> str | None:
        """Return why it cannot be done here; none where it can."""
        return None

    @abstractmethod
    def strike(self, installation: Installation, drawn: Random) -> AbstractContextManager[None]:
        """Let it happen; it is undone at the end, and the service is what it has made of it."""
