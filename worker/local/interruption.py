"""Ctrl-C, SIGTERM and SIGHUP as one question that is asked between two slices of work."""

import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Any, Final

_SIGNALS: Final = tuple(
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)
)


@contextmanager
def interruption() -> Iterator[Callable[[], bool]]:
    """Turn signals that end a process into an answer while the block runs: whether one came.

    One that is ignored, as `nohup` has it, stays so.  In a thread that is not the main one nothing
    hears of signals, and the answer stays no.
    """
    asked = False

    def end(number: int, frame: object) -> None:
        nonlocal asked
        asked = True
        if number == getattr(signal, "SIGHUP", None):
            _leave_the_terminal()

    if threading.current_thread() is not threading.main_thread():
        yield lambda: False
        return
    before: dict[int, Any] = {}
    for number in _SIGNALS:
        if signal.getsignal(number) is not signal.SIG_IGN:
            before[number] = signal.signal(number, end)
    try:
        yield lambda: asked
    finally:
        for number, handler in before.items():
            signal.signal(number, signal.SIG_DFL if handler is None else handler)


def _leave_the_terminal() -> None:
    """Write to nowhere what would go to a terminal that is gone, where writing fails."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError, ValueError, AttributeError):  # closed, or no file
            if stream.isatty():
                os.dup2(nowhere, stream.fileno())
    os.close(nowhere)
