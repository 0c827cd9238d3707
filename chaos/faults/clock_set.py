"""A clock that is set: an hour ahead or back, and right again."""

from collections.abc import Iterator
from contextlib import contextmanager
from random import Random

from jointplay.chaos.faults.fault import Fault
from jointplay.chaos.installation import Installation

_MOST = 3600.0  # s; idempotency keys live longer


class ClockSet(Fault):
    """`time.time` of every Python process of the service jumps, and so do its stamps of files."""

    lasts = (5.0, 20.0)

    @contextmanager
    def strike(self, installation: Installation, drawn: Random) -> Iterator[None]:
        """Set the clock, and set it right."""
        installation.set_clock(drawn.choice((-_MOST, _MOST)))
        try:
            yield
        finally:
            installation.set_clock(0.0)
