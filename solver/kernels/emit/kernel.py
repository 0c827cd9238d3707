"""A kernel: a scene's compiled equations, one method's step, and the layout they share."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from jointplay.solver.integrators import Method
from jointplay.solver.integrators.method import Rosenbrock
from jointplay.solver.kernels.emit import bends, closer_looks, implicit, inside, scanning, stepping
from jointplay.solver.kernels.emit.emit import FixedNodes, Tape, lane_function
from jointplay.solver.kernels.emit.functions import addresses_of
from jointplay.solver.kernels.emit.module import Module, load
from jointplay.solver.kernels.emit.slots import KEEPS_LEDGER, DenseRow, StepRow, slots_of
from jointplay.solver.kernels.emit.tapes import Source
from jointplay.solver.kernels.emit.turned_sines import TurnedSines
from jointplay.solver.kernels.layout import Layout
from jointplay.solver.kernels.target import own_target
from jointplay.solver.kernels.trace.equations import (
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

    module: Module
    lanes: int
    """Advanced at once."""
    layout: Layout
    row: DenseRow
    step_row: StepRow
    slots: NDArray[np.void]
    """Structure that compiled loops take as `at`; see `solver.kernels.emit.slots`."""
    coordinates: tuple[str, ...]
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
        return len(self.equations.ledger) - len(self.equations.drivers) - len(self.pairs)

    @cached_property
    def addresses(self) -> NDArray[np.void]:
        """The compiled functions, by name; see `solver.kernels.emit.functions`."""
        return addresses_of(self.module)


def compile_kernel(
    scene: Scene, tree: Tree, formulation: str, tableau: Method, lanes: int = 0
) -> Kernel:
    """Trace, emit and load the kernel of a scene's structure; seconds when it is not cached.

    `lanes` : that it advances at once; 0: as many as suit the processor. Raises what `trace` does.
    """
    equations = trace(scene, tree, formulation)
    rows, again = arrange(scene, equations), dict.fromkeys(needed_again(equations))
    fixed = FixedNodes(_layout(equations, rows, tableau, len(again)))
    tracer = implicit.RosenbrockTracer if isinstance(tableau, Rosenbrock) else stepping.StepTracer
    known = {node: f"again{i}" for i, node in enumerate(again)}
    steps = tracer(tableau, equations, fixed, known)
    lanes = lanes or own_target().lanes
    sources = _functions(steps, rows)
    layout, states, pairs = fixed.layout, equations.states, len(equations.pairs)
    row = DenseRow.of(len(equations.clocks), states, pairs)
    step_row = StepRow.of(len(equations.coordinates), states, pairs)
    counts = {
        "states": states,
        "inner_states": len(equations.inner_rates),
        "ledger": len(equations.ledger),
        "pairs": pairs,
        "clocks": len(equations.clocks),
        "rows": rows.scanned,
        "watched_closely": int(tableau.watched_closely),
    }
    return Kernel(
        load(sources, lanes),
        lanes,
        layout,
        row,
        step_row,
        slots_of(layout, row, step_row, counts),
        equations.coordinates,
        equations.pairs,
        rows,
        FixedNumbers(fixed.nodes),
        equations,
        tableau,
        steps.turned,
    )


def _layout(equations: Equations, rows: Rows, tableau: Method, again: int) -> Layout:
    """Give slots to all but a scene's numbers; `again` : number of values needed again."""
    layout, pairs = Layout(), len(equations.pairs)
    stepping.allocate(layout, equations.states, len(equations.ledger), pairs, tableau.stages)
    layout.add_block("again", again)
    layout.add_block("correction", len(equations.corrections))
    if isinstance(tableau, Rosenbrock):
        implicit.allocate(layout, equations.states)
    scanning.allocate(layout, rows.scanned, len(rows.rest))
    for name in ("slip_row", "penetration_row", "normal_row"):
        layout.add_block(name, pairs)
    layout.add_block("inner_row", len(equations.inner_rates))
    bends.allocate(layout, pairs)
    layout.add("may_look")
    for name in ("clock_start", "clock_travel", "clock_turn"):
        layout.add_block(name, len(equations.clocks))
    layout.add("numbers")  # from here on: what is constant during a period, copied as one piece
    for name in ("phase", "wound"):
        layout.add_block(name, len(equations.clocks))
    return layout


def _functions(steps: stepping.StepTracer, rows: Rows) -> list[Source]:
    """Return the sources of a kernel's functions."""
    equations, layout, fixed, known = steps.equations, steps.layout, steps.fixed, steps.known
    observed = [(f"channel{i}", equations.channels[name]) for i, name in enumerate(rows.names)]
    scanned, rest = observed[: rows.scanned], observed[rows.scanned :]
    energies = [
        ("potential", equations.channels["energy.potential"]),
        ("stored", equations.channels["stored"]),
    ]
    closely = steps.tableau.watched_closely or bool(equations.inner_rates)
    return [
        _slope_function(steps),
        _right_hand_side(steps),
        lane_function("observe", scanned, layout, fixed, known),
        lane_function("observe_rest", rest, layout, fixed, known),
        lane_function("weigh", energies, layout, fixed, known),
        *steps.source(energies),
        *scanning.source(layout, rows.scanned),
        bends.source(layout, steps.pairs),
        closer_looks.source(layout, steps.pairs, always=closely),
        *inside.source(equations, steps.dense(), scanned, rest, layout, fixed),
    ]


def _slope_function(steps: stepping.StepTracer) -> Source:
    """Return the source of slopes(W, row), which writes slopes where a stage's are kept.

    `row` : slots from those of the first stage.
    """
    equations = steps.equations
    held = equations.tracer.held.values()
    known = {node: f"inverse_rate{j}" for j, node in enumerate(held)}
    tape = Tape(steps.layout, steps.fixed, known)
    steps.turned.turn(tape)
    tape.store_rows([(f"k1_{i}", rate) for i, rate in equations.slopes])
    tape.go_on_where(equations.tracer.variable(KEEPS_LEDGER))
    tape.store_rows([(f"kledger1_{i}", rate) for i, rate in enumerate(equations.ledger)])
    return tape.function("slopes", "row")


def _right_hand_side(steps: stepping.StepTracer) -> Source:
    """Return the source of right_hand_side(W); the ledger's rates only where they are wanted."""
    equations = steps.equations
    again = [(slot, node) for node, slot in steps.known.items()]
    tape = Tape(steps.layout, steps.fixed)
    tape.store([*right_hand_side(equations), *again, *steps.knots.at_end()])
    tape.go_on_where(equations.tracer.variable(KEEPS_LEDGER))
    tape.store([(f"ledger{i}", rate) for i, rate in enumerate(equations.ledger)])
    return tape.function("right_hand_side")
