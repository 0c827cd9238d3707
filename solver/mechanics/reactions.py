"""Forces of ideal joints and efforts of drivers from Lagrange multipliers: -Φ_qᵀ λ."""

from __future__ import annotations

from jointplay.solver.mechanics.absolute import AbsoluteMechanism, Row
from jointplay.solver.mechanics.frames import Pair
from jointplay.solver.quantities.scalars import Scalar
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.references import ends


def joint_reactions(
    scene: Scene, mechanism: AbsoluteMechanism, rows: list[Row], multipliers: list[Scalar]
) -> tuple[dict[str, Pair], dict[str, Scalar]]:
    """Return the force on each joint's second body, N, and each driver's effort, N m or N."""
    forces: dict[str, Pair] = {}
    efforts: dict[str, Scalar] = {}
    for row, multiplier in zip(rows, multipliers, strict=True):
        (_, first), (_, second) = ends(scene.joints[row.joint])
        body, sign = second.split(".")[0], 1.0
        if body == "ground":
            body, sign = first.split(".")[0], -1.0
        k = 3 * mechanism.bodies.index(body)
        x, y = forces.get(row.joint, (0.0, 0.0))
        fx = row.jacobian.get(k, 0.0) * multiplier
        fy = row.jacobian.get(k + 1, 0.0) * multiplier
        forces[row.joint] = (x - sign * fx, y - sign * fy)
        driver = mechanism.drivers.get(row.joint)
        driven = "angle" if scene.joints[row.joint].type == "revolute" else "along"
        if driver is not None and row.part == driven:
            efforts[driver] = -multiplier
    return forces, efforts
