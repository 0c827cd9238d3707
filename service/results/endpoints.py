"""``/v1/jobs/{id}/history`` and its siblings: numbers that a job has computed."""

from collections.abc import Mapping
from typing import Annotated, Any

import numpy as np
from fastapi import APIRouter, Query, Response
from numpy.typing import NDArray

from jointplay.records.certificate import certificate_document
from jointplay.service.dependencies import (
    NO_PARAMETERS,
    CatalogueDependency,
    JobOfThePath,
    SettingsDependency,
)
from jointplay.service.jobs.results_of_kinds import insist, is_study
from jointplay.service.problems import RequestRefused, kinds, problems
from jointplay.service.results import schemas
from jointplay.service.results.as_json import as_json
from jointplay.service.results.certificate_schema import Certificate
from jointplay.service.results.negotiation import JSON, Form
from jointplay.service.results.queries import (
    ChannelsQuery,
    HistoryQuery,
    Selection,
    Window,
    check_points,
    check_size,
    chosen_channels,
)
from jointplay.service.results.stores import StoreOfThePath, not_ready, open_store, open_study
from jointplay.service.results.tables import AS_FILES, Column, as_file
from jointplay.service.studies.answers import sections
from jointplay.service.studies.queries import PoincareQuery
from jointplay.service.studies.schemas import Sections
from jointplay.storage.catalogue import Job
from jointplay.storage.results import ResultReader

router = APIRouter(
    prefix="/v1/jobs/{job_id}",
    tags=["results"],
    responses=problems(
        kinds.UNKNOWN_JOB,
        kinds.EXPIRED_JOB,
        kinds.WRONG_KIND,
        kinds.NO_RESULTS,
        kinds.RESULTS_NOT_READY,
        kinds.INVALID_REQUEST,
        kinds.UNKNOWN_CHANNEL,
        kinds.RESPONSE_TOO_LARGE,
    ),
)
Floats = NDArray[np.float64]


@router.get(
    "/history",
    response_model=schemas.History | schemas.Overview,
    responses=AS_FILES | problems(kinds.NOT_ACCEPTABLE),
)
def show_history(
    job: JobOfThePath,
    store: StoreOfThePath,
    query: Annotated[HistoryQuery, Query()],
    form: Form,
) -> Response:
    """Return channels on the output grid, in a window of time; of a running job as far as it is.

    With `points`, smallest and largest values of that many groups of samples, so that no peak is
    lost.  Accept chooses JSON, CSV, NPZ or a MATLAB file.
    """
    start, stop = query.checked()
    names = chosen_channels(query.channels, _names(store))
    first, last = store.between(start, stop)
    if query.points is not None and last - first > query.points:
        return _overview(job, store, names, (first, last, query.points), form)
    if last > first:
        ends = store.history([], first, first + 1)[0], store.history([], last - 1, last)[0]
        seconds = float(ends[1][0] - ends[0][0])
        check_size(last - first, len(names) + 1, "samples", seconds)
    time, columns = store.history(names, first, last)
    if form != JSON:
        return _file(job, store, "history", form, {"time": time, **columns})
    return as_json(
        schemas.History.model_construct(
            complete=store.complete, time=_time(time), channels=_series(store, columns)
        )
    )


@router.get(
    "/poincare",
    response_model=schemas.Poincare | Sections,
    responses=AS_FILES | problems(kinds.NOT_ACCEPTABLE),
)
def show_poincare(
    job: JobOfThePath,
    settings: SettingsDependency,
    catalogue: CatalogueDependency,
    query: Annotated[PoincareQuery, Query()],
    form: Form,
) -> Response:
    """Return channels at the Poincare sections.

    Of a simulation: once in every period, in a window of time.  Of a study: at the sections that
    each of its points has recorded so far; start and stop are a range of points.  Accept chooses
    JSON, or of a simulation CSV, NPZ or a MATLAB file.
    """
    insist(job, "poincare")
    if is_study(job):
        if form != JSON:
            raise RequestRefused(
                kinds.NOT_ACCEPTABLE, f"Sections of a study are there as {JSON} and as Zarr."
            )
        study = open_study(job, settings)
        return as_json(sections(study, query.range_of_points(), query.channels))
    store = open_store(job, settings, catalogue)
    found = _poincare(store, query.window_of_time())
    if form != JSON:
        columns = {"time": found.time.values, **{k: v.values for k, v in found.channels.items()}}
        return _file(job, store, "poincare", form, columns)
    return as_json(found)


@router.get("/peaks", response_model=schemas.Peaks, dependencies=[NO_PARAMETERS])
def show_peaks(store: StoreOfThePath) -> Response:
    """Return each channel's signed minimum and maximum, with their times."""
    units = {channel.name: channel.unit for channel in store.channels}
    peaks = {
        name: schemas.Peak.model_construct(unit=units[name], **vars(peak))
        for name, peak in store.peaks().items()
    }
    return as_json(schemas.Peaks.model_construct(complete=store.complete, peaks=peaks))


@router.get("/statistics", dependencies=[NO_PARAMETERS])
def show_statistics(store: StoreOfThePath) -> schemas.Statistics:
    """Return the steps that the run took, and its energy ledger with the residual."""
    summary = store.attributes.get("summary") or {}
    return schemas.Statistics(complete=store.complete, **summary)


@router.get("/certificate", response_model=Certificate)
def show_certificate(
    job: JobOfThePath, store: StoreOfThePath, query: Annotated[ChannelsQuery, Query()]
) -> Response:
    """Return how far the numbers can be believed: estimated errors, horizon, exponent, spread.

    It is made when the run ends; a job with `"certificate": false` has none.
    """
    found = store.certificate()
    if found is None and not store.sealed:
        raise not_ready(job, "its certificate is made when it ends")
    if found is None:
        raise RequestRefused(kinds.NO_RESULTS, f"Job {job.id} was computed without a certificate.")
    names = chosen_channels(query.channels, _names(store))
    instants = len(found.arrays["time"].values)
    check_size(instants, len(names), "instants", float(job.spec["duration"]))
    return as_json(Certificate.model_validate(certificate_document(store, found, names)))


@router.get("/impacts", response_model=schemas.Impacts)
def show_impacts(store: StoreOfThePath, window: Annotated[Window, Query()]) -> Response:
    """Return the contacts in the clearance joints whose onset is in a window of time."""
    start, stop = window.checked()
    rows = store.impacts()
    rows = rows[_inside(rows["onset"], start, stop)]
    if len(rows):
        check_size(len(rows), len(rows.dtype.names or ()), "impacts", float(np.ptp(rows["onset"])))
    names = rows.dtype.names or ()
    impacts = []
    for row in rows.tolist():
        values = dict(zip(names, row, strict=True))
        values["joint"] = store.joints[values["joint"]]
        impacts.append(schemas.Impact.model_construct(**values))
    return as_json(schemas.Impacts.model_construct(complete=store.complete, impacts=impacts))


def _overview(
    job: Job, store: ResultReader, names: list[str], window: tuple[int, int, int], form: str
) -> Response:
    """Return extremes of a window (first, last, points) of samples."""
    first, last, points = window
    check_points(points, len(names))
    time, found = store.extremes(names, first, last, points)
    described = {channel.name: channel for channel in store.channels}
    if form != JSON:
        columns = [
            Column("time", "s", time[:, 0], "first"),
            Column("time", "s", time[:, 1], "last"),
        ]
        for name, pairs in found.items():
            unit = described[name].unit
            columns.append(Column(name, unit, pairs[:, 0], "minimum"))
            columns.append(Column(name, unit, pairs[:, 1], "maximum"))
        return as_file(form, f"{job.id}-history", columns, complete=store.complete)
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
    return as_json(
        schemas.Overview.model_construct(
            complete=store.complete, samples=last - first, bins=bins, extremes=extremes
        )
    )


def _file(
    job: Job, store: ResultReader, what: str, form: str, columns: Mapping[str, Any]
) -> Response:
    units = {channel.name: channel.unit for channel in store.channels} | {"time": "s"}
    table = [
        Column(name, units[name], np.asarray(values, dtype=np.float64))
        for name, values in columns.items()
    ]
    return as_file(form, f"{job.id}-{what}", table, complete=store.complete)


def _poincare(store: ResultReader, selection: Selection) -> schemas.Poincare:
    start, stop = selection.checked()
    names = chosen_channels(selection.channels, _names(store))
    time = store.sections([])[0]
    inside = _inside(time, start, stop)
    if inside.any():
        check_size(int(inside.sum()), len(names) + 1, "sections", float(np.ptp(time[inside])))
    columns = {name: column[inside] for name, column in store.sections(names)[1].items()}
    return schemas.Poincare.model_construct(
        complete=store.complete,
        time=_time(time[inside]),
        channels=_series(store, columns),
        note=str(store.attributes.get("section_note", "")),
    )


def _names(store: ResultReader) -> list[str]:
    return [channel.name for channel in store.channels]


def _inside(time: Floats, start: float | None, stop: float | None) -> NDArray[np.bool_]:
    low = -np.inf if start is None else start
    high = np.inf if stop is None else stop
    return (time >= low) & (time <= high)


def _time(time: Floats) -> schemas.Series:
    return schemas.Series.model_construct(unit="s", long_name="time", values=time.tolist())


def _series(store: ResultReader, columns: dict[str, Floats]) -> dict[str, schemas.Series]:
    described = {channel.name: channel for channel in store.channels}
    return {
        name: schemas.Series.model_construct(
            unit=described[name].unit,
            long_name=described[name].long_name,
            values=column.tolist(),
        )
        for name, column in columns.items()
    }
