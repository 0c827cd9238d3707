"""The constraints of the ideal mechanism where it starts."""

from typing import NamedTuple

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.mechanics.absolute import AbsoluteMechanism
from jointplay.solver.mechanics.assembly import assemble, shortest_link
from jointplay.solver.mechanics.closing import arrays
from jointplay.solver.mechanics.rows import Row
from jointplay.solver.mechanics.start.guess import first_clocks
from jointplay.solver.mechanics.view import view
from jointplay.solver.scene.document import Scene


class ConstraintsAtStart(NamedTuple):
    """A mechanism with all play closed, and its rows at the start."""

    ideal: AbsoluteMechanism
    rows: list[Row]
    jacobian: Floats
    """(rows, 3 bodies), by what is in `scale`."""
    scale: Floats
    """(3 bodies,): shortest links, m, and radians."""


def constraints_at_start(scene: Scene) -> ConstraintsAtStart:
    """Return the constraints of a scene that closes."""
    ideal = AbsoluteMechanism(scene, view(scene), close_play=True)
    pose, length = assemble(scene).pose, shortest_link(scene)
    scale = np.tile([length, length, 1.0], len(ideal.bodies))
    rows = ideal.rows(pose, np.zeros_like(pose), first_clocks(scene))
    return ConstraintsAtStart(ideal, rows, arrays(rows, len(pose))[1] * scale, scale)
