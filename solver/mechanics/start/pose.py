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
from jointplay.solver.mechanics.closing import NEAR, arrays, part_taken
from jointplay.solver.mechanics.start.closings import alike
from jointplay.solver.mechanics.start.demands import KEPT, Demands
from jointplay.solver.mechanics.start.given import Given, Rows, distance
from jointplay.solver.mechanics.start.levels import MOST_ITERATIONS, approach, step_of
from jointplay.solver.mechanics.start.out_of_reach import as_near_as_it_gets

FAR = 1e-3
"""From which on other assemblies are sought: drawings give three digits."""
ALIKE = 1e-6
"""Relative difference of distances up to which two assemblies are equally near."""

ROUGHLY, FEW = 6, 8
"""Steps towards what is given after which poses are sorted, and how many different ones go on."""


def nearest(demands: Demands, poses: Iterable[Floats]) -> Floats:
    """Return the closed pose nearest to what is given, of those near each of some closed ones."""

    def apart(pose: Floats) -> float:
        return distance(demands.given, pose, np.zeros_like(pose))

    found = [_nearest_here(demands, pose, ROUGHLY) for pose in poses]
    few: list[Floats] = []
    for pose in sorted(found, key=apart):
        if len(few) < FEW and not any(alike(pose, other, demands.scale, NEAR) for other in few):
            few.append(pose)
    near = [_nearest_here(demands, pose, MOST_ITERATIONS) for pose in few]
    least = min(map(apart, near)) * (1.0 + ALIKE) + KEPT * demands.length
    equal = [pose for pose in near if apart(pose) <= least]
    chosen = min(equal, key=lambda pose: _from_zero(demands, pose))
    chosen = as_near_as_it_gets(demands, chosen, MOST_ITERATIONS)
    return unwound(demands, demands.closed, chosen)


def unwound(demands: Demands, held: AbsoluteMechanism, pose: Floats) -> Floats:
    """Return a closed pose in which angles that nothing says are within half a turn.

    That is of zero, and then of the other body where a force follows the angle between two.
    """
    columns = {body: 3 * i + 2 for i, body in enumerate(demands.closed.bodies)}
    for body, column in columns.items():
        pose = _turned_back(demands, held, pose, body, pose[column])
    for element in demands.scene.forces.values():
        first, second = (point.split(".")[0] for point in element.turns_counted() or ("", ""))
        angles = [pose[columns[one]] if one in columns else 0.0 for one in (first, second)]
        twist = angles[1] - angles[0]
        back = _turned_back(demands, held, pose, second, twist)
        pose = _turned_back(demands, held, pose, first, -twist) if back is pose else back
    return pose


def _turned_back(
    demands: Demands, held: AbsoluteMechanism, pose: Floats, body: str, angle: float
) -> Floats:
    """Return a pose with a body turned back by the whole turns of an angle, rad, if it may be."""
    turns = round(float(angle) / (2.0 * math.pi))
    if not turns or body not in demands.closed.bodies:
        return pose
    group = _turning_with(demands, body)
    back = pose.copy()
    back[[3 * demands.closed.bodies.index(one) + 2 for one in group]] -= 2.0 * math.pi * turns
    said = demands.scene.start.angles.keys() & set(group)
    return back if not said and demands.is_closed(held, back) else pose


def in_given_turns(demands: Demands, pose: Floats) -> Floats:
    """Return a closed pose with whole turns added, so that angles are nearest to those given.

    Bodies turn with what they are fixed to or slide in; what drivers or gears hold stays.
    """
    for body, angle in demands.scene.start.angles.items():
        columns = [3 * demands.closed.bodies.index(one) + 2 for one in _turning_with(demands, body)]
        turns = round((angle - float(pose[columns[0]])) / (2.0 * math.pi))
        turned = pose.copy()
        turned[columns] += 2.0 * math.pi * turns
        if turns and demands.is_closed(demands.closed, turned):
            pose = turned
    return pose


def hold(demands: Demands, pose: Floats) -> Floats:
    """Return a closed pose near another that keeps what it can of what is given, in its order.

    What that leaves free is as near as it can be to angles of zero, and slides to their middle.
    """
    kept: list[Given] = []
    for one in demands.given:
        found = _with(demands, pose, [*kept, one], 1)
        if found is not None:
            pose = found
            kept.append(one)
    return _settled(demands, pose, kept)


def _turning_with(demands: Demands, body: str) -> list[str]:
    """Return a body and those that joints keep at an angle to it."""
    reached = [body]
    for here in reached:
        for joint in demands.scene.joints.values():
            if joint.holds_angle and here in joint.bodies:
                reached += [one for one in joint.bodies if one not in [*reached, "ground"]]
    return reached


def _nearest_here(demands: Demands, pose: Floats, iterations: int) -> Floats:
    def levels(pose: Floats) -> list[Rows]:
        return [
            demands.constraints(demands.closed, pose),
            demands.wanted(demands.given, pose),
        ]

    found = approach(pose, levels, demands.scale, 2, iterations)
    if demands.is_closed(demands.closed, found):
        return found
    return as_near_as_it_gets(demands, pose, iterations)


def _with(demands: Demands, pose: Floats, kept: Sequence[Given], judged: int) -> Floats | None:
    """Return a closed pose that keeps some of what is given, and comes near the rest.

    None: it cannot. judged : 2 if steps must not take it farther from the rest; see `approach`.
    """
    rest = [one for one in demands.given if one not in kept]

    def levels(pose: Floats) -> list[Rows]:
        hard, soft = demands.constraints(demands.closed, pose), demands.wanted(kept, pose)
        first = Rows(
            np.concatenate([hard.value, soft.value]), np.concatenate([hard.jacobian, soft.jacobian])
        )
        return [first, demands.wanted(rest, pose)]

    found = approach(pose, levels, demands.scale, judged)
    if demands.is_closed(demands.closed, found) and demands.keeps(kept, found):
        return found
    return None


def _settled(demands: Demands, pose: Floats, kept: Sequence[Given]) -> Floats:
    """Return a pose that keeps and comes near the same, but rests where that leaves it free.

    Bodies of which nothing is given turn towards zero, then slides go to their middle.
    """
    free, still = demands.free_angles, [0.0] * len(pose)
    turning = demands.length * np.eye(len(pose))[free]
    farthest = distance(demands.given, pose, np.zeros_like(pose)) * (1.0 + ALIKE)
    farthest += KEPT * demands.length
    for _ in range(MOST_ITERATIONS):
        levels = [
            demands.constraints(demands.closed, pose),
            demands.wanted(kept, pose),
            demands.wanted((one for one in demands.given if one not in kept), pose),
            Rows(applied(turning, pose), turning),
            Rows(*arrays(demands.closed.slides(pose.tolist(), still), len(pose))),
        ]
        step = step_of(levels, demands.scale)
        step *= part_taken(step)
        found = _with(demands, pose + step, kept, 2)
        if found is None or _from_zero(demands, found) > (1.0 + KEPT) * _from_zero(demands, pose):
            break
        if distance(demands.given, found, np.zeros_like(pose)) > farthest:
            break
        pose = found
        if float(np.abs(step / demands.scale).max()) < KEPT:
            break
    return pose


def _from_zero(demands: Demands, pose: Floats) -> float:
    """Return how far bodies of which nothing is given are from zero, rad and shortest links."""
    turned = [math.remainder(float(pose[i]), 2.0 * math.pi) for i in demands.free_angles]
    still = np.zeros_like(pose)
    for joint in demands.closed.numbers.joints.values():
        if joint.freedom == "slide":
            between = demands.closed.ends(joint.points, pose, still)
            turned.append(math.hypot(*between.gap) / demands.length)
    return math.hypot(*turned)
