"""The process that computes the beginning of jobs, kept warm: `jointplay.worker.probe`."""

import json
import select
import subprocess
import sys
import threading
import time
from typing import Any

from jointplay.records.failure import InvalidInput, Problem
from jointplay.service.problems import RequestRefused, kinds

_PATIENCE = 90.0  # s; compiling the kernel of a new mechanism takes some 20 of them
_MOST_WAITING = 8
_LONGEST_ANSWER = 65_536  # bytes


class Prober:
    """Asks the probing process, one job at a time, and starts it when there is none."""

    def __init__(self) -> None:
        self._turn = threading.Lock()
        self._waiting = threading.BoundedSemaphore(_MOST_WAITING)
        self._process: subprocess.Popen[bytes] | None = None

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
            raise _unavailable("Many estimates are being made; ask again in a moment.", 2)
        try:
            with self._turn:
                answer = self._asked(json.dumps(job).encode() + b"\n")
        finally:
            self._waiting.release()
        if "refused" in answer:
            raise InvalidInput([Problem("", str(answer["refused"]))])
        return answer

    def close(self) -> None:
        """End the process."""
        process, self._process = self._process, None
        if process is not None:
            process.kill()
            process.communicate()

    def _asked(self, line: bytes) -> dict[str, Any]:
        for _ in range(2):  # it ends by itself when idle for a while
            process = self._process = self._alive()
            assert process.stdin is not None  # noqa: S101  (it was opened with pipes)
            try:
                process.stdin.write(line)
                process.stdin.flush()
            except BrokenPipeError:
                self.close()
                continue
            text = self._line(process)
            if text.endswith(b"\n"):
                found: dict[str, Any] = json.loads(text)
                return found
            self.close()
        raise _unavailable("The beginning of the job could not be computed.", 5)

    def _alive(self) -> subprocess.Popen[bytes]:
        if self._process is not None and self._process.poll() is None:
            return self._process
        self.close()
        return subprocess.Popen(
            [sys.executable, "-P", "-m", "jointplay.worker.probe"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            bufsize=0,
        )

    def _line(self, process: subprocess.Popen[bytes]) -> bytes:
        """Return one line, or less when the process ended or takes too long."""
        assert process.stdout is not None  # noqa: S101  (it was opened with pipes)
        text = b""
        deadline = time.monotonic() + _PATIENCE
        while not text.endswith(b"\n"):
            left = deadline - time.monotonic()
            if left <= 0 or not select.select([process.stdout], [], [], left)[0]:
                self.close()
                raise _unavailable(f"No estimate was made within {_PATIENCE:g} s.", 30)
            some = process.stdout.read(_LONGEST_ANSWER)
            if not some:
                break
            text += some
        return text


def _unavailable(sentence: str, seconds: int) -> RequestRefused:
    return RequestRefused(kinds.UNAVAILABLE, sentence, headers={"Retry-After": str(seconds)})
