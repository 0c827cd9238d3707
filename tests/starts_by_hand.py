"""Studies of many starts in memory, by the cycles that they end on."""

import numpy as np

from jointplay.records.channel import Channel
from jointplay.records.cycles import INDEPENDENT, MEAN, SPREAD
from jointplay.records.point import PointStatus
from jointplay.records.study import StudyDataset

VERDICTS = ("undecided", "periodic", "quasi-periodic", "chaotic", "equilibrium")
PERIODIC = 1.0


def study(
    periods,
    means,
    spreads=None,
    verdicts=PERIODIC,
    status=PointStatus.done,
    grid=(),
    independent=np.nan,
    along=None,
):
    """Return a study of a pendulum's cycles: means of its angle and rate.

    independent : sections of motions that do not recur. along : (points,) values of a torque, where
    the shares of basins are wanted over it.
    """
    count = len(periods)
    names = ("rod.theta", "rod.theta_rate")
    means = np.asarray(means, np.float64).reshape(count, 2)
    spreads = np.zeros((count, 2)) if spreads is None else np.asarray(spreads).reshape(count, 2)
    numbers = {f"{MEAN}{name}": means[:, k] for k, name in enumerate(names)}
    numbers |= {f"{SPREAD}{name}": spreads[:, k] for k, name in enumerate(names)}
    numbers[INDEPENDENT] = np.broadcast_to(np.asarray(independent, np.float64), count)
    drawn = {"kind": "basin-stability", "along": {"parameter": "push"}}
    return StudyDataset(
        {
            "job": {"kind": "basins"} if along is None else drawn,
            "states": {"scales": dict(zip(names, (0.1, 1.0), strict=True)), "angles": names[:1]},
        },
        (Channel("push" if along is not None else "y", "N m", ""), Channel("x", "1", "")),
        np.stack([np.zeros(count) if along is None else along, np.zeros(count)], axis=1),
        np.full(count, status, np.uint8),
        statistics=numbers,
        indicators={
            "period": np.asarray(periods, np.float64),
            "verdict": np.broadcast_to(np.asarray(verdicts, np.float64), count),
        },
        verdict_names=VERDICTS,
        grid=() if along is not None else grid or (1, count),
    )
