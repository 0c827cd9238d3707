"""`AsyncJob`: what became of a job, and its results, awaited."""

from typing import TYPE_CHECKING, Any

from jointplay.client.asynchronous.picture import AsyncPicture
from jointplay.client.asynchronous.verbs import Attribute, awaited, changing, iterated
from jointplay.client.job import Job
from jointplay.client.job_record import JobRecord

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr


class AsyncJob(JobRecord):
    """A `Job` whose verbs and results are awaited; its record is at hand.

    ``await job.wait()``, ``await job.peaks``, ``async for seen in job.follow()``.  Arrays that
    `open`, `history` and `dataset` give are xarray's: those that come from the store are read when
    they are used, which blocks (``await asyncio.to_thread(history.load)`` does not).

    A `report` that is given to `wait` gets the blocking `Job`, and may call its verbs.
    """

    __slots__ = ("_blocking",)

    def __init__(self, job: Job) -> None:
        self.__dict__ = vars(job)  # one record: what the one learns the other knows
        self._blocking = job

    def __hash__(self) -> int:
        return hash(self.id)

    def __repr__(self) -> str:
        return repr(self._blocking).replace("<Job", "<AsyncJob", 1)

    def _repr_html_(self) -> str:
        return self._blocking._repr_html_()

    def check(self) -> None:
        """Raise `JobFailed` or `JobCancelled` if the job ended so; nobody is asked."""
        self._blocking.check()

    refresh = changing(Job.refresh)
    wait = changing(Job.wait)
    cancel = changing(Job.cancel)
    retry = awaited(Job.retry, lambda job: AsyncJob(job))
    delete = awaited(Job.delete)
    follow = iterated(Job.follow, lambda job: AsyncJob(job))

    open = awaited(Job.open)
    window = awaited(Job.window)
    sensitivity = awaited(Job.sensitivity)
    study = awaited(Job.study)
    export = awaited(Job.export)
    figure = awaited(Job.figure, AsyncPicture)
    film = awaited(Job.film)

    figures: Attribute[Job, list[str]] = Attribute(lambda job: job.figures)
    history: "Attribute[Job, xr.Dataset]" = Attribute(lambda job: job.history)
    dataset: "Attribute[Job, xr.Dataset]" = Attribute(lambda job: job.dataset)
    peaks: "Attribute[Job, pd.DataFrame]" = Attribute(lambda job: job.peaks)
    poincare: "Attribute[Job, pd.DataFrame]" = Attribute(lambda job: job.poincare)
    impacts: "Attribute[Job, pd.DataFrame]" = Attribute(lambda job: job.impacts)
    points: "Attribute[Job, pd.DataFrame]" = Attribute(lambda job: job.points)
    statistics: Attribute[Job, dict[str, Any]] = Attribute(lambda job: job.statistics)
    certificate: Attribute[Job, dict[str, Any]] = Attribute(lambda job: job.certificate)
    accuracy: Attribute[Job, dict[str, Any]] = Attribute(lambda job: job.accuracy)
    attractors: Attribute[Job, dict[str, Any]] = Attribute(lambda job: job.attractors)
    branch: Attribute[Job, dict[str, Any]] = Attribute(lambda job: job.branch)
    calibration: Attribute[Job, dict[str, Any]] = Attribute(lambda job: job.calibration)
