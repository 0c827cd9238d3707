"""Findings of a calibration, against those of its repetition."""

from collections.abc import Iterator, Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from jointplay.storage.results.comparison import Compared, compared_values

_NOT_COMPARED: Final = ("solver", "misfits")
"""The solver's version; and what follows from all else, and is not in older files."""


def compared_findings(
    stored: Mapping[str, Any], again: Mapping[str, Any]
) -> tuple[tuple[Compared, ...], tuple[str, ...]]:
    """Compare what two calibrations found: tables of numbers as arrays, all else by name."""
    arrays: list[Compared] = []
    others: list[str] = []
    results = [
        {key: one[key] for key in one if key not in _NOT_COMPARED} for one in (stored, again)
    ]
    for path, one, other in _leaves("", *results):
        if all(isinstance(leaf, np.ndarray) for leaf in (one, other)):
            arrays.append(compared_values(path, one, other))
        elif one != other:
            others.append(path)
    return tuple(arrays), tuple(others)


def _leaves(path: str, stored: Any, again: Any) -> Iterator[tuple[str, Any, Any]]:
    """Yield by path tables of numbers, as arrays, and whatever is not made of others."""
    tables = _table(stored), _table(again)
    if all(one is not None for one in tables):
        yield path, *tables
        return
    pairs = [dict(enumerate(one)) if isinstance(one, list) else one for one in (stored, again)]
    if not all(isinstance(one, Mapping) for one in pairs):
        yield path, stored, again
        return
    for key in dict.fromkeys([*pairs[0], *pairs[1]]):
        yield from _leaves(f"{path}/{key}".lstrip("/"), *(one.get(key) for one in pairs))


def _table(value: Any) -> NDArray[np.float64] | None:
    """Return a number, or nested lists of numbers, as an array; None of anything else."""
    if isinstance(value, bool | str) or value is None:
        return None
    try:
        return np.asarray(value, np.float64)
    except (TypeError, ValueError):
        return None
