"""How fast something advances: steps a second, and the time that is left."""

import time
from collections.abc import Callable


class Pace:
    """Watches a fraction and a count of steps grow.

    Parameters
    ----------
    clock
        Seconds that only grow.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._first: tuple[float, float] | None = None  # time, fraction
        self._last: tuple[float, int] | None = None  # time, steps
        self._rate: float | None = None

    def saw(self, fraction: float, steps: int | None = None) -> None:
        """Note how far it is."""
        now = self._clock()
        if self._first is None or fraction <= self._first[1]:
            self._first = now, fraction  # it has not begun, or began anew
        if steps is None:
            return
        if self._last is not None and steps > self._last[1] and now > self._last[0]:
            self._rate = (steps - self._last[1]) / (now - self._last[0])
        if self._last is None or steps != self._last[1]:
            self._last = now, steps

    def seconds_left(self, fraction: float) -> float | None:
        """Return the time left at the average pace so far, s; none while that is unknown."""
        if self._first is None or fraction <= self._first[1]:
            return None
        return (1.0 - fraction) * (self._clock() - self._first[0]) / (fraction - self._first[1])

    @property
    def steps_per_second(self) -> float | None:
        """Steps a second between the last two reports that had more of them."""
        return self._rate


def duration(seconds: float) -> str:
    """Return a time in words, such as ``1 h 05 min``."""
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60:02d} s"
    return f"{whole // 3600} h {whole % 3600 // 60:02d} min"
