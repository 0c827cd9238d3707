"""Compiling in a process of its own, which somebody watches who may end it.

A compiler cannot be interrupted, and what it takes in memory it hardly gives back. A worker
therefore has a source compiled by another process, into the cache on the disk, and asks meanwhile
whether the code is still wanted. Without a watch, as on the command line, a scene's code is
compiled where it is used.
"""

import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from pathlib import Path

MOST_MEMORY = 4 * 2**30
"""Bytes that a compiling process may take. A chain of 20 bodies, near the limit of statements,
takes 0.22 GB with its tangents, the shortest 0.14 GB: `python -m benchmarks compilation`."""
_POLL = 0.1  # s between two questions
_MODULE = "jointplay.solver.kernels.compile_file"


class CompilationEnded(Exception):
    """Code was not compiled to its end."""


class CompilationUnwanted(CompilationEnded):
    """Somebody asked for the end; `answer` is what was said."""

    def __init__(self, answer: object) -> None:
        self.answer = answer
        super().__init__("the compilation was ended, as was asked for")


class CompilationTooLong(CompilationEnded):
    """It took more than is allowed; `code` is ``compile-time`` or ``compile-memory``."""

    def __init__(self, code: str, detail: str) -> None:
        self.code = code
        super().__init__(detail)


@dataclass(frozen=True)
class _Watch:
    ask: Callable[[], object | None]
    seconds: float


_watch: ContextVar[_Watch | None] = ContextVar("watch", default=None)


@contextmanager
def watched(ask: Callable[[], object | None], seconds: float) -> Iterator[None]:
    """Compile in another process while the block runs.

    Parameters
    ----------
    ask
        Called ten times a second; anything but None ends the compilation.
    seconds
        Longest time for one source, the wait for others that compile the same one included.

    Raises
    ------
    CompilationUnwanted
        The answer was another than None.
    CompilationTooLong
        It took more time, or more than `MOST_MEMORY`.
    """
    token = _watch.set(_Watch(ask, seconds))
    try:
        yield
    finally:
        _watch.reset(token)


def require_wanted() -> None:
    """Raise CompilationUnwanted where somebody watches who wants the code no more.

    Tracing and emitting ask this now and then: of the largest scene they take seconds.
    """
    watch = _watch.get()
    answer = None if watch is None else watch.ask()
    if answer is not None:
        raise CompilationUnwanted(answer)


def is_watched() -> bool:
    """Return whether somebody watches."""
    return _watch.get() is not None


def compile_elsewhere(path: Path) -> None:
    """Have a file compiled into the cache by another process; raise what `watched` does.

    An error in the file is left to who loads it afterwards: it is raised again there.
    """
    process = subprocess.Popen(  # noqa: S603 - our own program
        [sys.executable, "-P", "-m", _MODULE, str(path)],
        stdin=subprocess.PIPE,  # its end tells the process of ours
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    with process:
        try:
            attend(process)
        finally:
            process.kill()
    if process.returncode < 0 or process.returncode == OUT_OF_MEMORY:
        raise CompilationTooLong(
            "compile-memory",
            "Compiling the equations of this scene takes more than"
            f" {MOST_MEMORY / 2**30:g} GB of memory, or more than there is. Use fewer bodies.",
        )


OUT_OF_MEMORY = 3
"""Exit status of a compiling process that ran out of memory and could still say so."""


def attend(
    process: subprocess.Popen[bytes],
    what: str = "the equations of this scene",
    remedy: str = "Use fewer bodies",
) -> None:
    """Wait until a process that compiles ends; raise what `watched` does, and leave it running.

    `what` it compiles, and the `remedy` where that takes too long, are told.
    """
    watch = _watch.get()
    if watch is None:
        process.wait()
        return
    until = time.monotonic() + watch.seconds
    while True:
        try:
            process.wait(_POLL)
            return
        except subprocess.TimeoutExpired:
            pass
        answer = watch.ask()
        if answer is not None:
            raise CompilationUnwanted(answer)
        if time.monotonic() > until:
            raise CompilationTooLong(
                "compile-time",
                f"Compiling {what} takes more than {watch.seconds:g} s, the limit"
                f" (JOINTPLAY_LONGEST_COMPILATION). {remedy}.",
            )
