"""Derivatives of mechanisms' accelerations, against differences."""

from dataclasses import replace

import numpy as np
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from jointplay.solver.kernels.trace.derivative import Derivative
from jointplay.solver.kernels.trace.equations import trace
from jointplay.solver.mechanics.tree import spanning_tree
from tests.solver.kernels.test_derivative import as_in_kernels
from tests.solver.kernels.test_tracer import variables
from tests.solver.random_mechanisms import instants, near_start, trees
from tests.solver.readable_mechanics import Instant, preset


def moved(instant: Instant, direction: dict[str, float], by: float) -> Instant:
    """Return an instant displaced along a direction of its coordinates, speeds, impact rates."""
    return replace(
        instant,
        **{
            part: {
                name: value + by * direction[f"{part} {name}"]
                for name, value in getattr(instant, part).items()
            }
            for part in ("position", "speed", "impact_rate")
        },
    )


@settings(max_examples=60, deadline=None)
@given(
    instant=st.one_of(
        instants(trees()),
        near_start(preset("seven-bar-press", friction=0.1, stiffness=1e9), 1e-3),
        near_start(preset("seven-bar-press", friction=0.1, slip_velocity="as-published"), 1e-3),
        near_start(preset("slider-crank", exponent=1.3, stiffness=1e9), 1e-3),
    ),
    seed=st.integers(0, 1000),
)
def test_accelerations_of_mechanisms_are_differentiated(instant: Instant, seed: int) -> None:
    assume(instant.position)  # a tree may leave no freedom
    random = np.random.default_rng(seed)
    direction = {
        f"{part} {name}": float(random.uniform(-1.0, 1.0)) * scale
        for part, scale in (("position", 1e-3), ("speed", 1.0), ("impact_rate", 1e-2))
        for name in getattr(instant, part)
    }
    equations = trace(instant.scene, spanning_tree(instant.scene), "reduced")
    tracer = equations.tracer
    names = [f"position {c}" for c in equations.coordinates]
    names += [f"speed {c}" for c in equations.coordinates]
    along = {f"stage{i}": tracer.constant(direction[name]) for i, name in enumerate(names)}
    for j, joint in enumerate(equations.pairs):
        along[f"impact_rate{j}"] = tracer.constant(direction[f"impact_rate {joint}"])
    derivative = Derivative(along)
    known = {**tracer.numbers, **variables(instant, "reduced")}
    exact = as_in_kernels([derivative(a) for a in equations.accelerations], known)

    def at(by: float) -> np.ndarray:
        return np.array(moved(instant, direction, by).reduced().accelerations)

    # a millionth of the direction: 1e-9 m, against clearances of 0.5 mm; differences over two
    # spans agree where no kink of friction or contact is near
    differences = [(at(h) - at(-h)) / (2.0 * h) for h in (1e-6, 2e-6)]
    size = max(1.0, np.abs(differences[0]).max(), np.abs(exact).max(), 1e-5 * np.abs(at(0.0)).max())
    assume(np.abs(differences[0] - differences[1]).max() < 1e-5 * size)
    assert np.abs(exact - differences[0]).max() < 3e-5 * size
