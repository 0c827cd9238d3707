"""Functions that refuse the argument at which a run stopped."""

from collections.abc import Iterator

import numpy as np

from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.laws.force import Ends
from jointplay.solver.laws.function import Function
from jointplay.solver.mechanics.absolute import AbsoluteMechanism
from jointplay.solver.mechanics.courses import acting_between
from jointplay.solver.mechanics.view import view
from jointplay.solver.scene.clocks import clocks
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.domains import bounded_courses, bounded_motions

NEAR = 1e-6
"""Share of its span within which an argument is taken to be about to leave."""
POSE, RATES = ("x", "y", "theta"), ("vx", "vy", "omega")


def left_domain(bundle: Bundle, lane: int, scene: Scene) -> str:
    """Return which driver or force a lane stopped at for its function's sake; empty: none.

    Its argument is at an end of what the function is given for, and on its way out.
    """
    time = bundle.lane(lane).time
    found = [(f"the motion of driver '{n}'", f, time, 1.0) for n, f in bounded_motions(scene)]
    for what, function, at, rate in [*found, *_arguments(bundle, lane, scene)]:
        first, last = function.domain or (0.0, 0.0)
        near = NEAR * (last - first)
        if (at - first <= near and rate <= 0.0) or (last - at <= near and rate >= 0.0):
            return (
                f"{what} is given from {first:g} to {last:g}, where its argument came to"
                f" {at:.6g}, and refuses others. Give more knots, or another 'outside'"
            )
    return ""


def _arguments(
    bundle: Bundle, lane: int, scene: Scene
) -> Iterator[tuple[str, Function, float, float]]:
    """Yield which course of a force it is, the course, its argument and that argument's rate.

    The rate is 0 where it is not known: the argument is a rate itself.
    """
    courses = bounded_courses(scene)
    if not courses:
        return
    rows, stopped = bundle.kernel.rows, bundle.lane(lane)
    columns = [[f"{b}.{n}" for b in scene.bodies for n in names] for names in (POSE, RATES)]
    indices = np.array([rows.index(name) for names in columns for name in names], np.int64)
    q, v = np.split(bundle.observe(lane, stopped.row(), indices)[0], 2)
    numbers = view(scene)
    mechanism = AbsoluteMechanism(scene, numbers, close_play=False)

    def ends(first: str, second: str) -> Ends:
        return mechanism.ends((first, second), q, v)

    now = {name: clock.start + clock.rate * stopped.time for name, clock in clocks(scene).items()}
    for name, course in courses.items():
        acting, over = acting_between(numbers, name, ends, now), scene.forces[name].follows()
        in_time = over is not None and over.quantity == "time"
        rate = 1.0 if in_time else float(acting.argument_rate)
        yield f"the course of force '{name}'", course, float(acting.argument), rate
