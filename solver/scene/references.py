"""Checks of a scene that need more than one field: names that must exist, and must be new."""

from collections import Counter
from collections.abc import Collection, Iterator

from jointplay.records.failure import Problem
from jointplay.records.names import RESERVED, RESERVED_OUTPUTS
from jointplay.records.suggestions import unknown
from jointplay.solver.joints import Gear
from jointplay.solver.joints.starts import GuideStart
from jointplay.solver.laws.friction.law import InnerState
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.drivers import Driver, MovingDriver
from jointplay.solver.scene.pairs import contact_pairs
from jointplay.solver.scene.parameter_problems import parameter_problems
from jointplay.solver.scene.parameters import targeted_paths, value_at
from jointplay.solver.scene.sizes import size_problems
from jointplay.solver.scene.varying_forces import varying_problems


def inner_states(scene: Scene) -> dict[str, tuple[InnerState, ...]]:
    """Return the states that friction laws have of their own, by pair, where there are any."""
    laws = {name: pair.clearance.friction for name, pair in contact_pairs(scene).items()}
    return {
        name: law.inner_states
        for name, law in laws.items()
        if law is not None and not law.is_off and law.inner_states
    }


def tangent_obstacle(scene: Scene) -> str:
    """Return why no tangent vector can follow a scene's motion, and the remedy; empty: one can."""
    clearances = [pair.clearance for pair in contact_pairs(scene).values()]
    laws = [law for c in clearances for law in (c.contact, c.friction) if law]
    return next((law.tangent_obstacle for law in laws if law.tangent_obstacle), "")


def reference_problems(scene: Scene) -> Iterator[Problem]:
    """Yield what is wrong between the parts of a scene; pointers begin at the scene."""
    yield from part_problems(scene)
    yield from parameter_problems(scene)
    setting = targeted_paths(scene)
    for path, other, sentence in idle_fields(scene):
        if other not in setting:  # else it may give way
            yield Problem(path, sentence)


def idle_fields(scene: Scene) -> Iterator[tuple[str, str, str]]:
    """Yield pointers to fields that have no effect, and to what makes them idle, and the sentence.

    A field with its default counts as not given: filled-in documents have all fields.
    """
    for pointer, other, sentence in without_effect(scene):
        contact, _, field = pointer.rpartition("/")
        law = value_at(scene, contact)
        if getattr(law, field) != type(law).model_fields[field].default:
            yield pointer, other, sentence


def without_effect(scene: Scene) -> Iterator[tuple[str, str, str]]:
    """Yield the same for all fields that have no effect, whatever their values are."""
    for name, joint in scene.joints.items():
        if joint.slack is None:
            continue
        pointer = f"/joints/{name}/clearance/contact"
        other, fields = joint.slack.contact.idle_beside()
        for field in fields:
            sentence = f"'{field}' has no effect beside a given '{other}'; leave one out."
            yield f"{pointer}/{field}", f"{pointer}/{other}", sentence


def part_problems(scene: Scene) -> Iterator[Problem]:
    """Yield the same but for what is wrong with declared parameters."""
    yield from _names(scene)
    for name, joint in scene.joints.items():
        yield from _points(scene, f"/joints/{name}", joint.ends)
    for name, force in scene.forces.items():
        pair = (("first", force.first), ("second", force.second))
        yield from _points(scene, f"/forces/{name}", pair)
        over = force.follows()
        if over is not None and (over.first or over.second):
            other = (("first", over.first or force.first), ("second", over.second or force.second))
            yield from _points(scene, f"/forces/{name}/over", other)
    yield from varying_problems(scene)
    yield from size_problems(scene)
    for name, joint in scene.joints.items():
        for field, sentence in joint.problems():
            yield Problem(f"/joints/{name}/{field}", sentence)
    for name, gear in scene.gears.items():
        yield from _gear(scene, f"/gears/{name}", gear)
    for name, driver in scene.drivers.items():
        yield from _driver(scene, name, driver)
    doubled = Counter(driver.joint for driver in scene.drivers.values() if driver.joint)
    for joint_name in (joint for joint, count in doubled.items() if count > 1):
        yield Problem("/drivers", f"Joint '{joint_name}' has more than one driver; keep one.")
    yield from _start(scene)
    yield from _recorded(scene)


def _recorded(scene: Scene) -> Iterator[Problem]:
    doubled = Counter(scene.recorded)
    for index, reference in enumerate(scene.recorded):
        pointer = f"/recorded/{index}"
        problems = list(_point(scene, pointer, reference))
        yield from problems
        if doubled[reference] > 1 and not problems:
            yield Problem(pointer, f"'{reference}' is named twice; name it once.")


def _point(scene: Scene, pointer: str, reference: str) -> Iterator[Problem]:
    """Yield what is wrong with the reference of a body's point."""
    body, point = reference.split(".")
    if body not in scene.bodies:
        yield Problem(pointer, unknown("body", body, scene.bodies))
    elif point not in scene.bodies[body].points:
        points = scene.bodies[body].points
        yield Problem(pointer, unknown(f"point of '{body}' named", point, points))


def _start(scene: Scene) -> Iterator[Problem]:
    start = scene.start
    for field, table in (
        ("angles", start.angles),
        ("angular_velocities", start.angular_velocities),
        ("velocities", start.velocities),
    ):
        for body in table:
            if body not in scene.bodies:
                yield Problem(f"/start/{field}/{body}", unknown("body", body, scene.bodies))
    for reference in start.points:
        yield from _point(scene, f"/start/points/{reference}", reference)
    for name in start.joints:
        if name not in scene.joints:
            yield Problem(f"/start/joints/{name}", unknown("joint", name, scene.joints))
        elif not scene.joints[name].has_play:
            yield Problem(
                f"/start/joints/{name}",
                f"Joint '{name}' has no clearance, so its parts coincide; leave it out.",
            )
        elif not scene.joints[name].is_journal:
            yield Problem(
                f"/start/joints/{name}",
                f"Joint '{name}' is no journal in a bearing; say where what it guides starts in"
                " 'guides', by its 'offset' (m) and its 'tilt' (rad).",
            )
    for name, guided in start.guides.items():
        yield from _guided(scene, f"/start/guides/{name}", name, guided)


def _guided(scene: Scene, pointer: str, name: str, start: GuideStart) -> Iterator[Problem]:
    """Yield what is wrong with the start of what a joint with play guides."""
    joint = scene.joints.get(name)
    if joint is None:
        yield Problem(pointer, unknown("joint", name, scene.joints))
    elif joint.is_journal:
        yield Problem(pointer, f"'{name}' is a journal; say where it starts in 'joints'.")
    elif not joint.has_play:
        yield Problem(
            pointer,
            f"Joint '{name}' has no clearance, so its parts coincide; leave it out.",
        )
    elif not joint.holds_angle:
        for field in ("tilt", "tilt_rate"):
            if getattr(start, field):
                sentence = f"What joint '{name}' guides may turn; leave the {field} out."
                yield Problem(f"{pointer}/{field}", sentence)


def _names(scene: Scene) -> Iterator[Problem]:
    sections: dict[str, Collection[str]] = {
        "joints": scene.joints,
        "gears": scene.gears,
        "drivers": scene.drivers,
        "forces": scene.forces,
    }
    used = Counter(name for names in sections.values() for name in names)
    # a body may share a name: it shares no quantity with the others, nor therefore a channel
    for section, names in {"bodies": scene.bodies, **sections}.items():
        for name in names:
            if name in RESERVED:
                yield Problem(f"/{section}/{name}", f"The name '{name}' is reserved; take another.")
            elif section != "bodies" and used[name] > 1:
                yield Problem(
                    f"/{section}/{name}",
                    f"The name '{name}' is used twice; joints, gears, drivers and forces have names"
                    " of their own.",
                )
    outputs = Counter(output.name for output in scene.outputs)
    for index, output in enumerate(scene.outputs):
        if output.factor == 0.0:
            sentence = f"'{output.name}' would always be {output.offset:g}; give another factor."
            yield Problem(f"/outputs/{index}/factor", sentence)
        if output.name in RESERVED_OUTPUTS:
            sentence = f"The name '{output.name}' is reserved; take another."
            yield Problem(f"/outputs/{index}/name", sentence)
        elif outputs[output.name] > 1:
            sentence = f"The name '{output.name}' is taken; take another."
            yield Problem(f"/outputs/{index}/name", sentence)


def _points(
    scene: Scene, pointer: str, pair: tuple[tuple[str, str], tuple[str, str]]
) -> Iterator[Problem]:
    """Yield what is wrong with the (field, reference) pairs of two points to be connected."""
    bodies = []
    for field, reference in pair:
        body, point = reference.split(".")
        bodies.append(body)
        if body != "ground" and body not in scene.bodies:
            yield Problem(f"{pointer}/{field}", unknown("body", body, ["ground", *scene.bodies]))
            continue
        points = scene.ground.points if body == "ground" else scene.bodies[body].points
        if point not in points:
            yield Problem(f"{pointer}/{field}", unknown(f"point of '{body}' named", point, points))
    if bodies[0] == bodies[1]:
        kind = "a joint joins" if pointer.startswith("/joints") else "a force acts between"
        yield Problem(pointer, f"Both ends are on '{bodies[0]}'; {kind} two bodies.")


def _gear(scene: Scene, pointer: str, gear: Gear) -> Iterator[Problem]:
    for field, name in (("first", gear.first), ("second", gear.second)):
        joint = scene.joints.get(name)
        if joint is None:
            yield Problem(f"{pointer}/{field}", unknown("joint", name, scene.joints))
        elif joint.freedom != "turn":
            yield Problem(
                f"{pointer}/{field}",
                f"The bodies of joint '{name}' do not turn against each other: it is"
                f" {joint.type}; couple revolute joints.",
            )
    if gear.first == gear.second:
        yield Problem(
            f"{pointer}/second", f"A gear couples two joints, and '{gear.second}' is one."
        )


def _driver(scene: Scene, name: str, driver: Driver) -> Iterator[Problem]:
    if isinstance(driver, MovingDriver) and not driver.motion.has_curvature:
        yield Problem(
            f"/drivers/{name}/motion/between",
            "A driven motion needs a continuous speed and a bounded acceleration that varies"
            " smoothly; give 'smooth'.",
        )
    if (driver.joint is None) == (driver.body is None):
        both = "" if driver.joint is None else ", not both"
        yield Problem(f"/drivers/{name}/joint", f"Drive a 'joint' or a 'body'{both}.")
        return
    if driver.joint is None:
        yield from _driven_body(scene, name, driver.body or "")
        return
    joint_name = driver.joint
    joint = scene.joints.get(joint_name)
    if joint is None:
        yield Problem(f"/drivers/{name}/joint", unknown("joint", joint_name, scene.joints))
    elif joint.driven_part is None or joint.has_play:
        yield Problem(
            f"/drivers/{name}/joint",
            f"Joint '{joint_name}' cannot be driven: it is "
            + ("a joint with clearance" if joint.driven_part else joint.called)
            + "; drive an ideal revolute or prismatic joint.",
        )


def _driven_body(scene: Scene, name: str, body: str) -> Iterator[Problem]:
    pointer = f"/drivers/{name}/body"
    if body not in scene.bodies:
        yield Problem(pointer, unknown("body", body, scene.bodies))
    for joint_name, joint in scene.joints.items():
        if joint.holds_angle and not joint.has_play and body in joint.bodies:
            yield Problem(
                pointer,
                f"The angle of '{body}' cannot be driven: joint '{joint_name}' holds it. Drive a"
                " body whose joints let it turn.",
            )
    others = [d.body for d in scene.drivers.values()]
    if others.count(body) > 1:
        yield Problem(pointer, f"Body '{body}' has more than one driver; keep one.")
