"""Whether a scene's equations are short enough to compile; asked before a job is queued."""

from __future__ import annotations

from jointplay.records.failure import LimitExceeded
from jointplay.solver.kernels.emit.emit import reachable
from jointplay.solver.kernels.record.equations import record, slopes
from jointplay.solver.kernels.record.recorder import MOST_STATEMENTS, too_many
from jointplay.solver.mechanics.tree import Tree
from jointplay.solver.scene.document import Scene

SURELY_SHORT = 7
"""Bodies up to which no scene comes near the limit: recording it would only cost time."""


def check_length(scene: Scene, tree: Tree, formulation: str) -> None:
    """Record a scene's equations and count their statements.

    Raises
    ------
    LimitExceeded
        More than can be compiled, with the count.
    """
    if len(scene.bodies) <= SURELY_SHORT:
        return
    equations = record(scene, tree, formulation)
    for expressions in ([e for _, e in slopes(equations)], equations.channels.values()):
        count = len(reachable(expressions))
        if count > MOST_STATEMENTS:
            raise LimitExceeded([too_many(count)])
