"""Runs that carry tangent vectors, and by how much those grew."""

from jointplay.records.arrays import Floats
from jointplay.solver.integrators import TSITOURAS5
from jointplay.solver.kernels.emit.kernel import compile_kernel
from jointplay.solver.kernels.emit.tangents import compile_tangents
from jointplay.solver.lanes.bundle import Bundle, LaneProblem
from jointplay.solver.mechanics.tree import spanning_tree
from jointplay.solver.scene.document import Scene


def problem(scene: Scene, duration: float, tolerance: float) -> LaneProblem:
    return LaneProblem(scene, duration, tolerance, duration, 0, 0, 0.0)


def bundle_of(problems: list[LaneProblem], *, carried: bool = True) -> Bundle:
    scene = problems[0].scene
    kernel = compile_kernel(scene, spanning_tree(scene), "reduced", TSITOURAS5)
    return Bundle(kernel, problems, tangents=compile_tangents(kernel) if carried else None)


def growth(bundle: Bundle, lane: int = 0) -> Floats:
    """Return the growth rows that a lane has handed out in the last call."""
    return bundle.growth(lane)


def grown(scene: Scene, duration: float, tolerance: float) -> Floats:
    """Run a scene; (periods, 2) end of time and logarithm of growth."""
    bundle = bundle_of([problem(scene, duration, tolerance)])
    bundle.advance(10**8)
    return growth(bundle)
