"""Numbers of a scene's document as arrays that compiled functions read."""

import math
from collections.abc import Mapping, Sequence
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from benchmarks.lies.truth.pairs import Pair, pairs_of
from jointplay.solver.mechanics.assembly import shortest_link
from jointplay.solver.mechanics.impact_floors import impact_floor, resting_rate
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.pairs import contact_pairs

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

ACROSS_X, ACROSS_Y, ANGLE, NORMAL, ALONG = range(5)
"""Kinds of constraint rows: coincidence of two points in x and in y, difference of two angles,
distance of two points across an axis and along it."""
ENDS: Final = {
    "revolute": ("bearing", "journal"),
    "prismatic": ("guide", "slider"),
    "fixed": ("base", "part"),
}


EDGE, ARM, KIND = 2, 3, 4
"""Columns of `wall`."""


PLAY = ("radial_clearance", "wall_clearance", "lash")


class Mechanism(NamedTuple):
    """A scene; bodies and points by index, the ground is body -1.

    Attributes
    ----------
    inverse_mass : (3 bodies,) 1/m, 1/m, 1/I of each body
    gravity : (2,) m/s^2
    body, arm : (points,), (points, 2) body of each point, and its body coordinates, m
    row : (rows, 3) kind of each constraint, its first point, its second
    motion : (rows, 7) position and speed of a driver, the axis in the guide's coordinates,
        amplitude, frequency and phase of a driver that swings
    play : (joints, 2) bearing's point and journal's; of walls the guide's and the corner's or pin's
    wall : (joints, 5) normal out of the guide in its coordinates, or into the cam in the
        follower's, distance of the corner from the axis, radius of the pin, kind of the surface
    cam : (joints, 4) mean and amplitude of a profile, its waves a turn, their phase
    law : (joints, 11) radial clearance, bearing radius, K, exponent, 3 (1 - c_e^2) / 4, floor of
        the impact rate, friction coefficient, v_0, v_1, whether the slip is as published, least
        impact rate of a contact that is there from the start on
    motor, motor_law : (motors, 2), (motors, 2) points; stall torque, speed without load
    spring, spring_law : (springs, 2), (springs, 3) points; stiffness, damping, free length
    """

    inverse_mass: Floats
    gravity: Floats
    body: Integers
    arm: Floats
    row: Integers
    motion: Floats
    play: Integers
    wall: Floats
    cam: Floats
    law: Floats
    motor: Integers
    motor_law: Floats
    spring: Integers
    spring_law: Floats


class Named(NamedTuple):
    """A mechanism, and where its document's names are in it."""

    mechanism: Mechanism
    rows: dict[str, list[int]]
    """Constraint rows of a joint."""
    play: list[str]
    drivers: dict[str, int]
    """The row whose multiplier is the effort of a driver."""
    sliders: list[int]
    """The slider's own point of each joint with play."""
    motors: list[str]
    springs: list[str]


def has_play(joint: Mapping[str, Any]) -> bool:
    """Whether a joint's journal moves in its bearing, its slider between walls, or a follower."""
    clearance = joint.get("clearance") or {}
    return any(clearance.get(name, 0.0) > 0.0 for name in PLAY)


def read(scene: Mapping[str, Any]) -> Named:
    """Return the mechanism of a filled-in document."""
    bodies = list(scene["bodies"])
    index: dict[str, int] = {}
    body, arm = list[int](), list[Sequence[float]]()
    for owner, held in (("ground", scene["ground"]), *scene["bodies"].items()):
        for point, coordinates in held["points"].items():
            index[f"{owner}.{point}"] = len(body)
            body.append(bodies.index(owner) if owner != "ground" else -1)
            arm.append(coordinates)
    pins = {
        joint["journal"].split(".")[0]: name
        for name, joint in scene["joints"].items()
        if joint["type"] == "revolute" and joint["bearing"].startswith("ground.")
    }
    driven = {
        driver.get("joint") or pins[driver["body"]]: (name, driver)
        for name, driver in scene["drivers"].items()
    }
    row, motion = list[tuple[int, int, int]](), list[tuple[float, ...]]()
    rows, drivers = dict[str, list[int]](), dict[str, int]()
    wanted: list[tuple[int, tuple[float, ...]]]
    for name, joint in scene["joints"].items():
        if has_play(joint):
            continue
        first, second = (index[joint[end]] for end in ENDS[joint["type"]])
        driver, moved = driven.get(name, ("", {"position": 0.0, "speed": 0.0}))
        given = _motion(moved)
        ux, uy = joint.get("axis", (1.0, 0.0))
        axis = (ux / math.hypot(ux, uy), uy / math.hypot(ux, uy))
        still = (joint.get("angle", 0.0), 0.0)
        if joint["type"] == "prismatic":
            wanted = [(NORMAL, (0.0, 0.0)), (ANGLE, still)]
            wanted += [(ALONG, given)] if driver else []
        else:
            wanted = [(ACROSS_X, (0.0, 0.0)), (ACROSS_Y, (0.0, 0.0))]
            wanted += [(ANGLE, still)] if joint["type"] == "fixed" else []
            wanted += [(ANGLE, given)] if driver else []
        rows[name] = list(range(len(row), len(row) + len(wanted)))
        for kind, (position, speed, *swing) in wanted:
            row.append((kind, first, second))
            motion.append((position, speed, *axis, *(swing or (0.0, 0.0, 0.0))))
        if driver:
            drivers[driver] = len(row) - 1
    play, joints = [], []
    for name, joint in scene["joints"].items():
        found = pairs_of(name, joint) if has_play(joint) else []
        play += found
        joints += [joint] * len(found)
    seconds = []
    for pair in play:  # a corner is a point of its own
        second = index[pair.second]
        seconds.append(len(body) if any(pair.arm) else second)
        if any(pair.arm):
            body.append(body[second])
            arm.append((arm[second][0] + pair.arm[0], arm[second][1] + pair.arm[1]))
    motors = {name: one for name, one in scene["forces"].items() if one["type"] == "motor"}
    springs = {name: one for name, one in scene["forces"].items() if name not in motors}
    inverse_mass = [
        1.0 / value
        for each in scene["bodies"].values()
        for value in (each["mass"], each["mass"], each["inertia"])
    ]
    mechanism = Mechanism(
        np.array(inverse_mass, np.float64),
        np.array(scene["gravity"], np.float64),
        np.array(body, np.int64),
        np.array(arm, np.float64).reshape(-1, 2),
        np.array(row, np.int64).reshape(-1, 3),
        np.array(motion, np.float64).reshape(-1, 7),
        np.array(
            [[index[p.first], second] for p, second in zip(play, seconds, strict=True)], np.int64
        ).reshape(-1, 2),
        np.array([pair.wall for pair in play], np.float64).reshape(-1, 5),
        np.array([pair.cam for pair in play], np.float64).reshape(-1, 4),
        np.array(_laws(scene, play, joints), np.float64).reshape(-1, 11),
        _ends(motors, index),
        _numbers(motors, "stall_torque", "no_load_speed"),
        _ends(springs, index),
        _numbers(springs, "stiffness", "damping", "free_length"),
    )
    sliders = [index[pair.second] for pair in play]
    names = [pair.name for pair in play]
    return Named(mechanism, rows, names, drivers, sliders, list(motors), list(springs))


def _motion(driver: Mapping[str, Any]) -> tuple[float, ...]:
    """Return position and speed of a driver; of one that swings, how, too."""
    swing = driver.get("motion")
    if swing is None:
        return driver["position"], driver["speed"]
    fields = ("amplitude", "frequency", "phase")
    return (driver["position"] + swing["offset"], 0.0, *(swing[field] for field in fields))


def _ends(elements: Mapping[str, Any], index: Mapping[str, int]) -> Integers:
    points = [[index[one["first"]], index[one["second"]]] for one in elements.values()]
    return np.array(points, np.int64).reshape(-1, 2)


def _numbers(elements: Mapping[str, Any], *fields: str) -> Floats:
    values = [[one[field] for field in fields] for one in elements.values()]
    return np.array(values, np.float64).reshape(-1, len(fields))


def _laws(
    scene: Mapping[str, Any], play: Sequence[Pair], joints: Sequence[Mapping[str, Any]]
) -> list[tuple[float, ...]]:
    made = Scene.model_validate(dict(scene))
    pairs, length = contact_pairs(made), shortest_link(made)
    return [
        _law(
            joint["clearance"],
            impact_floor(made, pairs[pair.name], length),
            resting_rate(made, pairs[pair.name], length),
        )
        for pair, joint in zip(play, joints, strict=True)
    ]


def _law(fit: Mapping[str, Any], floor: float, resting: float) -> tuple[float, ...]:
    """Return the numbers of a joint's laws; eq. 9 of the press paper where K is not given."""
    contact, friction = fit["contact"], fit["friction"]
    clearance = next(fit[name] for name in PLAY if name in fit)
    radius = fit.get("bearing_radius", clearance)
    stiffness = contact["stiffness"]
    if stiffness is None:
        compliance = (1.0 - contact["poisson_ratio"] ** 2) / contact["youngs_modulus"]
        stiffness = 2.0 / (3.0 * compliance) * math.sqrt(radius * (radius - clearance) / clearance)
    rubbing = (0.0, 0.0, 1.0, 0.0)
    if friction is not None:
        rubbing = (
            friction["coefficient"],
            friction["static_velocity"],
            friction["dynamic_velocity"],
            float(friction["slip_velocity"] == "as-published"),
        )
    return (
        clearance,
        radius,
        stiffness,
        contact["exponent"],
        0.75 * (1.0 - contact["restitution"] ** 2),
        floor,
        *rubbing,
        resting,
    )
