"""Records one step of a Rosenbrock method: a Jacobian, its factors, stages, the ledger.

The Jacobian's columns are derivatives of the traced equations along one state each. The ledger,
which nothing feeds back on, is integrated by Lobatto's formula on the dense output.
"""

import math

from jointplay.solver.integrators.method import Rosenbrock
from jointplay.solver.kernels.emit.elimination import VECTORS
from jointplay.solver.kernels.emit.emit import Output, lane_function
from jointplay.solver.kernels.emit.stepping import StepTracer
from jointplay.solver.kernels.emit.tapes import Source
from jointplay.solver.kernels.emit.turned_sines import Angle
from jointplay.solver.kernels.layout import Layout
from jointplay.solver.kernels.trace.derivative import Derivative
from jointplay.solver.kernels.trace.tracer import Expression

INNER = (0.5 - math.sqrt(0.05), 0.5 + math.sqrt(0.05))
"""Nodes of Lobatto's formula of order six between the ends of a step."""
LOBATTO = (1.0 / 12.0, 5.0 / 12.0, 5.0 / 12.0, 1.0 / 12.0)


def allocate(layout: Layout, states: int) -> None:
    """Give slots to the linear equations of a step."""
    layout.add("direction_time")
    for name in VECTORS:
        layout.add_block(name, states)
    layout.add_block("factor", states**2)


class RosenbrockTracer(StepTracer):
    """Records the functions of a Rosenbrock method's step."""

    unweighed = 1
    tableau: Rosenbrock

    def _steps(self) -> list[Source]:
        stages = range(1, len(self.tableau.nodes) + 1)
        parts = [self._start(), self._product(), *self._linear()]
        parts += [self._point(s) for s in stages if s > 1]
        parts += [self._right(s) for s in stages]
        parts += [self._inner(1), self._inner(2), self._finish()]
        return parts

    def _turned(self) -> list[Angle]:
        return []  # its steps are long

    def _start(self) -> Source:
        outputs = [*self._tried(), *self._held()]
        outputs += [(f"stage{i}", self.variable(f"y{i}")) for i in range(self.states)]
        return self._function("start", [*outputs, ("stage_time", self.variable("time"))])

    def _product(self) -> Source:
        """Write product(W): the derivative of the slopes along the direction."""
        tracer, count = self.equations.tracer, self.coordinates
        along = {f"stage{i}": tracer.variable(f"direction{i}") for i in range(self.states)}
        derivative = Derivative(along | {"stage_time": tracer.variable("direction_time")})
        outputs = [(f"product{i}", tracer.variable(f"direction{count + i}")) for i in range(count)]
        outputs += [(f"product{i}", derivative(rate)) for i, rate in self.equations.slopes]
        return lane_function("product", outputs, self.layout, self.fixed)

    def _linear(self) -> tuple[Source, Source]:
        """Write jacobian(W), which leaves the factors of I - h γ J, and solve(W)."""
        n, tried, first = self.states, self.layout["tried"], self.layout["direction_time"]
        factorised = f"jacobian {n} {self.tableau.gamma!r} {tried} {first}"
        return Source("jacobian", (factorised,)), Source("solve", (f"solve {n} {first}",))

    def _moved(self, weights: tuple[float, ...], i: int, *, fresh: bool = False) -> Expression:
        """State i after h times a weighted sum of stages; the `fresh` last is in `right` still."""
        v, stages = self.variable, [f"k{s}_{i}" for s in range(2, len(weights) + 2)]
        if fresh:
            stages[-1] = f"right{i}"
        total = self._sum(weights, stages)
        return v(f"y{i}") + v("tried") * total

    def _stored(self, s: int) -> list[Output]:
        return [(f"k{s + 1}_{i}", self.variable(f"right{i}")) for i in range(self.states)]

    def _point(self, s: int) -> Source:
        """Go where stage s evaluates the slope; keep the stage before."""
        v, weights = self.variable, self.tableau.matrix[s - 1]
        outputs = [(f"stage{i}", self._moved(weights, i, fresh=True)) for i in range(self.states)]
        outputs.append(("stage_time", v("time") + self.tableau.nodes[s - 1] * v("tried")))
        return self._function(f"point_{s}", [*outputs, *self._stored(s - 1)])

    def _right(self, s: int) -> Source:
        """Set the right side of stage s."""
        v, gamma = self.variable, self.tableau.gamma
        outputs: list[Output] = []
        for i in range(self.states):
            total = v(f"k1_{i}") if s == 1 else self._inner_slope(i)
            total = total + (self.tableau.drifts[s - 1] * v("tried")) * v(f"drift{i}")
            for j, c in enumerate(self.tableau.couplings[s - 1], start=1):
                total = total + c * v(f"k{j + 1}_{i}")
            outputs.append((f"right{i}", gamma * total))
        return self._function(f"right_{s}", outputs)

    def _inner(self, number: int) -> Source:
        """Go to an inner node of the ledger's formula, and keep the ledger where it was."""
        v, theta = self.variable, INNER[number - 1]
        weights = tuple(
            sum(c * math.prod([theta] * (k + 1)) for k, c in enumerate(row))
            for row in self.tableau.dense[1:]
        )
        first = number == 1
        outputs = [(f"stage{i}", self._moved(weights, i, fresh=first)) for i in range(self.states)]
        outputs.append(("stage_time", v("time") + theta * v("tried")))
        if first:
            outputs += self._stored(len(self.tableau.nodes))
        else:
            outputs += self._kept_ledger(2)
        return self._function(f"inner_{number}", outputs)

    def _finish(self) -> Source:
        v = self.variable
        outputs = [(f"stage{i}", self._moved(self.tableau.weights, i)) for i in range(self.states)]
        outputs += [("stage_time", v("time") + v("tried")), ("arrival", v("time") + v("tried"))]
        return self._function("finish", outputs + self._kept_ledger(3))

    def _slope(self, s: int, i: int) -> str:
        return f"k{s}_{i}"

    def _inner_slope(self, i: int) -> Expression:
        """Slope of state i at the point just evaluated: of a coordinate, the speed there."""
        count = self.coordinates
        return self.variable(f"stage{count + i}" if i < count else f"slope{i}")

    def _kept_ledger(self, s: int) -> list[Output]:
        return [(f"kledger{s}_{i}", self.variable(f"ledger{i}")) for i in range(self.ledger)]

    def _ledger_at(self, s: int, i: int) -> str:
        return f"ledger{i}" if s == len(LOBATTO) else f"kledger{s}_{i}"

    def _ledger_weights(self) -> tuple[float, ...]:
        return LOBATTO

    def _calls(self) -> list[str]:
        offset = self.layout["slope0"] - self.layout["k1_0"]
        calls = ["start", "jacobian", "right_1", "solve"]
        for s in range(2, len(self.tableau.nodes) + 1):
            calls += [f"point_{s}", f"slopes {offset}", f"right_{s}", "solve"]
        for name in ("inner_1", "inner_2", "finish"):
            calls += [name, "right_hand_side"]
        return calls
