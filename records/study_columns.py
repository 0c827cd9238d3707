"""Columns of a study's tables: one row a point, and no two quantities under one name.

A parameter, or an output of the scene, may be called as one of our own columns, such as ``steps``
or ``status``. Its column is then ``parameter.steps``, or ``channel.status``, in every table.
"""

from collections.abc import Iterable, Sequence
from typing import Final

import numpy as np

from jointplay.records.attractors import attractors_of
from jointplay.records.channel import by_name
from jointplay.records.peak import PEAK
from jointplay.records.point import PointStatus
from jointplay.records.point_numbers import meanings_of
from jointplay.records.study import StudySource, directions_of
from jointplay.records.table_files.column import Column

_OWN: Final = frozenset(
    {"point", "direction", "status", "verdict", "reason", "attractor", "failure"}
    | {"section", "sections", "time", "extreme", "channel", "unit", *PEAK}
)
"""Columns, axes and indices of tables of studies, beside its numbers."""


def parameter_names(source: StudySource) -> list[str]:
    """Return what the columns of the parameters are called, in their order."""
    return _apart("parameter", [one.name for one in source.parameters], _own(source))


def channel_names(source: StudySource) -> dict[str, str]:
    """Return what the columns of observables and channels are called, by the names of these."""
    names = list(by_name((*source.observables, *source.channels)))
    taken = _own(source) | {*parameter_names(source)}
    return dict(zip(names, _apart("channel", names, taken), strict=True))


def _own(source: StudySource) -> frozenset[str]:
    return _OWN | source.indicators.keys() | source.statistics.keys()


def _apart(what: str, names: Iterable[str], taken: Iterable[str]) -> list[str]:
    """Return names, each that is taken with what it is before it."""
    known, found = {*taken}, []
    for name in names:
        own = name
        while own in known:
            own = f"{what}.{own}"
        known.add(own)
        found.append(own)
    return found


def point_columns(source: StudySource, channels: Sequence[str]) -> list[Column]:
    """Return all that there is of points: words, parameters, extremes of `channels`, numbers."""
    return [*words(source), *parameters(source), *results(source, channels)]


def words(source: StudySource) -> list[Column]:
    """Return status, verdict with its reason, attractor, and code of a failure of all points.

    Where a continuation goes both ways, the direction is the first of them. Words that a point does
    not have are empty.
    """
    directions = directions_of(source)
    found = {} if directions is None else {"direction": directions.tolist()}
    found["status"] = [PointStatus(code).name for code in source.status]
    if source.verdicts is not None:
        names = [*source.verdict_names, ""]
        found["verdict"] = [names[code] for code in source.verdicts]
        reasons = source.reasons
        found["reason"] = [reasons.get(point, "") for point in range(source.points)]
    if "states" in source.attributes:
        ends = attractors_of(source)
        named = {code: ends.name_of(code) for code in np.unique(ends.labels).tolist()}
        found["attractor"] = [named[code] for code in ends.labels.tolist()]
    codes = {point: failure.code for point, failure in source.failures.items()}
    found["failure"] = [codes.get(point, "") for point in range(source.points)]
    return [Column(name, "", np.array(column, np.str_)) for name, column in found.items()]


def parameters(source: StudySource) -> list[Column]:
    """Return the values of the points."""
    described = zip(parameter_names(source), source.parameters, source.values.T, strict=True)
    return [Column(name, one.unit, values) for name, one, values in described]


def results(source: StudySource, channels: Sequence[str]) -> list[Column]:
    """Return counts of sections, extremes of `channels` and their range, and numbers of points.

    The statistics of other channels are left out.
    """
    found = []
    if source.observables:
        found.append(Column("sections", "1", source.counts.astype(np.float64)))
    units = {one.name: one.unit for one in source.channels}
    for name in channels:
        peaks, unit = source.peaks(name), units[name]
        found += [
            Column(f"{name} minimum", unit, peaks.minimum),
            Column(f"{name} minimum at", "s", peaks.minimum_time),
            Column(f"{name} maximum", unit, peaks.maximum),
            Column(f"{name} maximum at", "s", peaks.maximum_time),
            Column(f"{name} range", unit, peaks.maximum - peaks.minimum),
        ]
    left_out = units.keys() - {*channels}
    return found + [one for one in numbers(source) if one.name.rpartition(".")[0] not in left_out]


def numbers(source: StudySource) -> list[Column]:
    """Return indicators and statistics; a verdict is one of the `words`."""
    meanings = meanings_of(source)
    found = {**source.indicators, **source.statistics}
    return [
        Column(name, meanings.get(name, ("1", ""))[0], np.asarray(values))
        for name, values in found.items()
        if name != "verdict"
    ]
