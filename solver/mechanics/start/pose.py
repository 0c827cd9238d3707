"""The pose at the start: given angles and points hold where the joints allow it.

Joints with play start closed, or as `start.joints` and `start.guides` say, unless what is given
needs their play and is within it (`opening`). What cannot hold all together holds in the scene's
order as far as it can, angles first; the rest comes as near as it gets. Of several assemblies that
is the nearest one, by `given.distance`: the first that closes if it keeps all; else, of equally
near ones, that in which bodies of which nothing is given are nearest to angle zero, and slides to
the middle.
"""

import math
from collections.abc import Iterable, Sequence

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.linear_algebra.products import applied
from jointplay.solver.mechanics.absolute import AbsoluteMechanism
from jointplay.solver.mechanics.closing import LARGEST_TURN, NEAR, arrays
from jointplay.solver.mechanics.start.closings import alike
from jointplay.solver.mechanics.start.given import Given, Rows, distance
from jointplay.solver.mechanics.start.levels import MOST_ITERATIONS, approach, step_of
from jointplay.solver.mechanics.start.out_of_reach import as_near_as_it_gets
from jointplay.solver.mechanics.start.places import KEPT, Places
from jointplay.solver.scene.document import Scene

FAR = 1e-3
"""From which on other assemblies are sought: drawings give three digits."""
ALIKE = 1e-6
"""Relative difference of distances up to which two assemblies are equally near."""

ROUGHLY, FEW = 6, 8
"""Steps towards what is given after which poses are sorted, and how many different ones go on."""


def nearest(places: Places, poses: Iterable[Floats]) -> Floats:
    """Return the closed pose nearest to what is given, of those near each of some closed ones."""

    def apart(pose: Floats) -> float:
        return distance(places.given, pose, np.zeros_like(pose))

    found = [_nearest_here(places, pose, ROUGHLY) for pose in poses]
    few: list[Floats] = []
    for pose in sorted(found, key=apart):
        if len(few) < FEW and not any(alike(pose, other, places.scale, NEAR) for other in few):
            few.append(pose)
    near = [_nearest_here(places, pose, MOST_ITERATIONS) for pose in few]
    least = min(map(apart, near)) * (1.0 + ALIKE) + KEPT * places.length
    equal = [pose for pose in near if apart(pose) <= least]
    chosen = min(equal, key=lambda pose: _from_zero(places, pose))
    chosen = as_near_as_it_gets(places, chosen, MOST_ITERATIONS)
    return unwound(places, places.closed, chosen)


def unwound(places: Places, held: AbsoluteMechanism, pose: Floats) -> Floats:
    """Return a closed pose in which angles that nothing says are within half a turn.

    That is of zero, and then of the other body where a force follows the angle between two.
    """
    columns = {body: 3 * i + 2 for i, body in enumerate(places.closed.bodies)}
    for body, column in columns.items():
        pose = _turned_back(places, held, pose, body, pose[column])
    for element in places.scene.forces.values():
        first, second = (point.split(".")[0] for point in element.turns_counted() or ("", ""))
        angles = [pose[columns[one]] if one in columns else 0.0 for one in (first, second)]
        twist = angles[1] - angles[0]
        back = _turned_back(places, held, pose, second, twist)
        pose = _turned_back(places, held, pose, first, -twist) if back is pose else back
    return pose


def _turned_back(
    places: Places, held: AbsoluteMechanism, pose: Floats, body: str, angle: float
) -> Floats:
    """Return a pose with a body turned back by the whole turns of an angle, rad, if it may be."""
    turns = round(float(angle) / (2.0 * math.pi))
    if not turns or body not in places.closed.bodies:
        return pose
    group = _turning_with(places, body)
    back = pose.copy()
    back[[3 * places.closed.bodies.index(one) + 2 for one in group]] -= 2.0 * math.pi * turns
    said = places.scene.start.angles.keys() & set(group)
    return back if not said and places.is_closed(held, back) else pose


def in_given_turns(places: Places, pose: Floats) -> Floats:
    """Return a closed pose with whole turns added, so that angles are nearest to those given.

    Bodies turn with what they are fixed to or slide in; what drivers or gears hold stays.
    """
    for body, angle in places.scene.start.angles.items():
        columns = [3 * places.closed.bodies.index(one) + 2 for one in _turning_with(places, body)]
        turns = round((angle - float(pose[columns[0]])) / (2.0 * math.pi))
        turned = pose.copy()
        turned[columns] += 2.0 * math.pi * turns
        if turns and places.is_closed(places.closed, turned):
            pose = turned
    return pose


def hold(places: Places, pose: Floats) -> Floats:
    """Return a closed pose near another that keeps what it can of what is given, in its order.

    What that leaves free is as near as it can be to angles of zero, and slides to their middle.
    """
    kept: list[Given] = []
    for one in places.given:
        found = _with(places, pose, [*kept, one], 1)
        if found is not None:
            pose = found
            kept.append(one)
    return _settled(places, pose, kept)


def _turning_with(places: Places, body: str) -> list[str]:
    """Return a body and those that joints keep at an angle to it."""
    reached = [body]
    for here in reached:
        for joint in places.scene.joints.values():
            if joint.holds_angle and here in joint.bodies:
                reached += [one for one in joint.bodies if one not in [*reached, "ground"]]
    return reached


def _nearest_here(places: Places, pose: Floats, iterations: int) -> Floats:
    def levels(pose: Floats) -> list[Rows]:
        return [
            places.constraints(places.closed, pose),
            places.wanted(places.given, pose),
        ]

    found = approach(pose, levels, places.scale, 2, iterations)
    if places.is_closed(places.closed, found):
        return found
    return as_near_as_it_gets(places, pose, iterations)


def _with(places: Places, pose: Floats, kept: Sequence[Given], judged: int) -> Floats | None:
    """Return a closed pose that keeps some of what is given, and comes near the rest.

    None: it cannot. judged : 2 if steps must not take it farther from the rest; see `approach`.
    """
    rest = [one for one in places.given if one not in kept]

    def levels(pose: Floats) -> list[Rows]:
        hard, soft = places.constraints(places.closed, pose), places.wanted(kept, pose)
        first = Rows(
            np.concatenate([hard.value, soft.value]), np.concatenate([hard.jacobian, soft.jacobian])
        )
        return [first, places.wanted(rest, pose)]

    found = approach(pose, levels, places.scale, judged)
    if places.is_closed(places.closed, found) and places.keeps(kept, found):
        return found
    return None


def _settled(places: Places, pose: Floats, kept: Sequence[Given]) -> Floats:
    """Return a pose that keeps and comes near the same, but rests where that leaves it free.

    Bodies of which nothing is given turn towards zero, then slides go to their middle.
    """
    named, still = named_bodies(places.scene), [0.0] * len(pose)
    free = [3 * i + 2 for i, body in enumerate(places.closed.bodies) if body not in named]
    turning, angles = places.length * np.eye(len(pose))[free], np.arange(len(pose)) % 3 == 2
    farthest = distance(places.given, pose, np.zeros_like(pose)) * (1.0 + ALIKE)
    farthest += KEPT * places.length
    for _ in range(MOST_ITERATIONS):
        levels = [
            places.constraints(places.closed, pose),
            places.wanted(kept, pose),
            places.wanted((one for one in places.given if one not in kept), pose),
            Rows(applied(turning, pose), turning),
            Rows(*arrays(places.closed.slides(pose.tolist(), still), len(pose))),
        ]
        step = step_of(levels, places.scale)
        step *= min(1.0, LARGEST_TURN / max(float(np.abs(step[angles]).max()), 1e-300))
        found = _with(places, pose + step, kept, 2)
        if found is None or _from_zero(places, found) > (1.0 + KEPT) * _from_zero(places, pose):
            break
        if distance(places.given, found, np.zeros_like(pose)) > farthest:
            break
        pose = found
        if float(np.abs(step / places.scale).max()) < KEPT:
            break
    return pose


def named_bodies(scene: Scene) -> set[str]:
    """Return the bodies of which an angle or a point is given."""
    return {*scene.start.angles, *(name.split(".")[0] for name in scene.start.points)}


def _from_zero(places: Places, pose: Floats) -> float:
    """Return how far bodies of which nothing is given are from zero, rad and shortest links."""
    named = named_bodies(places.scene)
    turned = [
        math.remainder(float(pose[3 * i + 2]), 2.0 * math.pi)
        for i, body in enumerate(places.closed.bodies)
        if body not in named
    ]
    still = np.zeros_like(pose)
    for joint in places.closed.numbers.joints.values():
        if joint.freedom == "slide":
            between = places.closed.ends(joint.points, pose, still)
            turned.append(math.hypot(*between.gap) / places.length)
    return math.hypot(*turned)
