"""Results of a job of a service."""

import math
from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

from jointplay.client import studies
from jointplay.client.connection import Connection, segment
from jointplay.client.halving import parts_that_fit
from jointplay.client.job_record import JobRecord
from jointplay.client.results import Form, Impacts, Peak, Store
from jointplay.client.window import Window, floats
from jointplay.records.impact import IMPACT_UNITS
from jointplay.records.peak import PEAK
from jointplay.records.run_in_memory import Dataset
from jointplay.records.study_in_memory import StudyDataset

_Times = tuple[float | None, float | None]


class HttpResults:
    """The `Results` of a job of a service; what is too large for one answer comes in several."""

    def __init__(self, connection: Connection, job: JobRecord) -> None:
        self._connection = connection
        self._job = job
        self._path = f"/v1/jobs/{segment(job.id)}"

    def store(self) -> Store:
        """Return the address of the job's store."""
        session = {
            "headers": self._connection.headers,
            "trust_env": self._connection.trusts_environment,
        }
        return Store(f"{self._connection.url}{self._path}/zarr", {"client_kwargs": session})

    def window(
        self,
        channels: Sequence[str] | None,
        start: float | None,
        stop: float | None,
        points: int | None,
    ) -> Window:
        """Return channels from ``start`` to ``stop``, in s."""
        chosen = {"channels": _joined(channels), "points": points}
        if points is not None:
            document = self._document("history", {**chosen, "start": start, "stop": stop})
            return Window.from_document(document)
        found = self._windows("history", start, stop, **chosen)
        return Window.joined([Window.from_document(document) for document in found])

    def sections(self, channels: Sequence[str] | None) -> Window:
        """Return channels at the Poincare sections of a simulation."""
        found = self._windows("poincare", None, None, channels=_joined(channels))
        return Window.joined([Window.from_document(document) for document in found])

    def peaks(self) -> Mapping[str, Peak]:
        """Return the signed extremes of every channel."""
        return {
            channel: Peak(*_numbers(peak), peak["unit"])
            for channel, peak in self._document("peaks")["peaks"].items()
        }

    def impacts(self) -> Impacts:
        """Return the contacts of the clearance joints."""
        found = self._windows("impacts", None, None)
        rows = [row for document in found for row in document["impacts"]]
        if len(found) > 1:  # windows are of onsets
            rows.sort(key=lambda row: math.inf if row["release"] is None else row["release"])
        columns = {name: floats([row[name] for row in rows]) for name in IMPACT_UNITS}
        return Impacts(joint=[row["joint"] for row in rows], **columns)

    def statistics(self) -> dict[str, Any]:
        """Return what the run cost, and its energy ledger."""
        return self._document("statistics")

    def certificate(self) -> dict[str, Any]:
        """Return how far the run can be believed."""
        return self._document("certificate")

    def accuracy(self) -> dict[str, Any]:
        """Return what every method and tolerance costs and buys."""
        return self._document("accuracy")

    def study(
        self,
        observables: Sequence[str] | None,
        channels: Sequence[str] | None,
        sections: tuple[int, int] | None,
    ) -> StudyDataset:
        """Return the points of a study, fetched as they are now."""
        if "sweep" in self._job.links:
            fetch = partial(self._query, "sweep", channel=_joined(channels))
            return studies.with_extremes(self._job, fetch)
        fetch = partial(self._query, "poincare", channels=_joined(observables))
        window = sections or (0, int(self._job.job["record"]))
        return studies.with_sections(self._job, fetch, window)

    def source(
        self, channels: Sequence[str] | None, start: float | None, stop: float | None
    ) -> Dataset:
        """Return a window of a simulation, fetched."""
        return self.window(channels, start, stop, None).dataset()

    def figures(self) -> list[str]:
        """Return the names of the figures that can be drawn."""
        return [figure["name"] for figure in self._document("figures")["figures"]]

    def figure(
        self,
        name: str,
        form: Form,
        *,
        channels: Sequence[str],
        joints: Sequence[str],
        start: float | None,
        stop: float | None,
    ) -> bytes:
        """Return a figure, drawn by the service."""
        query = {
            "channels": _joined(channels or None),
            "joints": _joined(joints or None),
            "start": start,
            "stop": stop,
        }
        path = f"{self._path}/figures/{segment(name)}.{segment(form)}"
        return self._connection.get(path, query).content

    def _windows(
        self, name: str, start: float | None, stop: float | None, **query: Any
    ) -> list[dict[str, Any]]:
        def fetch(window: _Times) -> dict[str, Any]:
            return self._document(name, {**query, "start": window[0], "stop": window[1]})

        def halves(window: _Times) -> tuple[_Times, _Times] | None:
            start, stop = window
            first = 0.0 if start is None else start
            last = float(self._job.job["duration"]) if stop is None else stop
            middle = first + (last - first) / 2.0
            following = math.nextafter(middle, math.inf)  # both ends are included
            fits = first <= middle < following <= last
            return ((start, middle), (following, stop)) if fits else None

        return [document for _, document in parts_that_fit(fetch, (start, stop), halves)]

    def _query(self, name: str, **query: Any) -> dict[str, Any]:
        return self._document(name, query)

    def _document(self, name: str, query: Mapping[str, Any] | None = None) -> dict[str, Any]:
        document: dict[str, Any] = self._connection.get(f"{self._path}/{name}", query).json()
        return document


def _numbers(peak: Mapping[str, Any]) -> tuple[float, float, float, float]:
    low, low_time, high, high_time = floats([peak[name] for name in PEAK]).tolist()
    return low, low_time, high, high_time


def _joined(names: Sequence[str] | None) -> str | None:
    return None if names is None else ",".join(names)
