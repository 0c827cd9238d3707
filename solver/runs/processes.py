"""Calls on the cores of this machine: one pool of processes, one progress for all calls."""

import multiprocessing
import os
import sys
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, Protocol

from jointplay.solver.runs.pooled_process import Shared, begin, make, nothing

_POLL = 0.1  # s between two looks at the progress of other processes
Report = Callable[[float, int, str], None]
"""Receives the fraction of all calls, the parts that are done, the note of the last call ended."""


class Advance(Protocol):
    """A call's way to say how far it is. Returns whether to go on."""

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


class Processes:
    """A pool of processes; what one of them has loaded serves its next calls."""

    def __init__(
        self, pool: ProcessPoolExecutor, shared: Shared, asked_to_end: Callable[[], bool]
    ) -> None:
        self._pool = pool
        self._shared = shared
        self._asked_to_end = asked_to_end

    def make(
        self, calls: Sequence[Call], report: Report | None = None, *, in_order: bool = False
    ) -> list[Any]:
        """Make all calls, the heaviest first or `in_order`. Returns their results in their order.

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
        futures = self._submitted(calls, in_order=in_order)
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

    def _submitted(self, calls: Sequence[Call], *, in_order: bool) -> dict[Future[Any], int]:
        futures: dict[Future[Any], int] = {}
        turns = list(range(len(calls)))
        if not in_order:
            turns.sort(key=lambda index: -calls[index].weight)
        with _bare_start():
            for index in turns:
                call = calls[index]
                futures[self._pool.submit(make, call.function, call.arguments, index)] = index
            # The pool watches the processes that it knew when it was last roused, and rouses
            # itself before it starts the process of a call: without one more call, the death of
            # the last process would go unseen.
            self._pool.submit(nothing)
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
        shared = Shared(
            context.Array("d", most_calls, lock=False),
            context.Array("l", most_calls, lock=False),
            context.Value("b", 0, lock=False),
        )
        pool = ProcessPoolExecutor(count, context, begin, (shared,))
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
