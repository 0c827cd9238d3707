"""The windows of time of a case's targets: how a run is cut into legs, what each leg adds.

Extremes are sought inside the steps, and a lane can forget them; so a run stops wherever a window
begins or ends, and the extreme over a window is that over its legs.
"""

from collections.abc import Sequence

from jointplay.records.arrays import Floats
from jointplay.records.peak import Peak
from jointplay.solver.calibration.document import CalibrationTarget, Statistic
from jointplay.solver.calibration.targets import grid_indices

LAST_STEP = 1e-6
"""Length of a leg's last step.  An extreme is noticed by its channel turning from one step to
the next; a step from which a long one turns, and after which a short one begins, misses none."""
SAME = 1e-9
"""Closeness of times: this near to the end of the run, an instant of the grid is the end."""


class Windows:
    """Windows of a run that its targets need, and their values from its results."""

    def __init__(self, targets: Sequence[CalibrationTarget]) -> None:
        self.targets = tuple(targets)
        watched = [target for target in targets if target.sampled is None]
        self.watched = tuple(dict.fromkeys(target.channel for target in watched))
        """Channels whose extremes are sought inside the steps."""
        read = [target for target in targets if target.sampled is not None]
        self.read = tuple(dict.fromkeys(target.channel for target in read))
        """Channels that are read off a grid."""
        self.step = next((target.sampled for target in read if target.sampled), 0.0)
        """Step of that grid, s; 0 if there is none."""
        ends = {time for target in watched for time in (target.start, target.stop) if time > 0.0}
        last = max((grid_indices(t.start, t.stop, self.step)[-1] for t in read), default=-1)
        if last * self.step > max(ends, default=0.0) * (1.0 + SAME):
            ends.add(last * self.step)
        if not ends:  # what is read off is the start alone
            ends.add(max(target.stop for target in read))
        self.legs = tuple(sorted(ends))
        """When each leg of the run ends, s; the last is the run's end."""
        starts = (0.0, *self.legs[:-1])
        self.stops = tuple(
            stop
            for start, end in zip(starts, self.legs, strict=True)
            for stop in (end - LAST_STEP * (end - start), end)
        )
        """When the run stops, s: shortly before the end of each leg, and there."""
        lands = abs(last * self.step - self.legs[-1]) <= SAME * self.legs[-1]
        self.samples = last + (1 if lands else 2) if read else 0
        """Samples to ask for: from 0 on the grid's, and the last at the run's end in any case."""

    def values(self, legs: Sequence[dict[str, Peak]], samples: Floats) -> list[float]:
        """Return each target's value.

        Parameters
        ----------
        legs
            Extremes of the watched channels over each leg.
        samples : (instants, channels) float
            The channels read off the grid from 0 on.
        """
        return [
            value_of(
                self._over_legs(target, legs)
                if target.sampled is None
                else self._over_samples(target, samples[:, self.read.index(target.channel)]),
                target.statistic,
            )
            for target in self.targets
        ]

    def _over_legs(self, target: CalibrationTarget, legs: Sequence[dict[str, Peak]]) -> Peak:
        starts = (0.0, *self.legs[:-1])
        inside = [
            leg[target.channel]
            for leg, start, stop in zip(legs, starts, self.legs, strict=True)
            if target.start <= start and stop <= target.stop
        ]
        low = min(inside, key=lambda peak: peak.minimum)
        high = max(inside, key=lambda peak: peak.maximum)
        return Peak(low.minimum, low.minimum_time, high.maximum, high.maximum_time)

    def _over_samples(self, target: CalibrationTarget, column: Floats) -> Peak:
        index = grid_indices(target.start, target.stop, self.step)
        values = column[index.start : index.stop]
        low, high = int(values.argmin()), int(values.argmax())
        ends = ((float(values[at]), index[at] * self.step) for at in (low, high))
        return Peak(*next(ends), *next(ends))


def value_of(peak: Peak, statistic: Statistic) -> float:
    """Return a statistic of a channel's extremes over a window."""
    if statistic == "range":
        return peak.maximum - peak.minimum
    return float(getattr(peak, statistic))
