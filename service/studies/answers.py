"""From a study's store to the columns that the API shows."""

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.branch import branch_document
from jointplay.records.channel import Channel, by_name
from jointplay.records.peak import PeakColumns
from jointplay.records.point import PointStatus
from jointplay.records.point_numbers import OUTPUTS
from jointplay.service.results.schemas import Series
from jointplay.service.studies import schemas
from jointplay.service.studies.queries import (
    BifurcationQuery,
    BranchQuery,
    PointRange,
    PointsQuery,
    SectionRange,
    SweepQuery,
    chosen,
    page,
)
from jointplay.solver.nonlinear.reasons import undecided_reasons
from jointplay.storage.studies.reader import StudyReader

UNKNOWN = ("1", "")
TIME = Channel("time", "s", "time since the start of the point's run")
VERDICT = "verdict"
_READ = 4_000_000


class Shown(NamedTuple):
    """Parts of a study that are shown beside the numbers of its points."""

    sections: tuple[Channel, ...] = ()
    """At the sections: `TIME`, observables."""
    window: range = range(0)
    """Range of the sections of each point."""
    extremes: tuple[Channel, ...] = ()
    """Channels."""

    @property
    def width(self) -> int:
        """Values of each point."""
        return len(self.sections) * len(self.window) + 5 * len(self.extremes)


def points(store: StudyReader, query: PointsQuery) -> schemas.Points:
    """Return all that a study has of a range of points."""
    observables = query.taken(store)
    window = query.sections(store) if observables else range(0)
    shown = Shown((TIME, *observables) if observables else (), window, query.of_channels(store))
    return _points(store, query, shown)


def bifurcation(store: StudyReader, query: BifurcationQuery) -> schemas.Bifurcation:
    """Return an observable over the parameter: a view of `points`."""
    observable = query.taken(store)
    found = _points(store, query, Shown((observable,), query.sections(store)))
    (parameter,) = store.parameters
    directions: list[Any] | None = None
    if store.attributes["job"]["continuation"] == "both":
        half, first = store.points // 2, found.start
        every = range(first, first + len(found.status))
        directions = ["forward" if point < half else "backward" for point in every]
    return schemas.Bifurcation.model_construct(
        **vars(found)
        | {
            "parameter": parameter.name,
            "directions": directions,
            "observable": observable.name,
            "sections": found.sections[observable.name],
        }
    )


def sections(store: StudyReader, query: SectionRange, names: str | None) -> schemas.Sections:
    """Return times and channels at the sections of points: a view of `points`."""
    observables = chosen(names, store.observables, "channels")
    found = _points(store, query, Shown((TIME, *observables), query.sections(store)))
    return schemas.Sections.model_construct(**vars(found) | {"channels": found.sections})


def branch(store: StudyReader, query: BranchQuery) -> schemas.Branches:
    """Return the branches of a continuation, as far as they are known."""
    names = {one.name for one in query.taken(store)}
    return schemas.Branches.model_validate(branch_document(store, names))


def sweep(store: StudyReader, query: SweepQuery) -> schemas.Sweep:
    """Return extremes over the parameters: a view of `points`."""
    found = _points(store, query, Shown(extremes=query.of_channels(store)))
    return schemas.Sweep.model_construct(**vars(found))


def _points(store: StudyReader, query: PointRange, shown: Shown) -> schemas.Points:
    part, following = page(query.points(store), shown.width + _columns(store))
    names = {one.name for one in shown.extremes}
    rows = _rows(store, part, shown.window, shown.sections)
    return schemas.Points.model_construct(
        **_judged(store, part, following, by_name(store.channels).keys() - names),
        shape=list(store.shape),
        axes=list(axes(store).values()),
        time=rows.pop(TIME.name, None),
        sections=rows,
        peaks={one.name: _peaks(store, one, part) for one in shown.extremes},
        runs=store.attributes.get("runs", []),
    )


def axes(store: StudyReader) -> dict[str, schemas.Axis]:
    """Return the axes of a map by name, y and x; none of points on one axis."""
    return {
        name: schemas.Axis.of(one, name=name, parameter=one.name, values=values)
        for name, (one, values) in store.coordinates.items()
    }


def _peaks(store: StudyReader, channel: Channel, points: range) -> schemas.PeakColumns:
    part = slice(points.start, points.stop)
    found = PeakColumns(*(column[part] for column in store.peaks(channel.name)))
    ranges = found.maximum - found.minimum
    return schemas.PeakColumns.of(channel, range=ranges, **found._asdict())


def _columns(store: StudyReader) -> int:
    """Count the values that every point takes beside its sections or extremes."""
    return len(store.parameters) + len(store.statistics) + len(store.indicators) + 3


def _judged(
    store: StudyReader, points: range, following: int | None, left_out: Collection[str]
) -> dict[str, Any]:
    """Return what every study has; without statistics of the channels that are left out."""
    codes, names = store.verdicts, store.verdict_names
    reasons = store.reasons or undecided_reasons(store, points)
    part = slice(points.start, points.stop)
    return {
        "complete": store.complete,
        "points": store.points,
        "start": points.start,
        "next_start": following,
        "values": {
            one.name: Series.of(one, values=store.values[part, column])
            for column, one in enumerate(store.parameters)
        },
        "status": [PointStatus(code).name for code in store.status[part]],
        "failures": [
            schemas.PointFailure.model_construct(
                point=point, code=one.code, detail=one.detail, time=one.time
            )
            for point, one in sorted(store.failures.items())
            if point in points
        ],
        "statistics": _described(
            store,
            {
                name: column
                for name, column in store.statistics.items()
                if name.rpartition(".")[0] not in left_out
            },
            part,
        ),
        "counts": store.counts[part].tolist(),
        "indicators": _described(store, store.indicators, part),
        "verdicts": None
        if codes is None
        else [None if code < 0 else names[code] for code in codes[part]],
        "reasons": None if codes is None else [reasons.get(point) for point in points],
    }


def _described(store: StudyReader, columns: Mapping[str, Floats], part: slice) -> dict[str, Series]:
    outputs = {**OUTPUTS, **store.own_outputs}
    return {
        name: Series.of(Channel(name, *outputs.get(name, UNKNOWN)), values=one[part])
        for name, one in columns.items()
        if name != VERDICT
    }


def _rows(
    store: StudyReader, points: range, window: range, columns: Sequence[Channel]
) -> dict[str, schemas.Rows]:
    """Return columns at the sections that were recorded: `TIME` and observables."""
    names = [one.name for one in columns if one is not TIME]
    values: dict[str, list[Any]] = {}
    if len(points) == 1 and columns:  # of a long record, only the window is read
        time, found = store.point_sections(points[0], names, window.start, window.stop)
        values = {name: [column] for name, column in {TIME.name: time, **found}.items()}
    else:
        for one in columns:
            read = store.section_times if one is TIME else partial(store.sections, one.name)
            values[one.name] = list(_recorded(store, points, window, read))
    return {one.name: schemas.Rows.of(one, values=values[one.name]) for one in columns}


def _recorded(
    store: StudyReader, points: range, window: range, read: Callable[[int, int], Floats]
) -> Iterator[Floats]:
    """Yield a window of what each point recorded; at most about `_READ` values are held."""
    ends = np.clip(store.counts, window.start, window.stop).tolist()
    rows = max(_READ // store.record, 1)
    for first in range(points.start, points.stop, rows):
        last = min(first + rows, points.stop)
        for point, row in enumerate(read(first, last), first):
            yield row[window.start : ends[point]].copy()
