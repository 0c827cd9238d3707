"""Progress on stderr: a bar on a terminal, a line now and then anywhere else."""

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from jointplay.pace import Pace, duration

_QUIET = 5.0  # s between two plain lines: a log stays readable


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
        TextColumn("{task.description}"),
        BarColumn(),
        TaskProgressColumn(),
        TextColumn("{task.fields[note]}"),
        Remaining(),
    )
    with Progress(*columns, console=Console(stderr=True)) as bars:
        task = bars.add_task(title, total=1.0, note="")
        yield lambda fraction, note: bars.update(task, completed=fraction, note=note)


@contextmanager
def _lines(title: str) -> Iterator[Callable[[float, str], None]]:
    last = time.monotonic()
    told = ""
    pace = Pace()

    def report(fraction: float, note: str) -> None:
        nonlocal last, told
        now = time.monotonic()
        pace.saw(fraction)
        left = pace.seconds_left(fraction) if fraction < 1 else None
        line = f"{title}: {fraction:4.0%} {note}".rstrip()
        line += "" if left is None else f", {duration(left)} left"
        finished = fraction >= 1 and line != told
        if finished or now - last >= _QUIET:
            sys.stderr.write(line + "\n")
            sys.stderr.flush()
            last, told = now, line

    yield report
