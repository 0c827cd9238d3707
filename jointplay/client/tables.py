"""Results as pandas tables and xarray datasets.

``attrs["units"]`` of each table has the units of its columns.
"""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from jointplay.client.errors import MissingExtra, NotFound, ResultsNotReady
from jointplay.client.job_record import JobRecord
from jointplay.client.results import Results, Store
from jointplay.records.impact import IMPACT_UNITS
from jointplay.records.peak import PEAK
from jointplay.records.point import PointStatus
from jointplay.records.study import StudySource

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr


def insist(job: JobRecord, what: str, *results: str) -> None:
    """Raise `NotFound` if jobs of this kind have none of these results."""
    if not job.links.keys() & {*results}:
        sentence = f"Job {job.id} is of kind {job.kind} and has no {what}."
        raise NotFound(sentence, problem="wrong-kind")


def insist_on_points(job: JobRecord) -> None:
    """Raise `NotFound` if jobs of this kind have no points with values."""
    insist(job, "points", *(("sweep", "poincare") if job.is_study else ()))


def sections(job: JobRecord, results: Results) -> "pd.DataFrame":
    """Return channels at the Poincare sections."""
    insist(job, "sections", "poincare")
    if not job.is_study:
        found = results.sections(None)
        units = {"time": "s"} | {name: one.unit for name, one in found.channels.items()}
        table = {"time": found.time} | {name: found[name] for name in found.channels}
        return _table(table, units).rename_axis("section")
    study = results.study(None, None, None)
    inside = np.arange(study.record) < study.counts[:, None]
    point, section = np.nonzero(inside)
    columns: dict[str, Any] = {"point": point, "section": section}
    columns |= {name: column[point] for name, column in _values(study).items()}
    columns["time"] = study.section_times()[inside]
    columns |= {one.name: study.sections(one.name)[inside] for one in study.observables}
    units = {one.name: one.unit for one in (*study.parameters, *study.observables)}
    return _table(columns, units | {"time": "s"}, "point", "section")


def peaks(job: JobRecord, results: Results) -> "pd.DataFrame":
    """Return signed extremes with their times."""
    insist(job, "extremes", "peaks", "sweep")
    if not job.is_study:
        found = results.peaks()
        every = found.values()
        table: dict[str, Any] = {"channel": list(found), "unit": [peak.unit for peak in every]}
        table |= {name: np.array([getattr(peak, name) for peak in every]) for name in PEAK}
        return _table(table, {}, "channel")
    study = results.study(None, None, None)
    names = [channel.name for channel in study.channels]
    extremes = [study.peaks(name) for name in names]
    columns: dict[str, Any] = {
        "point": np.repeat(np.arange(study.points), len(names)),
        "channel": names * study.points,
    }
    columns |= {name: np.repeat(column, len(names)) for name, column in _values(study).items()}
    columns["unit"] = [channel.unit for channel in study.channels] * study.points
    for name in PEAK:
        columns[name] = np.column_stack([getattr(one, name) for one in extremes]).ravel()
    units = {one.name: one.unit for one in study.parameters}
    return _table(columns, units, "point", "channel")


def impacts(job: JobRecord, results: Results) -> "pd.DataFrame":
    """Return the contacts of the clearance joints."""
    insist(job, "impacts", "impacts")
    found = results.impacts()
    columns = {name: getattr(found, name) for name in ("joint", *IMPACT_UNITS)}
    return _table(columns, IMPACT_UNITS).rename_axis("impact")


def points(job: JobRecord, results: Results) -> "pd.DataFrame":
    """Return what has one value a point."""
    insist_on_points(job)
    # one section of each: they are not in this table
    study = results.study(None, None, None if "sweep" in job.links else (0, 1))
    columns = _values(study)
    columns["status"] = [PointStatus(code).name for code in study.status]
    codes = {point: failure.code for point, failure in study.failures.items()}
    columns["failure"] = [codes.get(point, "") for point in range(study.points)]
    if study.verdicts is not None:
        names = [*study.verdict_names, None]
        columns["verdict"] = [names[code] for code in study.verdicts]
    numbers = {**study.indicators, **study.statistics}
    columns |= {name: one for name, one in numbers.items() if name != "verdict"}
    units = {one.name: one.unit for one in study.parameters}
    units |= {name: unit for name, (unit, _) in study.attributes.get("meanings", {}).items()}
    return _table(columns, units).rename_axis("point")


def _values(study: StudySource) -> dict[str, Any]:
    return {one.name: study.values[:, column] for column, one in enumerate(study.parameters)}


def _table(columns: Mapping[str, Any], units: Mapping[str, str], *index: str) -> "pd.DataFrame":
    try:
        import pandas as pd
    except ImportError as error:
        raise _missing_extra("tables", error) from error
    table = pd.DataFrame(dict(columns))
    if index:
        table = table.set_index(list(index))
    table.attrs["units"] = dict(units)
    return table


def open_group(job: JobRecord, store: Store, group: str) -> "xr.Dataset":
    """Open a group of a job's store with xarray; values are read when they are used.

    `MissingExtra` if xarray is not installed, or what it needs to read over HTTP; `NotFound` if
    the job has no such group, or `ResultsNotReady` if it has committed nothing yet.
    """
    try:
        import xarray as xr
        from zarr.storage import ZipStore

        local = store.options is None
        found: xr.Dataset = xr.open_zarr(
            ZipStore(store.address, mode="r") if local else store.address,
            group=group or None,
            chunks=None,  # lazy by itself, without dask
            storage_options=store.options,
        )
    except ImportError as error:
        raise _missing_extra("stored arrays", error) from error
    except (FileNotFoundError, KeyError) as error:  # of a group: no such key in the metadata
        if not job.is_finished:
            sentence = f"Job {job.id} is {job.state} and has committed nothing yet."
            raise ResultsNotReady(sentence) from error
        what = f"no group {group!r}" if group else "no results"
        sentence = f"Job {job.id} is {job.state} and has {what}."
        raise NotFound(sentence) from error
    return found


def _missing_extra(what: str, error: ImportError) -> MissingExtra:
    """Say what to install."""
    return MissingExtra(f"{what} need an extra: pip install 'jointplay[xarray]' ({error}).")
