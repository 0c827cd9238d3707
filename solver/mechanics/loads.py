"""Loads on bodies: forces, and moments about the bodies' reference points."""

from collections.abc import Iterable, Mapping

from jointplay.solver.joints.contact import Interaction
from jointplay.solver.mechanics.kinematics import Kinematics
from jointplay.solver.quantities.frames import WORLD, cross
from jointplay.solver.quantities.scalars import Scalar

Load = tuple[Scalar, Scalar, Scalar]
"""Force (x and y, N) and moment (N m)."""
Loads = Mapping[str, Load]
"""Loads on bodies, by name."""
NO_LOAD: Load = (0.0, 0.0, 0.0)


def about_references(kinematics: Kinematics, interactions: Iterable[Interaction]) -> Loads:
    """Return what interactions come to on each moving body."""
    sums: dict[str, Load] = {}
    for acting in interactions:
        fx, fy = acting.force_on_second
        for reference, force, moment in (
            (acting.second, (fx, fy), acting.moment_on_second),
            (acting.first, (-fx, -fy), acting.moment_on_first),
        ):
            body, point = reference.split(".")
            if body == WORLD:
                continue
            arm = kinematics.arm(body, point).world()
            x, y, turning = sums.get(body, NO_LOAD)
            sums[body] = (x + force[0], y + force[1], turning + moment + cross(arm, force))
    return sums
