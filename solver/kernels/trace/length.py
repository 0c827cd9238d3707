"""Length of equations in traced statements, known before they are compiled."""

from jointplay.records.bounded_dict import BoundedDict
from jointplay.records.failure import LimitExceeded
from jointplay.solver.kernels.trace.equations import needed_again, trace
from jointplay.solver.kernels.trace.reachable import reachable
from jointplay.solver.kernels.trace.tracer import MOST_STATEMENTS, Tracer, too_many
from jointplay.solver.mechanics.tree import Tree
from jointplay.solver.mechanics.view import form
from jointplay.solver.scene.document import Scene

SURELY_SHORT = 7
"""Bodies up to which no scene comes near the limit: tracing it would only cost time."""
_MOST_KEPT = 64
"""Lengths that a process keeps: jobs of a batch differ in numbers, seldom in form."""
_lengths: BoundedDict[tuple[str, Tree, str], int | LimitExceeded] = BoundedDict(_MOST_KEPT)


def check_length(scene: Scene, tree: Tree, formulation: str) -> None:
    """Refuse (LimitExceeded) a scene whose equations have more statements than can be compiled."""
    if len(scene.bodies) > SURELY_SHORT:
        statements(scene, tree, formulation)


def statements(scene: Scene, tree: Tree, formulation: str) -> int:
    """Return how many statements slopes and channels take; raises what `check_length` does."""
    key = (form(scene), tree, formulation)
    if key not in _lengths:
        try:
            _lengths[key] = _counted(scene, tree, formulation)
        except LimitExceeded as error:
            _lengths[key] = LimitExceeded(error.problems)  # without the frames of this one
    found = _lengths[key]
    if isinstance(found, LimitExceeded):
        raise LimitExceeded(found.problems)
    return found


def _counted(scene: Scene, tree: Tree, formulation: str) -> int:
    # a third of what is traced may never be used; closing loops adds half as much again
    most = (3 if tree.closing else 2) * MOST_STATEMENTS
    equations = trace(scene, tree, formulation, Tracer(most))
    found = frozenset(needed_again(equations)) if tree.closing else frozenset()
    total = len(reachable(equations.corrections))
    for expressions, known in (
        ([*(rate for _, rate in equations.slopes), *equations.ledger], frozenset()),
        (equations.channels.values(), found),
    ):
        count = len(reachable(expressions, known))
        if count > MOST_STATEMENTS:
            raise too_many(count)
        total += count
    return total
