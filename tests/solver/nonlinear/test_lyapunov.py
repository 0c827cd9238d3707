"""Exponents of systems whose exponents are known."""

import math

import numpy as np
import pytest

from jointplay.solver.nonlinear.estimate import UNKNOWN, Estimate
from jointplay.solver.nonlinear.lyapunov import (
    confirmed,
    contradicts,
    exponent_from_growth,
    in_smaller_steps,
    undecided,
)
from tests.solver.nonlinear.exponents import (
    agrees,
    companion_exponent,
    map_exponent,
    tangent_exponent,
)
from tests.solver.nonlinear.textbook import (
    CAT,
    HENON,
    LOGISTIC_4,
    LORENZ,
    UEDA,
    Driven,
    Map,
    circle,
    delayed_logistic,
    impact_oscillator,
    linear,
    logistic,
    sawtooth_ball,
)


def exponent_of(system: Map, iterations: int):
    return map_exponent(system.step, system.jacobian, system.start, iterations)


def exponent_by_tangent(system: Driven, blocks: int):
    return tangent_exponent(system.flow, system.start, system.block_time, blocks, system.steps)


@pytest.mark.parametrize(
    "system",
    [
        linear([[2.0, 1.0], [0.0, 0.5]]),
        linear([[0.5, 0.2], [0.1, 0.3]]),
        linear([[3.0, 0.0, 0.0], [1.0, 2.0, 0.0], [0.0, 1.0, -1.0]]),
        CAT,
    ],
)
def test_linear_maps_are_exact(system: Map) -> None:
    found = exponent_of(system, 400)
    # the second eigenvalue has died out to rounding after the tenth that is left out
    assert agrees(found, system.exponent)
    assert found.error < 1e-14


@pytest.mark.parametrize(
    ("system", "iterations", "precision"),
    [(LOGISTIC_4, 5000, 0.005), (HENON, 10_000, 0.006)],
)
def test_chaotic_maps_agree_within_their_error(
    system: Map, iterations: int, precision: float
) -> None:
    found = exponent_of(system, iterations)
    assert agrees(found, system.exponent, errors=2.0)
    assert found.error < precision
    assert not found.drifting


def test_tangent_vectors_find_the_exponent_of_the_lorenz_attractor() -> None:
    found = exponent_by_tangent(LORENZ, 1000)
    assert agrees(found, LORENZ.exponent, errors=2.0)
    assert found.error < 0.05


def test_tangent_and_companion_find_that_of_duffings_oscillator() -> None:
    tangent = exponent_by_tangent(UEDA, 250)
    companion = companion_exponent(UEDA.advance_pair, UEDA.start, UEDA.block_time, 250)
    for found in (tangent, companion):
        assert agrees(found, UEDA.exponent, errors=2.0)
        assert found.error < 0.02
    # the same motion, the same growth: they part only by the companion's finite distance
    assert companion.value == pytest.approx(tangent.value, abs=1e-5)


def test_an_impact_oscillator_that_is_a_cat_map_has_its_exponent() -> None:
    """Every bit of it comes from the jumps: between impacts differences grow only linearly."""
    ball = sawtooth_ball()
    tangent = exponent_by_tangent(ball, 800)
    companion = companion_exponent(ball.advance_pair, ball.start, ball.block_time, 800)
    for found in (tangent, companion):
        assert agrees(found, ball.exponent, errors=2.0)
        assert found.error < 0.01
        assert found.exceeds(0.0)


def test_without_the_saltation_the_exponent_would_be_wrong() -> None:
    ball = sawtooth_ball()
    x, tangent = ball.start, np.array([[0.6], [0.8]])
    growth = []
    for i in range(400):
        time = i * ball.block_time
        _, smooth = type(ball.flow)(ball.flow.rate, ball.flow.jacobian).advance_tangents(
            time, x, tangent, ball.block_time, ball.steps
        )
        x = ball.flow.advance(time, x, ball.block_time, ball.steps)
        length = float(np.hypot(*smooth[:, 0]))
        growth.append(math.log(length))
        tangent = smooth / length
    found = exponent_from_growth(np.array(growth), ball.block_time)
    assert not agrees(found, ball.exponent, errors=10.0)


@pytest.mark.parametrize(
    ("damping", "restitution", "frequency"), [(0.05, 0.8, 2.4), (0.02, 0.9, 2.2), (0.05, 0.7, 1.8)]
)
def test_a_stable_impact_oscillator_contracts_as_its_determinant_says(
    damping: float, restitution: float, frequency: float
) -> None:
    system = impact_oscillator(damping, restitution, frequency, stop=0.0)
    found = exponent_by_tangent(system, 250)
    assert agrees(found, system.exponent)
    assert found.error < 0.01
    assert found.falls_below(0.0)


def test_a_chaotic_impact_oscillator_is_seen_by_both_ways() -> None:
    system = impact_oscillator(0.02, 0.8, 2.8, stop=0.0)
    tangent = exponent_by_tangent(system, 250)
    companion = companion_exponent(system.advance_pair, system.start, system.block_time, 250)
    assert tangent.exceeds(0.05)
    # near grazing the square root takes a companion out of the linear range now and then
    assert agrees(companion, tangent.value, errors=1.0)


@pytest.mark.parametrize(
    "system", [circle(0.5 * (math.sqrt(5.0) - 1.0), 0.7), delayed_logistic(2.1)]
)
def test_quasi_periodic_motion_has_exponent_zero(system: Map) -> None:
    found = exponent_of(system, 2000)
    assert agrees(found, 0.0)
    assert found.error < 0.005


def test_on_a_torus_the_error_covers_where_the_record_begins_and_ends() -> None:
    """The length of the vector comes and goes; batches in which that averages out do not see it."""
    torus = delayed_logistic(2.1)
    for start in torus.orbit(15, 3000):
        found = map_exponent(torus.step, torus.jacobian, start, 3000)
        assert agrees(found, 0.0)
        assert found.error < 0.001
        assert not found.drifting


@pytest.mark.parametrize(("rate", "multipliers"), [(2.8, [2.0 - 2.8]), (3.2, [4.0 + 6.4 - 3.2**2])])
def test_periodic_motion_has_the_exponent_of_its_multiplier(
    rate: float, multipliers: list[float]
) -> None:
    # fixed point: 2 - r; period two: 4 + 2r - r²
    period = 1 if rate < 3.0 else 2
    found = exponent_of(logistic(rate), 2000)
    assert agrees(found, math.log(abs(multipliers[0])) / period)
    assert found.falls_below(-0.2)


def test_a_superstable_orbit_has_exponent_minus_infinity() -> None:
    found = exponent_of(Map(lambda x: 0.5 + 0.0 * x, lambda x: np.zeros((1, 1)), np.ones(1), 0), 50)
    assert (found.value, found.error) == (-math.inf, 0.0)


def test_the_metric_of_a_companion_does_not_matter() -> None:
    one = companion_exponent(UEDA.advance_pair, UEDA.start, UEDA.block_time, 40)
    other = companion_exponent(
        UEDA.advance_pair, UEDA.start, UEDA.block_time, 40, metric=np.array([1.0, 30.0])
    )
    # lengths in two metrics differ by a factor of up to 30 at either end
    assert other.value == pytest.approx(
        one.value, abs=2.0 * math.log(30.0) / (36 * UEDA.block_time)
    )


@pytest.mark.parametrize(
    ("found", "finer", "error", "contradicted"),
    [
        (Estimate(14.6, 1e-5), Estimate(-3.3, 4.9), 17.9, True),
        (Estimate(6.4, 0.6), Estimate(6.7, 1.2), 1.2, False),
        (Estimate(40.0, 3.0), Estimate(28.0, 4.0), 12.0, False),  # too near to tell them apart
        (Estimate(40.0, 1.0), Estimate(20.0, 1.0), 20.0, True),
        (Estimate(40.0, 1e-3), Estimate(39.9, 1e-3), 0.1, False),  # of no consequence
        (Estimate(1.0, 0.1), UNKNOWN, 0.1, False),
        (Estimate(-math.inf, 0.0), Estimate(-2.0, 0.1), 0.0, False),
    ],
)
def test_an_exponent_is_no_better_than_what_smaller_steps_leave_of_it(
    found: Estimate, finer: Estimate, error: float, contradicted: bool
) -> None:
    assert confirmed(found, finer).value == found.value
    assert confirmed(found, finer).error == pytest.approx(error)
    assert contradicts(finer, found) == contradicted


@pytest.mark.parametrize(
    ("finer", "open_still"),
    [(Estimate(18.0, 7.0), True), (Estimate(18.0, 5.0), False), (Estimate(-20.0, 7.0), False)],
)
def test_a_stretch_in_smaller_steps_is_longer_where_it_settles_nothing(
    finer: Estimate, open_still: bool
) -> None:
    assert undecided(Estimate(20.0, 1.0), finer) == open_still
    assert not undecided(Estimate(2.0, 1.0), finer)


def test_a_short_stretch_has_the_error_of_its_length() -> None:
    noise = np.random.default_rng(5).standard_normal(400)
    found = [in_smaller_steps(noise[:360] + 0.5, part + 0.5, 2.0) for part in noise.reshape(-1, 8)]
    # four to eight numbers of standard deviation 1, over blocks that last 2; widened by Student's t
    errors = [one.error for one in found]
    assert min(errors) > 0.8 / math.sqrt(8.0) / 2.0
    assert max(errors) < 1.5 / math.sqrt(4.0) / 2.0
    assert all(agrees(one, 0.25) for one in found[45:])


def test_on_a_torus_a_short_stretch_has_the_error_of_where_it_begins_and_ends() -> None:
    growth = np.cos(2.0 * math.pi * 0.06180339887 * np.arange(500.0))
    found = in_smaller_steps(growth[:480], growth[480:488], 1.0)
    assert agrees(found, 0.0)
    assert found.error > 0.3  # half a swing


@pytest.mark.parametrize("record", [60, 100])
def test_smaller_steps_of_the_same_motion_do_not_contradict_it(record: int) -> None:
    """A damped oscillator that is driven: the vector turns, and growth differs by its direction.

    Its exponent is -c / (2 m), whatever drives it. Beside some drives the vector is nearly back
    after a few periods, so that means over eight periods hardly differ, and those over seven do.
    """
    damping, stiffness, first = 1.2, 400.0, 21.0
    for drive in np.arange(first, 60.0, 0.25):
        period = 2.0 * math.pi / drive
        free = math.sqrt(stiffness - damping**2 / 4.0)
        turn, decay = free * period, math.exp(-damping * period / 2.0)
        unit = np.diag([1.0, free])  # motion is a spiral in x and (v + c x / 2) / free
        skew = np.array([[1.0, 0.0], [damping / 2.0, 1.0]])
        spiral = np.array([[math.cos(turn), math.sin(turn)], [-math.sin(turn), math.cos(turn)]])
        to_motion = np.linalg.inv(skew) @ unit
        step = decay * to_motion @ spiral @ np.linalg.inv(to_motion)
        scale = np.diag([1.0, 1.0 / drive])
        step = scale @ step @ np.linalg.inv(scale)
        vector, growth = np.array([math.cos(1.0), math.sin(1.0)]), []
        for _ in range(record + 8):
            vector = step @ vector
            growth.append(math.log(np.linalg.norm(vector)))
            vector /= np.linalg.norm(vector)
        found = exponent_from_growth(np.array(growth[:record]), period)
        finer = in_smaller_steps(np.array(growth[:record]), np.array(growth[record:]), period)
        assert not contradicts(finer, found), drive
