"""Margins: how near a driven mechanism comes to a dead point, how far it fails to pass one.

At either, one joint is off by the vector γ λ_j that lets the others just close, stretched or
folded: Φ = γ λ in this joint's rows and 0 in all others, Φ_qᵀ λ = 0, |λ_j| = 1, by Newton's
iteration (the equations of a fold, Govaerts 2000, ch. 4, with the gap as the parameter). γ is
extreme in time where λᵀ Φ_t = 0.
"""

from typing import NamedTuple

import numpy as np

from jointplay.records.arrays import Flags, Floats
from jointplay.solver.runs.ideal.constraints import Constraints
from jointplay.solver.runs.ideal.path import Path

LOOKS = 200
"""Instants of a turn, beside those of the path, at which the nearest is sought."""
MOST_BODIES = 30
"""Bodies up to which it is sought; of more the time would be felt."""
STEPS = 60
"""Instants of the rest of a turn at which it is seen how far links fail to reach."""
DIFFERENCE = 1e-5
"""Half of the difference by which second derivatives are taken, in rad, links and time scales."""
LARGEST = 0.3
MOST_ITERATIONS = 30
CONVERGED = 1e-9
ALIKE = 0.999
NEAR_ENOUGH = 4.0
"""Factor within which the first guess and what is found are one."""


class Margin(NamedTuple):
    """The gap at one joint that makes a dead point, or that is left where none is passed."""

    time: float
    """Where it is extreme, s."""
    size: float
    """m."""
    joint: str


class _Fold(NamedTuple):
    """A state in which all joints but one close, stretched or folded."""

    pose: Floats
    stress: Floats
    gap: float
    """γ, in lengths of the shortest link."""
    time: float


def nearest(path: Path, closing: tuple[str, ...]) -> Margin | None:
    """Return how near a path comes to a dead point; None if it stays far from any.

    `closing` : joints that are named rather than others under the same force.
    """
    constraints = path.constraints
    if len(path.end.pose) > 3 * MOST_BODIES:
        return None
    times = np.union1d(np.linspace(0.0, path.end.time, LOOKS + 1), path.times)
    poses, driven = path.poses(times), constraints.driven(times)
    system = constraints.system(poses, np.zeros_like(poses), driven)
    if system.jacobian.shape[1] != system.jacobian.shape[2]:
        return None
    left, values, right = np.linalg.svd(system.jacobian)
    weak, along, least = left[:, :, -1], right[:, -1, :], values[:, -1]
    moved = constraints.system(poses, along * constraints.scale, driven)
    curvature = np.einsum("ij,ij->i", weak, system.gamma - moved.gamma)
    # the closure along the weakest direction is σ s + k s²/2, least at s = -σ/k
    with np.errstate(divide="ignore"):
        off = -(least**2) / (2.0 * curvature)
    k = int(np.abs(off).argmin())
    joint, rows = _chosen(constraints, weak[k], closing)
    if not rows.any() or not np.isfinite(off[k]):
        return None
    share = float(np.linalg.norm(weak[k][rows]))
    pose = poses[k] - least[k] / curvature[k] * along[k] * constraints.scale
    guess = _Fold(pose, weak[k] / share, float(off[k]) / share, float(times[k]))
    at_end = k in (0, len(times) - 1)  # of a motion that does not come back
    found = _solved(path, guess, rows, extreme=not at_end)
    if found is None or not 0.0 <= found.time <= path.end.time:
        return None
    if not abs(guess.gap) <= NEAR_ENOUGH * abs(found.gap) <= NEAR_ENOUGH**2 * abs(guess.gap):
        return None
    return Margin(found.time, abs(found.gap) * constraints.length, joint)


def lacking(path: Path, until: float, closing: tuple[str, ...]) -> Margin | None:
    """Return by how much links fail to reach beyond the path's end; None if that is not found."""
    constraints, end = path.constraints, path.end
    rows, columns = end.system.jacobian.shape
    if rows != columns or columns > 3 * MOST_BODIES:
        return None
    left, _, _ = np.linalg.svd(end.system.jacobian)
    joint, open_rows = _chosen(constraints, left[:, -1], closing)
    if not open_rows.any():
        return None
    stress = left[:, -1] / np.linalg.norm(left[:, -1][open_rows])
    here = _Fold(end.pose, stress, 0.0, end.time)
    widest = here
    for time in np.linspace(end.time, until, STEPS + 1)[1:]:
        there = _solved(path, here._replace(time=float(time)), open_rows, extreme=False)
        if there is None:
            return None
        if there.gap * widest.gap < 0.0:
            break
        here = there
        widest = max(widest, there, key=lambda fold: abs(fold.gap))
    best = _solved(path, widest, open_rows, extreme=True)
    if best is None or not end.time <= best.time <= until or abs(best.gap) < abs(widest.gap):
        best = widest
    return Margin(best.time, abs(best.gap) * constraints.length, joint)


def _chosen(
    constraints: Constraints, stress: Floats, closing: tuple[str, ...]
) -> tuple[str, Flags]:
    """Return the joint whose force is largest in a state of self-stress, and its rows."""
    names = constraints.lengths
    shares: dict[str, float] = {}
    for name, share in zip(names, stress, strict=True):
        if name:
            shares[name] = shares.get(name, 0.0) + float(share) ** 2
    alike = [name for name, share in shares.items() if share >= ALIKE * max(shares.values())]
    joint = next((name for name in alike if name in closing), alike[0] if alike else "")
    return joint, np.array([bool(name) and name == joint for name in names])


def _solved(path: Path, guess: _Fold, rows: Flags, *, extreme: bool) -> _Fold | None:
    """Return the fold beside a guess, at its time or at that at which the gap is extreme."""
    scale = path.constraints.scale
    n, clock = len(scale), path.scale
    pose, stress, gap, time = guess
    for _ in range(MOST_ITERATIONS):
        value, jacobian, rate, pulls, powers = _derivatives(path, pose, stress, time)
        aside = np.where(rows, stress, 0.0)
        system = np.zeros((2 * n + 2, 2 * n + 2))
        system[:n, :n], system[:n, n : 2 * n] = jacobian, -gap * np.diag(rows.astype(float))
        system[:n, -2], system[:n, -1] = -aside, rate * clock
        system[n : 2 * n, :n], system[n : 2 * n, n : 2 * n] = pulls[:, :n], jacobian.T
        system[n : 2 * n, -1] = pulls[:, n]
        system[-2, n : 2 * n] = 2.0 * aside
        system[-1, :n], system[-1, -1] = powers[:n], powers[n]
        system[-1, n : 2 * n] = rate * clock
        left = np.concatenate(
            [value - gap * aside, jacobian.T @ stress, [aside @ aside - 1.0, stress @ rate * clock]]
        )
        if not extreme:
            system, left = system[:-1, :-1], left[:-1]
        try:
            step = -np.linalg.solve(system, left)
        except np.linalg.LinAlgError:
            return None
        size = float(np.abs(step[:n]).max())
        if not np.isfinite(size):
            return None
        step *= min(1.0, LARGEST / max(size, 1e-300))
        pose, stress = pose + step[:n] * scale, stress + step[n : 2 * n]
        gap += float(step[2 * n])
        time += float(step[-1]) * clock if extreme else 0.0
        if float(np.abs(step).max()) < CONVERGED:
            return _Fold(pose, stress, gap, time)
    return None


def _derivatives(
    path: Path, pose: Floats, stress: Floats, time: float
) -> tuple[Floats, Floats, Floats, Floats, Floats]:
    """Return Φ, Φ_q, Φ_t, and how Φ_qᵀ λ and λᵀ Φ_t change with pose and time, (.., n + 1)."""
    constraints, clock = path.constraints, path.scale
    n = len(pose)
    moves = DIFFERENCE * np.vstack([np.zeros(n + 1), np.eye(n + 1), -np.eye(n + 1)])
    poses = pose + moves[:, :n] * constraints.scale
    times = time + moves[:, n] * clock
    found = constraints.system(poses, np.zeros_like(poses), constraints.driven(times))
    pulled, power = stress @ found.jacobian, found.rate @ stress * clock
    ahead, behind = slice(1, n + 2), slice(n + 2, None)
    pulls = (pulled[ahead] - pulled[behind]).T / (2.0 * DIFFERENCE)
    powers = (power[ahead] - power[behind]) / (2.0 * DIFFERENCE)
    return found.value[0], found.jacobian[0], found.rate[0], pulls, powers
