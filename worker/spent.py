"""Seconds that this process spends on publishing and compiling, told to the catalogue by and by."""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from jointplay.solver.kernels.cache import SPENT
from jointplay.storage.catalogue.counters import COMPILING, PUBLISHED, PUBLISHING

if TYPE_CHECKING:
    from jointplay.storage.catalogue.catalogue import Catalogue

_published = {PUBLISHED: 0.0, PUBLISHING: 0.0}  # since this process began


@contextmanager
def publishing() -> Iterator[None]:
    """Count what is done inside as the publication of one job's results, if it comes to its end."""
    began = time.monotonic()
    yield
    _published[PUBLISHED] += 1.0
    _published[PUBLISHING] += time.monotonic() - began


def _spent() -> dict[str, float]:
    return {**_published, COMPILING: SPENT.seconds + SPENT.elsewhere}


class Telling:
    """Tells the catalogue what this process has spent since this was made."""

    def __init__(self) -> None:
        self._told = _spent()

    def tell(self, catalogue: "Catalogue", worker: str) -> None:
        """Count what was not told yet; Unavailable: it is told the next time."""
        spent = _spent()
        more = {name: amount - self._told.get(name, 0.0) for name, amount in spent.items()}
        if more := {name: amount for name, amount in more.items() if amount > 0.0}:
            catalogue.note_spent(worker, more)
            self._told = spent
