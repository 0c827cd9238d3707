"""Many calls on all cores, with one progress for the whole, until Ctrl-C."""

import multiprocessing
import os
import signal
from collections.abc import Callable, Iterator, MutableSequence, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

_POLL = 0.1  # s between two looks at the progress of other processes
Report = Callable[[float, str], None]
Advance = Callable[[float], bool]
"""Told the fraction that is done, several times a second; says whether to go on."""


class Interrupted(Exception):
    """Ctrl-C ended the calls before all were made."""


@dataclass(frozen=True)
class Call:
    """`function(*arguments, advance)` in another process; `weight` is about its seconds."""

    function: Callable[..., Any]
    arguments: tuple[Any, ...]
    weight: float
    note: str = ""


class Processes:
    """A pool of processes; `make` uses it, and what a process has loaded serves the next calls."""

    def __init__(self, pool: ProcessPoolExecutor, shared: "_Shared") -> None:
        self._pool = pool
        self._shared = shared
        self.interrupted = False

    def make(self, calls: Sequence[Call], report: Report) -> list[Any]:
        """Make all calls, the heaviest first, and return their results in the calls' order.

        Raises
        ------
        Interrupted
            By Ctrl-C.
        Exception
            What a call raised.
        """
        fractions = self._shared.fractions
        fractions[:] = [0.0] * len(fractions)
        self._shared.leave.value = 0
        order = sorted(range(len(calls)), key=lambda index: -calls[index].weight)
        futures: dict[Future[Any], int] = {}
        for index in order:
            call = calls[index]
            futures[self._pool.submit(_make, call.function, call.arguments, index)] = index
        # The pool watches the processes that it knew when it was last roused, and rouses itself
        # before it starts the process of a call: without one more, the last one could die unseen.
        self._pool.submit(_nothing)
        weights = [call.weight for call in calls]
        running, done = set(futures), set[Future[Any]]()
        ended = 0
        try:
            while running and not self.interrupted:
                done, running = wait(running, _POLL, FIRST_COMPLETED)
                for future in done:
                    future.result()
                    fractions[futures[future]] = 1.0
                ended += len(done)
                reached = sum(w * f for w, f in zip(weights, fractions, strict=False))
                last = max(done, key=lambda one: futures[one], default=None)
                note = f"{ended} of {len(calls)}"
                if last is not None and calls[futures[last]].note:
                    note += f": {calls[futures[last]].note}"
                if ended < len(calls):
                    report(min(reached / sum(weights), 1.0), note)
        finally:
            self._shared.leave.value = int(bool(running))  # after an error too nobody goes on
            for future in running:
                future.cancel()
        if self.interrupted:
            raise Interrupted
        report(1.0, f"{len(calls)} of {len(calls)}")
        return [future.result() for future in sorted(futures, key=futures.__getitem__)]


@dataclass
class _Shared:
    """What the parent and all processes see."""

    fractions: MutableSequence[float]
    leave: Any


_shared: _Shared | None = None
"""In a process of the pool."""


@contextmanager
def processes(count: int | None, most_calls: int) -> Iterator[Processes]:
    """Open a pool of processes, by default one for each core, for at most so many calls a time."""
    context = multiprocessing.get_context("spawn")  # threads of libraries do not survive a fork
    shared = _Shared(context.Array("d", most_calls, lock=False), context.Value("b", 0, lock=False))
    begin = (shared.fractions, shared.leave)
    pool = ProcessPoolExecutor(count or _cores(), context, _begin, begin)
    opened = Processes(pool, shared)

    def end(signal_number: int, frame: object) -> None:
        opened.interrupted = True

    before = signal.signal(signal.SIGINT, end)
    try:
        yield opened
    finally:
        signal.signal(signal.SIGINT, before)
        shared.leave.value = 1
        pool.shutdown(wait=True, cancel_futures=True)


def _cores() -> int:
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _begin(fractions: MutableSequence[float], leave: Any) -> None:
    """Prepare a process of the pool; Ctrl-C is for the one that reports."""
    global _shared
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    _shared = _Shared(fractions, leave)


def _nothing() -> None:
    """Do what takes no time."""


def _make(function: Callable[..., Any], arguments: tuple[Any, ...], index: int) -> Any:
    shared = _shared
    assert shared is not None  # noqa: S101  (every process of the pool begins so)

    def advance(fraction: float) -> bool:
        shared.fractions[index] = fraction
        return not shared.leave.value

    return function(*arguments, advance)
