"""Derivatives of traced expressions: against differences, and where no difference would do."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from jointplay.solver.kernels.trace.derivative import Derivative
from jointplay.solver.kernels.trace.equations import trace
from jointplay.solver.kernels.trace.operations import OPERATIONS
from jointplay.solver.kernels.trace.reachable import reachable
from jointplay.solver.kernels.trace.tracer import Expression, Tracer
from jointplay.solver.mechanics.tree import spanning_tree
from jointplay.solver.quantities import elementary, scalars
from tests.solver.kernels.test_tracer import evaluate
from tests.solver.readable_mechanics import preset

STEP = 1e-5
"""Step of a central difference: its error is about STEP² f''' / 6 + 1e-16 f / STEP, 1e-10 where
f and its derivatives are about 1."""


def rates(
    function: Callable[..., Any], point: dict[str, float], along: dict[str, float]
) -> tuple[float, float]:
    """Return the derivative of a function of variables along a direction, and its difference."""
    tracer = Tracer()
    variables = {name: tracer.variable(name) for name in point}
    node = tracer.lift(function(*variables.values()))
    derivative = Derivative({name: tracer.variable(f"d{name}") for name in along})(node)
    moving = {f"d{name}": rate for name, rate in along.items()}
    exact = evaluate(derivative, point | moving, {})
    ends = [
        evaluate(node, {name: x + step * along.get(name, 0.0) for name, x in point.items()}, {})
        for step in (-STEP, STEP)
    ]
    return exact, (ends[1] - ends[0]) / (2.0 * STEP)


def as_in_kernels(outputs: list[Expression], values: dict[str, float]) -> np.ndarray:
    """Evaluate expressions as kernels do: all branches of them, division by zero included."""
    found: dict[int, np.float64] = {}
    fixed: dict[int, float] = {}
    with np.errstate(all="ignore"):
        for node in reachable(outputs):
            if node.fixed or node.operation == "variable":
                found[node.index] = np.float64(evaluate(node, values, fixed))
            else:
                arguments = [found[a.index] for a in node.arguments]
                found[node.index] = np.float64(OPERATIONS[node.operation].on_floats(*arguments))
    return np.array([found[node.index] for node in outputs])


value = st.floats(-2.0, 2.0).map(lambda x: round(x, 3))
positive = st.floats(0.1, 2.0).map(lambda x: round(x, 3))


@pytest.mark.parametrize(
    "function",
    [
        lambda x: scalars.sine_cosine(x)[0],
        lambda x: scalars.sine_cosine(3.0 * x - 1.0)[1],
        lambda x: elementary.sine_cosine(x)[0],
        lambda x: elementary.sine_cosine(x)[1],
        lambda x: elementary.exp2(x),
        lambda x: elementary.log2(1.5 + x * x),
        lambda x: scalars.power(x * x + 0.5, 1.3),
        lambda x: elementary.power(x * x + 0.5, 1.3),
        lambda x: scalars.power(x * x + 0.5, 1.5),
        lambda x: scalars.sqrt(x * x + 1.0),
        lambda x: scalars.logarithm(x * x + 0.5),
        lambda x: scalars.exponential(0.5 * x),
        lambda x: scalars.hyperbolic_tangent(0.5 * x),
        lambda x: 1.0 / (x * x + 1.0),
        lambda x: (x - 2.0) / (x * x + 1.0),
        lambda x: abs(x * x - 7.0),
        lambda x: -(x * x * x),
    ],
)
@given(x=value, dx=value)
def test_lane_functions_are_differentiated(
    function: Callable[..., Any], x: float, dx: float
) -> None:
    exact, difference = rates(function, {"x": x}, {"x": dx})
    # third derivatives are at most 81 (of the cubed argument's cosine), times dx³ = 8
    assert exact == pytest.approx(difference, abs=2e-8)


@st.composite
def formulas(draw: st.DrawFn) -> Callable[..., Expression]:
    """Draw a formula of x and y: a chain of operations on what came before, bounded in size."""
    count = draw(st.integers(1, 12))
    index = st.integers(0, 99)
    choices = [
        (draw(st.sampled_from(sorted(RANDOM))), draw(index), draw(index), draw(index))
        for _ in range(count)
    ]

    def build(x: Expression, y: Expression) -> Expression:
        known = [x, y, x.tracer.constant(0.75), x.tracer.number("size", 1.25)]
        for operation, i, j, k in choices:
            a, b, c = (known[n % len(known)] for n in (i, j, k))
            known.append(RANDOM[operation](a, b, c))
        return known[-1]

    return build


def bounded(a: Expression) -> Expression:
    """Return a function of `a` between -1 and 1."""
    return a / (1.0 + a * a) * 2.0


RANDOM: dict[str, Callable[[Expression, Expression, Expression], Expression]] = {
    "add": lambda a, b, c: bounded(a + b),
    "sub": lambda a, b, c: a - bounded(b),
    "mul": lambda a, b, c: bounded(a) * bounded(b),
    "div": lambda a, b, c: bounded(a) / (1.5 + bounded(b)),
    "neg": lambda a, b, c: -a,
    "abs": lambda a, b, c: abs(bounded(a)),
    "sqrt": lambda a, b, c: (1.0 + bounded(a)).sqrt() * 0.5 + (2.0 + bounded(b)).sqrt(),
    "select": lambda a, b, c: bounded(a).select_positive(bounded(b), c),
    "sine": lambda a, b, c: a.sine_cosine()[0] * bounded(b),
    "cosine": lambda a, b, c: a.sine_cosine()[1] - b,
    "power": lambda a, b, c: (1.5 + bounded(a)).power(1.25),
    "floor": lambda a, b, c: bounded(a) - elementary.operate("floor", 4.0 * bounded(a)),
    "positive": lambda a, b, c: scalars.positive_part(bounded(a)) * b,
}


@settings(max_examples=300, deadline=None)
@given(formula=formulas(), x=value, y=value, dx=value, dy=value)
def test_random_expressions_are_differentiated(
    formula: Callable[..., Expression], x: float, y: float, dx: float, dy: float
) -> None:
    tracer = Tracer()
    node = formula(tracer.variable("x"), tracer.variable("y"))
    numbers = dict(tracer.numbers)
    derivative = Derivative({"x": tracer.variable("dx"), "y": tracer.variable("dy")})(node)
    exact = evaluate(derivative, {"x": x, "y": y, "dx": dx, "dy": dy} | numbers, {})

    def at(step: float) -> float:
        return evaluate(node, {"x": x + step * dx, "y": y + step * dy} | numbers, {})

    # only where the function is smooth: differences over two spans agree, and those to both sides
    # differ in proportion to the span, as curvature has it; at a kink they differ alike
    spans = (STEP, 3.0 * STEP)
    differences = [(at(h) - at(-h)) / (2.0 * h) for h in spans]
    bends = [(at(h) - 2.0 * at(0.0) + at(-h)) / h for h in spans]
    size = max(1.0, abs(exact), abs(differences[0]))
    assume(abs(differences[0] - differences[1]) < 1e-6 * size)
    assume(abs(bends[1] - 3.0 * bends[0]) < 1e-6 * size)
    assert exact == pytest.approx(differences[0], abs=1e-6 * size)


# where nothing is smooth


def derived(node: Expression, **values: float) -> float:
    """Return the derivative of a node along x."""
    derivative = Derivative({"x": node.tracer.constant(1.0)})(node)
    return float(as_in_kernels([derivative], values)[0])


def test_the_depth_of_a_contact_has_no_slope_where_it_begins() -> None:
    for exponent in (1.5, 1.3):
        tracer = Tracer()
        depth = scalars.positive_part(tracer.variable("x"))
        force = scalars.power(depth, exponent)
        assert derived(force, x=0.0) == 0.0
        assert derived(force, x=-1.0) == 0.0
        assert derived(force, x=0.25) == pytest.approx(
            exponent * 0.25 ** (exponent - 1.0), rel=1e-14
        )


def test_a_root_of_zero_does_not_change() -> None:
    tracer = Tracer()
    x = tracer.variable("x")
    assert derived((x * x).sqrt(), x=0.0) == 0.0


def test_the_chosen_branch_alone_counts() -> None:
    tracer = Tracer()
    x = tracer.variable("x")
    chosen = (x - 1.0).select_positive(3.0 * x, 1.0 / (x - 0.5))
    assert derived(chosen, x=2.0) == 3.0
    assert derived(chosen, x=0.0) == -4.0
    # at the border the other branch is in force, and is not a number
    assert math.isinf(derived(chosen, x=0.5))


def test_what_vanishes_keeps_out_what_changes_infinitely_fast() -> None:
    tracer = Tracer()
    x, load = tracer.variable("x"), tracer.variable("load")
    force = scalars.positive_part(load)
    fast = x * 1e300 * 1e300
    for product in (force * fast, -(0.1 * force) * fast, (force / 3.0) * fast):
        assert derived(product, x=0.0, load=-1.0) == 0.0
        assert math.isinf(derived(product, x=0.0, load=1.0))


def test_whole_numbers_and_powers_of_two_do_not_change() -> None:
    tracer = Tracer()
    x = tracer.variable("x")
    operate = elementary.operate
    exponent, mantissa = operate("exponent_of", x), operate("mantissa_of", x)
    whole = operate("floor", x)
    for node in (whole, exponent, operate("power_of_two", whole)):
        assert Derivative({"x": tracer.constant(1.0)})(node).is_literal(0.0)
    assert derived(mantissa, x=6.0) == 0.25


def test_what_does_not_change_leaves_no_statement() -> None:
    tracer = Tracer()
    x, y = tracer.variable("x"), tracer.variable("y")
    derivative = Derivative({"x": tracer.variable("dx")})
    sine, cosine = y.sine_cosine()
    assert derivative(sine + cosine * y).is_literal(0.0)
    assert derivative(x * cosine + sine) is tracer.variable("dx") * cosine


def test_sines_are_derived_without_their_polynomials() -> None:
    tracer = Tracer()
    x = tracer.variable("x")
    sine, cosine = x.sine_cosine()
    dx = tracer.variable("dx")
    derivative = Derivative({"x": dx})
    assert derivative(sine) is cosine * dx
    assert derivative(cosine) is -(sine * dx)


def test_tangent_slopes_of_the_press_cost_at_most_twice_its_accelerations() -> None:
    scene = preset("seven-bar-press", friction=0.1)
    equations = trace(scene, spanning_tree(scene), "reduced")
    count = len(equations.coordinates)
    tracer = equations.tracer
    along = {f"stage{i}": tracer.variable(f"carried{i}") for i in range(2 * count)}
    derivative = Derivative(along)
    derivatives = [derivative(acceleration) for acceleration in equations.accelerations]
    # what they share with the accelerations, values of the state, is counted too
    assert len(reachable(derivatives)) < 2 * len(reachable(equations.accelerations))
