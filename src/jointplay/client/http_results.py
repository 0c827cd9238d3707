"""Results of a job of a service."""

import math
from collections.abc import Callable, Mapping
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from jointplay.client import studies
from jointplay.client.connection import Connection, segment
from jointplay.client.errors import FieldProblem, NotFound, Refused
from jointplay.client.halving import parts_that_fit
from jointplay.client.job_record import JobRecord
from jointplay.client.results import Impacts, Names, Peak, Seconds, Shown, Store
from jointplay.client.window import Window, floats
from jointplay.records.figure_form import Form
from jointplay.records.impact import IMPACT_UNITS
from jointplay.records.peak import PEAK
from jointplay.records.run import Dataset
from jointplay.records.study import StudyDataset
from jointplay.records.window_query import WindowQuery

if TYPE_CHECKING:
    from jointplay.figures import Options, Pace
    from jointplay.records.sensitivity.analysis import Side

_Times = tuple[Seconds, Seconds]


class HttpResults:
    """The `Results` of a job of a service; what is too large for one answer comes in several."""

    def __init__(self, connection: Connection, path: str, job: JobRecord) -> None:
        self._connection = connection
        self._path = path
        self._job = job

    def store(self) -> Store:
        """Return the address of the job's store."""
        session = {
            "headers": self._connection.headers,
            "trust_env": self._connection.trusts_environment,
        }
        return Store(f"{self._connection.url}{self._path}/zarr", {"client_kwargs": session})

    def content(self, key: str) -> bytes:
        """Return a file of the store, such as ``zarr.json``; FileNotFoundError if there is none."""
        try:
            return self._connection.content(f"{self._path}/zarr/{key}")
        except NotFound as error:
            raise FileNotFoundError(str(error)) from error

    def window(self, query: WindowQuery) -> Window:
        """Return channels in a window of time."""
        if query.of_samples:
            return self._window("history", query.channels, query.start, query.stop)
        return Window.from_document(self._get("history", **asdict(query)))

    def sections(self, channels: Names) -> Window:
        """Return channels at the Poincare sections of a simulation."""
        return self._window("poincare", channels)

    def peaks(self, start: Seconds = None, stop: Seconds = None) -> Mapping[str, Peak]:
        """Return the signed extremes of every channel."""
        found = self._get("peaks", start=start, stop=stop)["peaks"]
        return {
            channel: Peak(**{name: _number(peak[name]) for name in PEAK}, unit=peak["unit"])
            for channel, peak in found.items()
        }

    def impacts(self) -> Impacts:
        """Return the contacts of the clearance joints."""
        found = self._in_parts("impacts")
        rows = [row for document in found for row in document["impacts"]]
        if len(found) > 1:  # windows are of onsets
            rows.sort(key=lambda row: math.inf if row["release"] is None else row["release"])
        columns = {name: floats([row[name] for row in rows]) for name in IMPACT_UNITS}
        return Impacts(joint=[row["joint"] for row in rows], **columns)

    def statistics(self) -> dict[str, Any]:
        """Return what the run cost, and its energy ledger."""
        return self._get("statistics")

    def certificate(self) -> dict[str, Any]:
        """Return how far the run can be believed."""
        return self._get("certificate")

    def accuracy(self) -> dict[str, Any]:
        """Return what every method and tolerance costs and buys."""
        return self._get("accuracy")

    def attractors(self) -> dict[str, Any]:
        """Return the attractors of many starts."""
        return self._get("attractors")

    def calibration(self) -> dict[str, Any]:
        """Return what a calibration found."""
        return self._get("calibration")

    def sensitivity(
        self, output: str | None, limit: float | None, failing: "Side", confidence: float
    ) -> dict[str, Any]:
        """Return what one output owes to each parameter."""
        names = {"output": None if output is None else [output], "failing": [failing]}
        return self._get("sensitivity", **names, limit=limit, confidence=confidence)

    def branch(self) -> dict[str, Any]:
        """Return the branches of a continuation."""
        return self._get("branch")

    def study(
        self, observables: Names, channels: Names, sections: tuple[int, int] | None
    ) -> StudyDataset:
        """Return the points of a study, fetched as they are now."""
        record = int(self._job.job.get("record", 0)) if self._job.job.get("observables") else 0
        taken = (observables or ["*"]) if record else None
        kept = channels if self._job.job.get("channels") else None
        fetch = partial(self._get, "points", channels=kept, observables=taken)
        return studies.study_of(self._job, fetch, (sections or (0, record)) if record else (0, 0))

    def source(self, query: WindowQuery) -> Dataset:
        """Return the samples of a window, fetched."""
        return self.window(query).dataset()

    def figures(self) -> list[str]:
        """Return the names of the figures that can be drawn."""
        return [figure["name"] for figure in self._get("figures")["figures"]]

    def figure(self, name: str, form: Form, shown: Shown, options: "Options") -> bytes:
        """Return a figure, drawn by the service."""
        chosen = {"channels": shown.channels or None, "joints": shown.joints or None}
        over = {} if shown.over is None else {"over": shown.over.id}
        query = _query(**chosen, start=shown.start, stop=shown.stop) | over | options.given()
        path = f"{self._path}/figures/{segment(name)}.{segment(form)}"
        return self._connection.content(path, query)

    def film(
        self,
        path: Path,
        shown: Shown,
        pace: "Pace",
        options: "Options",
        report: Callable[[float], object],
    ) -> None:
        """Refuse: a service draws single frames, its page saves films."""
        sentence = (
            "A service draws no films; its page saves them, and one frame is there as svg, png, pdf"
            " or eps. Films are drawn of a folder that `jointplay run` made."
        )
        raise Refused(sentence, problem="not-drawable", fields=[FieldProblem("form", sentence)])

    def _window(
        self, name: str, channels: Names, start: Seconds = None, stop: Seconds = None
    ) -> Window:
        found = self._in_parts(name, start, stop, channels=channels)
        return Window.joined([Window.from_document(document) for document in found])

    def _in_parts(
        self, name: str, start: Seconds = None, stop: Seconds = None, **query: Any
    ) -> list[dict[str, Any]]:
        def fetch(window: _Times) -> dict[str, Any]:
            return self._get(name, **query, start=window[0], stop=window[1])

        def halves(window: _Times) -> tuple[_Times, _Times] | None:
            start, stop = window
            first = 0.0 if start is None else start
            last = float(self._job.job["duration"]) if stop is None else stop
            middle = first + (last - first) / 2.0
            following = math.nextafter(middle, math.inf)  # both ends are included
            fits = first <= middle < following <= last
            return ((start, middle), (following, stop)) if fits else None

        return [document for _, document in parts_that_fit(fetch, (start, stop), halves)]

    def _get(self, name: str, **query: Any) -> dict[str, Any]:
        return self._connection.get(f"{self._path}/{name}", _query(**query))


def _query(**given: Any) -> dict[str, Any]:
    """Return parameters of a request; names come as one text."""
    return {
        name: value if value is None or isinstance(value, int | float) else ",".join(value)
        for name, value in given.items()
    }


def _number(value: float | None) -> float:
    return math.nan if value is None else value
