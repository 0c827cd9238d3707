"""Mechanisms of any size: random trees of bodies, with a loop closed, random instants, chains."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
from hypothesis import assume
from hypothesis import strategies as st

from jointplay.solver.mechanics.reduced import ReducedMechanism
from jointplay.solver.mechanics.start.states import start_state
from jointplay.solver.mechanics.tree import spanning_tree
from jointplay.solver.mechanics.view import view
from jointplay.solver.scene.document import Scene
from tests.solver.readable_mechanics import Instant, at_start

KINDS = ("revolute", "prismatic", "fixed")
ENDS = {
    "revolute": ("bearing", "journal"),
    "prismatic": ("guide", "slider"),
    "fixed": ("base", "part"),
}


def numbers(low: float, high: float) -> st.SearchStrategy[float]:
    """Return floats that are not so small that their squares vanish."""
    return st.floats(low, high).map(lambda x: round(x, 4))


coordinates = st.tuples(numbers(-0.4, 0.4), numbers(-0.4, 0.4)).map(list)
angles = numbers(-3.0, 3.0)


@st.composite
def trees(draw: st.DrawFn, fewest: int = 1, kinds: tuple[str, ...] = KINDS) -> Scene:
    """Draw a scene: a tree of some to five bodies on the ground, perhaps a floating pair.

    Every joint has points of its own; either end may come first; half of the joints are driven.
    A floating part hangs on the rest by a joint with play alone. Bodies and joints stand in the
    document in any order.
    """
    ground: dict[str, list[float]] = {}
    bodies: dict[str, dict[str, Any]] = {}
    joints: dict[str, dict[str, Any]] = {}
    drivers: dict[str, dict[str, Any]] = {}

    def point(body: str, name: str) -> str:
        points = ground if body == "ground" else bodies[body]["points"]
        points[name] = draw(coordinates)
        return f"{body}.{name}"

    def join(name: str, kind: str, first: str, second: str) -> dict[str, Any]:
        one, two = ENDS[kind]
        joint: dict[str, Any] = {
            "type": kind,
            one: point(first, f"at{name}"),
            two: point(second, f"on{name}"),
        }
        if kind == "prismatic":
            turn = draw(st.sampled_from([[1.0, 0.0], [0.0, -2.0], [0.6, 0.8], [-0.3, 1.1]]))
            joint["axis"] = turn
        if kind != "revolute":
            joint["angle"] = draw(angles)
        return joint

    def add_body() -> str:
        name = f"body{len(bodies)}"
        bodies[name] = {
            "mass": draw(numbers(0.1, 4.0)),
            "inertia": draw(numbers(0.01, 0.5)),
            "points": {},
        }
        return name

    count = draw(st.integers(fewest, 5))
    floating_from = draw(st.integers(1, 6))
    for i in range(count):
        carriers = ["ground", *bodies]
        name = add_body()
        if i == floating_from:
            carrier = draw(st.sampled_from(carriers))
            ends = [carrier, name] if draw(st.booleans()) else [name, carrier]
            joints["Play"] = {
                **join("Play", "revolute", *ends),
                "clearance": {
                    "radial_clearance": draw(numbers(1e-3, 0.05)),
                    "bearing_radius": draw(numbers(0.06, 0.5)),
                    "contact": {
                        "stiffness": draw(numbers(1e2, 1e5)),
                        "exponent": draw(st.sampled_from([1.5, 1.5, 1.2, 2.0])),
                        "restitution": draw(numbers(0.0, 1.0)),
                    },
                    "friction": {
                        "coefficient": draw(st.sampled_from([0.0, 0.3])),
                        "static_velocity": 0.05,
                        "dynamic_velocity": 0.1,
                        "slip_velocity": draw(st.sampled_from(["material", "as-published"])),
                    },
                },
            }
            continue
        carrier = draw(st.sampled_from(carriers))
        kind = draw(st.sampled_from(kinds))
        ends = [carrier, name] if draw(st.booleans()) else [name, carrier]
        joints[f"J{i}"] = join(f"J{i}", kind, *ends)
        if kind != "fixed" and draw(st.integers(0, 2)) == 0:
            drivers[f"D{i}"] = {
                "joint": f"J{i}",
                "position": draw(angles),
                "speed": draw(numbers(-5.0, 5.0)),
            }
    return Scene.model_validate(
        {
            "name": "random",
            "gravity": [draw(numbers(-10.0, 10.0)), draw(numbers(-10.0, 10.0))],
            "ground": {"points": ground},
            "bodies": {name: bodies[name] for name in draw(st.permutations(list(bodies)))},
            "joints": {name: joints[name] for name in draw(st.permutations(list(joints)))},
            "drivers": drivers,
        }
    )


@st.composite
def instants(draw: st.DrawFn, scenes: st.SearchStrategy[Scene]) -> Instant:
    """Draw a scene anywhere in its motion: any coordinates, speeds, driver positions, modes."""
    scene = draw(scenes)
    tree = spanning_tree(scene)
    value = numbers(-2.0, 2.0)
    return Instant(
        scene,
        {name: draw(value) for name in tree.coordinates},
        {name: draw(value) for name in tree.coordinates},
        {name: draw(value) for name in scene.drivers},
        {name: draw(st.sampled_from([0.0, 1.0])) for name in tree.pairs},
        {name: draw(numbers(0.01, 2.0)) for name in tree.pairs},
    )


INDEPENDENT = 1e-6
"""Smallest eigenvalue of J M^-1 J^T, rows scaled to a diagonal of 1, of a loop that is drawn."""


@st.composite
def closed(draw: st.DrawFn) -> Instant:
    """Draw an instant of a tree in which one more joint closes a loop.

    The joint holds two bodies as they happen to be, and speeds are brought to those that it allows.
    """
    drawn = draw(instants(trees(fewest=4, kinds=("revolute", "revolute", "prismatic"))))
    document, motion = drawn.scene.model_dump(), drawn.reduced()
    first, second = draw(st.permutations(["ground", *document["bodies"]]))[:2]
    kind = draw(st.sampled_from(KINDS))
    one, two = ENDS[kind]
    place = draw(coordinates)
    there = draw(coordinates) if kind == "prismatic" else [0.0, 0.0]
    frames = {"ground": (np.zeros(2), 0.0)}
    frames |= {n: (np.array(body.position), body.angle) for n, body in motion.bodies.items()}

    def turned(angle: float, vector: Any) -> Any:
        c, s = math.cos(angle), math.sin(angle)
        return np.array([c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]])

    (origin, angle), (other, other_angle) = frames[first], frames[second]
    here = origin + turned(angle, place)
    reached = turned(-other_angle, here + turned(angle, there) - other).tolist()
    for body, at, point in ((first, "from", place), (second, "to", reached)):
        owner = document["ground"] if body == "ground" else document["bodies"][body]
        owner["points"][at] = point
    joint: dict[str, Any] = {"type": kind, one: f"{first}.from", two: f"{second}.to"}
    if kind == "prismatic":
        assume(math.hypot(*there) > 0.1)
        joint["axis"] = there
    if kind != "revolute":
        joint["angle"] = other_angle - angle
    document["joints"]["Loop"] = joint
    scene = Scene.model_validate(document)
    tree = spanning_tree(scene)
    assume(tree.closing)
    moving = [motion.bodies[name] for name in scene.bodies]
    pose = np.array([x for body in moving for x in (*body.position, body.angle)])
    rates = np.array([x for body in moving for x in (*body.velocity, body.spin)])
    state = start_state(scene, tree.coordinates, pose, rates)
    position, speed = (
        dict(zip(tree.coordinates, half, strict=True)) for half in np.split(state, 2)
    )
    mechanism = ReducedMechanism(tree, view(scene), position, speed, drawn.driven)
    loops = mechanism.loops()
    matrix = np.zeros((len(loops.rows), len(loops.rows)))
    for (i, j), value in loops.matrix.items():
        matrix[i, j] = matrix[j, i] = value
    size = np.sqrt(np.diag(matrix))
    assume(size.min() > 0.0)
    assume(np.linalg.eigvalsh(matrix / np.outer(size, size)).min() > INDEPENDENT)
    changes = loops.correction([row.rate for row in loops.rows])
    allowed = {n: v + change for (n, v), change in zip(speed.items(), changes, strict=True)}
    return replace(drawn, scene=scene, position=position, speed=allowed)


@st.composite
def near_start(draw: st.DrawFn, scene: Scene, spread: float) -> Instant:
    """Draw a scene near its start: coordinates within `spread` (m, rad), any speeds and modes."""
    start = at_start(scene)
    shift, rate = numbers(-1.0, 1.0), numbers(-2.0, 2.0)
    return replace(
        start,
        position={name: q + spread * draw(shift) for name, q in start.position.items()},
        speed={name: v + draw(rate) for name, v in start.speed.items()},
        mode={name: draw(st.sampled_from([0.0, 1.0])) for name in start.mode},
        impact_rate={name: draw(numbers(0.01, 2.0)) for name in start.mode},
    )


def chain(bodies: int) -> Scene:
    """Return a pendulum of many rods."""
    rod = {"mass": 1.0, "inertia": 0.1, "points": {"a": [-0.5, 0.0], "b": [0.5, 0.0]}}
    ends = ["ground.a", *(f"r{i}.b" for i in range(bodies))]
    return Scene.model_validate(
        {
            "name": "chain",
            "gravity": [0.0, -9.81],
            "ground": {"points": {"a": [0.0, 0.0]}},
            "bodies": {f"r{i}": rod for i in range(bodies)},
            "joints": {
                f"j{i}": {"type": "revolute", "bearing": ends[i], "journal": f"r{i}.a"}
                for i in range(bodies)
            },
        }
    )
