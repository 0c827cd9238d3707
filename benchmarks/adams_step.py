"""Records one step of a variable-step, variable-order Adams method for eight lanes.

Modified divided differences, predict-evaluate-correct-evaluate with local extrapolation, as in
Shampine and Gordon 1975 (Computer Solution of Ordinary Differential Equations, chapters 5 and 10):
phi_1 = f, and each further difference is scaled so that it would be a backward difference if all
steps were equal. Every lane has its own step and order; what lies beyond a lane's order weighs 0.
"""

import math
from itertools import pairwise

from jointplay.solver.kernels.emit.emit import HEADER, lane_function
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.emit.lane_functions import exp2, log2
from jointplay.solver.kernels.record.recorder import Expression, Recorder
from jointplay.solver.quantities.scalars import maximum, minimum, select_positive

SAFETY, LARGEST_CUT = 0.85, 0.1
SLOTS = ("order", "starting", "since", "attempts", "landing", "tries", "corrector", "judging")
ESTIMATES = ("two_below", "below", "here", "above")
"""Factors of the error estimates at orders k-2 to k+1."""


def moulton(count: int) -> list[float]:
    """Return the magnitudes of the Adams-Moulton coefficients from gamma*_1 on."""
    found = [1.0]
    for i in range(1, count + 1):
        found.append(-sum(found[j] / (i + 1 - j) for j in range(i)))
    return [abs(value) for value in found[1:]]


class AdamsRecorder:
    """Records `predict`, `correct`, `judge` and `take` on the slots of a kernel and some more."""

    def __init__(self, kernel: Kernel, highest: int) -> None:
        self.states, self.joints, self.highest = kernel.states, len(kernel.play), highest
        self.ledger = len(kernel.equations.ledger)
        self.layout, self.recorder = kernel.layout.copy(), Recorder()
        self.layout.add(*SLOTS, *ESTIMATES)
        for name in ("spacing", "inverse", "new_inverse", "scale", "factor"):
            self.layout.add_block(name, highest + 1)
        for i in range(highest + 1):
            self.layout.add_block(f"difference{i}_", self.states + self.ledger)

    def source(self) -> str:
        """Return the source of the four functions."""
        parts = {
            "predict": self._predict(),
            "correct": self._correct(),
            "judge": self._judge(),
            "take": self._take(),
        }
        texts = [lane_function(name, outputs, self.layout) for name, outputs in parts.items()]
        return "\n\n".join([HEADER, *texts])

    def _at(self, values: list[Expression], offset: int) -> Expression:
        """Return the entry of index order + offset, where it exists; else the first one."""
        found = values[0]
        for i, value in enumerate(values[1:], start=1):
            found = select_positive(
                self.recorder.variable("order") + (offset + 0.5 - i), value, found
            )
        return found

    def _predict(self) -> list[tuple[str, Expression]]:
        v, one = self.recorder.variable, self.recorder.constant(1.0)
        h = minimum(minimum(v("step"), v("largest_step")), v("end") - v("time"))
        h = select_positive(v("active"), h, v("step"))
        spacing = [h, *(v(f"spacing{i}") + h for i in range(self.highest))]
        inverse = [1.0 / each for each in spacing]
        scale, alpha, sigma = [one], [h * each for each in inverse], [one]
        for i in range(1, self.highest + 1):
            scale.append(scale[-1] * (spacing[i - 1] * v(f"inverse{i - 1}")))
            sigma.append(sigma[-1] * (float(i) * alpha[i - 1]))
        sigma.append(sigma[-1] * (float(self.highest + 1) * alpha[-1]))
        row: list[Expression] = [one / float(q) for q in range(1, self.highest + 3)]
        weights = [row[0]]
        for i in range(1, self.highest + 2):  # g_1, …, g_{K+2} by Krogh's recurrence
            if i == 1:
                row = [one / float(q * (q + 1)) for q in range(1, self.highest + 2)]
            else:
                row = [a - alpha[i - 1] * b for a, b in pairwise(row)]
            weights.append(row[0])
        outputs = [("tried", h), ("stage_time", v("time") + h), ("arrival", v("time") + h)]
        zero = self.recorder.constant(0.0)
        within = [
            select_positive(v("order") - (i + 0.5), each, zero) if i else each
            for i, each in enumerate(scale)
        ]
        for i in range(self.highest + 1):
            outputs.append((f"scale{i}", scale[i]))
            outputs.append((f"new_inverse{i}", inverse[i]))
        factors = [h * g * b for g, b in zip(weights, within, strict=False)]
        outputs += [(f"factor{i}", each) for i, each in enumerate(factors)]
        for s in range(self.states):
            outputs.append((f"stage{s}", self._extrapolated(v(f"y{s}"), factors, s)))
        after, at = self._at(weights, 0), self._at(weights, -1)
        outputs += [("corrector", h * after), ("judging", h * (after - at))]
        stars = moulton(self.highest + 1)
        expected = [h * stars[i] * sigma[i + 1] for i in range(self.highest + 1)]
        for offset, name in enumerate(ESTIMATES, start=-3):  # index k-1 belongs to order k
            outputs.append((name, self._at(expected, offset)))
        return outputs

    def _extrapolated(self, value: Expression, factors: list[Expression], s: int) -> Expression:
        for i in range(self.highest):
            value = value + factors[i] * self.recorder.variable(f"difference{i}_{s}")
        return value

    def _predicted(self, s: int) -> list[Expression]:
        """Return the differences of state s as the predictor continues them, zero from order on."""
        v, zero = self.recorder.variable, self.recorder.constant(0.0)
        found = [zero]
        for i in reversed(range(self.highest)):
            weight = v(f"scale{i}")
            weight = select_positive(v("order") - (i + 0.5), weight, zero) if i else weight
            found.append(found[-1] + weight * v(f"difference{i}_{s}"))
        return found[::-1]

    def _correct(self) -> list[tuple[str, Expression]]:
        """Correct the state, and choose the next order and step from the errors expected."""
        v, number = self.recorder.variable, self.recorder.constant
        squares = [number(1e-30)] * 4
        outputs = []
        for s in range(self.states):
            predicted = self._predicted(s)
            defect = v(f"slope{s}") - predicted[0]
            outputs.append((f"stage{s}", v(f"stage{s}") + v("corrector") * defect))
            scaled = v(f"weight{s}") * (v("full") / v("fastest"))
            ahead = self._at([v(f"difference{i}_{s}") for i in range(self.highest + 1)], 0)
            ahead = ahead * self._at([v(f"scale{i}") for i in range(self.highest + 1)], 0)
            terms = (
                defect + self._at(predicted[:-1], -2),
                defect + self._at(predicted[:-1], -1),
                defect,
                defect - ahead,
            )
            for i, term in enumerate(terms):
                squares[i] = squares[i] + (scaled * term) * (scaled * term)
        two_below, below, here, above = (
            square * v(name) * v(name) for square, name in zip(squares, ESTIMATES, strict=True)
        )
        order, highest = v("order"), number(float(self.highest))
        good = select_positive(
            1.0 - squares[2] * v("judging") * v("judging"), number(1.0), number(0.0)
        )
        lower = select_positive(order - 2.5, maximum(below, two_below), below * 4.0)
        down = select_positive(
            here - lower, select_positive(order - 1.5, number(1.0), number(0.0)), number(0.0)
        )
        room = select_positive(highest - order - 0.5, number(1.0), number(0.0))
        settled = select_positive(v("since") - order - 0.5, number(1.0), number(0.0))
        wanted = select_positive(order - 1.5, here - above, 0.25 * here - above)
        up = select_positive(wanted, number(1.0), number(0.0)) * settled
        starting = v("starting") * good * (1.0 - down)
        up = good * room * (1.0 - down) * maximum(up, starting)
        expected = select_positive(down, below, select_positive(up * (1.0 - starting), above, here))
        next_order = order - down + up
        exponent = (
            log2(expected)
            * (-0.5)
            / (select_positive(up * (1.0 - starting), next_order, order - down) + 1.0)
        )
        growth = minimum(exp2(minimum(exponent, number(2.0)) + math.log2(SAFETY)), number(2.0))
        cut = minimum(growth, number(0.7))
        growth = maximum(select_positive(good, growth, cut), number(LARGEST_CUT))
        going = select_positive(growth - 1.0, starting, number(0.0))
        return [
            *outputs,
            ("accept", good * v("active")),
            ("next_step", v("tried") * growth),
            ("memory", next_order),
            ("new_memory", going),
            ("attempts", v("attempts") + v("active")),
        ]

    def _judge(self) -> list[tuple[str, Expression]]:
        """Flag lanes that reject, that touch or come near, that open, and that are over."""
        v, number = self.recorder.variable, self.recorder.constant
        flag = 1.0 - v("accept")
        for j in range(self.joints):
            gap, rate = v(f"gap{j}"), v(f"gap_rate{j}")
            start, start_rate = v(f"gap_start{j}"), v(f"gap_rate_start{j}")
            turn = start_rate / (start_rate - rate + 1e-300)
            rest = 1.0 - turn
            top = (
                rest * rest * (1.0 + 2.0 * turn) * start
                + turn * turn * (3.0 - 2.0 * turn) * gap
                + turn * rest * v("tried") * (rest * start_rate - turn * rate)
            )
            passing = select_positive(
                start_rate, select_positive(-rate, top, number(-1.0)), number(-1.0)
            )
            near = select_positive(maximum(gap, passing), number(1.0), number(0.0))
            open_again = select_positive(gap, number(0.0), number(1.0))
            flag = flag + select_positive(v(f"mode{j}"), open_again, near)
        flag = (
            flag + v("landing") + select_positive(v("end") - v("arrival"), number(0.0), number(1.0))
        )
        return [("flag", flag * v("active"))]

    def _take(self) -> list[tuple[str, Expression]]:
        v, number = self.recorder.variable, self.recorder.constant
        accept = v("accept")
        changed = abs(v("memory") - v("order"))
        outputs = [
            ("time", v("arrival")),
            ("steps", v("steps") + 1.0),
            ("starting", v("new_memory")),
            ("since", select_positive(changed - 0.5, number(0.0), v("since") + 1.0)),
        ]
        fastest = v("fastest")
        for s in range(self.states // 2, self.states):
            fastest = maximum(fastest, abs(v(f"stage{s}")) * v(f"weight{s}"))
        outputs.append(("fastest", minimum(fastest, v("full"))))
        for i in range(self.highest + 1):
            before = v(f"spacing{i - 1}") + v("tried") if i else v("tried")
            outputs += [(f"spacing{i}", before), (f"inverse{i}", v(f"new_inverse{i}"))]
        for s in range(self.states):
            predicted = self._predicted(s)
            defect = v(f"slope{s}") - predicted[0]
            outputs.append((f"y{s}", v(f"stage{s}")))
            outputs += [(f"difference{i}_{s}", defect + each) for i, each in enumerate(predicted)]
        factors = [v(f"factor{i}") for i in range(self.highest)]
        for i in range(self.ledger):  # works and impulses: integrated along, without a say
            s = self.states + i
            predicted = self._predicted(s)
            defect = v(f"ledger{i}") - predicted[0]
            total = self._extrapolated(v(f"total{i}"), factors, s) + v("corrector") * defect
            outputs.append((f"total{i}", total))
            outputs += [(f"difference{d}_{s}", defect + each) for d, each in enumerate(predicted)]
        for j in range(self.joints):
            outputs.append((f"gap_start{j}", v(f"gap{j}")))
            outputs.append((f"gap_rate_start{j}", v(f"gap_rate{j}")))
        kept = [(slot, select_positive(accept, new, v(slot))) for slot, new in outputs]
        return [*kept, ("order", v("memory")), ("step", v("next_step"))]
