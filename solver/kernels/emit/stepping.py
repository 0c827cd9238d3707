"""Records one step of an embedded Runge-Kutta method: stages, commit, dense output.

The functions work on the slots of one work array (`allocate` names them). They take no branch:
flags tell the driving loop (`solver.kernels.loop.advance`) which lanes want attention.
"""

from itertools import count

from jointplay.solver.integrators import Method
from jointplay.solver.kernels.emit import closing, enclosure
from jointplay.solver.kernels.emit.emit import FixedNodes, Known, Output, Outputs, Tape
from jointplay.solver.kernels.emit.judged_step import JudgedStep, before, where_accepted
from jointplay.solver.kernels.emit.slots import KEEPS_LEDGER
from jointplay.solver.kernels.emit.tapes import Source
from jointplay.solver.kernels.emit.turned_sines import Angle, TurnedSines, turned_in_slopes
from jointplay.solver.kernels.layout import MOTION, Layout
from jointplay.solver.kernels.trace.equations import Equations
from jointplay.solver.kernels.trace.reachable import reachable
from jointplay.solver.kernels.trace.tracer import Expression
from jointplay.solver.quantities.scalars import maximum, minimum, select_positive

ENDS = ("penetration", "penetration_rate", "slip", "slip_rate")
"""Quantities of a contact pair that are known at both ends of a step."""
OF_CONTACT = (
    *("mode", "impact_rate", "inverse_rate", "impact_floor", "restart"),
    *("onset_time", "approach_rate", "onset_total", "opened", "abrupt"),
)
"""Further ones: of its law, and of how its contact began and ended."""


def allocate(layout: Layout, states: int, ledger: int, pairs: int, stages: int) -> None:
    """Give slots to everything a step reads or writes; `states` counts coordinates and speeds."""
    layout.add("time", "step", "tried", "arrival", "stage_time", "theta")
    layout.add("lengthening", "reach")
    layout.add("active", "accept", "flag", "next_step", "memory", "new_memory", "fastest", "full")
    layout.add("end", "next_due", "largest_step", "steps", "pace_at", "smallest_step")
    layout.add("look_at", "look_beyond", "looked_into", "rough_until")
    layout.add("swing", "inside", "looks_inside")
    layout.add_block("y", states)
    for s in range(1, stages + 1):  # equal pieces, which the slopes are written into
        layout.add_block(f"k{s}_", states)
        layout.add_block(f"kledger{s}_", ledger)
    layout.add_block("slope", states)
    layout.add_block("ledger", ledger)
    layout.add_block("total", ledger)
    layout.add(KEEPS_LEDGER, "gross", "potential", "stored", "potential_start", "stored_start")
    layout.add_block("stage", states)
    layout.add_block("weight", states)
    for name in ENDS:
        layout.add_block(name, pairs)
        layout.add_block(f"{name}_start", pairs)
    for name in OF_CONTACT:
        layout.add_block(name, pairs)
    enclosure.allocate(layout, pairs)


class StepTracer(JudgedStep):
    """Records the functions of one method for the equations of a scene."""

    def __init__(
        self, tableau: Method, equations: Equations, fixed: FixedNodes, known: Known
    ) -> None:
        """`known` : what the right-hand side leaves in slots."""
        layout = fixed.layout
        super().__init__(tableau, equations, layout)
        self.fixed, self.known = fixed, known
        self.turned = TurnedSines(self._turned())
        self.turned.allocate(layout)
        layout.add(*(before(name) for name in self._remembered()))

    def source(self, energies: Outputs) -> list[Source]:
        """Return the sources of all functions of a step.

        `energies` : what gravity and contacts store, at the stage.
        """
        parts = [*self._steps(), *self.knots.source(self.fixed)]
        parts += [self._look_inside(), self._judge(), self._attempt(), *self._remember()]
        if self.turned.angles:
            parts.insert(0, self.turned.source(self.layout, self.fixed))
        if self.equations.corrections:
            parts.insert(0, closing.source(self.equations, self.layout, self.fixed))
        return [*parts, self._take(energies)]

    def _turned(self) -> list[Angle]:
        return turned_in_slopes(self.equations)

    def _steps(self) -> list[Source]:
        """Return the sources of what an attempt calls beside the slopes, but for the judge."""
        return [self._stage(s) for s in range(2, self.tableau.stages + 1)]

    def _calls(self) -> list[str]:
        """Return what an attempt calls before the judge, in its order."""
        last = self.tableau.stages
        calls = ["sines_at_start"] if self.turned.angles else []
        for s in range(2, last):
            offset = self.layout[f"k{s}_0"] - self.layout["k1_0"]
            calls += [f"stage_{s}", f"slopes {offset}"]
        return [*calls, f"stage_{last}", "right_hand_side"]

    def _ledger_weights(self) -> tuple[float, ...]:
        return self.tableau.matrix[-1]

    def _tried(self) -> list[Output]:
        """Return the length of the step, and what it would be if there were no knots ahead."""
        v, longest = self.variable, self._longest()
        limited = minimum(longest, v("to_knot")) if self.knots.clocked else longest
        unhindered = [("unhindered", longest)] if self.knots.clocked else []
        return [("tried", select_positive(v("active"), limited, 0.0)), *unhindered]

    def _longest(self) -> Expression:
        """Return the length of the step but for knots: as the last one says, within all bounds."""
        v = self.variable
        remaining = v("end") - v("time")
        limited = minimum(minimum(v("step"), v("largest_step")), remaining)
        if self.tableau.error:
            speeds = [f"y{self.coordinates + i}" for i in self.angles]
            limited = minimum(limited, enclosure.longest(v, speeds))
        return limited

    def _stage(self, s: int) -> Source:
        """Stage s of the step: y + h Σ a k. The slopes of its coordinates are its speeds."""
        v = self.variable
        weights = self.tableau.matrix[s - 1]
        outputs = [*self._tried(), *self._held()] if s == 2 else []
        step = outputs[0][1] if s == 2 else v("tried")
        for i in range(self.states):
            moved = v(f"y{i}") + step * self._sum(weights, (f"k{s}_{i}" for s in count(1)))
            outputs.append((f"stage{i}", moved))
            coordinate = i - self.coordinates
            if 0 <= coordinate < self.coordinates and s < self.tableau.stages:
                outputs.append((f"k{s}_{coordinate}", moved))
        moment = v("time") + self.tableau.nodes[s - 1] * step
        outputs.append(("stage_time", moment))
        if s == self.tableau.stages:
            outputs.append(("arrival", moment))
        return self._function(f"stage_{s}", outputs)

    def _held(self) -> list[Output]:
        """Return what slopes need that keeps its value in a step."""
        return [
            (f"inverse_rate{j}", 1.0 / self.variable(f"impact_rate{j}")) for j in range(self.pairs)
        ]

    def _ledger_at(self, s: int, i: int) -> str:
        return f"kledger{s}_{i}"

    def _attempt(self) -> Source:
        """Attempt a step. Returns the largest flag that has a lane looked after by itself."""
        calls = self._calls()
        if self.equations.corrections:  # where the step ends, before its slopes are evaluated
            calls.insert(-1, "project")
        calls = [*self.knots.around(calls), "look_inside"]
        return Source("attempt", (*(f"call {each}" for each in calls), "return call judge"))

    def _take(self, energies: Outputs) -> Source:
        """Take the step in the lanes that accept it."""
        v = self.variable
        running = v("active")
        smallest = minimum(v("tried"), v("smallest_step"))
        outputs = [
            ("time", v("arrival")),
            ("memory", v("new_memory")),
            ("steps", v("steps") + running),
            ("smallest_step", select_positive(running, smallest, v("smallest_step"))),
        ]
        fastest = v("fastest")
        for i in range(self.coordinates, 2 * self.coordinates):
            fastest = maximum(fastest, abs(v(f"stage{i}")) * v(f"weight{i}"))
        outputs.append(("fastest", minimum(fastest, v("full"))))
        for j in range(self.pairs):
            outputs += [(f"{name}_start{j}", v(f"{name}{j}")) for name in ENDS]
        outputs += [(start, v(end)) for start, end in self.knots.ends()]
        outputs += self.turned.at_end()
        paths = range(MOTION * self.pairs)
        outputs += [(f"eccentricity_start{i}", v(f"eccentricity{i}")) for i in paths]
        for i in range(self.states):
            outputs += [(f"y{i}", v(f"stage{i}")), (f"k1_{i}", v(f"slope{i}"))]
        outputs = where_accepted(outputs)
        tape = Tape(self.layout, self.fixed, self.known)
        tape.store([*outputs, ("step", v("next_step"))])
        tape.go_on_where(v(KEEPS_LEDGER))
        tape.carry(energies)
        tape.store(where_accepted(self._added_to_ledger()))
        return tape.function("take")

    def _added_to_ledger(self) -> list[Output]:
        """Return the ledger's terms after the step.

        The gross work grows by the magnitudes of what a step's works come to: of each driver, of
        gravity, of what contacts store and lose, of friction.
        """
        v = self.variable
        outputs = []
        gross = v("gross")
        for energy in ("potential", "stored"):
            gross = gross + abs(v(energy) - v(f"{energy}_start"))
            outputs.append((f"{energy}_start", v(energy)))
        for i in range(self.ledger):
            slots = (self._ledger_at(s, i) for s in count(1))
            added = v("tried") * self._sum(self._ledger_weights(), slots)
            if i == 0:  # what went into contacts and is not stored there is lost
                added = added - (v("stored") - v("stored_start"))
            outputs.append((f"total{i}", v(f"total{i}") + added))
            if i < self.ledger - self.pairs:
                gross = gross + abs(added)
        outputs += [(f"kledger1_{i}", v(f"ledger{i}")) for i in range(self.ledger)]
        return [("gross", gross), *outputs]

    def _remember(self) -> list[Source]:
        """Keep the dense output of this step before the next one begins: of all lanes, or of some.

        Those are the ones that accept it.
        """
        outputs = [(before(name), self.variable(name)) for name in self._remembered()]
        accepted = where_accepted(outputs)
        return [self._function("remember", outputs), self._function("remember_some", accepted)]

    def _remembered(self) -> list[str]:
        """Return the slots that dense output reads."""
        return sorted(
            str(node.data)
            for node in reachable(expression for _, expression in self.dense())
            if node.operation == "variable" and node.data != "theta"
        )

    def dense(self) -> list[Output]:
        """Return time, state, modes and impact rates at the share `theta` of the step."""
        v = self.variable
        theta, step = v("theta"), v("tried")
        weights: list[Expression] = []
        for row in self.tableau.dense:
            total: Expression = self.tracer.constant(0.0)
            for coefficient in reversed(row):
                total = (total + coefficient) * theta
            weights.append(total)
        outputs = [("stage_time", v("time") + theta * step)]
        for i in range(self.states):
            slope = self._sum(weights, (self._slope(s, i) for s in count(1)))
            outputs.append((f"stage{i}", v(f"y{i}") + step * slope))
        ramp = theta * theta * (3.0 - 2.0 * theta)
        for i in range(len(self.equations.corrections)):
            name, unclosed = outputs[1 + i]
            outputs[1 + i] = (name, unclosed + ramp * v(f"correction{i}"))
        for j in range(self.pairs):
            outputs.append((f"mode{j}", v(f"mode{j}")))
            outputs.append((f"impact_rate{j}", v(f"impact_rate{j}")))
        return outputs
