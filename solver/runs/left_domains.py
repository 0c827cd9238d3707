"""Functions that refuse the argument at which a run stopped."""

import numpy as np

from jointplay.solver.kernels.loop.bundle import Bundle
from jointplay.solver.laws.force import Ends
from jointplay.solver.mechanics.absolute import AbsoluteMechanism
from jointplay.solver.mechanics.courses import acting_between
from jointplay.solver.mechanics.view import view
from jointplay.solver.scene.clocks import clocks
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.domains import bounded_courses

NEAR = 1e-6
"""Share of its span within which an argument is taken to be about to leave."""
POSE, RATES = ("x", "y", "theta"), ("vx", "vy", "omega")


def left_domain(bundle: Bundle, lane: int, scene: Scene) -> str:
    """Return which force a lane stopped at for its course's sake, and where; empty: none."""
    courses = bounded_courses(scene)
    if not courses:
        return ""
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
        first, last = course.domain or (0.0, 0.0)
        at = float(acting_between(numbers, name, ends, now).argument)
        if min(at - first, last - at) <= NEAR * (last - first):
            return (
                f"the course of force '{name}' is given from {first:g} to {last:g}, where its"
                f" argument came to {at:.6g}, and refuses others. Give more knots, or another"
                " 'outside'"
            )
    return ""
