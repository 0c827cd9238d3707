"""From a study's store to the columns that the API shows."""

from collections.abc import Callable, Collection, Iterator, Mapping
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.channel import Channel, by_name
from jointplay.records.peak import PeakColumns
from jointplay.records.point import PointStatus
from jointplay.service.results.queries import chosen_channels
from jointplay.service.results.schemas import Series
from jointplay.service.studies import schemas
from jointplay.service.studies.queries import BifurcationQuery, SectionRange, SweepQuery, page
from jointplay.solver.runs.study.outputs import OUTPUTS
from jointplay.storage.studies.reader import StudyReader

Floats = NDArray[np.float64]
UNKNOWN = ("1", "")
TIME = Channel("time", "s", "time since the start of the point's run")
VERDICT = "verdict"
_READ = 4_000_000


def bifurcation(store: StudyReader, query: BifurcationQuery) -> schemas.Bifurcation:
    """Return an observable over the parameter."""
    observable = query.taken(store)
    window = query.sections(store)
    points, following = page(query.points(store), len(window) + _columns(store))
    (parameter,) = store.parameters
    directions: list[Any] | None = None
    if store.attributes["job"]["continuation"] == "both":
        half = store.points // 2
        directions = ["forward" if point < half else "backward" for point in points]
    return schemas.Bifurcation.model_construct(
        **_judged(store, points, following),
        parameter=parameter.name,
        directions=directions,
        observable=observable.name,
        sections=_rows(store, points, window, [observable])[observable.name],
    )


def sections(store: StudyReader, query: SectionRange, chosen: str | None) -> schemas.Sections:
    """Return times and channels at the sections of points."""
    names = chosen_channels(chosen, store.observables)
    window = query.sections(store)
    width = (len(names) + 1) * len(window) + _columns(store)
    points, following = page(query.points(store), width)
    described = by_name(store.observables)
    rows = _rows(store, points, window, [described[name] for name in names])
    return schemas.Sections.model_construct(
        **_judged(store, points, following), time=rows.pop(""), channels=rows
    )


def sweep(store: StudyReader, query: SweepQuery) -> schemas.Sweep:
    """Return extremes over the parameters."""
    names = chosen_channels(query.channel, store.channels, "channel")
    points, following = page(query.points(store), 5 * len(names) + _columns(store))
    part = slice(points.start, points.stop)
    described = by_name(store.channels)
    peaks = {}
    for name in names:
        found = PeakColumns(*(column[part] for column in store.peaks(name)))
        ranges = found.maximum - found.minimum
        peaks[name] = schemas.PeakColumns.of(described[name], range=ranges, **found._asdict())
    left_out = described.keys() - set(names)
    return schemas.Sweep.model_construct(**_points(store, points, following, left_out), peaks=peaks)


def _columns(store: StudyReader) -> int:
    """Count the values that every point takes beside its sections or extremes."""
    return len(store.parameters) + len(store.statistics) + len(store.indicators) + 3


def _points(
    store: StudyReader, points: range, following: int | None, left_out: Collection[str] = ()
) -> dict[str, Any]:
    """Return what every study has; without statistics of the channels that are left out."""
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
    }


def _judged(store: StudyReader, points: range, following: int | None) -> dict[str, Any]:
    part = slice(points.start, points.stop)
    codes, names = store.verdicts, store.verdict_names
    return {
        **_points(store, points, following),
        "counts": store.counts[part].tolist(),
        "indicators": _described(store, store.indicators, part),
        "verdicts": None
        if codes is None
        else [None if code < 0 else names[code] for code in codes[part]],
        "reasons": None if codes is None else [store.reasons.get(point) for point in points],
    }


def _described(store: StudyReader, columns: Mapping[str, Floats], part: slice) -> dict[str, Series]:
    outputs = {**OUTPUTS, **store.own_outputs}
    return {
        name: Series.of(Channel(name, *outputs.get(name, UNKNOWN)), values=one[part])
        for name, one in columns.items()
        if name != VERDICT
    }


def _rows(
    store: StudyReader, points: range, window: range, observables: list[Channel]
) -> dict[str, schemas.Rows]:
    """Return times, under the name "", and observables at sections that were recorded."""
    names = [one.name for one in observables]
    values: dict[str, list[Any]] = {}
    if len(points) == 1:  # of a long record, only the window is read
        time, columns = store.point_sections(points[0], names, window.start, window.stop)
        values = {name: [column] for name, column in {"": time, **columns}.items()}
    else:
        for name in ("", *names):
            read = partial(store.sections, name) if name else store.section_times
            values[name] = list(_recorded(store, points, window, read))
    described = {"": TIME, **by_name(observables)}
    return {name: schemas.Rows.of(described[name], values=rows) for name, rows in values.items()}


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
