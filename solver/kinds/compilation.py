"""Seconds that compiling the equations of a job takes, before anything is compiled."""

from jointplay.records.failure import LimitExceeded
from jointplay.solver.kernels.trace.length import SURELY_SHORT, statements
from jointplay.solver.mechanics.assembly import assemble
from jointplay.solver.mechanics.tree import spanning_tree
from jointplay.solver.runs.admission import Admission
from jointplay.solver.runs.study.plan import Study

LINES = {"statement": 8, "state": 200, "pair": 1300}
"""Lines of the longest source for each statement of the equations, state, and contact pair: that of
the methods of order 8 or implicit, at most half as much again; others have down to half as many
lines, tangents a third."""
SECONDS_PER_LINE = 1.5e-4
"""Seconds of one core; measured: 0.08 to 0.11 ms (`python -m benchmarks compilation`)."""
SURELY_ENOUGH = 60.0
"""Seconds within which every scene of few bodies is compiled: tracing it would only cost time."""


def compile_seconds(admitted: Admission | Study) -> float:
    """Return the most that one source of an admitted job takes to compile, s of one core."""
    scene = admitted.point_scene(0) if isinstance(admitted, Study) else admitted.scene
    if not assemble(scene).freedom_with_play:
        return 0.0  # every pose is found without compiled equations
    tree = spanning_tree(scene)
    formulation = admitted.job["formulation"]
    count = 3 * len(scene.bodies) if formulation == "lagrange" else len(tree.coordinates)
    counts = {
        "statement": statements(scene, tree, formulation),
        "state": 2 * count,
        "pair": len(tree.pairs),
    }
    return SECONDS_PER_LINE * sum(lines * counts[what] for what, lines in LINES.items())


def check_compilation(admitted: Admission | Study, limit: float) -> None:
    """Refuse (LimitExceeded) a job whose equations take longer to compile than `limit`, s."""
    scene = admitted.scenes.base if isinstance(admitted, Study) else admitted.scene
    if len(scene.bodies) <= SURELY_SHORT and limit >= SURELY_ENOUGH:
        return
    seconds = compile_seconds(admitted)
    if seconds > limit:
        raise LimitExceeded.at(
            "/scene",
            f"Compiling the equations of this scene takes about {seconds:.2g} s; the limit is"
            f" {limit:g} s (JOINTPLAY_LONGEST_COMPILATION). Use fewer bodies.",
        )
