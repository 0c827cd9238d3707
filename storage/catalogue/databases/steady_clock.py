"""A clock that is never set."""

import time
from typing import Any


def steady_seconds() -> float:
    """Return seconds that also pass while the machine sleeps, where it can tell."""
    clock: Any = getattr(time, "CLOCK_BOOTTIME", time.CLOCK_MONOTONIC)
    return time.clock_gettime(clock)
