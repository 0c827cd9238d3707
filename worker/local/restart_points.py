"""Restart points of a local run: one now and then, and one before an end that was asked for."""

import time
from collections.abc import Callable

from jointplay.worker.execute import Answer, Progress

PERIOD = 5.0
"""Seconds between two restart points: what a killed process loses."""
_MOST_OVERHEAD = 20
"""Restart points are made so rarely that computing takes this many times as long as they do."""


class RestartPoints:
    """Answer to the reports of one simulation, or of one block of a study.

    Parameters
    ----------
    go_on
        Hears how far it is, several times a second, and says whether to go on.
    end
        Answer once it shall not: `Answer.cancel` seals what there is, `Answer.leave` does not.
    """

    def __init__(self, go_on: Callable[[Progress], bool], end: Answer) -> None:
        self._go_on, self._end = go_on, end
        self._next = time.monotonic() + PERIOD

    def __call__(self, progress: Progress) -> Answer:
        """Return the answer to one report."""
        if not self._go_on(progress):
            progress.keep()
            return self._end
        begun = time.monotonic()
        if begun >= self._next:
            progress.keep()
            now = time.monotonic()
            self._next = now + max(PERIOD, _MOST_OVERHEAD * (now - begun))
        return Answer.go_on
