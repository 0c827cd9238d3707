"""A bar while a job is waited for."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from jointplay.client.job_record import JobRecord
from jointplay.pace import Pace
from jointplay.progress import progress


@contextmanager
def shown(job: JobRecord) -> Iterator[Callable[[], None]]:
    """Show how far a job is whenever what is yielded is called."""
    pace = Pace()
    with progress(job.label or job.id) as report:

        def show() -> None:
            pace.saw(job.progress.fraction, job.progress.steps)
            report(job.progress.fraction, job.activity or _note(job, pace))

        yield show


def _note(job: JobRecord, pace: Pace) -> str:
    parts = [job.done_so_far, job.state]
    if not job.is_finished and pace.steps_per_second is not None:
        parts.append(f"{pace.steps_per_second:.3g} steps/s")
    return ", ".join(parts)
