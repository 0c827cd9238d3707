"""Constraints that others imply: which joints share a force that nothing determines."""

from typing import NamedTuple

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.mechanics.assembly import assemble
from jointplay.solver.mechanics.closing import RANK_TOLERANCE, rank
from jointplay.solver.mechanics.constraints_at_start import (
    ConstraintsAtStart,
    constraints_at_start,
)
from jointplay.solver.mechanics.start.guess import first_clocks
from jointplay.solver.quantities.scalars import SLIGHT
from jointplay.solver.scene.document import Scene

TAKES_PART = 1e-6
"""Share of the largest force in a state of self-stress that is rounding."""

FLAT = 1e-9
"""Second derivative of a row of unit length that is rounding, in rad and shortest links."""


class SelfStress(NamedTuple):
    """Forces in joints that balance one another with no load: one for each redundant row.

    w, (rows,), with wᵀ J = 0.
    """

    joints: list[str]
    """Joints, gears and drivers that take part, in the order of the document."""
    member: str
    """The body farthest from the ground that two joints alone press or pull; empty: none."""
    ends: list[str]
    """These two joints."""
    is_one_sided: bool
    """Whether wᵀ Φ has the same sign on either side of the start, wherever first derivatives let
    it go: then what they let go is held by the second ones."""


def self_stresses(scene: Scene) -> list[SelfStress]:
    """Return the states of self-stress of the ideal mechanism at its start."""
    start = constraints_at_start(scene)
    norms = np.linalg.norm(start.jacobian, axis=1, keepdims=True)
    start = start._replace(jacobian=start.jacobian / np.maximum(norms, SLIGHT))
    rows, jacobian = start.rows, start.jacobian
    found: list[SelfStress] = []
    independent: list[int] = []
    for i in range(len(rows)):
        if rank(jacobian[[*independent, i]]) > len(independent):
            independent.append(i)
            continue
        shares, *_ = np.linalg.lstsq(jacobian[independent].T, jacobian[i], rcond=RANK_TOLERANCE)
        stress = np.zeros(len(rows))
        stress[independent], stress[i] = -shares, 1.0
        found.append(_described(scene, start, stress))
    return found


def _described(scene: Scene, start: ConstraintsAtStart, stress: Floats) -> SelfStress:
    rows = start.rows
    weights: dict[str, float] = {}
    for row, share in zip(rows, stress, strict=True):
        weights[row.joint] = max(weights.get(row.joint, 0.0), abs(float(share)))
    least = TAKES_PART * max(weights.values())
    joints = [name for name, weight in weights.items() if weight > least]
    turned = {row.joint for row, share in zip(rows, stress, strict=True) if row.part == "angle"}
    member, pins = _member(scene, joints, turned)
    return SelfStress(joints, member, pins, _one_sided(scene, start, stress))


def _member(scene: Scene, joints: list[str], turned: set[str]) -> tuple[str, list[str]]:
    """Return the body farthest from the ground that only two pins stress, and these."""
    touching: dict[str, list[str]] = {}
    neighbours: dict[str, set[str]] = {}
    for name in joints:
        if name not in scene.joints:
            continue
        one, two = scene.joints[name].bodies
        for here, there in ((one, two), (two, one)):
            touching.setdefault(here, []).append(name)
            neighbours.setdefault(here, set()).add(there)
    far, reached = {"ground": 0}, ["ground"]
    for here in reached:
        for there in sorted(neighbours.get(here, ())):
            if there not in far:
                far[there] = far[here] + 1
                reached.append(there)
    members = [b for b in scene.bodies if len(touching.get(b, ())) == 2]
    members = [b for b in members if not turned & set(touching[b]) and b in far]
    farthest = [b for b in members if far[b] == max(far[other] for other in members)]
    if len(farthest) != 1:
        return "", []
    return farthest[0], touching[farthest[0]]


def _one_sided(scene: Scene, start: ConstraintsAtStart, stress: Floats) -> bool:
    """Return whether the quadratic form of wᵀ Φ has one sign where first derivatives are free."""
    ideal, rows, jacobian, scale = start
    pose, driven = assemble(scene).pose, first_clocks(scene)
    _, values, directions = np.linalg.svd(jacobian)
    free = directions[int((values > RANK_TOLERANCE * values[0]).sum()) :]
    norms = np.array([np.linalg.norm([e * scale[k] for k, e in r.jacobian.items()]) for r in rows])
    resting = np.array([row.gamma for row in rows])

    def bent(direction: Floats) -> float:
        moving = ideal.rows(pose, direction * scale, driven)
        gamma = np.array([row.gamma for row in moving]) - resting
        return float(stress @ (gamma / np.maximum(norms, SLIGHT)))

    count = len(free)
    form = np.zeros((count, count))
    for i in range(count):
        form[i, i] = bent(free[i])
    for i in range(count):
        for j in range(i):
            mixed = 0.5 * (bent(free[i] + free[j]) - form[i, i] - form[j, j])
            form[i, j] = form[j, i] = mixed
    curvatures = np.linalg.eigvalsh(form)
    largest = float(np.abs(curvatures).max(initial=0.0))
    least = TAKES_PART * largest
    one_sided = (curvatures > -least).all() or (curvatures < least).all()
    return bool(largest > FLAT and one_sided)
