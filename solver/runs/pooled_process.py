"""A process of a pool: makes calls, leaves them when it is asked to, and ends with the caller."""

import multiprocessing
import os
import signal
import threading
import time
from collections.abc import Callable, MutableSequence
from dataclasses import dataclass
from typing import Any

_DELIVERY = 0.5  # s in which the result of a call has reached the caller


@dataclass
class Shared:
    """Memory that the caller and the processes of a pool see; an element for each call."""

    fractions: MutableSequence[float]
    parts: MutableSequence[int]
    leave: Any


_shared: Shared | None = None
"""Set when the process begins."""
_idle = threading.Event()
"""Set while the process makes no call."""
_leaving = threading.Event()
"""Set when the process was asked to end by a signal of its own."""


def begin(shared: Shared) -> None:
    """Make this process one of a pool, which ends with its caller."""
    global _shared
    _idle.set()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    for number in (signal.SIGTERM, getattr(signal, "SIGHUP", signal.SIGTERM)):
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, _leave_soon)
    threading.Thread(target=_end_with_the_caller, daemon=True).start()
    _shared = shared


def _end_with_the_caller() -> None:
    """End this process when the one that started it is gone: what it computes, nobody takes."""
    caller = multiprocessing.parent_process()
    if caller is not None:
        caller.join()
        os._exit(1)


def _leave_soon(number: int, frame: object) -> None:
    """Have the present call leave, as the caller would, and then end this process."""
    if not _leaving.is_set():
        _leaving.set()
        threading.Thread(target=_end_when_idle, daemon=True).start()


def _end_when_idle() -> None:
    _idle.wait()
    time.sleep(_DELIVERY)
    os._exit(0)


def nothing() -> None:
    """Do what takes no time."""


def make(function: Callable[..., Any], arguments: tuple[Any, ...], index: int) -> Any:
    """Make the call of an index, and return its result."""
    shared = _shared
    assert shared is not None  # noqa: S101  (every process of the pool begins so)

    def advance(fraction: float, parts: int = 0, /) -> bool:
        shared.fractions[index], shared.parts[index] = fraction, parts
        return not (shared.leave.value or _leaving.is_set())

    _idle.clear()
    try:
        return function(*arguments, advance)
    finally:
        _idle.set()
