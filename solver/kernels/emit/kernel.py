"""A kernel: a scene's compiled equations, one method's step, and the layout they share."""

from dataclasses import dataclass
from functools import cached_property
from types import ModuleType

import numpy as np
from numpy.typing import NDArray

from jointplay.solver.integrators import Method
from jointplay.solver.integrators.method import Rosenbrock
from jointplay.solver.kernels.cache import load
from jointplay.solver.kernels.emit import (
    bends,
    closer_looks,
    implicit,
    inside,
    scanning,
    stepping,
)
from jointplay.solver.kernels.emit.emit import (
    FixedNodes,
    Outputs,
    Tape,
    lane_function,
    module_source,
)
from jointplay.solver.kernels.emit.functions import addresses_of
from jointplay.solver.kernels.emit.slots import DenseRow, StepRow, slots_of
from jointplay.solver.kernels.emit.turned_sines import TurnedSines
from jointplay.solver.kernels.layout import Layout
from jointplay.solver.kernels.target import own_target
from jointplay.solver.kernels.trace.equations import (
    KEEPS_LEDGER,
    Equations,
    needed_again,
    right_hand_side,
    trace,
)
from jointplay.solver.kernels.trace.fixed_numbers import FixedNumbers
from jointplay.solver.kernels.trace.rows import Rows, arrange
from jointplay.solver.mechanics.tree import Tree
from jointplay.solver.scene.document import Scene


@dataclass(frozen=True, eq=False)
class Kernel:
    """Compiled functions over one work array, and what the slots mean."""

    module: ModuleType
    lanes: int
    """Advanced at once."""
    layout: Layout
    row: DenseRow
    step_row: StepRow
    slots: NDArray[np.void]
    """Structure that compiled loops take as `at`; see `solver.kernels.emit.slots`."""
    coordinates: tuple[str, ...]
    drivers: tuple[str, ...]
    clocks: tuple[str, ...]
    pairs: tuple[str, ...]
    rows: Rows
    """Channels of the ``channel`` block."""
    fixed: FixedNumbers
    """Numbers that depend on those of the scene alone."""
    equations: Equations
    tableau: Method
    turned: TurnedSines
    """Sines in slopes."""

    @property
    def states(self) -> int:
        """Number of states; coordinates and speeds come first."""
        return self.equations.states

    @property
    def losses(self) -> int:
        """Terms of the ledger before the drivers' works and the pairs' impulses."""
        return len(self.equations.ledger) - len(self.drivers) - len(self.pairs)

    @cached_property
    def addresses(self) -> NDArray[np.void]:
        """The compiled functions, by name; see `solver.kernels.emit.functions`."""
        return addresses_of(self.module)


def compile_kernel(
    scene: Scene, tree: Tree, formulation: str, tableau: Method, lanes: int = 0
) -> Kernel:
    """Trace, emit and load the kernel of a scene's structure; seconds when it is not cached.

    `lanes` : that it advances at once; 0: as many as suit the processor.

    Raises
    ------
    LimitExceeded
        The scene's equations are too long to compile.
    """
    equations = trace(scene, tree, formulation)
    layout = Layout()
    states, pairs = equations.states, len(equations.pairs)
    clocks = len(equations.clocks)
    ledger = len(equations.ledger)
    stepping.allocate(layout, states, ledger, pairs, tableau.stages)
    again = needed_again(equations)
    layout.add_block("again", len(again))
    known = {node: f"again{i}" for i, node in enumerate(again)}
    layout.add_block("correction", len(equations.corrections))
    if isinstance(tableau, Rosenbrock):
        implicit.allocate(layout, states)
    rows = arrange(scene, equations)
    scanning.allocate(layout, rows.scanned, len(rows.rest))
    layout.add_block("slip_row", pairs)
    layout.add_block("penetration_row", pairs)
    layout.add_block("normal_row", pairs)
    inner = states - 2 * len(equations.coordinates)
    layout.add_block("inner_row", inner)
    bends.allocate(layout, pairs)
    for name in ("clock_start", "clock_travel", "clock_turn"):
        layout.add_block(name, clocks)
    layout.add("numbers")  # from here on: what is constant during a period, copied as one piece
    layout.add_block("phase", clocks)
    layout.add_block("wound", clocks)
    fixed = FixedNodes(layout)
    steps = (
        implicit.RosenbrockTracer(tableau, equations, fixed, ledger, layout, known)
        if isinstance(tableau, Rosenbrock)
        else stepping.StepTracer(tableau, equations, ledger, layout, known)
    )
    observed = [(f"channel{i}", equations.channels[name]) for i, name in enumerate(rows.names)]
    energies = [
        ("potential", equations.channels["energy.potential"]),
        ("stored", equations.channels["stored"]),
    ]
    evaluated = right_hand_side(equations) + [(known[node], node) for node in again]
    evaluated += steps.knots.at_end()
    scanned, rest = observed[: rows.scanned], observed[rows.scanned :]
    lanes = lanes or own_target().lanes
    source = module_source(
        [
            _slope_function(equations, layout, fixed, steps.turned),
            _right_hand_side(equations, evaluated, layout, fixed),
            lane_function("observe", scanned, layout, fixed, known),
            lane_function("observe_rest", rest, layout, fixed, known),
            lane_function("weigh", energies, layout, fixed, known),
            steps.source(energies, fixed),
            scanning.source(layout, rows.scanned),
            bends.source(layout, pairs),
            closer_looks.source(layout, pairs, always=tableau.watched_closely or inner > 0),
            inside.source(equations, steps.dense(), scanned, rest, layout, fixed),
        ],
        lanes,
    )
    row = DenseRow.of(clocks, states, pairs)
    step_row = StepRow.of(len(equations.coordinates), states, pairs)
    counts = {
        "states": states,
        "inner_states": inner,
        "ledger": ledger,
        "pairs": pairs,
        "clocks": clocks,
        "rows": rows.scanned,
        "watched_closely": int(tableau.watched_closely),
    }
    return Kernel(
        load(source),
        lanes,
        layout,
        row,
        step_row,
        slots_of(layout, row, step_row, counts),
        equations.coordinates,
        equations.drivers,
        equations.clocks,
        equations.pairs,
        rows,
        FixedNumbers({layout[f"fixed{index}"]: node for index, node in fixed.nodes.items()}),
        equations,
        tableau,
        steps.turned,
    )


def _slope_function(
    equations: Equations, layout: Layout, fixed: FixedNodes, turned: TurnedSines
) -> str:
    """Return the source of slopes(W, row), which writes slopes where a stage's are kept.

    `row` : slots from those of the first stage.
    """
    held = equations.tracer.held.values()
    tape = Tape(layout, fixed, {node: f"inverse_rate{j}" for j, node in enumerate(held)})
    turned.turn(tape)
    tape.store_rows([(f"k1_{i}", rate) for i, rate in equations.slopes])
    tape.go_on_where(equations.tracer.variable(KEEPS_LEDGER))
    tape.store_rows([(f"kledger1_{i}", rate) for i, rate in enumerate(equations.ledger)])
    return tape.function("slopes", "row")


def _right_hand_side(
    equations: Equations, outputs: Outputs, layout: Layout, fixed: FixedNodes
) -> str:
    """Return the source of right_hand_side(W); the ledger's rates only where they are wanted."""
    tape = Tape(layout, fixed)
    tape.store(outputs)
    tape.go_on_where(equations.tracer.variable(KEEPS_LEDGER))
    tape.store([(f"ledger{i}", rate) for i, rate in enumerate(equations.ledger)])
    return tape.function("right_hand_side")
