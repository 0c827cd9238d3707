"""Waiting in tests for what other processes do."""

from __future__ import annotations

import time
from collections.abc import Callable


def until(condition: Callable[[], bool], patience: float = 90.0) -> None:
    """Wait until something is so; fail after `patience` seconds, for other tests run beside."""
    deadline = time.monotonic() + patience
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.01)  # leaves the processor to whom is waited for
