"""A whole service as a child of this process: for the demo, for tests, for a notebook."""

import os
import subprocess
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from jointplay.service.processes.child import StartFailed

_STOP_PATIENCE = 40.0


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
            url = service.stdout.readline().decode().strip() if service.stdout else ""
            if not url:
                service.wait()
                raise StartFailed((logs / "serve.log").read_text().strip())
            yield url
        finally:
            if service.stdin:
                service.stdin.close()
            try:
                service.wait(_STOP_PATIENCE)
            except subprocess.TimeoutExpired:
                service.kill()  # its children are bound to it
