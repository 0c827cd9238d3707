"""Running the service on one machine: broker, API, relay and workers under one supervisor."""

import json
import os
import subprocess
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from jointplay.service.loopback import is_loopback
from jointplay.service.processes.child import StartFailed, WrongSetting
from jointplay.service.processes.supervisor import Supervisor

__all__ = ["StartFailed", "WrongSetting", "running_service", "serve"]

_STOP_PATIENCE = 40.0  # s


def serve(
    host: str,
    port: int,
    data: Path,
    workers: int,
    *,
    as_json: bool = False,
    parent_pipe: int | None = None,
) -> None:
    """Run the service until SIGTERM or SIGINT; print its URL once it answers.

    Parameters
    ----------
    host, port
        Where the API listens; port 0 takes a free one.
    data
        Folder of everything it keeps; one service a folder.
    workers
        How many blocks are computed at a time.
    as_json
        Print a line of JSON with "url" and "data" instead of a sentence.
    parent_pipe
        A file descriptor that becomes readable when the starting process ends.

    Raises
    ------
    StartFailed
        It could not start; `WrongSetting` if other arguments or variables are needed.
    """

    def announce(url: str) -> None:
        if as_json:
            sys.stdout.write(json.dumps({"url": url, "data": str(data)}) + "\n")
            sys.stdout.flush()
            return
        sys.stdout.write(f"jointplay is ready at {url} (data in {data}; Ctrl-C stops it)\n")
        if not is_loopback(host) and os.environ.get("JOINTPLAY_KEYS") == "none":
            sys.stdout.write(
                "It listens beyond this machine and asks for no key: everyone who can reach it can"
                " run jobs and read all results.\n"
            )
        sys.stdout.flush()

    Supervisor(host, port, data, workers, parent_pipe).run(announce)


@contextmanager
def running_service(
    data: Path, workers: int = 1, environment: Mapping[str, str] | None = None
) -> Iterator[str]:
    """Start a service on a free port of this machine and stop all of it at the end.

    It also ends, with everything it started, when this process does, whatever ends it.

    Parameters
    ----------
    data
        Its folder; made if missing. Logs are in its folder `logs`.
    workers
        How many blocks are computed at a time.
    environment
        Further variables for it, such as `JOINTPLAY_LEASE`.

    Yields
    ------
    str
        The URL of its API.

    Raises
    ------
    StartFailed
        It did not start; the message says why.
    """
    logs = data / "logs"
    logs.mkdir(parents=True, exist_ok=True)
    command = [sys.executable, "-P", "-m", "jointplay.service.processes"]
    command += ["--data", str(data), "--workers", str(workers)]
    with (
        (logs / "serve.log").open("wb") as log,
        subprocess.Popen(  # noqa: S603 - our own program
            command,
            stdin=subprocess.PIPE,  # its end tells the service of ours
            stdout=subprocess.PIPE,
            stderr=log,
            env=os.environ | dict(environment or {}),
            process_group=0,
        ) as service,
    ):
        try:
            announced = service.stdout.readline() if service.stdout else b""
            if not announced:
                service.wait()
                raise StartFailed((logs / "serve.log").read_text().strip())
            yield str(json.loads(announced)["url"])
        finally:
            if service.stdin:
                service.stdin.close()
            try:
                service.wait(_STOP_PATIENCE)
            except subprocess.TimeoutExpired:
                service.kill()  # its children are bound to it
