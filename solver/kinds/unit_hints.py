"""Hints at numbers that are hardly meant in SI units: degrees, kg mm², GPa, periods of turns."""

import math
from collections.abc import Iterator

from jointplay.records.failure import Problem
from jointplay.solver.laws.force.torsion_spring import TorsionSpring
from jointplay.solver.laws.force.varying import Varying
from jointplay.solver.laws.function.whole_turn import NEARLY as EXACT
from jointplay.solver.laws.function.whole_turn import TURN
from jointplay.solver.scene.document import Scene

LARGE = 10.0
"""Radius of gyration, over the largest length of a mechanism, from which on it is told."""
SOFTEST = 1e5
"""Young's modulus, Pa, below which it is told."""
NEARLY = 1e-2
"""Mismatch of a period and a turn beyond which a turn is not meant."""


def in_degrees(scene: Scene) -> Iterator[Problem]:
    """Yield the angles that are more than a turn."""
    for pointer, angle in _angles(scene):
        if abs(angle) > TURN * (1.0 + EXACT):
            yield Problem(
                pointer,
                f"{angle:g} rad are {angle / TURN:.3g} turns. If degrees are meant, give"
                f" {math.radians(angle):.9g}.",
            )


def _angles(scene: Scene) -> Iterator[tuple[str, float]]:
    """Yield pointers to angles that are given, and their values, rad."""
    for body, angle in scene.start.angles.items():
        yield f"/start/angles/{body}", angle
    for name, driver in scene.drivers.items():
        joint = scene.joints.get(driver.joint or "")
        if driver.body is not None or (joint is not None and joint.freedom == "turn"):
            yield f"/drivers/{name}/position", driver.position
    for name, joint in scene.joints.items():
        if joint.holds_angle:
            yield f"/joints/{name}/angle", joint.angle
    for name, element in scene.forces.items():
        if isinstance(element, TorsionSpring):
            yield f"/forces/{name}/free_angle", element.free_angle


def too_inert(scene: Scene) -> Iterator[Problem]:
    """Yield the bodies whose radius of gyration is far larger than all lengths of a mechanism."""
    points = [point for body in scene.bodies.values() for point in body.points.values()]
    points += scene.ground.points.values()
    sizes = [joint.size for joint in scene.joints.values()]
    largest = max([*(math.hypot(*point) for point in points), *sizes], default=0.0)
    for name, body in scene.bodies.items():
        gyration = math.sqrt(body.inertia / body.mass)
        if 0.0 < LARGE * largest < gyration:
            yield Problem(
                f"/bodies/{name}/inertia",
                f"{body.inertia:g} kg m^2 and {body.mass:g} kg are a radius of gyration of"
                f" {gyration:.3g} m, and no point is farther than {largest:.3g} m from the origin"
                f" of its axes. If kg mm^2 are meant, give {1e-6 * body.inertia:g}.",
            )


def too_soft(scene: Scene) -> Iterator[Problem]:
    """Yield the materials of contacts that are softer than any solid of a joint."""
    for name, joint in scene.joints.items():
        contact = joint.slack.contact if joint.slack else None
        for law, part in ((contact, ""), (getattr(contact, "stiffness", None), "/stiffness")):
            modulus = getattr(law, "youngs_modulus", math.inf)
            if modulus < SOFTEST:
                yield Problem(
                    f"/joints/{name}/clearance/contact{part}/youngs_modulus",
                    f"{modulus:g} Pa is softer than rubber, some 1e6 Pa. If GPa are meant, give"
                    f" {1e9 * modulus:g}.",
                )


def nearly_turns(scene: Scene) -> Iterator[Problem]:
    """Yield the courses over an angle whose period is nearly a turn, or a whole part of one."""
    for name, element in scene.forces.items():
        over = element.follows() if isinstance(element, Varying) else None
        if over is None or over.quantity != "angle" or over.rate:
            continue
        assert isinstance(element, Varying)  # noqa: S101  (narrows the type)
        period = 0.0 if element.course is None else element.course.period
        if not 0.0 < period < TURN * (1.0 + NEARLY):
            continue
        share = TURN / round(TURN / period)
        if EXACT < abs(period / share - 1.0) < NEARLY:
            yield Problem(
                f"/forces/{name}/course",
                f"It repeats after {period:.9g} rad, and so shifts by {period - share:.2g} rad each"
                f" time against the angle. If it shall repeat after {share:.9g} rad, give the last"
                " knot so.",
            )
