"""Seconds that this process spends on publishing and compiling, told to the catalogue by and by."""

import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING

from jointplay.solver.kernels.cache import SPENT
from jointplay.storage.catalogue.counters import COMPILING, PUBLISHED, PUBLISHING

if TYPE_CHECKING:
    from jointplay.storage.catalogue.catalogue import Catalogue

_published = {PUBLISHED: 0.0, PUBLISHING: 0.0}  # since this process began


@contextmanager
def publishing(jobs: float = 1.0) -> Iterator[None]:
    """Count what is done inside as the publication of one job's results, if it comes to its end.

    Of none where it is a part of that: sending to a service what was packed.
    """
    began = time.monotonic()
    yield
    _published[PUBLISHED] += jobs
    _published[PUBLISHING] += time.monotonic() - began


def _spent() -> dict[str, float]:
    return {**_published, COMPILING: SPENT.seconds + SPENT.elsewhere}


class Telling:
    """Tells the catalogue, or a service, what this process has spent since this was made."""

    def __init__(self) -> None:
        self._told = _spent()

    def tell(self, catalogue: "Catalogue", worker: str) -> None:
        """Count what was not told yet; Unavailable: it is told the next time."""
        if more := self.untold():
            catalogue.note_spent(worker, more)
            self.told(more)

    def untold(self) -> dict[str, float]:
        """Return what was not told yet, by its counter."""
        more = {name: amount - self._told[name] for name, amount in _spent().items()}
        return {name: amount for name, amount in more.items() if amount > 0.0}

    def told(self, more: Mapping[str, float]) -> None:
        """Note that this was told."""
        for name, amount in more.items():
            self._told[name] += amount
