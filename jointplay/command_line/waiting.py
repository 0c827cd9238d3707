"""Wait for a job with a progress bar."""

from typing import TYPE_CHECKING

from jointplay.command_line.exits import Exit, Stopped

if TYPE_CHECKING:
    from jointplay.client import Job


def wait_for(job: "Job") -> None:
    """Wait until a job is finished; Ctrl-C stops the waiting, not the job."""
    try:
        job.wait(progress=True, check=False)
    except KeyboardInterrupt:
        line = f"stopped waiting; the job goes on: jointplay show --wait {job.id}"
        raise Stopped(Exit.INTERRUPTED, line) from None
