"""``/v1/jobs/{id}/history`` and its siblings: numbers that a job has computed."""

from typing import Annotated

import numpy as np
from fastapi import APIRouter, Query, Response
from numpy.typing import NDArray

from service.dependencies import (
    NO_PARAMETERS,
    CatalogueDependency,
    JobOfThePath,
    SettingsDependency,
)
from service.jobs.results_of_kinds import insist, is_study
from service.problems import kinds, problems
from service.results import schemas
from service.results.as_json import as_json
from service.results.queries import Selection, Window, check_size, chosen_channels
from service.results.stores import StoreOfThePath, open_store, open_study
from service.studies.answers import sections
from service.studies.queries import PoincareQuery
from service.studies.schemas import Sections
from storage.results import ResultReader

router = APIRouter(
    prefix="/v1/jobs/{job_id}",
    tags=["results"],
    responses=problems(
        kinds.UNKNOWN_JOB,
        kinds.WRONG_KIND,
        kinds.NO_RESULTS,
        kinds.RESULTS_NOT_READY,
        kinds.INVALID_REQUEST,
        kinds.UNKNOWN_CHANNEL,
        kinds.RESPONSE_TOO_LARGE,
    ),
)
Floats = NDArray[np.float64]


@router.get("/history", response_model=schemas.History)
def show_history(store: StoreOfThePath, selection: Annotated[Selection, Query()]) -> Response:
    """Return channels on the output grid, in a window of time."""
    start, stop = selection.checked()
    names = chosen_channels(selection.channels, _names(store))
    first, last = store.between(start, stop)
    if last > first:
        ends = store.history([], first, first + 1)[0], store.history([], last - 1, last)[0]
        seconds = float(ends[1][0] - ends[0][0])
        check_size(last - first, len(names) + 1, "samples", seconds)
    time, columns = store.history(names, first, last)
    return as_json(
        schemas.History.model_construct(
            complete=store.complete, time=_time(time), channels=_series(store, columns)
        )
    )


@router.get("/poincare", response_model=schemas.Poincare | Sections)
def show_poincare(
    job: JobOfThePath,
    settings: SettingsDependency,
    catalogue: CatalogueDependency,
    query: Annotated[PoincareQuery, Query()],
) -> Response:
    """Return channels at the Poincare sections.

    Of a simulation: once in every period, in a window of time.  Of a study: at the sections that
    each of its points has recorded so far; start and stop are a range of points.
    """
    insist(job, "poincare")
    if is_study(job):
        study = open_study(job, settings)
        return as_json(sections(study, query.range_of_points(), query.channels))
    return as_json(_poincare(open_store(job, settings, catalogue), query.window_of_time()))


@router.get("/peaks", response_model=schemas.Peaks, dependencies=[NO_PARAMETERS])
def show_peaks(store: StoreOfThePath) -> Response:
    """Return each channel's signed minimum and maximum, with their times."""
    units = {channel.name: channel.unit for channel in store.channels}
    peaks = {
        name: schemas.Peak.model_construct(unit=units[name], **peak._asdict())
        for name, peak in store.peaks().items()
    }
    return as_json(schemas.Peaks.model_construct(complete=store.complete, peaks=peaks))


@router.get("/statistics", dependencies=[NO_PARAMETERS])
def show_statistics(store: StoreOfThePath) -> schemas.Statistics:
    """Return the steps that the run took, and its energy ledger with the residual."""
    summary = store.attributes.get("summary") or {}
    return schemas.Statistics(complete=store.complete, **summary)


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
