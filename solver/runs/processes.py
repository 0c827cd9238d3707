"""Calls on the cores of this machine: one pool of processes, one progress for all calls."""

import multiprocessing
import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator, MutableSequence, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, Protocol

_POLL = 0.1  # s between two looks at the progress of other processes
_DELIVERY = 0.5  # s in which the result of a call has reached the caller
Report = Callable[[float, int, str], None]
"""Receives the fraction of all calls, the parts that are done, the note of the last call ended."""


class Advance(Protocol):
    """A call's way to say how far it is; returns whether to go on."""

    def __call__(self, fraction: float, parts: int = 0, /) -> bool:
        """Say which fraction of the call is done, and how many of its parts."""


class Interrupted(Exception):
    """Somebody asked for the end before all calls were made."""


@dataclass(frozen=True)
class Call:
    """`function(*arguments, advance)` in another process."""

    function: Callable[..., Any]
    arguments: tuple[Any, ...]
    weight: float = 1.0
    """Its share of the progress, such as its seconds."""
    parts: int = 1
    """Number of things that it does."""
    note: str = ""
    """For the report, once it has ended."""


@dataclass
class _Shared:
    """Memory that this process and those of the pool see; an element for each call."""

    fractions: MutableSequence[float]
    parts: MutableSequence[int]
    leave: Any


class Processes:
    """A pool of processes; what one of them has loaded serves its next calls."""

    def __init__(
        self, pool: ProcessPoolExecutor, shared: _Shared, asked_to_end: Callable[[], bool]
    ) -> None:
        self._pool = pool
        self._shared = shared
        self._asked_to_end = asked_to_end

    def make(self, calls: Sequence[Call], report: Report | None = None) -> list[Any]:
        """Make all calls, the heaviest first, and return their results in the calls' order.

        Raises
        ------
        Interrupted
            The end was asked for; every call that had begun has ended.
        BrokenProcessPool
            A process died.
        Exception
            What a call raised.
        """
        shared = self._shared
        shared.fractions[:] = [0.0] * len(shared.fractions)
        shared.parts[:] = [0] * len(shared.parts)
        shared.leave.value = 0
        futures = self._submitted(calls)
        running, note = set(futures), ""
        try:
            while running:
                done, running = wait(running, _POLL, FIRST_COMPLETED)
                for future in done:
                    if not future.cancelled():
                        future.result()
                    if not shared.leave.value:
                        index = futures[future]
                        shared.fractions[index], shared.parts[index] = 1.0, calls[index].parts
                        note = calls[index].note or note
                if self._asked_to_end():
                    self._leave(running)
                elif report is not None:
                    reached = sum(
                        call.weight * fraction
                        for call, fraction in zip(calls, shared.fractions, strict=False)
                    )
                    whole = sum(call.weight for call in calls)
                    report(min(reached / whole, 1.0), sum(shared.parts), note)
        except BrokenProcessPool:
            if self._asked_to_end():  # a signal for all processes: they left, too
                raise Interrupted from None
            raise
        finally:
            self._leave(running)  # after an error too, the others stop
        if self._asked_to_end():
            raise Interrupted
        return [future.result() for future in sorted(futures, key=futures.__getitem__)]

    def _submitted(self, calls: Sequence[Call]) -> dict[Future[Any], int]:
        futures: dict[Future[Any], int] = {}
        with _bare_start():
            for index in sorted(range(len(calls)), key=lambda index: -calls[index].weight):
                call = calls[index]
                futures[self._pool.submit(_make, call.function, call.arguments, index)] = index
            # The pool watches the processes that it knew when it was last roused, and rouses
            # itself before it starts the process of a call: without one more call, the death of
            # the last process would go unseen.
            self._pool.submit(_nothing)
        return futures

    def _leave(self, running: set[Future[Any]]) -> None:
        self._shared.leave.value = 1
        for future in running:
            future.cancel()


@contextmanager
def processes(
    count: int, most_calls: int, asked_to_end: Callable[[], bool] = lambda: False
) -> Iterator[Processes]:
    """Open a pool of `count` processes, for at most `most_calls` calls at a time.

    `asked_to_end` is asked ten times a second.  Ctrl-C does not reach the processes; SIGTERM and
    SIGHUP have them leave their calls and end.  None outlives the caller, however that ends.
    """
    context = multiprocessing.get_context("spawn")  # threads of libraries do not survive a fork
    with _bare_start():
        shared = _Shared(
            context.Array("d", most_calls, lock=False),
            context.Array("l", most_calls, lock=False),
            context.Value("b", 0, lock=False),
        )
        pool = ProcessPoolExecutor(count, context, _begin, (shared,))
    try:
        yield Processes(pool, shared, asked_to_end)
    finally:
        shared.leave.value = 1
        pool.shutdown(wait=True, cancel_futures=True)


def cores() -> int:
    """Return how many cores this process may use: those that it is bound to."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


@contextmanager
def _bare_start() -> Iterator[None]:
    """Start processes without the caller's script and without the current folder.

    They would run the script again to look for functions in it, and import modules of the
    standard library from the folder; the functions called are in our modules.
    """
    main, safe = sys.modules["__main__"], os.environ.get("PYTHONSAFEPATH")
    hidden = {name: main.__dict__.pop(name, None) for name in ("__file__", "__spec__")}
    main.__spec__ = None
    os.environ["PYTHONSAFEPATH"] = "1"
    try:
        yield
    finally:
        main.__dict__.update({name: one for name, one in hidden.items() if one is not None})
        if safe is None:
            del os.environ["PYTHONSAFEPATH"]
        else:
            os.environ["PYTHONSAFEPATH"] = safe


_shared: _Shared | None = None
"""Set in a process of the pool when it begins."""


_idle = threading.Event()
"""Set while a process of the pool makes no call."""
_leaving = threading.Event()
"""Set when a process of the pool was asked to end by a signal of its own."""


def _begin(shared: _Shared) -> None:
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


def _nothing() -> None:
    """Do what takes no time."""


def _make(function: Callable[..., Any], arguments: tuple[Any, ...], index: int) -> Any:
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
