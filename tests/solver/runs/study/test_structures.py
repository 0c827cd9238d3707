"""Points of one structure have the same kernel, those of different structures do not."""

from itertools import product

from jointplay.solver.kernels.emit.emit import FixedNodes, lane_function
from jointplay.solver.kernels.emit.tapes import Source
from jointplay.solver.kernels.layout import Layout
from jointplay.solver.kernels.trace.equations import trace
from jointplay.solver.mechanics.tree import spanning_tree
from jointplay.solver.scene.document import Scene
from tests.solver.runs.study.jobs_of_studies import PRESS, SWEEP, study


def right_hand_side(scene: Scene) -> Source:
    """Return the generated source of a scene's right-hand side."""
    layout = Layout()
    equations = trace(scene, spanning_tree(scene), "reduced")
    slopes = [(f"slope{i}", rate) for i, rate in equations.slopes]
    names = dict.fromkeys(name for name, _ in slopes)
    variables = [f"stage{i}" for i in range(2 * len(equations.coordinates))]
    play = range(len(equations.pairs))
    modes = [name for j in play for name in (f"mode{j}", f"impact_rate{j}")]
    phases = [f"phase{k}" for k in range(len(equations.drivers))]
    for name in (*names, *variables, *modes, *phases, "stage_time"):
        layout.add(name)
    return lane_function("f", slopes, layout, FixedNodes(layout))


def test_points_have_the_same_source_if_and_only_if_they_have_the_same_structure() -> None:
    grid = {"friction": [0.0, 0.1, 0.2], "exponent": [1.5, 1.3, 1.2], "gravity_y": [0.0, 1.0]}
    found = study(SWEEP, grid=grid, scene=PRESS)
    sources = [right_hand_side(found.point_scene(point)) for point in range(found.points)]
    for one, other in product(range(found.points), repeat=2):
        alike = bool(found.structure[one] == found.structure[other])
        assert (sources[one] == sources[other]) is alike, (found.values[one], found.values[other])
