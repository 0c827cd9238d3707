"""Results as pandas tables and xarray datasets.

``attrs["units"]`` of each table has the units of its columns.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from jointplay.client.errors import MissingExtra, NotFound, ResultsNotReady
from jointplay.client.job_record import JobRecord, read_job
from jointplay.client.results import Results, Store
from jointplay.job_fields import KINDS
from jointplay.records.impact import IMPACT_UNITS
from jointplay.records.kinds_with import kinds_with
from jointplay.records.peak import PEAK
from jointplay.records.point import PointStatus
from jointplay.records.study import StudySource, directions_of
from jointplay.records.study_columns import channel_names, numbers, parameters, words
from jointplay.records.table_files import Column

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr


class TabledJob(JobRecord, ABC):
    """A job's record with its results as pandas tables and xarray datasets."""

    def __init__(self, document: Mapping[str, Any]) -> None:
        super().__init__(**read_job(document))
        self._opened: dict[str, xr.Dataset] = {}

    @cached_property
    def results(self) -> Results:
        """The results as plain numbers, without pandas and xarray."""
        return self._open_results()

    @abstractmethod
    def _open_results(self) -> Results:
        """Return the way to the results."""

    @property
    def history(self) -> "xr.Dataset":
        """All channels of a simulation over ``time``, read from the store as they are used."""
        self._insist("history", "history")
        if "time" not in self._opened:
            found = self.open().swap_dims(sample="time")
            if not self.is_finished:
                return found
            self._opened["time"] = found
        return self._opened["time"]

    @property
    def dataset(self) -> "xr.Dataset":
        """All that a study has of its points, over the axes of its parameters.

        ``job.dataset["A.normal_force"].sel(extreme="maximum")`` of a sweep has the axes that were
        swept; of a diagram ``job.dataset["A.eccentricity_x"]`` has ``section`` besides.
        """
        from jointplay.client.axes import on_axes

        self._insist_on_points("dataset")
        study = self.results.study(None, None, None)
        try:
            return on_axes(study)
        except ImportError as error:
            raise _missing_extra("datasets", error) from error

    def open(self, group: str = "") -> "xr.Dataset":
        """Open a group of the job's Zarr store, lazily; by default the root.

        Groups of a simulation are ``poincare``, ``impacts`` and ``peaks``, of a study ``values``,
        ``statistics``, ``indicators``, ``sections`` and ``peaks``.  Attributes that are no text or
        numbers, such as ``job``, are JSON text, so that `to_netcdf` takes them.
        """
        if group in self._opened:
            return self._opened[group]
        final = self.is_finished
        found = self._open(self.results.store(), group)
        if final:
            self._opened[group] = found
        return found

    @property
    def poincare(self) -> "pd.DataFrame":
        """The Poincare sections: ``time`` and channels of each.

        Of a study one row for each section of each point, with the values of the parameters.
        """
        self._insist("sections", "poincare")
        if not self.is_study:
            found = self.results.sections(None)
            units = {"time": "s"} | {name: one.unit for name, one in found.channels.items()}
            table = {"time": found.time} | {name: found[name] for name in found.channels}
            return _table(table, units).rename_axis("section")
        study = self.results.study(None, None, None)
        inside = np.arange(study.record) < study.counts[:, None]
        point, section = np.nonzero(inside)
        columns: dict[str, Any] = {"point": point, "section": section}
        given, called = _given(study), channel_names(study)
        columns |= {one.name: one.values[point] for one in given}
        columns["time"] = study.section_times()[inside]
        for one in study.observables:
            columns[called[one.name]] = study.sections(one.name)[inside]
        units = {called[one.name]: one.unit for one in study.observables} | _units(given)
        return _table(columns, units | {"time": "s"}, "point", "section")

    @property
    def peaks(self) -> "pd.DataFrame":
        """Signed extremes with their times, one row a channel; of a sweep of each point.

        A point whose ``status`` is failed has those of what it had computed.
        """
        self._insist("extremes", "peaks", "points")
        if not self.is_study:
            found = self.results.peaks()
            every = found.values()
            table: dict[str, Any] = {"channel": list(found), "unit": [peak.unit for peak in every]}
            table |= {name: np.array([getattr(peak, name) for peak in every]) for name in PEAK}
            return _table(table, {}, "channel")
        study = self.results.study(None, None, (0, 1))
        names = [channel.name for channel in study.channels]
        if not names:
            self._insist("extremes")
        extremes = [study.peaks(name) for name in names]
        columns: dict[str, Any] = {
            "point": np.repeat(np.arange(study.points), len(names)),
            "channel": names * study.points,
        }
        given = _given(study)
        columns |= {one.name: np.repeat(one.values, len(names)) for one in given}
        status = [PointStatus(code).name for code in study.status]
        columns["status"] = np.repeat(status, len(names))
        columns["unit"] = [channel.unit for channel in study.channels] * study.points
        for name in PEAK:
            columns[name] = np.column_stack([getattr(one, name) for one in extremes]).ravel()
        return _table(columns, _units(given), "point", "channel")

    @property
    def impacts(self) -> "pd.DataFrame":
        """Contacts of a simulation in order of release, one row each."""
        self._insist("impacts", "impacts")
        found = self.results.impacts()
        columns = {name: getattr(found, name) for name in ("joint", *IMPACT_UNITS)}
        return _table(columns, IMPACT_UNITS).rename_axis("impact")

    @property
    def points(self) -> "pd.DataFrame":
        """Status, verdict and its reason, values, indicators, statistics: one row a point.

        A parameter that is called as another column, such as `steps`, is `parameter.steps`.
        """
        self._insist_on_points()
        # one section of each: they are not in this table
        study = self.results.study(None, None, (0, 1))
        found = [*words(study), *parameters(study)]
        if study.observables:
            found.append(Column("sections", "1", study.counts))
        found += numbers(study)
        columns: dict[str, Any] = {one.name: one.values for one in found}
        for name in ("verdict", "reason", "attractor"):
            if name in columns:
                columns[name] = [word or None for word in columns[name].tolist()]
        return _table(columns, _units(found)).rename_axis("point")

    def _insist(self, what: str, *results: str) -> None:
        """Raise `NotFound` if jobs of this kind have none of these results."""
        if not self.links.keys() & {*results}:
            others = kinds_with({name: one["results"] for name, one in KINDS.items()}, *results)
            sentence = f"Job {self.id} is of kind {self.kind} and has no {what}{others}."
            raise NotFound(sentence, problem="wrong-kind")

    def _insist_on_points(self, what: str = "points") -> None:
        self._insist(what, "points")

    def _open(self, store: Store, group: str) -> "xr.Dataset":
        from jointplay.client.attributes import in_netcdf

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
            if not self.is_finished:
                sentence = f"Job {self.id} is {self.state} and has committed nothing yet."
                raise ResultsNotReady(sentence) from error
            what = f"no group {group!r}" if group else "no results"
            sentence = f"Job {self.id} is {self.state} and has {what}."
            raise NotFound(sentence) from error
        return in_netcdf(found)


def _given(study: StudySource) -> list[Column]:
    """Return the direction, where there are two, and the parameters of each point."""
    directions = directions_of(study)
    words = [] if directions is None else [Column("direction", "", directions)]
    return [*words, *parameters(study)]


def _units(columns: Sequence[Column]) -> dict[str, str]:
    return {one.name: one.unit for one in columns if one.unit}


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


def _missing_extra(what: str, error: ImportError) -> MissingExtra:
    """Say what to install."""
    return MissingExtra(f"{what} need an extra: pip install 'jointplay[xarray]' ({error}).")
