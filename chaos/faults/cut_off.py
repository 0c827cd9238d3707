"""Servers that are away for a while, as when they are restarted."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from random import Random
from typing import Literal

from jointplay.chaos.faults.fault import Fault
from jointplay.chaos.gate import Gate
from jointplay.chaos.installation import Installation


@dataclass(frozen=True)
class CutOff(Fault):
    """Every connection to the database, or to the store, ends, and no new one succeeds."""

    server: Literal["database", "store"]
    lasts = (0.0, 45.0)

    def hindrance(self, installation: Installation) -> str | None:
        """Return why, unless there is a gate before the server."""
        if self._gate(installation) is not None:
            return None
        if self.server == "database":
            return "the catalogue is not in a PostgreSQL that an address with a host names"
        return "results are not in a store that an endpoint http:// names"

    @contextmanager
    def strike(self, installation: Installation, drawn: Random) -> Iterator[None]:
        """Shut the gate, and open it."""
        gate = self._gate(installation)
        if gate is None:
            raise TypeError("nothing can be shut")
        gate.shut()
        try:
            yield
        finally:
            gate.open()

    def _gate(self, installation: Installation) -> Gate | None:
        return installation.gates[self.server]
