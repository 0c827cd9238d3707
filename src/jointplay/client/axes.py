"""A study as an xarray dataset whose axes are its parameters."""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from jointplay.records.extremes import whole_peaks
from jointplay.records.point import PointStatus
from jointplay.records.point_numbers import meanings_of
from jointplay.records.study import BACKWARD, FORWARD, StudySource, directions_of
from jointplay.records.study_columns import channel_names, numbers, parameter_names

if TYPE_CHECKING:
    import xarray as xr

EXTREMES = ("minimum", "maximum")


def on_axes(study: StudySource) -> "xr.Dataset":
    """Return all that a study has of its points, over the axes of its parameters.

    A channel whose extremes were kept has the axis ``extreme`` besides, one that was taken at
    sections the axis ``section``.  Points that are no grid, such as a list of them, stay on one
    axis ``point`` with the parameters as coordinates; those of both directions of a continuation
    have the axis ``direction``.  What was not computed is NaN, and so are extremes of points that
    failed.
    """
    import xarray as xr

    axes, coordinates, order = _axes(study)
    shape = [len(coordinates[name][1]) for name in axes] if order is not None else [study.points]

    def laid_out(values: NDArray[Any]) -> NDArray[Any]:
        rows = values if order is None else values[order]
        return rows.reshape(*shape, *values.shape[1:])

    variables: dict[str, tuple[Any, ...]] = {}
    status = np.array([PointStatus(code).name for code in study.status])
    variables["status"] = (axes, laid_out(status))
    if study.verdicts is not None:
        names = np.array([*study.verdict_names, ""])
        variables["verdict"] = (axes, laid_out(names[study.verdicts]))
    meanings = meanings_of(study)
    for number in numbers(study):
        long_name = meanings.get(number.name, ("", ""))[1]
        told = {"units": number.unit, "long_name": long_name}
        variables[number.name] = (axes, laid_out(number.values), told)
    called = channel_names(study)
    for one in study.channels:
        peaks = whole_peaks(study, one.name)
        pair = np.stack([peaks.minimum, peaks.maximum], axis=1)
        variables[called[one.name]] = ([*axes, "extreme"], laid_out(pair), _told(one))
    if study.channels:
        coordinates["extreme"] = (["extreme"], np.array(EXTREMES), {})
    for one in study.observables:
        sections = laid_out(study.sections(one.name))
        variables[called[one.name]] = ([*axes, "section"], sections, _told(one))
    if study.observables:
        told = {"units": "1", "long_name": "sections that were recorded"}
        variables["sections"] = (axes, laid_out(study.counts), told)
        told = {"units": "s", "long_name": "time"}
        variables["time"] = ([*axes, "section"], laid_out(study.section_times()), told)
    return xr.Dataset(variables, coordinates)


def _axes(
    study: StudySource,
) -> tuple[list[str], dict[str, tuple[Any, ...]], NDArray[np.int64] | None]:
    """Return the axes, their coordinates, and the points in their order; None: no grid."""
    names = parameter_names(study)
    found = [np.unique(column, return_inverse=True) for column in study.values.T]
    sizes = [len(values) for values, _ in found]
    cells = int(np.prod(sizes)) if sizes else 0
    told = dict(zip(names, map(_told, study.parameters), strict=True))
    turns = 1 if directions_of(study) is None else 2
    if cells and study.points == turns * cells:
        indices = np.ravel_multi_index([inverse for _, inverse in found], sizes)
        order = np.lexsort((np.arange(study.points), indices))
        if np.array_equal(np.bincount(indices, minlength=cells), np.full(cells, turns)):
            coordinates: dict[str, tuple[Any, ...]] = {
                name: ([name], values, told[name])
                for name, (values, _) in zip(names, found, strict=True)
            }
            if turns == 1:
                return names, coordinates, order
            directions = np.array([FORWARD, BACKWARD])
            coordinates["direction"] = (["direction"], directions, {})
            return [*names, "direction"], coordinates, order
    coordinates = {"point": (["point"], np.arange(study.points), {})}
    for name, column in zip(names, study.values.T, strict=True):
        coordinates[name] = (["point"], column, told[name])
    return ["point"], coordinates, None


def _told(one: Any) -> dict[str, str]:
    return {"units": one.unit, "long_name": one.long_name}
