"""Two runs of one job against the error bars of their certificates."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import zarr

from jointplay.client.errors import NotFound
from jointplay.client.job import Job
from jointplay.records.names import TIME
from jointplay.records.run import Floats
from jointplay.storage.results.comparison import Compared


def beyond_bars(
    jobs: Sequence[Job], roots: Sequence[zarr.Group], arrays: Sequence[Compared]
) -> tuple[str, ...] | None:
    """Name the channels of two runs that are farther apart than both bars where both converged.

    None where nothing differs, or there are no bars: of studies, and of motions that are exact.
    """
    differing = [one.name for one in arrays if one.differing]
    try:
        certificates = [one.certificate for one in jobs] if differing else []
    except NotFound:
        return None
    if not certificates or not all(one["time"]["values"] for one in certificates):
        return None
    time = np.asarray(roots[0][TIME])
    return tuple(
        name
        for name in differing
        if name in certificates[0]["channels"]
        and _exceeds(name, time, [np.asarray(one[name]) for one in roots], certificates)
    )


def _exceeds(
    name: str, time: Floats, values: Sequence[Floats], certificates: Sequence[Mapping[str, Any]]
) -> bool:
    if values[0].shape != values[1].shape:
        return True
    bars = np.zeros(len(time))
    for one in certificates:
        error = [math.nan if e is None else e for e in one["channels"][name]["error"]]
        bars += np.interp(time, one["time"]["values"], error)
    return bool(np.any(np.abs(values[0] - values[1]) > bars))  # false where a bar is NaN
