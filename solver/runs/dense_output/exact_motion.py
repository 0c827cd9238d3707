"""An ideal mechanism read at any time: its motion is known without steps."""

import math
from collections.abc import Sequence

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.quantities.extremes import least_miss, narrowed
from jointplay.solver.runs.admission import Admission
from jointplay.solver.runs.ideal.run import IdealRun

INSTANTS_A_PERIOD = 2000
FEWEST, MOST = 8, 4000
"""Instants in a bin."""
AT_ONCE = 2000
"""Instants that are computed together."""


class ExactMotion:
    """The motion of a job whose drivers leave no freedom."""

    def __init__(self, admission: Admission) -> None:
        self._run = IdealRun(admission)

    def channels(self, names: Sequence[str], times: Floats) -> Floats:
        """Return channels (m, names) at times (m,), s.

        Raises
        ------
        SimulationFailed
            The mechanism cannot be followed so far.
        """
        columns = [self._run.names.index(name) for name in names]
        pieces = [
            self._run.channels(times[i : i + AT_ONCE])[:, columns]
            for i in range(0, len(times), AT_ONCE)
        ]
        return np.concatenate([*pieces, np.empty((0, len(names)))])

    def extremes(self, names: Sequence[str], edges: Floats) -> Floats:
        """Return extremes (bins, names, 4) between edges: lowest, its time, highest, its time.

        By parabolas through instants that are at most a 2000th of a period apart. Where these do
        not describe a channel, it is evaluated at more.
        """
        width = float(np.diff(edges).max())
        count = math.ceil(width / self._run.motion.unit * INSTANTS_A_PERIOD)
        shares = np.linspace(0.0, 1.0, min(max(count, FEWEST), MOST))
        times = edges[:-1, None] + np.diff(edges)[:, None] * shares
        values = self.channels(names, times.ravel()).reshape(*times.shape, len(names))
        least = least_miss(values.reshape(-1, len(names)))
        found = np.empty((len(times), len(names), 4))
        for sense, column in ((-1.0, 0), (1.0, 2)):
            highest, at, miss = _highest(sense * values, times)
            bins, rows = (miss > least).nonzero()
            if len(bins):
                best = (sense * values).argmax(axis=1)[bins, rows]
                start = values[bins, best, rows], times[bins, best]
                reach, ends = times[bins, 1] - times[bins, 0], (times[bins, 0], times[bins, -1])
                top, at[bins, rows] = narrowed(
                    lambda when: self.channels(names, when), rows, start, reach, ends, sense
                )
                highest[bins, rows] = sense * top
            found[:, :, column], found[:, :, column + 1] = sense * highest, at
        return found


def _highest(values: Floats, times: Floats) -> tuple[Floats, Floats, Floats]:
    """Return the largest value (bins, names) of each bin, its time, and how values miss a parabola.

    The miss is that of the five about the largest: 0 for polynomials of the third degree.
    """
    best = values.argmax(axis=1)
    inner = np.clip(best, 1, values.shape[1] - 2)[:, None, :]
    before, here, after = (
        np.take_along_axis(values, inner + shift, axis=1)[:, 0] for shift in (-1, 0, 1)
    )
    rise, fall = here - before, here - after
    turns = (rise > 0.0) & (fall > 0.0)
    both = np.where(turns, rise + fall, 1.0)
    place = np.where(turns, 0.5 * (rise - fall) / both, 0.0)
    top = here + 0.25 * (rise - fall) * place
    spacing = (times[:, 1] - times[:, 0])[:, None]
    at = np.take_along_axis(times, best, axis=1)
    sampled = np.take_along_axis(values, best[:, None, :], axis=1)[:, 0]
    five = np.clip(best, 2, values.shape[1] - 3)[:, None, :] + np.arange(-2, 3)[:, None]
    miss = np.diff(np.take_along_axis(values, five, axis=1), 4, axis=1)[:, 0]
    return np.where(turns, top, sampled), np.where(turns, at + spacing * place, at), np.abs(miss)
