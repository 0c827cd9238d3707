"""The rotation number of a motion whose section is a closed curve.

Sources: Das, Saiki, Sander and Yorke 2017, Nonlinearity 30:4111 (weighted Birkhoff averages; the
lift by continuity).
"""

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.nonlinear.estimate import Estimate
from jointplay.solver.quantities.scalars import direction_angle, exponential

FEWEST_POINTS = 32
WIDEST_GAP = 0.125
"""Largest part of a turn around the centre that may be without points."""
ROUGHEST = 0.02
"""Largest distance of a point from the curve through its neighbours, as a part of the mean radius;
nine in ten points must be nearer."""
ROUNDING = 1e-15


def rotation_number(section: Floats) -> Estimate | None:
    """Return the mean turn per section about the centroid, in turns, counter-clockwise, in [0, 1).

    section : (n, 2) points in time, in any two units: the plane is scaled and sheared so that the
    points spread alike in all directions, which changes no rotation number.

    A turn by 0.7 and one by -0.3 have the same section; both are 0.7. The angle by which each point
    advances is a continuous function of where it is, so all advances lie within less than a turn:
    where they leave the largest gap, counting starts. Their mean is a weighted Birkhoff average,
    which for a quasi-periodic motion converges faster than any power of n; the error is the
    larger difference to the same average over either half.

    None where the points do not form one closed curve about their centroid that every ray meets
    once: fewer than 32, a gap wider than an eighth of a turn (a periodic motion of few points), or
    points scattered by more than 2 % of the radius about the curve through their neighbours (chaos,
    a folded torus). Of a torus with q separate curves, give every q-th point.

    Raises
    ------
    ValueError
        If the section is not (n, 2) or a point is not finite.
    """
    points = np.asarray(section, np.float64)
    if points.ndim != 2 or points.shape[1] != 2:
        raise ValueError("a rotation number is that of points (n, 2) in a plane")
    if not np.isfinite(points).all():
        raise ValueError("a rotation number needs finite points; leave out those never reached")
    if len(points) < FEWEST_POINTS:
        return None
    round_points = _made_round(points)
    if round_points is None:
        return None
    x, y = round_points
    turns = direction_angle(x, y) / (2.0 * np.pi)
    if not _closed_curve(turns, np.sqrt(x * x + y * y)):
        return None
    advances = _lifted(np.diff(turns))
    half = len(advances) // 2
    whole = _weighted_average(advances)
    first, second = _weighted_average(advances[:half]), _weighted_average(advances[-half:])
    return Estimate(whole % 1.0, max(abs(first - whole), abs(second - whole), ROUNDING))


def _made_round(points: Floats) -> tuple[Floats, Floats] | None:
    """Return coordinates about the centroid with the covariance of a circle; None: all in line."""
    x, y = (points - points.mean(axis=0)).T
    extent = float(np.abs(x).max())
    if extent == 0.0:
        return None
    x = x / extent
    y = y - x * float((x * y).sum() / (x * x).sum())
    breadth = float(np.sqrt((y * y).mean()))
    if breadth <= 1e-12 * float(np.abs(points).max()):
        return None
    return x / float(np.sqrt((x * x).mean())), y / breadth


def _closed_curve(turns: Floats, radius: Floats) -> bool:
    """Say whether points, in the order of their angle, lie on a curve r(θ) without wide gaps."""
    order = np.argsort(turns, kind="stable")
    angle, r = turns[order], radius[order]
    left, right = (angle - np.roll(angle, 1)) % 1.0, (np.roll(angle, -1) - angle) % 1.0
    if float(right.max()) > WIDEST_GAP:
        return False
    both = left + right
    share = np.where(both > 0.0, left / np.where(both > 0.0, both, 1.0), 0.5)
    between = np.roll(r, 1) + share * (np.roll(r, -1) - np.roll(r, 1))
    return bool(np.quantile(np.abs(r - between), 0.9) <= ROUGHEST * r.mean())


def _lifted(advances: Floats) -> Floats:
    """Return advances, in turns, within one turn, counted from the largest gap between them."""
    within = np.sort(advances % 1.0)
    gaps = np.diff(within, append=within[0] + 1.0)
    start = float(within[(int(gaps.argmax()) + 1) % len(within)])
    return np.asarray((advances - start + 1e-12) % 1.0 + start - 1e-12, np.float64)


def _weighted_average(values: Floats) -> float:
    """Return the average with weights exp(-1/(t(1-t))), t from 0 to 1 over the record."""
    t = np.arange(1.0, len(values) + 1.0) / (len(values) + 1.0)
    weights = exponential(-1.0 / (t * (1.0 - t)))
    return float((weights * values).sum() / weights.sum())
