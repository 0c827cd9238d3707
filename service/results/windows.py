"""Windows of a run at any resolution: computed from its steps, or else from its samples."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any

import numpy as np
from fastapi import Depends

from jointplay.records.arrays import Floats
from jointplay.records.channel import TIME, by_name
from jointplay.records.peak import Peak
from jointplay.records.resolution import Resolution
from jointplay.service.dependencies import of_the_application
from jointplay.service.problems import RequestRefused
from jointplay.service.results import schemas
from jointplay.service.results.queries import check_points, check_step
from jointplay.service.results.stores import ReaderOfThePath
from jointplay.service.results.streaming import Column
from jointplay.service.windows import TooLong, WindowProcess
from jointplay.storage.results.reader import ResultReader
from jointplay.worker.windows.ends import NoSuchWindow
from jointplay.worker.windows.trajectory import Trajectory


@dataclass(frozen=True)
class ExactReader:
    """The reader of a run, and its trajectory between samples."""

    reader: ResultReader
    trajectory: Trajectory

    def values(
        self, names: list[str], start: float | None, stop: float | None, step: float
    ) -> schemas.History:
        """Return channels every `step` s, or refuse."""
        first, last = self._ends(start, stop)
        check_step(step, last - first, len(names))
        count = int((last - first) / step * (1.0 + 1e-12)) + 1
        times = np.minimum(first + step * np.arange(count), last)
        found = self.trajectory.values(names, times)
        if found.values is None:
            raise RequestRefused.of_parameter("step", found.refused)
        columns = dict(zip(names, found.values.T, strict=True))
        return schemas.History.model_construct(
            complete=self.reader.complete,
            time=schemas.Series.of(TIME, values=times),
            channels=series(self.reader, columns),
            note=found.note,
            resolution=resolution(found.resolution),
        )

    def overview(
        self,
        names: list[str],
        start: float | None,
        stop: float | None,
        points: int,
        *,
        has_note: bool,
    ) -> schemas.Overview | str:
        """Return extremes of equal spans of time, or a sentence: why they are not known exactly.

        That depends on the run and the window alone: where the service is too busy, it is refused,
        and so is what takes too long, unless the answer `has_note`.
        """
        check_points(points, len(names))
        edges = self.trajectory.edges(start, stop, points)
        try:
            found = self.trajectory.extremes(names, edges)
        except TooLong as refused:
            if not has_note:
                raise
            return str(refused)
        if found.values is None:
            return found.refused
        return schemas.Overview.model_construct(
            complete=self.reader.complete,
            samples=int(np.subtract(*self.reader.between(start, stop)[::-1])),
            bins=bins(np.column_stack([edges[:-1], edges[1:]])),
            extremes=extremes(self.reader, names, found.values[:, :, ::2]),
            exact=True,
            note=found.note,
            resolution=resolution(found.resolution),
        )

    def peaks(self, start: float | None, stop: float | None) -> dict[str, Peak]:
        """Return extremes of a window by channel, or refuse; of no window those so far, if any.

        Those so far leave out what the job leaves out as settling.
        """
        names = [channel.name for channel in self.reader.channels]
        first, last = self._ends(start, stop)
        so_far = start is None and stop is None
        if so_far:
            first = float(self.reader.attributes["job"].get("settle", 0.0))
            if first > last:
                return {}
        found = self.trajectory.extremes(names, np.array([first, last]))
        if found.values is None:
            if so_far:
                return {}
            raise RequestRefused.of_parameter("start", found.refused)
        rows = found.values[0].tolist()
        return {name: Peak(*row) for name, row in zip(names, rows, strict=True)}

    def _ends(self, start: float | None, stop: float | None) -> tuple[float, float]:
        try:
            return self.trajectory.ends(start, stop)
        except NoSuchWindow as error:
            raise RequestRefused.of_parameter(error.end, str(error)) from None


def resolution(found: Resolution | None) -> schemas.Resolution | None:
    """Return what a window was computed from, as the API shows it."""
    return None if found is None else schemas.Resolution.model_construct(**vars(found))


def bins(times: Floats) -> schemas.Bins:
    """Return the spans (k, 2) of time of groups."""
    spans: dict[str, Any] = {"first": times[:, 0], "last": times[:, 1]}
    return schemas.Bins.model_construct(unit="s", **spans)


def extremes(reader: ResultReader, names: list[str], found: Floats) -> dict[str, schemas.Extremes]:
    """Return minima and maxima (k, names, 2) by channel."""
    described = by_name(reader.channels)
    return {
        name: schemas.Extremes.of(described[name], minimum=found[:, c, 0], maximum=found[:, c, 1])
        for c, name in enumerate(names)
    }


def series(reader: ResultReader, columns: Mapping[str, Column]) -> dict[str, schemas.Series]:
    """Return columns with their units."""
    described = by_name(reader.channels)
    return {
        name: schemas.Series.of(described[name], values=column) for name, column in columns.items()
    }


async def _exact_reader(
    reader: ReaderOfThePath, windows: Annotated[WindowProcess, of_the_application("windows")]
) -> ExactReader:
    return ExactReader(reader, windows.of(reader))


ExactReaderOfThePath = Annotated[ExactReader, Depends(_exact_reader)]
