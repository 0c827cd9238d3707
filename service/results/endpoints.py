"""``/v1/jobs/{id}/history`` and its siblings: numbers that a run has computed."""

from collections.abc import Mapping
from typing import Annotated, Any, Final

import numpy as np
from fastapi import APIRouter, Query, Response
from numpy.typing import NDArray

from jointplay.records.certificate import certificate_document
from jointplay.records.channel import TIME, by_name
from jointplay.records.resolution import of_samples
from jointplay.records.run import inside
from jointplay.records.table_files import Column as FileColumn
from jointplay.service.problems import RequestRefused, kinds, problems
from jointplay.service.results import schemas
from jointplay.service.results.certificate_schema import Certificate
from jointplay.service.results.forms import AS_FILES, IN_TURN, JSON, VARY, Form, as_file
from jointplay.service.results.queries import (
    ChannelsQuery,
    HistoryQuery,
    Selection,
    Window,
    check_points,
    check_size,
    chosen_channels,
)
from jointplay.service.results.stores import ReaderOfThePath, ResultsOfThePath
from jointplay.service.results.streaming import LEAST, Column, Parts, as_json
from jointplay.service.results.windows import (
    ExactReaderOfThePath,
    bins,
    extremes,
    resolution,
    series,
)
from jointplay.storage.results.contact_peaks import with_contact_peaks
from jointplay.storage.results.reader import ResultReader

router = APIRouter(
    prefix="/v1/jobs/{job_id}",
    tags=["results"],
    responses=problems(*kinds.OF_RESULTS),
)
_IMPACTS: Final = 1024
"""Contacts that are made at a time."""


@router.get(
    "/history",
    response_model=schemas.History | schemas.Overview,
    responses=AS_FILES | problems(kinds.NOT_ACCEPTABLE),
    dependencies=[IN_TURN],
)
def show_history(
    results: ResultsOfThePath,
    exact: ExactReaderOfThePath,
    query: Annotated[HistoryQuery, Query()],
    form: Form,
) -> Response:
    """Return channels on the output grid, in a window of time; of a running job as far as it is.

    With `points`, smallest and largest values of that many equal spans, so that no peak is lost;
    with `step`, values at any distance.  Both are computed from the steps of the run, where it
    keeps them, and know what is between samples; where it does not, `points` groups samples.
    Accept chooses JSON, CSV, NPZ or a MATLAB file.
    """
    file = f"{results.job.id}-history"
    reader = exact.reader
    start, stop = query.checked()
    names = chosen_channels(query.channels, reader.channels)
    note = ""
    if query.step is not None:
        if query.points is not None:
            raise RequestRefused.of_parameter("step", "Give step or points, not both.")
        return _shown_as(form, file, exact.values(names, start, stop, query.step))
    if query.points is not None:
        found = exact.overview(names, start, stop, query.points, has_note=form == JSON)
        if isinstance(found, schemas.Overview):
            return _shown_as(form, file, found)
        note = found
    first, last = reader.between(start, stop)
    if query.points is not None and last - first > query.points:
        overview = _overview(reader, names, first, last, query.points, note)
        return _shown_as(form, file, overview)
    if last > first:
        begin, end = (reader.history([], at, at + 1)[0][0] for at in (first, last - 1))
        check_size(last - first, len(names) + 1, "samples", float(end - begin))
    time: Column
    columns: Mapping[str, Column]
    if form == JSON and (last - first) * (len(names) + 1) > LEAST:
        for _ in reader.blocks(names, first, last):  # so that no damage is met on the way
            pass
        time = _read(reader, None, first, last)
        columns = {name: _read(reader, name, first, last) for name in names}
    else:
        time, columns = reader.history(names, first, last)
    history = schemas.History.model_construct(
        complete=reader.complete,
        time=schemas.Series.of(TIME, values=time),
        channels=series(reader, columns),
        note=note,
        resolution=resolution(of_samples(reader.attributes["job"])),
    )
    return _shown_as(form, file, history)


def _read(reader: ResultReader, name: str | None, first: int, last: int) -> Parts:
    """Return the samples of a channel, or the time, to be read while they are sent."""
    blocks = reader.blocks([] if name is None else [name], first, last)
    made = (time if name is None else columns[name] for time, columns in blocks)
    return Parts(made, last - first)


def show_sections(job_id: str, reader: ResultReader, selection: Selection, form: str) -> Response:
    """Return channels at the Poincare sections of a run, in a window of time."""
    names = chosen_channels(selection.channels, reader.channels)
    time, _ = reader.sections([])
    shown = inside(time, *selection.checked())
    if shown.any():
        check_size(int(shown.sum()), len(names) + 1, "sections", float(np.ptp(time[shown])))
    _, columns = reader.sections(names)
    sections = schemas.Poincare.model_construct(
        complete=reader.complete,
        time=schemas.Series.of(TIME, values=time[shown]),
        channels=series(reader, {name: column[shown] for name, column in columns.items()}),
        note=str(reader.attributes.get("section_note", "")),
    )
    return _shown_as(form, f"{job_id}-poincare", sections)


@router.get("/peaks", response_model=schemas.Peaks)
def show_peaks(exact: ExactReaderOfThePath, window: Annotated[Window, Query()]) -> Response:
    """Return each channel's signed minimum and maximum, with their times.

    Of a window, and of a running job as far as it is, they are computed from the steps of the run.
    """
    reader, (start, stop) = exact.reader, window.checked()
    described = by_name(reader.channels)
    peaks = reader.peaks()
    if (start, stop) != (None, None) or (not reader.sealed and reader.samples):
        peaks = exact.peaks(start, stop)
    found = {
        name: schemas.Peak.model_construct(unit=described[name].unit, **vars(peak))
        for name, peak in peaks.items()
    }
    return as_json(schemas.Peaks.model_construct(complete=reader.complete, peaks=found))


@router.get("/statistics")
def show_statistics(reader: ReaderOfThePath) -> schemas.Statistics:
    """Return the steps that the run took, its energy ledger with the residual, and notes."""
    summary = reader.attributes.get("summary") or {}
    notes = reader.attributes.get("notes", [])
    return schemas.Statistics(complete=reader.complete, notes=notes, **summary)


@router.get("/certificate", response_model=Certificate)
def show_certificate(
    results: ResultsOfThePath, reader: ReaderOfThePath, query: Annotated[ChannelsQuery, Query()]
) -> Response:
    """Return how far the numbers can be believed: estimated errors, horizon, exponent, spread.

    It is made when the run ends; a job with `"certificate": false` has none.
    """
    job = results.job
    found = reader.certificate()
    if found is None and not reader.sealed:
        raise results.not_ready("its certificate is made when it ends")
    if found is None:
        raise RequestRefused(kinds.NO_RESULTS, f"Job {job.id} was computed without a certificate.")
    names = chosen_channels(query.channels, reader.channels)
    instants = len(found.arrays["time"].values)
    check_size(instants, len(names), "instants", float(job.spec["duration"]))
    return as_json(Certificate.model_validate(certificate_document(reader, found, names)))


@router.get("/impacts", response_model=schemas.Impacts)
def show_impacts(reader: ReaderOfThePath, window: Annotated[Window, Query()]) -> Response:
    """Return the contacts in the clearance joints whose onset is in a window of time."""
    rows = reader.impacts()
    rows = rows[inside(rows["onset"], *window.checked())]
    names = rows.dtype.names or ()
    if len(rows):
        seconds = float(np.ptp(rows["onset"]))
        check_size(len(rows), len(names), "impacts", seconds, of_channels=False)

    def shown(some: NDArray[Any]) -> list[schemas.Impact]:
        found = [dict(zip(names, row, strict=True)) for row in some.tolist()]
        return [
            schemas.Impact.model_construct(**one | {"joint": reader.joints[one["joint"]]})
            for one in found
        ]

    made = (shown(rows[at : at + _IMPACTS]) for at in range(0, len(rows), _IMPACTS))
    found: Any = Parts(made, rows.size * len(names), rows.nbytes)
    return as_json(schemas.Impacts.model_construct(complete=reader.complete, impacts=found))


def _overview(
    reader: ResultReader, names: list[str], first: int, last: int, points: int, note: str
) -> schemas.Overview:
    check_points(points, len(names))
    time, found = reader.extremes(names, first, last, points)
    pairs = [with_contact_peaks(reader, name, time, found[name]) for name in names]
    columns = np.stack(pairs, axis=1)
    return schemas.Overview.model_construct(
        complete=reader.complete,
        samples=last - first,
        bins=bins(time),
        extremes=extremes(reader, names, columns),
        exact=False,
        note=note,
        resolution=resolution(of_samples(reader.attributes["job"])),
    )


def _shown_as(form: str, name: str, answer: schemas.History | schemas.Overview) -> Response:
    """Return an answer as JSON, or its columns as a file of a name."""
    if form == JSON:
        return as_json(answer, VARY)
    if isinstance(answer, schemas.History):
        series = {"time": answer.time} | answer.channels
        shown = [(channel, one.unit, one.values, "") for channel, one in series.items()]
    else:
        bins = answer.bins
        shown = [("time", bins.unit, bins.first, "first"), ("time", bins.unit, bins.last, "last")]
        for channel, one in answer.extremes.items():
            shown.append((channel, one.unit, one.minimum, "minimum"))
            shown.append((channel, one.unit, one.maximum, "maximum"))
    columns = [
        FileColumn(channel, unit, np.array(values, np.float64), part)
        for channel, unit, values, part in shown
    ]
    return as_file(form, name, columns, complete=answer.complete)
