"""Tangent vectors: how a small deviation from a run grows, compiled from the run's own equations.

A tangent vector v of a lane is the derivative of its state along a direction of starts. Over a
step it follows the variational equation v' = J(y, t) v by the same method and the same step as the
state, which makes it the exact derivative of the step as a map, not only of the motion it
approximates. No step is ever chosen for the tangent's sake, and nothing that the run reads is
written: a run with tangents has the same bits as one without.

The functions live in a module of their own, over a layout that begins with all slots of the
kernel's.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from types import ModuleType

import numpy as np
from numpy.typing import NDArray

from solver.compiler.cache import load
from solver.compiler.derivative import Derivative
from solver.compiler.emit import DECORATOR, HEADER, FixedNodes, lane_function
from solver.compiler.equations import Equations
from solver.compiler.kernel import CompiledAddress, Kernel
from solver.compiler.layout import LANES, Layout
from solver.compiler.recorder import Expression, Recorder
from solver.compiler.slots import Slot, slots_of
from solver.integrators.tableau import Tableau
from solver.mechanics.scalars import select_positive


@dataclass(frozen=True)
class Tangents:
    """Compiled tangent functions of a kernel, over its work array made longer.

    Attributes
    ----------
    slots
        The kernel's, with those of tangents filled in; indexed by `solver.compiler.slots.Slot`.
    fixed
        Slot and expression of what depends on the scene's numbers alone, beyond `Kernel.fixed`.
    """

    module: ModuleType
    layout: Layout
    slots: NDArray[np.int64]
    fixed: tuple[tuple[int, Expression], ...]

    @cached_property
    def functions(self) -> tuple[CompiledAddress, CompiledAddress]:
        """`tangent_step` and `tangent_gaps`."""
        m = self.module
        return CompiledAddress(m.tangent_step), CompiledAddress(m.tangent_gaps)


def compile_tangents(kernel: Kernel, equations: Equations, tableau: Tableau) -> Tangents:
    """Derive, emit and load a kernel's tangent functions; seconds when they are not cached.

    `equations` and `tableau` are those that the kernel was compiled from.

    Raises
    ------
    LimitExceeded
        The derivatives are too long to compile.
    """
    layout = kernel.layout.copy()
    states, joints = kernel.states, len(kernel.play)
    allocate(layout, states, joints, tableau.stages)
    fixed = FixedNodes(layout)
    steps = TangentRecorder(tableau, states, layout)
    source = "\n\n".join(
        [
            HEADER,
            slope_function(equations, layout, fixed),
            steps.source(),
            gap_function(equations, layout, fixed),
        ]
    )
    slots = kernel.slots.copy()
    slots[Slot.TANGENT :] = slots_of(layout)[Slot.TANGENT :]
    return Tangents(
        load(source),
        layout,
        slots,
        tuple((layout[f"fixed{index}"], node) for index, node in fixed.nodes.items()),
    )


def allocate(layout: Layout, states: int, joints: int, stages: int) -> None:
    """Give slots to tangents, behind all that the kernel has."""
    layout.add_block("tangent", states)
    layout.add_block("tangent_impact_rate", joints)
    for j in range(joints):
        layout.add(f"tangent_gap{j}", f"tangent_gap_rate{j}", f"gap_acceleration{j}")
    layout.add("passing_time")  # the base's own stage is wanted again: it is the state to come
    layout.add_block("passing", states)
    layout.add_block("carried", states)
    layout.add_block("carried_slope", states)
    for s in range(1, stages - 1):
        layout.add_block(f"l{s}_", states)


class _Renamed(Layout):
    """A layout in which some quantities are found under other names."""

    def __init__(self, layout: Layout, names: dict[str, str]) -> None:
        super().__init__()
        self._layout, self._names = layout, names

    def __getitem__(self, name: str) -> int:
        return self._layout[self._names.get(name, name)]


def slope_function(equations: Equations, layout: Layout, fixed: FixedNodes) -> str:
    """Return the source of carried_slopes(W): J w at a stage that the step passed through."""
    recorder = equations.recorder
    count = len(equations.coordinates)
    along = {f"stage{i}": recorder.variable(f"carried{i}") for i in range(2 * count)}
    for j in range(len(equations.play)):
        along[f"impact_rate{j}"] = recorder.variable(f"tangent_impact_rate{j}")
    derivative = Derivative(along)
    outputs = [
        (f"carried_slope{i}", recorder.variable(f"carried{count + i}")) for i in range(count)
    ]
    outputs += [
        (f"carried_slope{count + i}", derivative(acceleration))
        for i, acceleration in enumerate(equations.accelerations)
    ]
    names = {f"stage{i}": f"passing{i}" for i in range(2 * count)} | {"stage_time": "passing_time"}
    return lane_function("carried_slopes", outputs, _Renamed(layout, names), fixed)


def gap_function(equations: Equations, layout: Layout, fixed: FixedNodes) -> str:
    """Return the source of tangent_gaps(W): what the latching of an impact rate needs.

    At the state just taken, which is still in the base's stage: the derivatives of each gap and of
    its rate along the tangent, and the derivative of the rate in time along the motion.
    """
    if not equations.gaps:
        return f"{DECORATOR}\ndef tangent_gaps(W):\n    pass\n"
    recorder = equations.recorder
    states = 2 * len(equations.coordinates)
    tangent = Derivative({f"stage{i}": recorder.variable(f"tangent{i}") for i in range(states)})
    flow = {f"stage{i}": recorder.variable(f"slope{i}") for i in range(states)}
    motion = Derivative(flow | {"stage_time": recorder.constant(1.0)})
    outputs = []
    for j, (gap, rate) in enumerate(equations.gaps):
        outputs += [
            (f"tangent_gap{j}", tangent(gap)),
            (f"tangent_gap_rate{j}", tangent(rate)),
            (f"gap_acceleration{j}", motion(rate)),
        ]
    return lane_function("tangent_gaps", outputs, layout, fixed)


class TangentRecorder:
    """Records the step of a tangent vector: the base's method over the base's stages."""

    def __init__(self, tableau: Tableau, states: int, layout: Layout) -> None:
        self.tableau, self.states, self.layout = tableau, states, layout
        self.recorder = Recorder()

    def source(self) -> str:
        """Return the source of tangent_step(W) and what it calls.

        It is called when a step has been judged and its lanes' fate is known, before it is taken:
        ``y`` and ``k<s>_`` are then those of the step, ``accept`` tells which lanes take it.
        """
        stages = range(1, self.tableau.stages)  # the last one belongs to the next step
        calls = [line for s in stages for line in (f"carry_{s}(W)", "carried_slopes(W)")]
        body = "\n    ".join(["def tangent_step(W):", *calls, "arrive(W)"])
        parts = [self._begin(), *(self._carry(s) for s in stages[1:]), self._arrive()]
        return "\n\n".join([*parts, f"{DECORATOR}\n{body}\n"])

    def _begin(self) -> str:
        """Stage 1, where the step begins: one long loop a block.

        Lane by lane, each copy would become a call.
        """
        at = {
            name: self.layout[name] * LANES
            for name in ("passing0", "y0", "carried0", "tangent0", "passing_time", "time")
        }
        return f"""{DECORATOR}
def carry_1(W):
    for i in range({self.states * LANES}):
        W[{at["passing0"]} + i] = W[{at["y0"]} + i]
    for i in range({self.states * LANES}):
        W[{at["carried0"]} + i] = W[{at["tangent0"]} + i]
    for l in range({LANES}):
        W[{at["passing_time"]} + l] = W[{at["time"]} + l]
"""

    def _weighted(self, weights: tuple[float, ...], slopes: list[str], i: int) -> Expression:
        total: Expression = self.recorder.constant(0.0)
        for weight, slope in zip(weights, slopes, strict=True):
            total = total + weight * self.recorder.variable(f"{slope}{i}")
        return total

    def _slopes(self, s: int) -> list[str]:
        """Names of the tangent's slopes at the stages before s, which is not the first."""
        return [*(f"l{j}_" for j in range(1, s - 1)), "carried_slope"]

    def _carry(self, s: int) -> str:
        """Stage s: the point that the base passed, and the tangent carried there."""
        v = self.recorder.variable
        weights, node = self.tableau.matrix[s - 1], self.tableau.nodes[s - 1]
        step = v("tried")
        outputs = [("passing_time", v("time") + node * step)]
        for i in range(self.states):
            base = self._weighted(weights, [f"k{j}_" for j in range(1, s)], i)
            own = self._weighted(weights, self._slopes(s), i)
            outputs.append((f"passing{i}", v(f"y{i}") + step * base))
            outputs.append((f"carried{i}", v(f"tangent{i}") + step * own))
            outputs.append((f"l{s - 1}_{i}", v(f"carried_slope{i}")))
        return lane_function(f"carry_{s}", outputs, self.layout)

    def _arrive(self) -> str:
        """Bring the tangent to the end of the step, in the lanes that take it."""
        v = self.recorder.variable
        outputs = []
        for i in range(self.states):
            total = self._weighted(self.tableau.matrix[-1], self._slopes(self.tableau.stages), i)
            moved = v(f"tangent{i}") + v("tried") * total
            kept: Expression = select_positive(v("accept"), moved, v(f"tangent{i}"))
            outputs.append((f"tangent{i}", kept))
        return lane_function("arrive", outputs, self.layout)
