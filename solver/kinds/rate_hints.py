"""Hints at bodies that start far faster than anything that the scene gives."""

import math
from collections.abc import Iterator

from jointplay.records.failure import Problem
from jointplay.solver.kinds.start_hints import DIGITS
from jointplay.solver.mechanics.assembly import assemble, shortest_link
from jointplay.solver.mechanics.start.states import mechanism_size
from jointplay.solver.scene.document import Scene

FAR = 100.0
"""Times as fast as what is given, from which on a start is told to be next to a dead point."""


def fast_starts(scene: Scene) -> Iterator[Problem]:
    """Yield the fastest body of a start that nothing drives, if it is far faster than given rates.

    A given rate stands for all rates that links of the mechanism's sizes make of it.
    """
    start, length = scene.start, shortest_link(scene)
    size = mechanism_size(scene, length)
    turns = {f"/start/angular_velocities/{b}": abs(w) for b, w in start.angular_velocities.items()}
    moves = {f"/start/velocities/{b}": math.hypot(*v) for b, v in start.velocities.items()}
    if scene.drivers or start.joints or start.guides or not any({**turns, **moves}.values()):
        return
    fastest, quickest = max(moves.values(), default=0.0), max(turns.values(), default=0.0)
    velocity = max(fastest, quickest * size)
    turning = max(quickest, fastest / length)
    rates = assemble(scene).velocity.reshape(-1, 3).tolist()
    shares = [max(math.hypot(u, v) / velocity, abs(w) / turning) for u, v, w in rates]
    share = max(shares)
    if share > FAR:
        at = shares.index(share)
        body, (u, v, w) = [*scene.bodies][at], rates[at]
        yield Problem(
            max(turns or moves, key={**turns, **moves}.__getitem__),
            f"'{body}' starts at {math.hypot(u, v):.{DIGITS}g} m/s and {w:.{DIGITS}g} rad/s, as the"
            " mechanism starts next to a dead point, where a little of one motion is much of"
            f" another. Give the rate of '{body}' instead, or start farther from the dead point.",
        )
