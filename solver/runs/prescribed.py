"""Extremes of channels that drivers prescribe: functions of time alone, sought afterwards."""

import math
from collections.abc import Callable

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.peak import Peak
from jointplay.solver.kernels.emit.places import TIME
from jointplay.solver.kernels.loop.bundle import Bundle
from jointplay.solver.quantities.extremes import refine_extreme

INSTANTS_A_PERIOD = 720
MOST_INSTANTS = 200_000


def prescribed_peaks(
    bundle: Bundle, lane: int, names: list[str], reached: float
) -> dict[str, Peak]:
    """Return extremes of channels over 0..reached, s; a common period is looked at once."""
    kernel, at = bundle.kernel, bundle.lane(lane)
    period, common = float(at.run["period"]), bool(at.run["common"])
    span = min(reached, period) if common else reached
    columns = np.array([kernel.rows.index(name) for name in names], dtype=np.int64)

    def every(times: Floats) -> Floats:
        rows = np.zeros((len(times), kernel.row.width))
        rows[:, TIME] = times
        rows[:, kernel.row.phase : kernel.row.wound] = at["driver_start"]
        return bundle.observe(lane, rows, columns)

    def only(column: int) -> Callable[[Floats], Floats]:
        return lambda instants: every(instants)[:, column]

    count = min(math.ceil(INSTANTS_A_PERIOD * span / period) + 16, MOST_INSTANTS)
    times = np.linspace(0.0, span, count)
    values = every(times)
    found = {}
    for c, name in enumerate(names):
        column = values[:, c]
        if column.min() == column.max():
            found[name] = Peak(float(column[0]), 0.0, float(column[0]), 0.0)
            continue
        low_time, low = refine_extreme(only(c), times, column, -1.0)
        high_time, high = refine_extreme(only(c), times, column, 1.0)
        found[name] = Peak(low, low_time, high, high_time)
    return found
