"""The process that computes the beginning of jobs, kept warm: `jointplay.worker.probe`."""

import json
import subprocess
import sys
import threading
from contextlib import suppress
from multiprocessing import Pipe
from multiprocessing.connection import Connection
from typing import Any

from jointplay.records.failure import InvalidInput, Problem
from jointplay.service.problems import unavailable

_PATIENCE = 90.0  # s; compiling the kernel of a new mechanism takes some 20 of them
_MOST_WAITING = 8


class Prober:
    """Asks the probing process, one job at a time, and starts it when there is none."""

    def __init__(self) -> None:
        self._turn = threading.Lock()
        self._waiting = threading.BoundedSemaphore(_MOST_WAITING)
        self._process: subprocess.Popen[bytes] | None = None
        self._connection: Connection | None = None

    def cost_of(self, job: dict[str, Any]) -> dict[str, Any]:
        """Return what an admitted job costs, as `worker.probe.Cost` has it.

        Raises
        ------
        InvalidInput
            The solver cannot compute it after all.
        RequestRefused
            503: too many are waiting, or the process does not answer.
        """
        if not self._waiting.acquire(blocking=False):
            raise unavailable("Many estimates are being made; ask again in a moment.", 2)
        try:
            with self._turn:
                answer = self._asked(json.dumps(job).encode())
        finally:
            self._waiting.release()
        if "refused" in answer:
            raise InvalidInput([Problem("", str(answer["refused"]))])
        return answer

    def close(self) -> None:
        """End the process."""
        if self._process is not None and self._connection is not None:
            self._connection.close()
            self._process.kill()
            self._process.wait()
        self._process = self._connection = None

    def _asked(self, question: bytes) -> dict[str, Any]:
        for _ in range(2):  # it ends by itself when idle for a while
            connection = self._connected()
            with suppress(EOFError, OSError):
                connection.send_bytes(question)
                if connection.poll(_PATIENCE):
                    return dict(json.loads(connection.recv_bytes()))
                self.close()
                raise unavailable(f"No estimate was made within {_PATIENCE:g} s.", 30)
            self.close()
        raise unavailable("The beginning of the job could not be computed.", 5)

    def _connected(self) -> Connection:
        """Return the way to the process, which is started if it does not run."""
        if self._process is None or self._process.poll() is not None or self._connection is None:
            self.close()
            self._connection, theirs = Pipe()
            with theirs:
                self._process = subprocess.Popen(  # noqa: S603 - our own program
                    [sys.executable, "-P", "-m", "jointplay.worker.probe", str(theirs.fileno())],
                    stdin=subprocess.DEVNULL,
                    pass_fds=[theirs.fileno()],
                )
        return self._connection
