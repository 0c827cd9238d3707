"""The service that commands talk to, and the results that they are given."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from jointplay.command_line.exits import Exit, Stopped

if TYPE_CHECKING:
    from jointplay.client import Client, Job


def connect(url: str) -> "Client":
    """Return a client of the service at ``url``; nothing is sent yet."""
    from jointplay.client import Client

    return Client(url)


@contextmanager
def job_of(results: str, url: str) -> Iterator["Job"]:
    """Give the job that ``OUT|ID`` means: in a folder, or of the service at ``url``."""
    from jointplay.records.job import is_job_id

    if Path(results).exists() or not is_job_id(results):
        from jointplay.local import load

        yield load(results)
        return
    with connect(url) as client:
        yield client.job(results)


def wait_for(job: "Job") -> None:
    """Wait until a job is finished; Ctrl-C stops the waiting, not the job."""
    try:
        job.wait(progress=True, check=False)
    except KeyboardInterrupt:
        line = f"stopped waiting; the job goes on: jointplay show --wait {job.id}"
        raise Stopped(line, Exit.INTERRUPTED) from None
