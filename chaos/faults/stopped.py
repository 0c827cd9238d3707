"""Processes that are halted and go on later, as on a laptop that sleeps."""

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from random import Random

from jointplay.chaos.faults.fault import Fault
from jointplay.chaos.installation import LEASE, Installation


@dataclass(frozen=True)
class Stopped(Fault):
    """SIGSTOP of one process of a role, or of all at once, for longer than a lease; SIGCONT."""

    role: str | None = None
    lasts = (LEASE / 2, 2.5 * LEASE)

    @contextmanager
    def strike(self, installation: Installation, drawn: Random) -> Iterator[None]:
        """Stop, and let go on; in any order."""
        if self.role is None:
            chosen = installation.running()
        else:
            candidates = installation.running(self.role)
            chosen = [drawn.choice(candidates)] if candidates else []
        drawn.shuffle(chosen)
        for process in chosen:
            process.send(signal.SIGSTOP)
        try:
            yield
        finally:
            for process in chosen:
                process.send(signal.SIGCONT)
