"""Last knots that points vary, of functions of an angle that repeat: they end the turn they give.

Reading a whole document moves such a knot to the end of the turn (`whole_turn`); the numbers of
points are written into a scene that was read before.
"""

import re
from collections.abc import Callable
from typing import Any

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.joints.cam import CamJoint
from jointplay.solver.laws.force.varying import Varying
from jointplay.solver.laws.function.whole_turn import whole_turn
from jointplay.solver.scene.document import Scene

KNOT = re.compile(r"(/(forces|joints)/([^/]+)/(?:course|profile)/knots)/(\d+)")


def ended_turn(scene: Scene, path: str, column: Floats, knot: Callable[[str], Floats]) -> Floats:
    """Return numbers that stand at a path, (points,), where one that ends a turn is moved there.

    `scene` : one of the points, checked. `column` : (points,) what is varied there. `knot` returns
    the numbers of all points at another path, (points,).
    """
    found = KNOT.fullmatch(path)
    function = _of_turns(scene, *found.group(2, 3)) if found else None
    if found is None or function is None or int(found[4]) != len(function.knots) - 1:
        return column
    knots = [knot(f"{found[1]}/{index}") for index in range(int(found[4]))]
    rows = np.stack([*knots, column], axis=1)
    numbers, which = np.unique(rows, axis=0, return_inverse=True)
    ends = [_last_knot(function, row) for row in numbers.tolist()]
    return np.array(ends, np.float64)[which.reshape(-1)]


def _last_knot(function: Any, knots: list[float]) -> float:
    """Return the last knot of a function that is read with these knots."""
    read: Any = whole_turn(function.model_copy(update={"knots": knots}))
    return float(read.knots[-1])


def _of_turns(scene: Scene, part: str, name: str) -> Any:
    """Return the function of an angle that a force or a cam has, with its knots; else none."""
    owner = getattr(scene, part).get(name)
    function = None
    if isinstance(owner, Varying) and owner.is_over_angle:
        function = owner.course
    elif isinstance(owner, CamJoint):
        function = owner.profile
    return function if getattr(function, "knots", None) else None
