"""Tangent vectors: how a small deviation from a run grows, compiled from the run's own equations.

A tangent vector v of a lane is the derivative of its state along a direction of starts. It follows
the variational equation v' = J(y, t) v along the base's steps. No step is ever chosen for the
tangent's sake, and nothing that the run reads is written: a run with tangents has the same bits as
one without.

The functions live in a module of their own, over a layout that begins with all slots of the
kernel's.
"""

from copy import deepcopy
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from jointplay.solver.kernels.emit import kinks, tangent_step
from jointplay.solver.kernels.emit.emit import FixedNodes, Tape, lane_function
from jointplay.solver.kernels.emit.functions import addresses_of
from jointplay.solver.kernels.emit.judged_step import where_accepted
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.emit.kinks import Kinks
from jointplay.solver.kernels.emit.module import Module, load
from jointplay.solver.kernels.emit.slots import OF_TANGENTS
from jointplay.solver.kernels.emit.tapes import Source
from jointplay.solver.kernels.layout import Layout
from jointplay.solver.kernels.trace.derivative import Derivative
from jointplay.solver.kernels.trace.equations import Equations, numbered
from jointplay.solver.kernels.trace.fixed_numbers import FixedNumbers


@dataclass(frozen=True)
class Tangents:
    """Compiled tangent functions of a kernel, over its work array made longer."""

    module: Module
    layout: Layout
    slots: NDArray[np.void]
    """The kernel's, with those of tangents filled in."""
    fixed: FixedNumbers
    """Numbers that depend on those of the scene alone, beyond `Kernel.fixed`."""
    addresses: NDArray[np.void]
    """The kernel's functions and those of tangents."""


@lru_cache(maxsize=16)
def compile_tangents(kernel: Kernel) -> Tangents:
    """Derive, emit and load a kernel's tangent functions; seconds when they are not cached.

    Raises LimitExceeded if the derivatives are too long to compile.
    """
    equations, layout = kernel.equations, deepcopy(kernel.layout)
    piecewise = kinks.kinks_of(equations)
    allocate(layout, kernel.states, len(kernel.pairs), len(piecewise))
    fixed = FixedNodes(layout)
    sources = [
        kinks.kink_function(piecewise, along_motion(equations), layout, fixed),
        slope_function(kernel, piecewise, layout, fixed),
        *([] if equations.loops is None else [hold_function(equations, layout, fixed)]),
        *tangent_step.TangentTracer(equations, len(piecewise), layout).source(),
        penetration_function(equations, layout, fixed),
    ]
    slots = kernel.slots.copy()
    for name in OF_TANGENTS:
        slots[name] = layout.block(name).start
    module = load(sources, kernel.lanes)
    addresses = addresses_of(kernel.module, module)
    return Tangents(module, layout, slots, FixedNumbers(fixed.nodes), addresses)


def allocate(layout: Layout, states: int, pairs: int, piecewise: int) -> None:
    """Give slots to tangents, behind all that the kernel has."""
    for name in OF_TANGENTS:
        layout.add_block(name, states if name == "tangent" else pairs)
    kinks.allocate(layout, piecewise)
    tangent_step.allocate(layout, states)


def slope_function(kernel: Kernel, piecewise: Kinks, layout: Layout, fixed: FixedNodes) -> Source:
    """Return the source of carried_slopes(W): J w at a point that the step passes.

    That point has slots of its own: the base's stage holds the state to come.
    """
    equations, tracer = kernel.equations, kernel.equations.tracer
    along = {f"stage{i}": tracer.variable(f"carried{i}") for i in range(equations.states)}
    for j in range(len(equations.pairs)):
        along[f"impact_rate{j}"] = tracer.variable(f"tangent_impact_rate{j}")
    derivative = Derivative(along)
    kinks.take_mean_slopes(derivative, piecewise)
    passing = {f"stage{i}": f"passing{i}" for i in range(equations.states)}
    passing["stage_time"] = "passing_time"
    tape = Tape(layout, fixed, fetch=lambda name: f"load {layout[passing.get(name, name)]}")
    kernel.turned.turn(tape)
    # the slopes of coordinates are the carried speeds
    tape.store([(f"carried_slope{i}", derivative(rate)) for i, rate in equations.slopes])
    return tape.function("carried_slopes")


def hold_function(equations: Equations, layout: Layout, fixed: FixedNodes) -> Source:
    """Return the source of hold_tangent(W): in lanes that accept, the tangent keeps loops closed.

    At the state in the base's stage; the change is the least that takes away the derivatives of the
    loops' equations, and of their rates, along the tangent.
    """
    tracer, loops = equations.tracer, equations.loops
    assert loops is not None  # noqa: S101  (asked before)
    count = len(equations.coordinates)
    tangent = [tracer.variable(f"tangent{i}") for i in range(2 * count)]
    changes = loops.correction(loops.along(tangent[:count]))
    turned = [tracer.lift(old + new) for old, new in zip(tangent, changes, strict=False)]
    along = Derivative({f"stage{i}": w for i, w in enumerate([*turned, *tangent[count:]])})
    changes += loops.correction([along(tracer.lift(row.rate)) for row in loops.rows])
    moved = [
        (f"tangent{i}", w + change)
        for i, (w, change) in enumerate(zip(tangent, changes, strict=True))
    ]
    return lane_function("hold_tangent", where_accepted(moved), layout, fixed)


def along_motion(equations: Equations) -> Derivative:
    """Return the derivative in time at the state in the base's stage, whose slopes are known."""
    tracer = equations.tracer
    flow = {f"stage{i}": tracer.variable(f"slope{i}") for i in range(equations.states)}
    return Derivative(flow | {"stage_time": tracer.constant(1.0)})


def penetration_function(equations: Equations, layout: Layout, fixed: FixedNodes) -> Source:
    """Return the source of tangent_penetrations(W): what the latching of an impact rate needs.

    At the state just taken, which is still in the base's stage: the derivatives of each gap and of
    its rate along the tangent, and the derivative of the rate in time along the motion.
    """
    if not equations.penetrations:
        return Source("tangent_penetrations")
    tracer = equations.tracer
    states = equations.states
    tangent = Derivative({f"stage{i}": tracer.variable(f"tangent{i}") for i in range(states)})
    motion = along_motion(equations)
    rates = [(tangent(gap), tangent(rate), motion(rate)) for gap, rate in equations.penetrations]
    return lane_function("tangent_penetrations", numbered(OF_TANGENTS[2:], rates), layout, fixed)
