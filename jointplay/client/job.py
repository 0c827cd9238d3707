"""`Job`: what became of a job, and its results; the same from a service and from a folder."""

import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import nullcontext
from functools import cached_property
from typing import TYPE_CHECKING, Any, Self

from jointplay.client import tables
from jointplay.client.errors import JobCancelled, JobFailed, TimedOut
from jointplay.client.html import html_table
from jointplay.client.job_record import JobRecord, read_job
from jointplay.client.keeper import Keeper
from jointplay.client.picture import Picture
from jointplay.client.results import Form, Results
from jointplay.client.stored import open_group
from jointplay.client.waiting import shown
from jointplay.client.window import Window
from jointplay.study_source import StudySource

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

Names = str | Sequence[str]


class Job(JobRecord):
    """One job: its record as it was last seen, and its results.

    The attributes of the record (``state``, ``progress``, ``error``, ...) change when `wait`,
    `refresh` or `cancel` is called.  Results are read when they are asked for; those of a running
    job are what it has committed so far.

    Tables are pandas and stored arrays xarray: ``pip install 'jointplay[xarray]'``.  `window`,
    `study`, `results` and figures need neither.
    """

    def __init__(self, document: Mapping[str, Any], keeper: Keeper) -> None:
        super().__init__(**read_job(document))
        self._keeper = keeper
        self._opened: dict[str, xr.Dataset] = {}

    def __repr__(self) -> str:
        return f"<Job {self.id}: {self.kind} of {self.scene_name}, {self.state}>"

    def _repr_html_(self) -> str:
        return html_table(
            f"{self.kind} of {self.scene_name}",
            {
                "id": self.id,
                "label": self.label,
                "state": f"{self.state}, {self.done_so_far}",
                "error": self.error and f"{self.error.kind}: {self.error.detail}",
                "created": f"{self.created.astimezone():%Y-%m-%d %H:%M:%S}",
                "computed in": self.seconds and f"{self.seconds:.3g} s",
            },
        )

    def refresh(self) -> Self:
        """Look at the job once more."""
        self.renew(self._keeper.look(self))
        return self

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
        deadline = None if timeout is None else time.monotonic() + timeout
        with shown(self) if progress else nullcontext(lambda: None) as show:

            def tell() -> None:
                show()
                if report is not None:
                    report(self)

            if not self.is_finished:
                self.refresh()
            tell()
            if not self.is_finished:
                self._follow(tell, deadline)
        if check:
            self.check()
        return self

    def _follow(self, tell: Callable[[], None], deadline: float | None) -> None:
        for _ in self._keeper.follow(self, deadline):
            if not self.is_finished:
                tell()
        if not self.is_finished:
            raise TimedOut(f"Job {self.id} is still {self.state}; the time to wait is over.")
        self.refresh()
        tell()

    def check(self) -> None:
        """Raise `JobFailed` or `JobCancelled` if the job ended so."""
        if self.state == "failed":
            why = f" ({self.error.kind}): {self.error.detail}" if self.error else "."
            raise JobFailed(f"Job {self.id} failed{why}", self)
        if self.state == "cancelled":
            raise JobCancelled(f"Job {self.id} was cancelled at {self.done_so_far}.", self)

    def cancel(self) -> Self:
        """Ask for the job to be cancelled; asking again, or too late, changes nothing."""
        self.renew(self._keeper.cancel(self))
        return self

    def delete(self) -> None:
        """Delete the finished job with its results; there is no way back."""
        self._keeper.delete(self)

    @cached_property
    def results(self) -> Results:
        """The results as plain numbers, without pandas and xarray."""
        return self._keeper.results(self)

    @property
    def history(self) -> "xr.Dataset":
        """Of a simulation: all channels over the samples, read from the store as they are used."""
        tables.insist(self, "history", "simulate")
        return self.open()

    def open(self, group: str = "") -> "xr.Dataset":
        """Open a group of the job's Zarr store, lazily; by default the root.

        Groups of a simulation are ``poincare``, ``impacts`` and ``peaks``, of a study ``values``,
        ``statistics``, ``indicators``, ``sections`` and ``peaks``.
        """
        if group in self._opened:
            return self._opened[group]
        final = self.is_finished
        found = open_group(self, group)
        if final:
            self._opened[group] = found
        return found

    def window(
        self,
        channels: Names | None = None,
        start: float | None = None,
        stop: float | None = None,
        *,
        points: int | None = None,
    ) -> Window:
        """Return channels in a window of time; with ``points``, at the resolution of a screen.

        Parameters
        ----------
        channels
            Names or globs; all if None.
        start, stop
            Both included, s; None is unbounded.
        points
            Most pairs of smallest and largest values; see `Window`.
        """
        return self.results.window(_listed(channels), start, stop, points)

    @property
    def poincare(self) -> "pd.DataFrame":
        """The Poincare sections: ``time`` and channels of each.

        Of a study one row for each section of each point, with the values of the parameters.
        """
        return tables.sections(self)

    @property
    def peaks(self) -> "pd.DataFrame":
        """Signed extremes with their times, one row a channel; of a sweep of each point."""
        return tables.peaks(self)

    @property
    def impacts(self) -> "pd.DataFrame":
        """Of a simulation: contacts in order of release, one row each."""
        return tables.impacts(self)

    @property
    def points(self) -> "pd.DataFrame":
        """Of a study: values, status, verdict, indicators and statistics, one row a point."""
        return tables.points(self)

    @property
    def statistics(self) -> dict[str, Any]:
        """Of a simulation: what it cost, and its energy ledger with the residual, in J."""
        return self.results.statistics()

    @property
    def certificate(self) -> dict[str, Any]:
        """Of a simulation: how far it can be believed; `NotFound` where there is none."""
        return self.results.certificate()

    def study(
        self,
        observables: Names | None = None,
        channels: Names | None = None,
        sections: tuple[int, int] | None = None,
    ) -> StudySource:
        """Return the points of a study as they are now, as arrays; it need not be finished.

        Parameters
        ----------
        observables
            Names or globs of channels whose values at the sections to fetch; all if None.
        channels
            Of a sweep, names or globs of channels whose extremes to fetch; all if None.
        sections
            First section of each point, and the one before which to end; all if None.
        """
        tables.insist(self, "points", *tables.STUDIES)
        return self.results.study(_listed(observables), _listed(channels), sections)

    @property
    def figures(self) -> list[str]:
        """Names of the figures that can be drawn; the name of any channel is one, too."""
        return self.results.figures()

    def figure(
        self,
        name: str,
        *,
        channel: Names = (),
        joint: Names = (),
        start: float | None = None,
        stop: float | None = None,
        form: Form = "png",
    ) -> Picture:
        """Draw a figure; notebooks show it, and ``save`` writes it to a file.

        Parameters
        ----------
        name
            One of `figures`, or a channel.
        channel, joint
            What to show, one or several; all if not given.
        start, stop
            Window of time, s; of a study the first point, and the one before which to end.
        form
            "png" or "svg".
        """
        return Picture(
            self.results.figure(
                name,
                form,
                channels=_listed(channel) or (),
                joints=_listed(joint) or (),
                start=start,
                stop=stop,
            ),
            form,
        )


def _listed(names: Names | None) -> list[str] | None:
    if names is None:
        return None
    return [names] if isinstance(names, str) else list(names)
