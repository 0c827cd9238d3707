"""Repetitions in logs: of each text one line in a while, with a count of those left out."""

import logging
import math
import time
from collections.abc import Callable
from typing import Final

from jointplay.records.bounded_dict import BoundedDict

PERIOD: Final = 60.0  # s
_MOST: Final = 256
"""Texts that are known."""


class Repetitions:
    """Counts texts that come again within a period, s, of when they were written."""

    def __init__(self, period: float, clock: Callable[[], float] = time.monotonic) -> None:
        """`clock` : tells seconds that never go back."""
        self.period = period
        self._clock = clock
        self._written: BoundedDict[str, tuple[float, int]] = BoundedDict(_MOST)

    def left_out(self, text: str) -> int | None:
        """Return how often a text was left out since it was written; None: leave it out again."""
        now = self._clock()
        written, left_out = self._written.get(text, (-math.inf, 0))
        if now < written + self.period:
            self._written[text] = (written, left_out + 1)
            return None
        self._written[text] = (now, 0)
        return left_out


class OncePerPeriod(logging.Filter):
    """Leaves out warnings of a text that was written less than `PERIOD` ago.

    The next one that is written says how many were left out. What has a traceback is written.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        super().__init__()
        self._repetitions = Repetitions(PERIOD, clock)

    def filter(self, record: logging.LogRecord) -> bool:
        """Return whether a record is to be written."""
        if record.levelno < logging.WARNING or record.exc_info:
            return True
        text = record.getMessage()
        left_out = self._repetitions.left_out(text)
        if left_out:
            record.msg, record.args = f"{text} (and {left_out} times since it was written)", ()
        return left_out is not None
