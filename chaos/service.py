"""A service as a user and the checks see it."""

from collections.abc import Sequence
from typing import Protocol

from jointplay.chaos.processes import Process
from jointplay.storage.settings import Settings


class Service(Protocol):
    """On one machine, such as an `Installation`, or on several."""

    @property
    def url(self) -> str:
        """Address that is asked next."""
        ...

    @property
    def settings(self) -> Settings:
        """Where the catalogue and the results are."""
        ...

    def running(self) -> Sequence[Process]:
        """Return its processes that run."""
        ...
