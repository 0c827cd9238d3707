"""Processes that end by SIGKILL, as when memory is short or the power fails."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from random import Random

from jointplay.chaos.faults.fault import Fault
from jointplay.chaos.installation import Installation
from jointplay.chaos.processes import end


@dataclass(frozen=True)
class Killed(Fault):
    """SIGKILL of one process of a role, or of all processes at once.

    Without its supervisor a service ends; it is then started again, as its user would.
    """

    role: str | None = None

    @contextmanager
    def strike(self, installation: Installation, drawn: Random) -> Iterator[None]:
        """Kill, and start a service again that lost its supervisor."""
        if self.role is None:
            installation.kill()
        elif candidates := installation.running(self.role):
            end([drawn.choice(candidates)])
        yield
        if not installation.alive:
            installation.start()
