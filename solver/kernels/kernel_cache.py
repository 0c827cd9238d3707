"""Kernels that a process keeps, each ready to run, with the loop around it."""

from jointplay.records.bounded_dict import BoundedDict
from jointplay.solver.integrators import AUTO, METHODS
from jointplay.solver.kernels import loop_code
from jointplay.solver.kernels.emit.kernel import Kernel, compile_kernel
from jointplay.solver.kernels.target import ALONE, own_target
from jointplay.solver.mechanics.tree import Tree, spanning_tree
from jointplay.solver.mechanics.view import form
from jointplay.solver.scene.document import Scene

MOST_KEPT = 16
"""Kernels that a process keeps for the next job: tracing the equations takes 20 ms and more."""
_kernels: BoundedDict[tuple[str, Tree, str, str, int], Kernel] = BoundedDict(MOST_KEPT)


def ready_kernel(
    scene: Scene, formulation: str, method: str = AUTO.name, *, alone: bool = False
) -> Kernel:
    """Return the kernel of a scene's structure, the loop ready, too; seconds when not cached.

    `method` : a name of `solver.integrators.METHODS`. `alone` : for a run without others beside it.

    Raises
    ------
    LimitExceeded
        The scene's equations are too long to compile.
    CompilationEnded
        Somebody watched the compilation, and it took too long or was not wanted any more.
    """
    tree = spanning_tree(scene)
    lanes = min(own_target().lanes, ALONE) if alone else own_target().lanes
    key = (form(scene), tree, formulation, method, lanes)
    if key in _kernels:
        return _kernels[key]
    aside = loop_code.begin(loop_code.FOR_RUNS)
    kernel = _kernels[key] = compile_kernel(scene, tree, formulation, METHODS[method], lanes)
    if aside is not None:
        loop_code.wait_for(aside)
    return kernel
