"""The velocities at the start: given rates hold where the joints allow it, the rest is fitted.

In this order: ideal joints, drivers and the rates of `start.joints` and `start.guides`; angular
velocities and velocities as given, those that do not hold all together in the scene's order; joints
with play, whose parts move with one another unless a body of theirs is thrown, by a velocity of its
centre, or a follower is away from its cam; bodies of which nothing is given do not turn, then
others do not; slides rest; at last centres rest. A rate that is possible only where something else
moves more than a million times as fast, as at a dead point, does not hold.
"""

from collections.abc import Iterator

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.mechanics.closing import arrays
from jointplay.solver.mechanics.rows import Row
from jointplay.solver.mechanics.start.demands import KEPT, Demands
from jointplay.solver.mechanics.start.given import Given, Rows, given_rates, without_rounding
from jointplay.solver.mechanics.start.levels import Steps, off
from jointplay.solver.quantities.scalars import greatest

HOLDS = 1e-12
"""Share of the largest rate that is given or driven by which one that holds may be off."""
DEAD_POINT = 1e-6
"""Least share of other rates that a rate may be. A pose at a dead point is off by up to the root of
rounding, 1e-8."""


def start_rates(demands: Demands, pose: Floats) -> tuple[Floats, list[Given]]:
    """Return the rates of a pose, (3 bodies,), and what is given of them.

    Where nothing is, drivers may have the speeds of many points: then (3 bodies, points).
    """
    given = given_rates(demands.closed, demands.length)
    still = np.zeros_like(pose)
    rows = demands.closed.rows(pose.tolist(), still.tolist(), demands.driven)
    hard = [row for row in rows if _is_hard(demands, row)]
    soft = [row for row in rows if not _is_hard(demands, row) and _moves_along(demands, row)]
    held = _rates(hard, pose)
    wanted = {one.pointer: one.rows(pose, still) for one in given}
    every = [held, *wanted.values()]
    size = greatest(np.abs(rows.value).max(axis=0, initial=0.0) for rows in every)
    rest: list[Rows] = []
    together = Rows.joined([*wanted.values()], len(pose))
    if len(wanted) > 1 and _hold(held, together, demands.scale, size):
        held, wanted = Rows.joined([held, together], len(pose)), {}
    for also in wanted.values():
        if _hold(held, also, demands.scale, size):
            held = Rows.joined([held, also], len(pose))
        else:
            rest.append(also)
    slides = demands.closed.slides(pose.tolist(), still.tolist())
    levels = [held, Rows.joined(rest, len(pose)), _rates(soft, pose)]
    levels += [*_still(demands, pose), _rates(slides, pose)]
    steps = Steps([rows.jacobian for rows in levels], demands.scale, DEAD_POINT)
    velocity = steps.step([rows.value for rows in levels])
    # once more, from there: what is left is the rounding of the first
    left = [off(rows, velocity) for rows in levels]
    velocity = velocity + steps.step(left)
    without_rounding(given, velocity, HOLDS * size)
    return velocity, given


def _hold(held: Rows, also: Rows, scale: Floats, size: float) -> bool:
    """Whether rates that meet what is held meet other rows as well; all are of a size."""
    steps = Steps([held.jacobian, also.jacobian], scale, DEAD_POINT)
    velocity = steps.step([held.value, also.value])
    return all(
        bool(np.abs(off(rows, velocity)).max(initial=0.0) <= HOLDS * size) for rows in (held, also)
    )


def _rates(rows: list[Row], pose: Floats) -> Rows:
    """Return the rates at which rows are violated at rest, and how they change."""
    _, jacobian = arrays(rows, len(pose))
    rates = np.broadcast_arrays(*(row.rate for row in rows))
    return Rows(np.array(rates, np.float64), jacobian)


def _is_hard(demands: Demands, row: Row) -> bool:
    """Whether a row is of an ideal joint or a driver, or its rate is given."""
    start = demands.scene.start
    if row.joint in start.joints:
        return start.joints[row.joint].rate is not None
    if row.joint in start.guides:
        guided = start.guides[row.joint]
        return (guided.tilt_rate if row.part == "angle" else guided.rate) is not None
    return row.joint in demands.loose.joints or row.joint not in demands.scene.joints


def _moves_along(demands: Demands, row: Row) -> bool:
    """Whether the parts of a joint with play move with one another, if nothing else is said."""
    thrown = demands.scene.start.velocities
    joint = demands.scene.joints[row.joint]
    if any(body in thrown for body in joint.bodies):
        return False
    # a follower that is given a position away from its cam is not carried along
    return not joint.one_sided or bool(abs(row.value) <= KEPT * demands.length)


def _still(demands: Demands, pose: Floats) -> Iterator[Rows]:
    """Yield the rows that keep bodies from turning of which nothing is given, then the others."""
    start = demands.scene.start
    for named in ({*start.angular_velocities, *start.velocities}, set[str]()):
        columns = [3 * i + 2 for i, body in enumerate(demands.closed.bodies) if body not in named]
        yield Rows(np.zeros(len(columns)), demands.length * np.eye(len(pose))[columns])
