"""One process that the supervisor keeps running, in a process group of its own."""

import contextlib
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from jointplay.service.processor_time import processor_time

_LARGEST_LOG = 10_000_000  # bytes; a larger log is set aside when its process starts
_FIRST_PAUSE, _LONGEST_PAUSE = 0.2, 10.0  # seconds before a process is started again
_STEADY = 30.0  # a process that ran this long was well: its failures are forgotten
_BOUND = Path(__file__).with_name("bound.py")
_LONGER = 5  # times of the patience for which a process that computes is waited for
_POLL = 0.02
_TOLD = 12  # lines at the end of a log that are looked at for why its process ended
_LOGGED = re.compile(r"\d{4}-\d{2}-\d{2} \S+ [A-Z]+ |{")  # begins a line of `records.log_lines`
_LITTLE = 2**16  # bytes that are free on a disk on which nothing can be started


class StartFailed(Exception):
    """The service cannot start; the message is for the user."""


class WrongSetting(StartFailed):
    """It cannot start with these settings or arguments: others are needed."""


class Child:
    """A process with a log file; started again by `revive`, ever later while it keeps failing.

    Parameters
    ----------
    environment
        Variables beside those of this process.
    file_descriptors
        Open files the process inherits.
    """

    def __init__(
        self,
        name: str,
        command: Sequence[str],
        log: Path,
        environment: Mapping[str, str],
        file_descriptors: tuple[int, ...] = (),
    ) -> None:
        self.name = name
        self.log = log
        self._command = list(command)
        self._environment = dict(environment)
        self._file_descriptors = file_descriptors
        self._process: subprocess.Popen[bytes] | None = None
        self._started = 0.0
        self._log_before = 0
        self._failures = 0
        self._due = 0.0

    def start(self) -> None:
        """Start the process; it ends by SIGKILL when this process does."""
        self.log.parent.mkdir(parents=True, exist_ok=True)
        if self.log.exists() and self.log.stat().st_size > _LARGEST_LOG:
            self.log.replace(self.log.with_name(self.log.name + ".old"))
        with self.log.open("ab") as log:
            self._log_before = log.tell()
            self._process = subprocess.Popen(  # noqa: S603 - our own programs
                [sys.executable, "-I", "-S", str(_BOUND), str(os.getpid()), *self._command],
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=subprocess.STDOUT,
                env=os.environ | self._environment,
                pass_fds=self._file_descriptors,
                process_group=0,  # Ctrl-C reaches us alone; we end them in order
            )
        self._started = time.monotonic()

    def add(self, *arguments: str) -> None:
        """Give the process further arguments from its next start on."""
        self._command += arguments

    @property
    def alive(self) -> bool:
        """Whether the process runs."""
        return self._process is not None and self._process.poll() is None

    @property
    def pid(self) -> int | None:
        """Process id, if it was started."""
        return self._process.pid if self._process else None

    def revive(self) -> float | None:
        """Start the process again if it ended and its pause is over.

        Returns
        -------
        float or None
            Seconds of a pause that begins now, or none if nothing ended.
        """
        if self.alive or self._process is None:
            return None
        now = time.monotonic()
        if self._due <= self._started:  # it has just ended
            self._failures = 0 if now - self._started > _STEADY else self._failures + 1
            pause: float = min(_FIRST_PAUSE * 2.0**self._failures, _LONGEST_PAUSE)
            self._due = now + pause
            return pause
        if now >= self._due:
            self.start()
        return None

    def await_answer(
        self, answers: Callable[[], bool], patience: float, pause: Callable[[float], object]
    ) -> None:
        """Wait until the process answers; StartFailed if it ended, or comes no further.

        That is when it has computed nothing for `patience` seconds, or after many times as long: on
        a machine with much else to do it starts slowly.
        """
        begun = moved = time.monotonic()
        computed = None
        while not answers():
            if not self.alive:
                told = _reasons(self._written().splitlines()[-_TOLD:])
                if shutil.disk_usage(self.log.parent).free < _LITTLE:  # which the log cannot tell
                    told.append(f"the disk with {self.log.parent} is full")
                how = (
                    "ended at once:" if told else f"ended at once, and wrote nothing to {self.log}"
                )
                raise StartFailed("\n".join([f"the {self.name} {how}", *told]))
            now, before = time.monotonic(), computed
            computed = None if self.pid is None else processor_time(self.pid)
            moved = moved if computed == before else now
            if now - moved > patience or now - begun > _LONGER * patience:
                waited = f"{now - begun:.0f} s"
                raise StartFailed(f"the {self.name} did not answer in {waited}: {self.log}")
            pause(_POLL)

    def _written(self) -> str:
        """Return what is in the log since the process was started."""
        with self.log.open("rb") as log:
            log.seek(self._log_before)
            return log.read().decode(errors="replace")

    def terminate(self) -> None:
        """Ask the process to end."""
        if self._process is not None and self.alive:
            self._process.terminate()

    def await_end(self, deadline: float) -> None:
        """Wait until the process ended; at the deadline end it and its group."""
        if self._process is None:
            return
        while self.alive and time.monotonic() < deadline:
            time.sleep(_POLL)
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self._process.pid, signal.SIGKILL)  # what it may have left behind, too
        self._process.wait()


def _reasons(lines: Sequence[str]) -> list[str]:
    """Return what a process says itself of its end, or else the errors that it logged.

    Lines of a traceback are left out.
    """
    flush = [line for line in lines if line.strip() and not line[:1].isspace()]
    own = [line for line in flush if not _LOGGED.match(line)]
    return own or [line for line in flush if " ERROR " in line or '"ERROR"' in line] or flush
