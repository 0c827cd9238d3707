"""Numbers that looks into steps compute, against closed forms: by kernels that call theirs."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from jointplay.solver.kernels.emit.functions import DTYPE as FUNCTIONS
from jointplay.solver.kernels.emit.slots import DTYPE as SLOTS
from jointplay.solver.kernels.jit import kernel
from jointplay.solver.kernels.layout import INSTANTS
from jointplay.solver.kernels.loop.extremes.inner_states import is_in_reach, surpasses
from jointplay.solver.kernels.loop.extremes.passages import orbiting_at_end
from jointplay.solver.kernels.loop.extremes.window.polynomial_extreme import (
    MIDDLE,
    fit,
    turning_point,
)
from jointplay.solver.kernels.loop.runs import DTYPE as RUN
from jointplay.solver.kernels.loop.step import Step
from jointplay.solver.kernels.loop.tangent import logarithm

Floats = NDArray[np.float64]


@kernel()
def logarithm_of(x: float) -> float:
    return logarithm(x)


@kernel()
def fitted(values: np.ndarray) -> np.ndarray:
    powers = np.empty(INSTANTS)
    fit(values, powers)
    return powers


@kernel()
def turning_place(powers: np.ndarray, best: float, start: float) -> float:
    return turning_point(powers, best, start)


@kernel()
def orbiting(s: Step) -> float:
    return orbiting_at_end(0, s)


@kernel()
def may_be_beyond(s: Step) -> bool:
    return is_in_reach(0, s)


@kernel()
def is_beyond(s: Step) -> bool:
    return surpasses(0, s)


@given(x=st.floats(1e-300, 1e300))
def test_the_logarithm_is_that_of_the_library(x: float) -> None:
    exact = math.log(x)
    assert logarithm_of(x) == pytest.approx(exact, rel=0.0, abs=4e-16 * max(1.0, abs(exact)))


@given(coefficients=st.lists(st.floats(-1.0, 1.0), min_size=INSTANTS, max_size=INSTANTS))
def test_a_polynomial_of_the_seventh_degree_is_known_from_eight_values(
    coefficients: list[float],
) -> None:
    places = np.arange(float(INSTANTS)) - MIDDLE
    values = np.polynomial.polynomial.polyval(places, coefficients)
    # values are rounded to 1e-16 of their largest; no coefficient is larger than ten of those
    error = 1e-14 * max(1.0, float(np.abs(values).max()))
    np.testing.assert_allclose(fitted(values), coefficients, rtol=0.0, atol=error)


@given(turn=st.floats(-3.0, 3.0), steep=st.floats(0.5, 2.0))
def test_a_parabola_turns_at_its_top(turn: float, steep: float) -> None:
    powers = np.zeros(INSTANTS)
    powers[:3] = 1.0 - steep * turn**2, 2.0 * steep * turn, -steep
    best = float(np.clip(round(turn + MIDDLE), 0, INSTANTS - 1) - MIDDLE)
    assert turning_place(powers, best, best) == pytest.approx(turn, abs=1e-12)


def step_with(values: dict[str, list[float]], spare: Floats | None = None) -> Step:
    """Return a step of one lane with such blocks, of the states of one inner state."""
    slots, work = np.zeros(1, SLOTS), np.zeros((64, 1))
    slot = 0
    for name, numbers in values.items():
        slots[name], work[slot : slot + len(numbers), 0] = slot, numbers
        slot += len(numbers)
    instants = np.zeros((1, INSTANTS)) if spare is None else spare
    rest = np.zeros(0), np.zeros(1, FUNCTIONS)[0]
    return Step(0, np.zeros(1, RUN)[0], slots[0], work, instants, *rest)


@pytest.mark.parametrize(
    ("place", "velocity", "speed"),
    [((2.0, 0.0), (7.0, 3.0), 3.0), ((0.0, 2.0), (3.0, 7.0), -3.0), ((3.0, 4.0), (3.0, 4.0), 0.0)],
)
def test_a_centre_orbits_anticlockwise(
    place: tuple[float, float], velocity: tuple[float, float], speed: float
) -> None:
    found = orbiting(step_with({"eccentricity": [*place, *velocity, 0.0, 0.0]}))
    assert found == pytest.approx(speed, abs=1e-15)


@pytest.mark.parametrize(
    ("slopes", "extremes", "may"),
    [
        ((1.0, -1.0), (-9.0, 1.1), True),  # 0.2 s at 1 + 1 per s: up to 0.4 beyond
        ((1.0, -1.0), (-9.0, 1.5), False),
        ((-1.0, 1.0), (0.9, 9.0), True),
        ((-1.0, 1.0), (0.5, 9.0), False),
        ((0.0, 0.0), (1.0, 1.0), False),  # at rest at its own extremes
    ],
)
def test_an_inner_state_may_go_as_far_as_its_slopes_take_it(
    slopes: tuple[float, float], extremes: tuple[float, float], may: bool
) -> None:
    lowest, highest = extremes
    blocks = {"inner_row": [0.0], "previous": [1.0], "channel": [1.0], "tried": [0.2]}
    blocks |= {"lowest": [lowest], "highest": [highest], "k1_": [slopes[0]], "slope": [slopes[1]]}
    assert may_be_beyond(step_with(blocks)) is may


@pytest.mark.parametrize(("highest", "beyond"), [(0.99, True), (1.02, False)])
def test_an_inner_state_that_swings_is_looked_at_up_to_half_a_bend(
    highest: float, beyond: bool
) -> None:
    # the top at 3.5 is 1; samples beside it are 0.9975, and the second difference is 0.02
    place = np.arange(float(INSTANTS)) - MIDDLE
    spare = 1.0 - 0.01 * place[None] ** 2
    step = step_with({"inner_row": [0.0], "lowest": [-9.0], "highest": [highest]}, spare)
    assert is_beyond(step) is beyond
