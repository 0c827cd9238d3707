"""An ideal mechanism read at any time: its motion is known without steps."""

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.quantities.corners import least_miss, misses, surpass_at_corners
from jointplay.solver.runs.admission import Admission
from jointplay.solver.runs.dense_output.moments import moments_of
from jointplay.solver.runs.ideal.run import IdealRun

INSTANTS_A_PERIOD = 2000
FEWEST, MOST, MOST_TOGETHER = 8, 4000, 200_000
"""Instants in a bin; more where bins are so few that all of them have no more than so many."""
AT_ONCE = 2000
"""Instants that are computed together."""


class ExactMotion:
    """The motion of a job whose drivers leave no freedom."""

    def __init__(self, admission: Admission) -> None:
        self._admission = admission
        self._run = IdealRun(admission)

    def channels(self, names: Sequence[str], times: Floats) -> Floats:
        """Return channels (m, names) at times (m,), s: at those of samples their bits.

        Raises
        ------
        SimulationFailed
            The mechanism cannot be followed so far.
        """
        return self._at(names, times, *moments_of(self._admission, times).T)

    def extremes(self, names: Sequence[str], edges: Floats) -> Floats:
        """Return extremes (bins, names, 4) between edges: lowest, its time, highest, its time.

        By parabolas through instants that are at most a 2000th of a period apart. Where these do
        not describe a channel, it is evaluated at more.
        """
        motion = self._run.motion
        wanted = partial(motion.instants, a_period=INSTANTS_A_PERIOD)
        times = instants(edges[:-1, None], edges[1:, None], motion.forces_period, wanted)
        values = self._between(names, times.ravel()).reshape(*times.shape, len(names))
        found = np.empty((len(times), len(names), 4))
        for sense, column in ((-1.0, 0), (1.0, 2)):
            best = _best(values, times, sense)
            surpass_at_corners(
                lambda when: self._between(names, when),
                range(len(names)),
                (times, values),
                best,
                sense,
            )
            found[:, :, column], found[:, :, column + 1] = best
        return found

    def _between(self, names: Sequence[str], times: Floats) -> Floats:
        """Return the same wherever samples are."""
        return self._at(names, times, times, np.ones(len(times)))

    def _at(self, names: Sequence[str], times: Floats, count: Floats, step: Floats) -> Floats:
        """Return channels (m, names) at count * step (m,), s, which are rounded to `times`."""
        columns = [self._run.names.index(name) for name in names]
        local = self._run.motion.local(count, step)
        pieces = [
            self._run.channels(times[i : i + AT_ONCE], local[i : i + AT_ONCE])[:, columns]
            for i in range(0, len(times), AT_ONCE)
        ]
        return np.concatenate([*pieces, np.empty((0, len(names)))])


def instants(
    first: Floats, last: Floats, period: float | None, wanted: Callable[[float], int]
) -> Floats:
    """Return (bins, n) instants, s, from first to last (bins, 1): as many as wanted, within bounds.

    Of bins longer than two periods those of the first one and of the last one: angles that go on
    turning are extreme there, and all else repeats. `wanted` : number of instants of a span, s.
    """
    most = max(MOST, MOST_TOGETHER // len(first))
    if period is not None and float((last - first).min()) > 2.0 * period:
        beyond = period * _shares(wanted(period), most // 2)
        return np.concatenate([first + beyond, last - beyond[::-1]], axis=1)
    shares = _shares(wanted(float((last - first).max())), most)
    return np.asarray(first + (last - first) * shares, np.float64)


def _shares(count: int, most: int) -> Floats:
    return np.linspace(0.0, 1.0, min(max(count, FEWEST), most))


def _best(values: Floats, times: Floats, sense: float) -> tuple[Floats, Floats]:
    """Return the largest (sense 1) or smallest values (bins, names) of bins, and their times.

    By parabolas, unless the five values about the best miss one.
    """
    values = sense * values
    best = values.argmax(axis=1)[:, None, :]
    inner = np.clip(best, 1, values.shape[1] - 2)
    before, here, after = (
        np.take_along_axis(values, inner + shift, axis=1)[:, 0] for shift in (-1, 0, 1)
    )
    rise, fall = here - before, here - after
    smooth = np.take_along_axis(misses(values), best, axis=1)[:, 0] <= least_miss(values)
    turns = (rise > 0.0) & (fall > 0.0) & smooth
    place = np.where(turns, 0.5 * (rise - fall) / np.where(turns, rise + fall, 1.0), 0.0)
    top = here + 0.25 * (rise - fall) * place
    highest = np.where(turns, top, np.take_along_axis(values, best, axis=1)[:, 0])
    spacing = (times[:, 1] - times[:, 0])[:, None]
    return sense * highest, np.take_along_axis(times, best[:, 0], axis=1) + spacing * place
