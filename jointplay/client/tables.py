"""Results as pandas tables; ``attrs["units"]`` of each has the units of its columns."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from jointplay.client.errors import NotFound
from jointplay.client.job_record import JobRecord
from jointplay.client.results import Results
from jointplay.client.stored import missing_extra
from jointplay.records.impact import IMPACT_UNITS
from jointplay.records.peak import PEAK
from jointplay.records.point import PointStatus
from jointplay.records.study import StudySource

if TYPE_CHECKING:
    import pandas as pd


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
        columns = {"time": found.time} | {name: found[name] for name in found.channels}
        return _table(columns, units).rename_axis("section")
    study = results.study(None, None, None)
    inside = np.arange(study.record) < study.counts[:, None]
    point, section = np.nonzero(inside)
    columns = {name: column[point] for name, column in _values(study).items()}
    columns["time"] = study.section_times()[inside]
    columns |= {one.name: study.sections(one.name)[inside] for one in study.observables}
    units = {one.name: one.unit for one in (*study.parameters, *study.observables)}
    return _table(columns, units | {"time": "s"}, {"point": point, "section": section})


def peaks(job: JobRecord, results: Results) -> "pd.DataFrame":
    """Return signed extremes with their times."""
    insist(job, "extremes", "peaks", "sweep")
    if not job.is_study:
        found = results.peaks()
        table: dict[str, Any] = {"unit": [peak.unit for peak in found.values()]}
        for name in PEAK:
            table[name] = np.array([getattr(peak, name) for peak in found.values()])
        return _table(table, {}, {"channel": list(found)})
    study = results.study(None, None, None)
    names = [channel.name for channel in study.channels]
    extremes = [study.peaks(name) for name in names]
    columns: dict[str, Any] = {
        name: np.repeat(column, len(names)) for name, column in _values(study).items()
    }
    columns["unit"] = [channel.unit for channel in study.channels] * study.points
    for name in PEAK:
        columns[name] = np.column_stack([getattr(one, name) for one in extremes]).ravel()
    index: dict[str, Any] = {
        "point": np.repeat(np.arange(study.points), len(names)),
        "channel": names * study.points,
    }
    return _table(columns, {one.name: one.unit for one in study.parameters}, index)


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
    columns: dict[str, Any] = {**_values(study)}
    columns["status"] = [PointStatus(code).name for code in study.status]
    failures = study.failures
    columns["failure"] = [
        failures[point].code if point in failures else "" for point in range(study.points)
    ]
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


def _table(
    columns: Mapping[str, Any],
    units: Mapping[str, str],
    index: Mapping[str, Any] | None = None,
) -> "pd.DataFrame":
    try:
        import pandas as pd
    except ImportError as error:
        raise missing_extra("tables", error) from error
    table = pd.DataFrame(dict(columns))
    if index is not None:
        levels = list(index.values())
        table.index = (
            pd.Index(levels[0], name=next(iter(index)))
            if len(levels) == 1
            else pd.MultiIndex.from_arrays(levels, names=list(index))
        )
    table.attrs["units"] = dict(units)
    return table
