"""Progress on stderr: a bar on a terminal, a line now and then anywhere else."""

import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

_QUIET = 5.0  # s between two plain lines: a log stays readable
_BEGINNING = 0.25
"""Share of what is done that says nothing about the pace of the rest."""
_FURTHER = 1.1
"""Factor by which more must be done than before, to tell a pace since then; or this much more:"""
_ENOUGH = 0.02
"""Fraction of the whole that tells a pace, also with all that came before it."""


@contextmanager
def progress(title: str) -> Iterator[Callable[[float, str], None]]:
    """Show the progress of one thing while the block runs.

    Yields
    ------
    Callable
        ``report(fraction, note)``: how much is done, 0 to 1, and a few words beside it.
    """
    shown = _bar if sys.stderr.isatty() else _lines
    with shown(title) as report:
        yield report


@contextmanager
def _bar(title: str) -> Iterator[Callable[[float, str], None]]:
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn
    from rich.progress import TimeRemainingColumn as Remaining

    columns = (
        TextColumn("{task.description}", markup=False),  # it may be a label
        BarColumn(),
        TaskProgressColumn(),
        TextColumn("{task.fields[note]}", markup=False),
        Remaining(),
    )
    with Progress(*columns, console=Console(stderr=True)) as bars:
        task = bars.add_task(title, total=1.0, note="")
        yield lambda fraction, note: bars.update(task, completed=fraction, note=note)


@contextmanager
def _lines(title: str) -> Iterator[Callable[[float, str], None]]:
    """Tell the last report every few seconds, also while none comes, as when a kernel compiles."""
    lines, pace, over = _Lines(), Pace(), threading.Event()

    def report(fraction: float, note: str) -> None:
        pace.saw(fraction)
        left = pace.seconds_left(fraction) if fraction < 1 else None
        line = f"{title}: {fraction:4.0%} {note}".rstrip()
        lines.latest = line + ("" if left is None else f", {duration(left)} left")
        if fraction >= 1:
            lines.tell()

    def tell_now_and_then() -> None:
        while not over.wait(_QUIET):
            lines.tell()

    telling = threading.Thread(target=tell_now_and_then, daemon=True)
    telling.start()
    try:
        yield report
    finally:
        over.set()
        telling.join()


class _Lines:
    """The latest line, which is told once."""

    def __init__(self) -> None:
        self.latest = self._told = ""
        self._lock = threading.Lock()

    def tell(self) -> None:
        """Write the latest line, unless it was."""
        with self._lock:
            if self.latest != self._told:
                sys.stderr.write(self.latest + "\n")
                sys.stderr.flush()
                self._told = self.latest


class Pace:
    """Steps a second and time left, of something whose fraction and count of steps grow.

    Parameters
    ----------
    clock
        Seconds that only grow.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._seen: list[tuple[float, float]] = []  # time, fraction: those that can count
        self._last: tuple[float, int] | None = None  # time, steps
        self._rate: float | None = None

    def saw(self, fraction: float, steps: int | None = None) -> None:
        """Take the present fraction, 0 to 1, and the accepted steps so far."""
        now = self._clock()
        self._mark(now, fraction)
        if steps is None:
            return
        if self._last is not None and steps > self._last[1] and now > self._last[0]:
            self._rate = (steps - self._last[1]) / (now - self._last[0])
        if self._last is None or steps != self._last[1]:
            self._last = now, steps

    def _mark(self, now: float, fraction: float) -> None:
        seen = self._seen
        if not seen or fraction <= seen[0][1]:
            seen[:] = [(now, fraction)]  # it has not begun, or began anew
        elif fraction >= _FURTHER * seen[-1][1]:
            seen.append((now, fraction))
        while len(seen) > 2 and seen[1][1] < _BEGINNING * fraction:
            del seen[0]

    def seconds_left(self, fraction: float) -> float | None:
        """Return the time left at the pace since a quarter of what is done, s.

        What came before is the beginning: kernels are prepared, other processes begin. None while
        little more than that is known.
        """
        before = max(fraction / _FURTHER, fraction - _ENOUGH)
        marks = [mark for mark in self._seen if mark[1] <= before < fraction]
        settled = [mark for mark in marks if mark[1] >= _BEGINNING * fraction]
        if not marks or (not settled and fraction < _ENOUGH):
            return None
        time_then, done = (settled or marks)[0]
        return (1.0 - fraction) * (self._clock() - time_then) / (fraction - done)

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
