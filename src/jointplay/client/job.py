"""`Job`: what became of a job, and its results; the same from a service and from a folder."""

import time
from abc import abstractmethod
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext
from typing import TYPE_CHECKING, Any, Self

from jointplay.client.errors import ClientError, ResultsNotReady, TimedOut
from jointplay.client.job_record import JobRecord
from jointplay.client.notebook import html_table
from jointplay.client.readable_job import ReadableJob
from jointplay.progress import Pace
from jointplay.progress import progress as bar

if TYPE_CHECKING:
    import xarray as xr


class Job(ReadableJob):
    """One job: its record as it was last seen, and its results.

    The attributes of the record (``state``, ``progress``, ``error``, ...) change when `wait`,
    `refresh` or `cancel` is called.  Results are read when they are asked for; those of a running
    job are what it has committed so far.

    Tables are pandas and stored arrays xarray: ``pip install 'jointplay[xarray]'``.  `window`,
    `study`, `results` and figures need neither.
    """

    def __hash__(self) -> int:
        return hash(self.id)  # the record changes, the job stays

    def __repr__(self) -> str:
        return f"<Job {self.id}: {self.kind} of {self.scene_name}, {self.state}>"

    def _repr_html_(self) -> str:
        return html_table(
            f"{self.kind} of {self.scene_name}",
            {
                "id": self.id,
                "label": self.label,
                "state": f"{self.state}, {self.done_so_far}",
                "error": self.error and f"{self.error.error_class}: {self.error.detail}",
                "created": f"{self.created.astimezone():%Y-%m-%d %H:%M:%S}",
                "computed in": self.seconds and f"{self.seconds:.3g} s",
            },
        )

    def refresh(self) -> Self:
        """Look at the job once more."""
        self.renew(self._look())
        return self

    def open(self, group: str = "") -> "xr.Dataset":
        """Open a group of the job's Zarr store, lazily; by default the root."""
        try:
            return super().open(group)
        except ResultsNotReady:
            if not self.refresh().is_finished:
                raise
            return super().open(group)  # it ended since it was last seen

    def wait(
        self,
        *,
        progress: bool = False,
        report: Callable[[Self], None] | None = None,
        timeout: float | None = None,
        check: bool = True,
    ) -> Self:
        """Wait until the job is finished, and return it.

        Parameters
        ----------
        progress
            Show a bar on stderr (plain lines where that is no terminal).
        report
            Called with the job whenever it has changed.
        timeout
            Longest wait, s.
        check
            Raise if the job did not succeed.

        Raises
        ------
        JobFailed, JobCancelled
            The job did not succeed; what it had computed can be read.
        TimedOut
            It is not finished yet; it goes on.
        Unreachable
            The service was lost and did not come back.
        """
        with _shown(self) if progress else nullcontext(lambda: None) as show:
            for _ in self.follow(timeout):
                show()
                if report is not None:
                    report(self)
        if check:
            self.check()
        return self

    def follow(self, timeout: float | None = None) -> Iterator[Self]:
        """Yield the job as it is, and again whenever it has changed, until it is finished.

        Parameters
        ----------
        timeout
            Longest wait, s; then `TimedOut`.
        """
        deadline = None if timeout is None else time.monotonic() + timeout
        begun = self if self.is_finished else self.refresh()
        yield begun
        if begun.is_finished:
            return
        for _ in self._follow(deadline):
            if not self.is_finished:
                yield self
        if not self.is_finished:
            raise TimedOut(f"Job {self.id} is still {self.state}; the time to wait is over.")
        self.refresh()
        yield self

    def check(self) -> None:
        """Raise `JobFailed` or `JobCancelled` if the job ended so."""
        if self.state == "failed":
            why = f" ({self.error.error_class}): {self.error.detail}" if self.error else "."
            raise JobFailed(f"Job {self.id} failed{why}", self)
        if self.state == "cancelled":
            raise JobCancelled(f"Job {self.id} was cancelled at {self.done_so_far}.", self)

    def cancel(self) -> Self:
        """Ask for the job to be cancelled; asking again, or too late, changes nothing."""
        self.renew(self._ask_to_end())
        return self

    @abstractmethod
    def retry(self) -> "Job":
        """Queue a job that failed or was cancelled once more, and return the new job.

        Asked again it is the same one, until that has failed or was cancelled itself.  `Refused`
        if there is nothing to retry.
        """

    @abstractmethod
    def delete(self) -> None:
        """Delete the finished job with its results; there is no way back."""

    @abstractmethod
    def _look(self) -> dict[str, Any]:
        """Return its document as it is now."""

    @abstractmethod
    def _ask_to_end(self) -> dict[str, Any]:
        """Ask for it to be cancelled, and return its document."""

    @abstractmethod
    def _follow(self, deadline: float | None) -> Iterator[None]:
        """Keep state and progress up to date until it is finished; yield when they have changed.

        What else its record says is as old as before.  After the deadline, of `time.monotonic`,
        the iteration ends early; `Unreachable` if the service was lost and did not come back.
        """


class JobEnded(ClientError):
    """A job that was waited for did not succeed.

    Attributes
    ----------
    job
        The job; what it had computed can be read.
    """

    def __init__(self, sentence: str, job: "Job") -> None:
        super().__init__(sentence)
        self.job = job


class JobFailed(JobEnded):
    """The job failed; ``job.error`` says why."""


class JobCancelled(JobEnded):
    """The job was cancelled."""


@contextmanager
def _shown(job: JobRecord) -> Iterator[Callable[[], None]]:
    """Show how far a job is whenever what is yielded is called."""
    pace = Pace()
    with bar(job.label or job.id) as report:

        def show() -> None:
            pace.saw(job.progress.fraction, job.progress.steps)
            report(job.progress.fraction, job.activity or _note(job, pace))

        yield show


def _note(job: JobRecord, pace: Pace) -> str:
    parts = [job.state]  # the bar shows the fraction
    if not job.is_study:
        parts.insert(0, f"t = {job.progress.time:.4g} s")
    if not job.is_finished and pace.steps_per_second is not None:
        parts.append(f"{pace.steps_per_second:.3g} steps/s")
    return ", ".join(parts)
