"""Traced expressions are the mechanics: they evaluate to what the same code gives on floats."""

import math
import re

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from jointplay.records.failure import LimitExceeded
from jointplay.records.names import RESERVED_OUTPUTS
from jointplay.solver.integrators import TSITOURAS5
from jointplay.solver.kernels.emit.kernel import compile_kernel
from jointplay.solver.kernels.trace import operations
from jointplay.solver.kernels.trace.equations import trace
from jointplay.solver.kernels.trace.tracer import MOST_STATEMENTS, Expression, Tracer
from jointplay.solver.mechanics.observe import channel_values, ledger_rates
from jointplay.solver.mechanics.tree import spanning_tree
from jointplay.solver.mechanics.view import view
from jointplay.solver.quantities import scalars
from jointplay.solver.scene import presets
from jointplay.solver.scene.document import Scene
from tests.solver.random_mechanisms import chain, instants, near_start, trees
from tests.solver.readable_mechanics import Instant, preset


def evaluate(node: Expression, values: dict[str, float], found: dict[int, float]) -> float:
    """Evaluate a node by plain recursion, apart from the emitter and the compiler."""
    if node.operation == "constant":
        return node.value
    if node.operation in ("number", "variable"):
        return values[str(node.data)]
    if node.index not in found:
        arguments = [evaluate(a, values, found) for a in node.arguments]
        found[node.index] = operations.OPERATIONS[node.operation].on_floats(*arguments)
    return found[node.index]


values = st.floats(-100.0, 100.0).map(lambda x: round(x, 6))
positive = st.floats(1e-6, 100.0)
OPERATIONS = {
    "sum": lambda x, y: x + y - 2.5,
    "reflected": lambda x, y: 1.0 - (2.0 * x) + (3.0 + y),
    "difference": lambda x, y: (x - y) - (-x),
    "product": lambda x, y: x * (-y) * 1.0 * -1.0,
    "quotient": lambda x, y: x / (y * y + 1.0),
    "inverse": lambda x, y: 2.0 / (x * x + y * y + 1.0),
    "root": lambda x, y: scalars.sqrt(x * x + y * y),
    "magnitude": lambda x, y: scalars.absolute(x - y),
    "sine": lambda x, y: scalars.sine_cosine(x * y)[0],
    "cosine": lambda x, y: scalars.sine_cosine(x + y)[1],
    "choice": lambda x, y: scalars.select_positive(x, y, 0.0),
    "smaller": lambda x, y: scalars.minimum(x, y),
    "larger": lambda x, y: scalars.maximum(x, y),
    "sign": lambda x, y: scalars.sign(x) * y,
    "clamp": lambda x, y: scalars.clamp_to_unit(x) + scalars.positive_part(y),
    "power": lambda x, y: scalars.power(scalars.absolute(x), 1.3) * y,
    "three halves": lambda x, y: scalars.power(scalars.absolute(x), 1.5) * y,
    "nothing": lambda x, y: 0.0 * x + (y - y) + 0.0 / (y * y + 1.0),
}


@pytest.mark.parametrize("operation", OPERATIONS)
@pytest.mark.parametrize("kind", ["variable", "number"])
@given(x=values, y=values)
def test_traced_arithmetic_equals_arithmetic_on_floats(
    operation: str, kind: str, x: float, y: float
) -> None:
    tracer = Tracer()
    if kind == "variable":
        a, b = tracer.variable("x"), tracer.variable("y")
    else:
        a, b = tracer.number("x", x), tracer.number("y", y)
    traced = tracer.lift(OPERATIONS[operation](a, b))
    exact = OPERATIONS[operation](x, y)
    # a few roundings of the largest operand, 1e4 for products; angles up to 1e4 lose as much
    tolerance = 1e-15 * max(1.0, abs(x) + abs(y), abs(exact)) * max(1.0, abs(x), abs(y))
    assert evaluate(traced, {"x": x, "y": y}, {}) == pytest.approx(exact, abs=tolerance)


def test_the_same_expression_is_traced_once() -> None:
    tracer = Tracer()
    x, y = tracer.variable("x"), tracer.variable("y")
    assert x * y is y * x
    assert x + y is y + x
    assert x - x is tracer.constant(0.0)
    assert x + 0.0 is x
    assert x * 1.0 is x
    negated = -x
    assert -negated is x
    assert (x * 0.0).is_literal(0.0)


scenes_near_start = st.one_of(
    instants(trees()),
    near_start(preset("seven-bar-press", friction=0.1), 1e-3),
    near_start(preset("seven-bar-press", friction=0.1, slip_velocity="as-published"), 1e-3),
    near_start(preset("slider-crank", exponent=1.3, stiffness=1e9), 1e-3),
)


def variables(instant: Instant, formulation: str) -> dict[str, float]:
    """Return the values of the variables that `solver.kernels.trace.equations` names."""
    if formulation == "lagrange":
        q, v = instant.absolute_state()
    else:
        order = spanning_tree(instant.scene).coordinates
        q = [instant.position[name] for name in order]
        v = [instant.speed[name] for name in order]
    found = {f"stage{i}": value for i, value in enumerate([*q, *v])}
    found["stage_time"] = 0.25
    for k, (name, driver) in enumerate(instant.scene.drivers.items()):
        found[f"phase{k}"] = instant.driven[name] - driver.clock_rate * 0.25
        found[f"wound{k}"] = 0.0
    for j, name in enumerate(spanning_tree(instant.scene).pairs):
        found[f"mode{j}"] = instant.mode[name]
        found[f"impact_rate{j}"] = instant.impact_rate[name]
    return found


@pytest.mark.parametrize("formulation", ["reduced", "lagrange"])
@settings(max_examples=30)
@given(instant=scenes_near_start)
def test_traced_mechanics_equal_the_mechanics_on_floats(formulation: str, instant: Instant) -> None:
    scene = instant.scene
    equations = trace(scene, spanning_tree(scene), formulation)
    given_values = {**equations.tracer.numbers, **variables(instant, formulation)}
    found: dict[int, float] = {}
    motion = getattr(instant, formulation)()
    # the direction of a concentric journal is a matter of rounding
    assume(all(math.hypot(*c.eccentricity) > 1e-12 for c in motion.contacts.values()))
    if formulation == "reduced":
        count = len(equations.coordinates)
        for i, acceleration in enumerate(motion.accelerations):
            given_values[f"slope{count + i}"] = acceleration
    numbers = view(scene)
    expected = dict(channel_values(numbers, motion))
    expected |= {f"a{i}": value for i, value in enumerate(motion.accelerations)}
    rates = ledger_rates(numbers, motion)
    expected |= {f"rate{i}": value for i, value in enumerate(rates.values())}
    traced = {**equations.channels}
    traced |= {f"a{i}": node for i, node in enumerate(equations.accelerations)}
    traced |= {f"rate{i}": node for i, node in enumerate(equations.ledger)}
    # simplification reorders sums; as for the formulations, chains amplify its rounding
    scale = max(1.0, *(abs(value) for value in expected.values()))
    for name, value in expected.items():
        got = evaluate(traced[name], given_values, found)
        assert got == pytest.approx(value, rel=1e-9, abs=1e-12 * scale), name


WORDS = ["import", "W", "l", "def", "exec", "lambda", "v0", "sqrt", "njit", "x", "time-1", "os_"]
legal_names = st.from_regex(r"\A[A-Za-z][A-Za-z0-9_-]{0,31}\Z").filter(
    lambda name: name not in RESERVED_OUTPUTS
)


@settings(max_examples=25)
@given(
    st.lists(st.one_of(st.sampled_from(WORDS), legal_names), min_size=6, max_size=6, unique=True)
)
def test_names_of_a_scene_select_nothing_and_stand_in_no_source(names: list[str]) -> None:
    body, joint, on_ground, on_body, tip, output = names
    document = presets.document("pendulum")
    rod = document["bodies"].pop("rod")
    rod["points"] = {on_body: rod["points"]["pivot"], tip: rod["points"]["tip"]}
    document["bodies"][body] = rod
    document["ground"]["points"] = {on_ground: [0.0, 0.0]}
    document["joints"] = {
        joint: {
            "type": "revolute",
            "bearing": f"ground.{on_ground}",
            "journal": f"{body}.{on_body}",
        }
    }
    document["start"] = {}
    document["parameters"] = {}
    for declared in document["outputs"]:
        declared["channel"] = declared["channel"].replace("rod.", f"{body}.")
    document["outputs"][0]["name"] = output
    kernels = [
        compile_kernel(scene, spanning_tree(scene), "reduced", TSITOURAS5)
        for scene in (preset("pendulum"), Scene.model_validate(document))
    ]
    assert kernels[0].module.prefix == kernels[1].module.prefix


def test_equations_beyond_the_limit_are_refused_with_their_length_before_compilation() -> None:
    scene = chain(60)
    with pytest.raises(LimitExceeded) as refused:
        compile_kernel(scene, spanning_tree(scene), "reduced", TSITOURAS5)
    (problem,) = refused.value.problems
    assert problem.pointer == "/scene"
    count = max(int(n) for n in re.findall(r"\d+", problem.detail))
    assert count >= MOST_STATEMENTS
    assert str(MOST_STATEMENTS) in problem.detail
