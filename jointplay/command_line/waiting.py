"""Wait for a job with a progress bar, and tell how it ended."""

from typing import TYPE_CHECKING

from jointplay.command_line.exits import Exit, Stopped
from jointplay.command_line.pace import Pace
from jointplay.command_line.progress import progress

if TYPE_CHECKING:
    from jointplay.client import Client, Job


def wait_for(client: "Client", job_id: str, title: str) -> "Job":
    """Return the finished job; Ctrl-C stops the waiting, not the job."""
    pace = Pace()

    def show(job: "Job") -> None:
        pace.saw(job.progress.fraction, job.progress.steps)
        report(job.progress.fraction, job.activity or _note(job, pace))

    with progress(title) as report:
        try:
            return client.wait(job_id, show)
        except KeyboardInterrupt:
            line = f"stopped waiting; the job goes on: jointplay show --wait {job_id}"
            raise Stopped(Exit.INTERRUPTED, line) from None


def _note(job: "Job", pace: Pace) -> str:
    parts = [done_so_far(job), job.state]
    if not job.is_finished and pace.steps_per_second is not None:
        parts.append(f"{pace.steps_per_second:.3g} steps/s")
    return ", ".join(parts)


def done_so_far(job: "Job") -> str:
    """Say how far a job is: simulated time, or of a study the part of all its points."""
    done = f"{job.progress.fraction:.0%}"
    return done if job.kind != "simulate" else f"t = {job.progress.time:.4g} s ({done})"


def exit_of(job: "Job") -> None:
    """Return if the job succeeded, else end the command with its reason and code."""
    if job.state == "failed" and job.error is not None:
        line = f"job {job.id} failed ({job.error.kind}): {job.error.detail}"
        raise Stopped(Exit.FAILED, line)
    if job.state == "cancelled":
        raise Stopped(Exit.CANCELLED, f"job {job.id} was cancelled at {done_so_far(job)}")
