"""Ctrl-C as a question that is asked between two slices of work."""

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager


@contextmanager
def interruption() -> Iterator[Callable[[], bool]]:
    """Turn Ctrl-C into an answer while the block runs: whether it was pressed.

    In a thread that is not the main one nothing hears of Ctrl-C, and the answer stays no.
    """
    asked = False

    def end(signal_number: int, frame: object) -> None:
        nonlocal asked
        asked = True

    if threading.current_thread() is not threading.main_thread():
        yield lambda: False
        return
    before = signal.signal(signal.SIGINT, end)
    try:
        yield lambda: asked
    finally:
        signal.signal(signal.SIGINT, before)
