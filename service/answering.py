"""A process of our own that answers questions, one at a time, kept while somebody asks."""

import subprocess
import sys
import threading
from contextlib import suppress
from multiprocessing import Pipe
from multiprocessing.connection import Connection
from typing import Any

_MOST_WAITING = 8


class Busy(Exception):
    """Many are waiting for an answer already."""


class TooSlow(Exception):
    """An answer took longer than the patience."""


class NoAnswer(Exception):
    """The process ended instead of answering, and did so again."""


class AnsweringProcess:
    """Starts a process when there is none, and asks it.

    Parameters
    ----------
    module
        Its program, as `jointplay.worker.answering` has them: it takes the file descriptor of a
        connection, answers each object it receives from there with another, and ends with the
        connection, or when it is idle.
    patience
        Seconds for one answer; what takes longer is ended.
    """

    def __init__(self, module: str, patience: float) -> None:
        self.patience = patience
        self._module = module
        self._turn = threading.Lock()
        self._waiting = threading.BoundedSemaphore(_MOST_WAITING)
        self._process: subprocess.Popen[bytes] | None = None
        self._connection: Connection | None = None

    def answer(self, question: object) -> Any:
        """Return the answer to a question.

        Raises
        ------
        Busy, TooSlow, NoAnswer
            See there.
        """
        if not self._waiting.acquire(blocking=False):
            raise Busy
        try:
            with self._turn:
                return self._asked(question)
        finally:
            self._waiting.release()

    def close(self) -> None:
        """End the process."""
        if self._process is not None and self._connection is not None:
            self._connection.close()
            self._process.kill()
            self._process.wait()
        self._process = self._connection = None

    def _asked(self, question: object) -> Any:
        for _ in range(2):  # it ends by itself when idle for a while
            connection = self._connected()
            with suppress(EOFError, OSError):
                connection.send(question)
                if connection.poll(self.patience):
                    return connection.recv()
                self.close()
                raise TooSlow
            self.close()
        raise NoAnswer

    def _connected(self) -> Connection:
        """Return the way to the process, which is started if it does not run."""
        if self._process is None or self._process.poll() is not None or self._connection is None:
            self.close()
            self._connection, theirs = Pipe()
            with theirs:
                self._process = subprocess.Popen(  # noqa: S603 - our own program
                    [sys.executable, "-P", "-m", self._module, str(theirs.fileno())],
                    stdin=subprocess.DEVNULL,
                    pass_fds=[theirs.fileno()],
                )
        return self._connection
