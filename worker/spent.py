"""Seconds of publishing and compiling, and points that a device computes, of this process.

They are told to the catalogue by and by.
"""

import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING

from jointplay.solver.kernels.cache import SPENT
from jointplay.storage.catalogue.counters import COMPILING, ON_DEVICES, PUBLISHED, PUBLISHING

if TYPE_CHECKING:
    from jointplay.storage.catalogue.catalogue import Catalogue

_counted = {PUBLISHED: 0.0, PUBLISHING: 0.0, ON_DEVICES: 0.0}  # since this process began


@contextmanager
def publishing(jobs: float = 1.0) -> Iterator[None]:
    """Count what is done inside as the publication of one job's results, if it comes to its end.

    Of none where it is a part of that: sending to a service what was packed.
    """
    began = time.monotonic()
    yield
    _counted[PUBLISHED] += jobs
    _counted[PUBLISHING] += time.monotonic() - began


def computed_on_device(points: int) -> None:
    """Count points that this process's device has computed to their ends."""
    _counted[ON_DEVICES] += points


def _spent() -> dict[str, float]:
    return {**_counted, COMPILING: SPENT.seconds + SPENT.elsewhere}


class SpentReport:
    """Reports to the catalogue, or to a service, what this process spends from now on."""

    def __init__(self) -> None:
        self._sent = _spent()

    def send(self, catalogue: "Catalogue", worker: str) -> None:
        """Count what was not sent yet; Unavailable: it is sent the next time."""
        if more := self.unsent():
            catalogue.note_spent(worker, more)
            self.note_sent(more)

    def unsent(self) -> dict[str, float]:
        """Return what was not sent yet, by its counter."""
        more = {name: amount - self._sent[name] for name, amount in _spent().items()}
        return {name: amount for name, amount in more.items() if amount > 0.0}

    def note_sent(self, more: Mapping[str, float]) -> None:
        """Note that this was sent."""
        for name, amount in more.items():
            self._sent[name] += amount
