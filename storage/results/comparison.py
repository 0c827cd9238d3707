"""Two stores of one job against each other: array by array, bit by bit."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import product
from typing import Any, Final

import numpy as np
import zarr
from numpy.typing import NDArray

from jointplay.storage.results.certificate_group import CERTIFICATE
from jointplay.storage.results.pyramid import GROUP

MEASURED: Final = "statistics/seconds"
"""Array of times that were measured, which no repetition repeats."""
_COST: Final = "solver_seconds"
_OF_THE_PROGRAM: Final = ("solver_version", "layout")
"""Attributes that another version of the solver changes, whatever it computes."""


@dataclass(frozen=True)
class Compared:
    """One array of two stores; where they differ, the first such index and the largest distance."""

    name: str
    values: int
    differing: int = 0
    """Values with other bits; all of them where the arrays have other shapes, or one is missing."""
    first: tuple[int, ...] | None = None
    """Index of the first value with other bits, and the value in either store."""
    stored: float | None = None
    again: float | None = None
    largest: float | None = None
    """Largest absolute difference where both are finite, in the array's unit."""


def compared_arrays(stored: zarr.Group, again: zarr.Group) -> Iterator[Compared]:
    """Compare all arrays but measured times, and the pyramid, which follows from the others.

    Memory is bounded by a file of an array.
    """
    ours, theirs = _arrays(again), _arrays(stored)
    for name in sorted(theirs.keys() | ours.keys()):
        one, other = theirs.get(name), ours.get(name)
        if one is None or other is None or (one.shape, one.dtype) != (other.shape, other.dtype):
            values = max(found.size for found in (one, other) if found is not None)
            yield Compared(name, values, values)
        else:
            yield _compared(name, one, other)


def differing_attributes(stored: zarr.Group, again: zarr.Group) -> list[str]:
    """Name the attributes of the root, and of a certificate, that differ."""
    found = _different("", _facts(stored.attrs), _facts(again.attrs))
    groups = [group.get(CERTIFICATE) for group in (stored, again)]
    attributes = [dict(one.attrs) if isinstance(one, zarr.Group) else {} for one in groups]
    return found + _different(f"{CERTIFICATE}/", *attributes)


def _arrays(root: zarr.Group) -> dict[str, zarr.Array[Any]]:
    return {
        name: one
        for name, one in root.members(max_depth=None)
        if isinstance(one, zarr.Array) and name != MEASURED and not name.startswith(f"{GROUP}/")
    }


def compared_values(name: str, stored: NDArray[Any], again: NDArray[Any]) -> Compared:
    """Compare arrays in memory."""
    if (stored.shape, stored.dtype) != (again.shape, again.dtype):
        most = max(stored.size, again.size)
        return Compared(name, most, most)
    indices = np.argwhere(_bits(stored) != _bits(again))
    if not len(indices):
        return Compared(name, stored.size)
    first = tuple(indices[0].tolist())
    with np.errstate(invalid="ignore"):  # of infinities
        distance = np.abs(stored.astype(np.float64) - again.astype(np.float64))
    return Compared(
        name,
        stored.size,
        len(indices),
        first,
        float(stored[first]),
        float(again[first]),
        float(distance[np.isfinite(distance)].max(initial=0.0)),
    )


def _compared(name: str, stored: zarr.Array[Any], again: zarr.Array[Any]) -> Compared:
    """Compare arrays file by file."""
    found = Compared(name, stored.size)
    for window in _windows(stored):
        part = compared_values(name, np.asarray(stored[window]), np.asarray(again[window]))
        if part.first is None:
            continue
        at = tuple(side.start + index for side, index in zip(window, part.first, strict=True))
        if found.first is None or at < found.first:
            found = replace(found, first=at, stored=part.stored, again=part.again)
        found = replace(
            found,
            differing=found.differing + part.differing,
            largest=max(found.largest or 0.0, part.largest or 0.0),
        )
    return found


def _windows(array: zarr.Array[Any]) -> Iterator[tuple[slice, ...]]:
    """Yield the parts of an array that are in one file each."""
    steps = array.shards or array.chunks
    sizes = zip(array.shape, steps, strict=True)
    starts = [range(0, length, step) for length, step in sizes]
    for corner in product(*starts):
        yield tuple(
            slice(begin, min(begin + step, length))
            for begin, step, length in zip(corner, steps, array.shape, strict=True)
        )


def _bits(values: NDArray[Any]) -> NDArray[Any]:
    """Return values as integers: NaN equals itself, and zero not minus zero."""
    return values.view(f"u{values.dtype.itemsize}")


def _facts(attributes: Mapping[str, Any]) -> dict[str, Any]:
    found = {name: one for name, one in attributes.items() if name not in _OF_THE_PROGRAM}
    if isinstance(summary := found.get("summary"), Mapping):
        found["summary"] = {name: one for name, one in summary.items() if name != _COST}
    return found


def _different(where: str, stored: Mapping[str, Any], again: Mapping[str, Any]) -> list[str]:
    names = sorted(stored.keys() | again.keys())
    return [f"{where}{name}" for name in names if stored.get(name) != again.get(name)]
