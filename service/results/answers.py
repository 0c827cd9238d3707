"""From a run's store to the rows and columns that the API shows."""

import numpy as np
from numpy.typing import NDArray

from jointplay.records.channel import TIME, by_name
from jointplay.records.run import inside
from jointplay.service.results import schemas
from jointplay.service.results.queries import (
    HistoryQuery,
    Selection,
    Window,
    check_points,
    check_size,
    chosen_channels,
)
from jointplay.service.results.tables import Column
from jointplay.storage.results import ResultReader

Floats = NDArray[np.float64]


def history(store: ResultReader, query: HistoryQuery) -> schemas.History | schemas.Overview:
    """Return a window of the output grid; at fewer points than it has samples, an overview."""
    start, stop = query.checked()
    names = chosen_channels(query.channels, list(by_name(store.channels)))
    first, last = store.between(start, stop)
    if query.points is not None and last - first > query.points:
        return _overview(store, names, first, last, query.points)
    if last > first:
        ends = store.history([], first, first + 1)[0], store.history([], last - 1, last)[0]
        seconds = float(ends[1][0] - ends[0][0])
        check_size(last - first, len(names) + 1, "samples", seconds)
    time, columns = store.history(names, first, last)
    return schemas.History.model_construct(
        complete=store.complete,
        time=schemas.Series.of(TIME, time),
        channels=_series(store, columns),
    )


def sections(store: ResultReader, selection: Selection) -> schemas.Poincare:
    """Return the Poincare sections in a window of time."""
    names = chosen_channels(selection.channels, list(by_name(store.channels)))
    time = store.sections([])[0]
    shown = inside(time, *selection.checked())
    if shown.any():
        check_size(int(shown.sum()), len(names) + 1, "sections", float(np.ptp(time[shown])))
    columns = {name: column[shown] for name, column in store.sections(names)[1].items()}
    return schemas.Poincare.model_construct(
        complete=store.complete,
        time=schemas.Series.of(TIME, time[shown]),
        channels=_series(store, columns),
        note=str(store.attributes.get("section_note", "")),
    )


def peaks(store: ResultReader) -> schemas.Peaks:
    """Return the signed extremes of every channel."""
    described = by_name(store.channels)
    found = {
        name: schemas.Peak.model_construct(unit=described[name].unit, **vars(peak))
        for name, peak in store.peaks().items()
    }
    return schemas.Peaks.model_construct(complete=store.complete, peaks=found)


def impacts(store: ResultReader, window: Window) -> schemas.Impacts:
    """Return the contacts whose onset is in a window of time."""
    rows = store.impacts()
    rows = rows[inside(rows["onset"], *window.checked())]
    names = rows.dtype.names or ()
    if len(rows):
        check_size(len(rows), len(names), "impacts", float(np.ptp(rows["onset"])))
    found = []
    for row in rows.tolist():
        values = dict(zip(names, row, strict=True))
        values["joint"] = store.joints[values["joint"]]
        found.append(schemas.Impact.model_construct(**values))
    return schemas.Impacts.model_construct(complete=store.complete, impacts=found)


def columns_of(answer: schemas.History | schemas.Overview) -> list[Column]:
    """Return an answer as the columns of a table."""
    if isinstance(answer, schemas.History):
        series = {"time": answer.time} | answer.channels
        return [_column(name, one.unit, one.values) for name, one in series.items()]
    found = [
        _column("time", answer.bins.unit, answer.bins.first, "first"),
        _column("time", answer.bins.unit, answer.bins.last, "last"),
    ]
    for name, one in answer.extremes.items():
        found.append(_column(name, one.unit, one.minimum, "minimum"))
        found.append(_column(name, one.unit, one.maximum, "maximum"))
    return found


def _column(name: str, unit: str, values: schemas.Values, part: str = "") -> Column:
    return Column(name, unit, np.array(values, np.float64), part)


def _overview(
    store: ResultReader, names: list[str], first: int, last: int, points: int
) -> schemas.Overview:
    check_points(points, len(names))
    time, found = store.extremes(names, first, last, points)
    described = by_name(store.channels)
    extremes = {
        name: schemas.Extremes.model_construct(
            unit=described[name].unit,
            long_name=described[name].long_name,
            minimum=pairs[:, 0].tolist(),
            maximum=pairs[:, 1].tolist(),
        )
        for name, pairs in found.items()
    }
    bins = schemas.Bins.model_construct(
        unit="s", first=time[:, 0].tolist(), last=time[:, 1].tolist()
    )
    return schemas.Overview.model_construct(
        complete=store.complete, samples=last - first, bins=bins, extremes=extremes
    )


def _series(store: ResultReader, columns: dict[str, Floats]) -> dict[str, schemas.Series]:
    described = by_name(store.channels)
    return {name: schemas.Series.of(described[name], column) for name, column in columns.items()}
