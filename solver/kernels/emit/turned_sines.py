"""Sines of stages, turned on from those where the step starts.

Contacts have steps so short that bodies turn by a few thousandths of a radian in one. Then sine and
cosine of an angle a + d are those of a, turned on by d:

    sin(a + d) = sin a + (sin a (cos d - 1) + cos a sin d),
    cos(a + d) = cos a + (cos a (cos d - 1) - sin a sin d),

with three terms each of the series of sin d and cos d - 1: 12 products instead of 20. The sines at
the start are to rounding, for where a step ends they are evaluated anew; so nothing adds up. A
lane that turns by more than `FARTHEST` has its sines evaluated as everywhere else.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce

from jointplay.solver.kernels.emit.emit import FixedNodes, Output, Tape
from jointplay.solver.kernels.emit.tapes import Source
from jointplay.solver.kernels.layout import Layout
from jointplay.solver.kernels.trace.equations import Equations, numbered
from jointplay.solver.kernels.trace.reachable import reachable
from jointplay.solver.kernels.trace.tracer import Expression
from jointplay.solver.quantities.elementary import polynomial
from jointplay.solver.quantities.scalars import maximum, select_positive

FARTHEST = 2.0**-5
"""Largest angle, rad, by which sines are turned on: the next terms are 2.3e-17 there at most."""
SINE = (-1.0 / 6.0, 1.0 / 120.0, -1.0 / 5040.0)
LESS = (-1.0 / 2.0, 1.0 / 24.0, -1.0 / 720.0)
"""Coefficients of (sin d - d) / d^3 and of (cos d - 1) / d^2 in d^2."""

AT_START = ("angle_start", "sine_start", "cosine_start")


@dataclass(frozen=True)
class Angle:
    """An angle that slopes depend on, and the expressions of its sine and cosine."""

    angle: Expression
    sine: Expression
    cosine: Expression


def turned_in_slopes(equations: Equations) -> list[Angle]:
    """Return the angles whose sines slopes need, but for those that depend on sines themselves.

    None without contacts, whose steps are long.
    """
    if not equations.pairs:
        return []
    functions = equations.tracer.functions
    found = []
    for node in reachable(rate for _, rate in equations.slopes):
        known = functions.get(node.index)
        if known is not None and known.name == "sin":
            inner = reachable([known.argument])
            if not any(one.operation == "quarter_turns" for one in inner):
                found.append(Angle(known.argument, node, known.partner))
    return found


@dataclass(frozen=True)
class TurnedSines:
    """Writes them on tapes; ``angle_start``, ``sine_start``, ``cosine_start`` are the start's.

    ``sines_known`` is 0 in a lane that has none yet.
    """

    angles: Sequence[Angle]

    def allocate(self, layout: Layout) -> None:
        """Give slots to sines where the step starts."""
        layout.add("sines_known")
        for name in AT_START:
            layout.add_block(name, len(self.angles))

    def at_end(self) -> list[Output]:
        """Return what an accepted step leaves for the next one, where it ends."""
        return numbered(AT_START, [(one.angle, one.sine, one.cosine) for one in self.angles])

    def source(self, layout: Layout, fixed: FixedNodes) -> Source:
        """Return the source of sines_at_start(W), for lanes that begin elsewhere than one ended."""

        def at_start(name: str) -> str:
            start = {"stage_time": "time"}.get(name, name.replace("stage", "y"))
            return f"load {layout[start]}"

        tape = Tape(layout, fixed, fetch=at_start)
        apart = [abs(one.angle - self._start("angle", n)) for n, one in enumerate(self.angles)]
        known = apart[0].tracer.variable("sines_known")
        tape.go_on_where(reduce(maximum, apart, 0.5 - known))
        tape.store([*self.at_end(), ("sines_known", known.tracer.constant(1.0))])
        return tape.function("sines_at_start")

    def turn(self, tape: Tape) -> None:
        """Have a tape take turned sines for those of a stage."""
        farthest: list[Expression] = []
        choices = []
        for n, one in enumerate(self.angles):
            turn = one.angle - self._start("angle", n)
            square = turn * turn
            far = square - FARTHEST**2
            farthest.append(far)
            sine = turn + (turn * square) * polynomial(square, SINE)
            less = square * polynomial(square, LESS)
            first, other = self._start("sine", n), self._start("cosine", n)
            near = first + (first * less + other * sine), other + (other * less - first * sine)
            for exact, turned in zip((one.sine, one.cosine), near, strict=True):
                choices.append((exact, turned, select_positive(far, exact, turned)))
        if choices:
            tape.take_unless(reduce(maximum, farthest), choices)

    def _start(self, name: str, n: int) -> Expression:
        return self.angles[n].angle.tracer.variable(f"{name}_start{n}")
