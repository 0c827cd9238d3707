"""Processes of our own that answer questions, kept while somebody asks; owners ask in turn."""

import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from multiprocessing import Pipe
from multiprocessing.connection import Connection
from typing import Any

from jointplay.service.fair_queue import FairQueue, Full
from jointplay.service.owners import OWNER
from jointplay.service.problems import unavailable
from jointplay.service.processor_time import processor_time

_AT_ONCE = 2
"""Processes: the second one is started where another owner asks while the first one is busy."""
_START = 60.0
"""Seconds that a question waits for a process to start; it goes on starting for the next one."""


_LONGER = 4
"""Times of the patience for which a process is waited for that is not let compute."""
_LOOKS = 20
"""In a patience, at most: how long it has computed."""


class Busy(Exception):
    """Many are waiting for an answer already, or the process has not started yet."""


class TooSlow(Exception):
    """An answer took more computing than the patience."""


class Hindered(Exception):
    """There is no answer, and the process was not let compute: others have the processors."""


class NoAnswer(Exception):
    """The process ended instead of answering, and did so again."""


@contextmanager
def refusing(busy: str, too_slow: Exception, no_answer: str) -> Iterator[None]:
    """Raise, instead of the above, what clients are told: two sentences of a 503, and an error."""
    try:
        yield
    except Busy:
        raise unavailable(busy, 2) from None
    except Hindered:
        raise unavailable("The machine of the service is too busy; ask again later.", 5) from None
    except TooSlow:
        raise too_slow from None
    except NoAnswer:
        raise unavailable(no_answer, 5) from None


class AnsweringProcess:
    """Starts a process when there is none, and asks it: one question of an owner at a time.

    Parameters
    ----------
    module
        Its program, as `jointplay.worker.answering` has them: it takes the file descriptor of a
        connection, sends an object once it has started, answers each that it receives with
        another, and ends with the connection, or when it is idle.
    patience
        Seconds of computing for one answer, beside the start of the process; what takes longer is
        ended. Where the system does not tell how long it computes, the clock is looked at.
    start
        Seconds for which a question waits for the start; the process is left to go on with it.
    """

    def __init__(self, module: str, patience: float, start: float = _START) -> None:
        self.patience, self.start = patience, start
        self.queue = FairQueue(_AT_ONCE)
        self._processes = [_Process(module) for _ in range(_AT_ONCE)]

    def answer(self, question: object) -> Any:
        """Return the answer to a question.

        Raises
        ------
        Busy, TooSlow, Hindered, NoAnswer
            See there.
        """
        try:
            with self.queue.slot(OWNER.get()) as slot:
                return self._processes[slot].answer(question, self.patience, self.start)
        except Full:
            raise Busy from None

    def running(self) -> "list[subprocess.Popen[bytes]]":
        """Return the processes that were started, and not ended by this one."""
        return [one.process for one in self._processes if one.process is not None]

    def close(self) -> None:
        """End the processes."""
        for process in self._processes:
            process.close()


class _Process:
    """One of them, or none yet."""

    def __init__(self, module: str) -> None:
        self._module = module
        self._has_started = False
        self.process: subprocess.Popen[bytes] | None = None
        self._connection: Connection | None = None

    def answer(self, question: object, patience: float, start: float) -> Any:
        """Return the answer, or raise as above."""
        for _ in range(2):  # it ends by itself when idle for a while
            connection = self._connected()
            with suppress(EOFError, OSError):
                self._wait_for_start(connection, start)
                connection.send(question)
                self._wait_for_answer(connection, patience)
                return connection.recv()
            self.close()
        raise NoAnswer

    def close(self) -> None:
        """End the process."""
        if self.process is not None and self._connection is not None:
            self._connection.close()
            self.process.kill()
            self.process.wait()
        self.process = self._connection = None

    def _wait_for_answer(self, connection: Connection, patience: float) -> None:
        """Wait for an answer or the end of the process; TooSlow or Hindered if neither comes."""
        begun, before, left = time.monotonic(), self._computed(), patience
        while not connection.poll(max(left, patience / _LOOKS)):
            now = self._computed()
            left = 0.0 if before is None or now is None else patience - (now - before)
            if left <= 0.0:
                self.close()
                raise TooSlow
            if time.monotonic() - begun > _LONGER * patience:
                self.close()
                raise Hindered

    def _computed(self) -> float | None:
        return None if self.process is None else processor_time(self.process.pid)

    def _wait_for_start(self, connection: Connection, patience: float) -> None:
        if not self._has_started:
            if not connection.poll(patience):
                raise Busy
            connection.recv()
            self._has_started = True

    def _connected(self) -> Connection:
        """Return the way to the process, which is started if it does not run."""
        if self.process is None or self.process.poll() is not None or self._connection is None:
            self.close()
            self._has_started = False
            self._connection, theirs = Pipe()
            with theirs:
                self.process = subprocess.Popen(  # noqa: S603 - our own program
                    [sys.executable, "-P", "-m", self._module, str(theirs.fileno())],
                    stdin=subprocess.DEVNULL,
                    pass_fds=[theirs.fileno()],
                )
        return self._connection
