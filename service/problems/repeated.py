"""Warnings of which an attack would make thousands: one a second of each kind, with a count."""

import time
from collections import OrderedDict
from typing import Final

_PERIOD: Final = 1.0  # s
_MOST: Final = 64
"""Sentences that are known; of more, the one that came first is forgotten."""


class Repeated:
    """Tells which sentences are to be written."""

    def __init__(self) -> None:
        self._written: OrderedDict[str, tuple[float, int]] = OrderedDict()

    def count(self, sentence: str) -> int | None:
        """Return how often a sentence was left out since it was written; None: leave it out."""
        now = time.monotonic()
        written, left_out = self._written.get(sentence, (-_PERIOD, 0))
        if now < written + _PERIOD:
            self._written[sentence] = (written, left_out + 1)
            return None
        self._written[sentence] = (now, 0)
        if len(self._written) > _MOST:
            self._written.popitem(last=False)
        return left_out
