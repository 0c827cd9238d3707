"""Warnings of which a fault that lasts makes one a second: one a minute of each, with a count."""

import logging
import time
from collections import OrderedDict
from collections.abc import Callable
from typing import Final

PERIOD: Final = 60.0  # s
_MOST: Final = 256
"""Texts that are known; of more, the one that came first is forgotten."""


class Repetitions(logging.Filter):
    """Leaves out warnings of a text that was written less than `PERIOD` ago.

    The next one that is written says how many were left out. What has a traceback is written.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        """`clock` : tells seconds that never go back."""
        super().__init__()
        self._clock = clock
        self._written: OrderedDict[str, tuple[float, int]] = OrderedDict()

    def filter(self, record: logging.LogRecord) -> bool:
        """Return whether a record is to be written."""
        if record.levelno < logging.WARNING or record.exc_info:
            return True
        text, now = record.getMessage(), self._clock()
        written, left_out = self._written.get(text, (-PERIOD, 0))
        if now < written + PERIOD:
            self._written[text] = (written, left_out + 1)
            return False
        self._written[text] = (now, 0)
        self._written.move_to_end(text)
        if len(self._written) > _MOST:
            self._written.popitem(last=False)
        if left_out:
            record.msg, record.args = f"{text} (and {left_out} times since it was written)", ()
        return True
