"""Everything `jointplay serve` runs: broker, API, relay with reaper, workers; kept running."""

import logging
import os
import select
import signal
import socket
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, closing, contextmanager
from functools import partial
from pathlib import Path
from types import FrameType

from pydantic import ValidationError
from pydantic_settings import SettingsError

from jointplay.records.log_lines import begin
from jointplay.service.processes.broker import Broker, answers
from jointplay.service.processes.child import Child, StartFailed, WrongSetting
from jointplay.service.processes.folder_lock import holding
from jointplay.service.processes.health import Health
from jointplay.service.processes.writable import require_writable
from jointplay.storage.settings import Settings

_START_PATIENCE = 60.0  # seconds in which the API neither answers nor computes; a cold disk is slow
_STOP_PATIENCE = 20.0  # seconds a worker has to store a restart point and give its block back
_LOOK_AGAIN = 0.2
_log = logging.getLogger(__name__)


class Supervisor:
    """The processes of one service.

    Parameters
    ----------
    host, port
        Where the API listens; port 0 takes a free one.
    data
        Folder of catalogue, results, broker and logs.
    workers
        How many blocks are computed at a time.
    parent_pipe
        A file descriptor that becomes readable when the starting process ends.

    Raises
    ------
    WrongSetting
        A variable `JOINTPLAY_...` of the environment has no possible value.
    """

    def __init__(
        self, host: str, port: int, data: Path, workers: int, parent_pipe: int | None
    ) -> None:
        self._host, self._port = host, port
        self._settings = settings_of(data)
        self._workers = workers
        self._parent_pipe = parent_pipe
        self._stop_asked = False
        self._children: list[Child] = []

    def run(self, announce: Callable[[str], None]) -> None:
        """Start everything, announce the URL, keep everything running until asked to stop.

        Raises
        ------
        StartFailed
            Something could not be started; what had been started is stopped again.
        """
        begin(self._settings.log_format, logging.WARNING)
        require_writable(self._settings.data)
        with ExitStack() as stack:
            say = stack.enter_context(holding(self._settings.data))
            wake = stack.enter_context(self._signals())
            listener = stack.enter_context(self._listener())
            redis_url = self._settings.redis_url
            if redis_url is None:
                broker = Broker(self._settings.data / "broker", self._log_file("broker"))
                stack.callback(broker.stop)
                broker.start()
                self._children.append(broker.child)
                redis_url = broker.url
            elif not answers(redis_url):
                raise StartFailed("no Redis answers at JOINTPLAY_REDIS_URL")
            stack.callback(self._stop_processes)
            self._start_processes(listener, redis_url)
            url = self._url(listener)
            self._await_api(listener, wake)
            if self._stop_asked:
                return
            say(f"process {os.getpid()}, {url}")
            announce(url)
            while not self._stop_asked:
                self._pause(wake)
                self._revive()

    def _start_processes(self, listener: socket.socket, redis_url: str) -> None:
        environment = {
            "JOINTPLAY_DATA": str(self._settings.data),
            "JOINTPLAY_CATALOGUE_URL": self._settings.catalogue_url,
            "JOINTPLAY_REDIS_URL": redis_url,
        }
        api = ["jointplay.service.processes.api", "--fd", str(listener.fileno())]
        worker = ["jointplay.worker", "--processes", str(self._workers)]
        for name, arguments, inherited in (
            ("API", api, (listener.fileno(),)),
            ("relay", ["jointplay.worker.relay"], ()),
            *([("worker", worker, ())] if self._workers else []),
        ):
            child = Child(
                name,
                [sys.executable, "-P", "-m", *arguments],
                self._log_file(name.lower()),
                environment,
                inherited,
            )
            child.start()
            self._children.append(child)

    def _stop_processes(self) -> None:
        """End all but the broker, all at once, the worker with time to give its block back."""
        mine = [child for child in self._children if child.name != "broker"]
        for child in mine:
            child.terminate()
        deadline = time.monotonic() + _STOP_PATIENCE
        for child in mine:
            child.await_end(deadline)

    def _revive(self) -> None:
        for child in self._children:
            pause = child.revive()
            if pause is not None:
                _log.warning(
                    "%s ended, starting it again in %.1f s; see %s", child.name, pause, child.log
                )

    def _listener(self) -> socket.socket:
        family = socket.AF_INET6 if ":" in self._host else socket.AF_INET
        try:
            return socket.create_server((self._host, self._port), family=family, backlog=256)
        except OSError as error:
            raise WrongSetting(
                f"cannot listen on {self._host} port {self._port}: {error.strerror};"
                " --port 0 takes a free port"
            ) from error

    def _url(self, listener: socket.socket) -> str:
        host = f"[{self._host}]" if ":" in self._host else self._host
        return f"http://{host}:{listener.getsockname()[1]}"

    def _await_api(self, listener: socket.socket, wake: int) -> None:
        api = next(child for child in self._children if child.name == "API")
        with closing(Health(listener)) as health:
            api.await_answer(
                lambda: self._stop_asked or health.is_good(),
                _START_PATIENCE,
                partial(self._pause, wake),
            )
        api.add("--again")

    def _pause(self, wake: int, seconds: float = _LOOK_AGAIN) -> None:
        """Wait for a signal, for the end of our parent, or until the time is over."""
        watched = [wake] if self._parent_pipe is None else [wake, self._parent_pipe]
        ready, _, _ = select.select(watched, [], [], seconds)
        if wake in ready:
            os.read(wake, 4096)
        if self._parent_pipe in ready:
            self._stop_asked = True

    @contextmanager
    def _signals(self) -> Iterator[int]:
        """Have SIGTERM and SIGINT ask for the end, and every signal wake the pause."""

        def ask(_number: int, _frame: FrameType | None) -> None:
            self._stop_asked = True

        def note(_number: int, _frame: FrameType | None) -> None:
            """Do nothing but wake up: a child ended."""

        reading, writing = os.pipe()
        os.set_blocking(writing, False)
        handlers = {signal.SIGTERM: ask, signal.SIGINT: ask, signal.SIGCHLD: note}
        before = {number: signal.signal(number, handler) for number, handler in handlers.items()}
        before_wakeup = signal.set_wakeup_fd(writing, warn_on_full_buffer=False)
        try:
            yield reading
        finally:
            signal.set_wakeup_fd(before_wakeup)
            for number, handler in before.items():
                signal.signal(number, handler)
            os.close(reading)
            os.close(writing)

    def _log_file(self, name: str) -> Path:
        return self._settings.data / "logs" / f"{name}.log"


def settings_of(data: Path | None = None) -> Settings:
    """Return the settings of a service, in this folder if one is given; or WrongSetting."""
    try:
        return Settings() if data is None else Settings(data=data)
    except SettingsError as error:
        raise WrongSetting(str(error)) from None
    except ValidationError as error:
        complaints = [
            ": ".join([*map(_variable, one["loc"]), one["msg"].removeprefix("Value error, ")])
            for one in error.errors()
        ]
        raise WrongSetting("; ".join(complaints)) from None


def _variable(name: object) -> str:
    """Return the variable of a field; what is no field is named as it was in a file."""
    return f"JOINTPLAY_{name}".upper() if name in Settings.model_fields else str(name).upper()
