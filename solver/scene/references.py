"""Checks of a scene that need more than one field: names that must exist, sizes that must fit."""

from collections import Counter
from collections.abc import Iterator
from difflib import get_close_matches

from solver.errors import Problem
from solver.scene.document import Clearance, Fixed, Joint, Prismatic, Revolute, Scene
from solver.scene.parameters import has_place

RESERVED = frozenset({"ground", "energy", "time", "poincare", "peaks", "impacts"})
RESERVED_OUTPUTS = RESERVED | {"c"}
"""In a store an output is a folder beside others, and ``c`` is where Zarr keeps chunks."""


def ends(joint: Joint) -> tuple[tuple[str, str], tuple[str, str]]:
    """Return the (field, reference) pairs of a joint's first and second point."""
    if isinstance(joint, Revolute):
        return ("bearing", joint.bearing), ("journal", joint.journal)
    if isinstance(joint, Prismatic):
        return ("guide", joint.guide), ("slider", joint.slider)
    return ("base", joint.base), ("part", joint.part)


def has_play(joint: Joint) -> bool:
    """Whether a joint is a force between a journal and its bearing, not a constraint."""
    return (
        isinstance(joint, Revolute)
        and joint.clearance is not None
        and joint.clearance.radial_clearance > 0.0
    )


def reference_problems(scene: Scene) -> Iterator[Problem]:
    """Yield what is wrong between the parts of a scene; pointers begin at the scene."""
    yield from _names(scene)
    for name, joint in scene.joints.items():
        yield from _joint(scene, name, joint)
    for name, driver in scene.drivers.items():
        yield from _driver(scene, name, driver.joint)
    doubled = Counter(driver.joint for driver in scene.drivers.values())
    for joint_name in (joint for joint, count in doubled.items() if count > 1):
        yield Problem("/drivers", f"Joint '{joint_name}' has more than one driver; keep one.")
    start = scene.start
    for field, table in (
        ("angles", start.angles),
        ("angular_velocities", start.angular_velocities),
        ("velocities", start.velocities),
    ):
        for body in table:
            if body not in scene.bodies:
                yield Problem(f"/start/{field}/{body}", unknown("body", body, scene.bodies))
    yield from _parameters(scene)


def unknown(kind: str, name: str, known: object) -> str:
    """Return a sentence that names an unknown thing and what there is instead."""
    names = [str(item) for item in known] if hasattr(known, "__iter__") else []
    near = get_close_matches(name, names, n=1)
    listed = ", ".join(names[:12]) + (", …" if len(names) > 12 else "")
    hint = f"did you mean '{near[0]}'?" if near else f"there are: {listed or 'none'}."
    return f"There is no {kind} '{name}'; {hint}"


def _parameters(scene: Scene) -> Iterator[Problem]:
    document = scene.model_dump()
    for name, parameter in scene.parameters.items():
        low, high = parameter.minimum, parameter.maximum
        if low is not None and high is not None and low > high:
            yield Problem(
                f"/parameters/{name}/minimum", f"The minimum {low:g} is above the maximum {high:g}."
            )
        for index, target in enumerate(parameter.targets):
            if not has_place(document, target.path):
                yield Problem(
                    f"/parameters/{name}/targets/{index}/path",
                    f"'{target.path}' leads nowhere in this scene.",
                )


def _names(scene: Scene) -> Iterator[Problem]:
    used = Counter([*scene.bodies, *scene.joints, *scene.drivers])
    for section, names in (
        ("bodies", scene.bodies),
        ("joints", scene.joints),
        ("drivers", scene.drivers),
    ):
        for name in names:
            if name in RESERVED:
                yield Problem(f"/{section}/{name}", f"The name '{name}' is reserved; take another.")
            elif used[name] > 1:
                yield Problem(
                    f"/{section}/{name}",
                    f"The name '{name}' is used twice; bodies, joints and drivers have names of"
                    " their own.",
                )
    outputs = Counter(output.name for output in scene.outputs)
    for index, output in enumerate(scene.outputs):
        if output.name in RESERVED_OUTPUTS or outputs[output.name] > 1:
            yield Problem(
                f"/outputs/{index}/name", f"The name '{output.name}' is taken; take another."
            )


def _joint(scene: Scene, name: str, joint: Joint) -> Iterator[Problem]:
    bodies = []
    for field, reference in ends(joint):
        body, point = reference.split(".")
        bodies.append(body)
        if body != "ground" and body not in scene.bodies:
            yield Problem(
                f"/joints/{name}/{field}", unknown("body", body, ["ground", *scene.bodies])
            )
            continue
        points = scene.ground.points if body == "ground" else scene.bodies[body].points
        if point not in points:
            yield Problem(
                f"/joints/{name}/{field}", unknown(f"point of '{body}' named", point, points)
            )
    if bodies[0] == bodies[1]:
        yield Problem(
            f"/joints/{name}", f"Both ends are on '{bodies[0]}'; a joint joins two bodies."
        )
    if isinstance(joint, Prismatic) and joint.axis[0] == joint.axis[1] == 0.0:
        yield Problem(f"/joints/{name}/axis", "The axis has no direction; give e.g. [1, 0].")
    if isinstance(joint, Revolute) and joint.clearance is not None:
        yield from _clearance(name, joint.clearance)


def _clearance(name: str, clearance: Clearance) -> Iterator[Problem]:
    place = f"/joints/{name}/clearance"
    if clearance.radial_clearance >= clearance.bearing_radius:
        yield Problem(
            f"{place}/radial_clearance",
            f"A radial clearance of {clearance.radial_clearance:g} m leaves no journal in a bearing"
            f" of radius {clearance.bearing_radius:g} m; it must be smaller.",
        )
    law = clearance.contact
    if law.stiffness is None and law.exponent != 1.5:
        yield Problem(
            f"{place}/contact/exponent",
            "Eq. 9 gives a stiffness for the exponent 1.5 only; with another exponent give a"
            " stiffness (N/m^n).",
        )
    friction = clearance.friction
    if friction is not None and friction.static_velocity > friction.dynamic_velocity:
        yield Problem(
            f"{place}/friction/static_velocity",
            f"The static limit velocity ({friction.static_velocity:g} m/s) is above the dynamic one"
            f" ({friction.dynamic_velocity:g} m/s); it may at most equal it.",
        )


def _driver(scene: Scene, name: str, joint_name: str) -> Iterator[Problem]:
    joint = scene.joints.get(joint_name)
    if joint is None:
        yield Problem(f"/drivers/{name}/joint", unknown("joint", joint_name, scene.joints))
    elif isinstance(joint, Fixed) or has_play(joint):
        yield Problem(
            f"/drivers/{name}/joint",
            f"Joint '{joint_name}' cannot be driven: it is "
            + ("fixed" if isinstance(joint, Fixed) else "a joint with clearance")
            + "; drive an ideal revolute or prismatic joint.",
        )
