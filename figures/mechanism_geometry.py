"""Bodies, points and joints of a scene in world coordinates."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.records.joint_marks import marks_of, play_of

Point = tuple[float, float]
Segment = tuple[Point, Point]
Pose = Mapping[str, tuple[float, float, float]]
"""By body: x and y of the centre of mass [m] and angle [rad]."""

GROUND = "ground"
WITH_CLEARANCE = "joint with clearance"
_SAME_POSITION = 1e-6
"""Joints closer than this share of the extent are labelled together."""
_FLAT = 1e-9
"""Twice the area of a triangle that is a line, in squares of the largest distance."""
_BESIDE = 0.03
"""A centre of mass closer to the only point of a body than this share of the extent is in it."""

_BEARINGS_ACROSS = 6.0
"""Width of the picture of a scene without extension, in bearing radii."""


@dataclass(frozen=True)
class JointMark:
    """One joint: its sign, its position [m], the direction of its axis if it slides [rad], play."""

    name: str
    style: str
    position: Point
    grounded: bool
    axis: float | None
    bodies: tuple[str, str]
    play: bool


@dataclass(frozen=True)
class Geometry:
    """A scene at a pose; all lengths in m, world frame."""

    bodies: dict[str, dict[str, Point]]
    centres: dict[str, Point]
    joints: tuple[JointMark, ...]
    gravity: Point
    fixed_points: tuple[Point, ...]
    smallest_extent: float

    @property
    def corners(self) -> Floats:
        """(2n,) every coordinate that is drawn."""
        points = [point for named in self.bodies.values() for point in named.values()]
        points += [*self.centres.values(), *self.fixed_points]
        return np.array(points).ravel()

    @property
    def extent(self) -> tuple[Point, Point]:
        """Smallest and largest x, and y; never empty."""
        points = self.corners.reshape(-1, 2)
        (left, low), (right, high) = points.min(axis=0).tolist(), points.max(axis=0).tolist()
        if right - left == high - low == 0.0:
            around = self.smallest_extent / 2.0
            return (left - around, right + around), (low - around, high + around)
        return (left, right), (low, high)

    @property
    def size(self) -> float:
        """Largest side of the extent."""
        (left, right), (low, high) = self.extent
        return max(right - left, high - low)

    def corners_of(self, name: str) -> list[Point]:
        """Corners of a body, at least one.

        A body of one point that does not slide reaches to its centre of mass.
        """
        centre = self.centres[name]
        corners = outline([*self.bodies[name].values()]) or [centre]
        slides = any(joint.axis is not None and name in joint.bodies for joint in self.joints)
        if len(corners) > 1 or slides or math.dist(corners[0], centre) < _BESIDE * self.size:
            return corners
        return [*corners, centre]

    def is_block(self, name: str) -> bool:
        """Tell whether this is a body without extension, drawn as a block or disc."""
        return name in self.bodies and len(self.corners_of(name)) < 2

    def segments(self) -> list[tuple[str, Segment]]:
        """Edges of the bodies with the body's name; a body of one point is a single point."""
        found = []
        for name in self.bodies:
            corners = self.corners_of(name)
            following = corners[1:] + corners[:1] if len(corners) > 2 else corners[1:] or corners
            found += [(name, segment) for segment in zip(corners, following, strict=False)]
        return found

    def positions(self) -> list[tuple[Point, list[JointMark]]]:
        """Joints by position: those in the same one together."""
        found: list[tuple[Point, list[JointMark]]] = []
        for joint in self.joints:
            for position, here in found:
                if math.dist(position, joint.position) <= _SAME_POSITION * self.size:
                    here.append(joint)
                    break
            else:
                found.append((joint.position, [joint]))
        return found


def geometry(scene: Mapping[str, Any], pose: Pose) -> Geometry:
    """Place everything that the scene document names."""
    bearings = [
        joint["clearance"][marks_of(joint)["size"]]
        for joint in scene["joints"].values()
        if joint.get("clearance") and marks_of(joint)["size"]
    ]
    motors = scene.get("drivers", {}).values()
    driven, moved = ({driver.get(of) for driver in motors} for of in ("joint", "body"))
    joints = []
    for name, joint in scene["joints"].items():
        marks = marks_of(joint)
        first, second = marks["ends"]
        bodies = (joint[first].partition(".")[0], joint[second].partition(".")[0])
        axis = None
        if marks["axis"]:
            axis = heading(joint, pose)
        joints.append(
            JointMark(
                name=name,
                style=_style(joint, name in driven or (marks["turns"] and bodies[1] in moved)),
                position=world(scene, pose, joint[second]),
                grounded=GROUND in bodies,
                axis=axis,
                bodies=bodies,
                play=play_of(joint) > 0.0,
            )
        )
    return Geometry(
        bodies={
            name: {
                point: placed(pose[name], position)
                for point, position in body.get("points", {}).items()
            }
            for name, body in scene["bodies"].items()
        },
        centres={name: (pose[name][0], pose[name][1]) for name in scene["bodies"]},
        joints=tuple(joints),
        gravity=tuple(scene.get("gravity") or (0.0, 0.0)),
        fixed_points=(
            *(joint.position for joint in joints if joint.grounded),
            *(
                world(scene, pose, element[end])
                for element in (scene.get("forces") or {}).values()
                for end in ("first", "second")
                if element["type"] == "spring-damper"
            ),
        ),
        smallest_extent=_BEARINGS_ACROSS * max(bearings, default=1.0 / _BEARINGS_ACROSS),
    )


def _style(joint: Mapping[str, Any], driven: bool) -> str:
    """Name the sign that a joint is drawn with; sliders have a rail instead."""
    sign = marks_of(joint)["sign"]
    if sign != "pin":
        return sign
    if play_of(joint) > 0.0:
        return WITH_CLEARANCE
    return "driven joint" if driven else "ideal joint"


def heading(joint: Mapping[str, Any], pose: Pose) -> float:
    """Return the angle in the world of the axis of a joint that has one [rad]."""
    marks = marks_of(joint)
    x, y = joint[marks["axis"]]
    return angle_of(pose, joint[marks["ends"][0]]) + math.atan2(y, x)


def angle_of(pose: Pose, reference: str) -> float:
    """Return the angle in the world of the body of a named point [rad]."""
    body = reference.partition(".")[0]
    return 0.0 if body == GROUND else pose[body][2]


def turned(angle: float, points: Floats) -> Floats:
    """Turn points (..., 2) about the origin [rad]."""
    c, s = np.cos(angle), np.sin(angle)
    return np.asarray(points @ np.array([[c, s], [-s, c]]))


def world(scene: Mapping[str, Any], pose: Pose, reference: str) -> Point:
    """Return where a named point is, m."""
    body, _, point = reference.partition(".")
    if body == GROUND:
        x, y = scene.get("ground", {}).get("points", {})[point]
        return float(x), float(y)
    return placed(pose[body], scene["bodies"][body]["points"][point])


def placed(pose: tuple[float, float, float], point: tuple[float, float]) -> Point:
    """Return where a point of a body is, m, from its position in the body's axes."""
    x, y, angle = pose
    cosine, sine = math.cos(angle), math.sin(angle)
    return x + cosine * point[0] - sine * point[1], y + sine * point[0] + cosine * point[1]


def outline(points: list[Point]) -> list[Point]:
    """Corners of the convex hull, counter-clockwise (Andrew's monotone chain).

    Of points in a line, to rounding, these are the ends.
    """
    ordered = sorted(set(points))
    if len(ordered) < 3:
        return ordered
    end = max(ordered, key=lambda point: math.dist(point, ordered[0]))
    start = max(ordered, key=lambda point: math.dist(point, end))
    if all(
        abs(_turn(start, end, point)) <= _FLAT * math.dist(start, end) ** 2 for point in ordered
    ):
        return [start, end]

    def half(line: list[Point]) -> list[Point]:
        chain: list[Point] = []
        for point in line:
            while len(chain) > 1 and _turn(chain[-2], chain[-1], point) <= 0.0:
                chain.pop()
            chain.append(point)
        return chain[:-1]

    return half(ordered) + half(ordered[::-1])


def distance(position: Point, segment: Segment) -> float:
    """Distance of a position from a segment."""
    start, end = np.array(segment[0]), np.array(segment[1])
    along = end - start
    length = float(along @ along)
    share = 0.0 if length == 0.0 else float(np.clip((position - start) @ along / length, 0.0, 1.0))
    return float(np.linalg.norm(position - (start + share * along)))


def among(position: Point, positions: list[Point], nearness: float) -> bool:
    """Tell whether one of the positions is no farther than `nearness`."""
    return any(math.dist(position, other) <= nearness for other in positions)


def _turn(a: Point, b: Point, c: Point) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
