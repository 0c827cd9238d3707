"""Flows with events: what passes through them, and what happens to small differences."""

import math

import numpy as np
import pytest

from tests.solver.nonlinear.flow import Event, Flow, saltation_matrix
from tests.solver.nonlinear.textbook import (
    LORENZ,
    UEDA,
    Driven,
    impact_oscillator,
    sawtooth_ball,
)


@pytest.mark.parametrize(
    "system", [LORENZ, UEDA, sawtooth_ball(), impact_oscillator(0.02, 0.8, 2.8, 0.0)]
)
def test_tangents_are_the_derivative_of_the_motion(system: Driven) -> None:
    """By central differences, across events too."""
    x = system.section(1, 7)[0]
    time, duration, steps = 8 * system.block_time, 3 * system.block_time, 12 * system.steps
    identity = np.eye(len(x))
    _, tangents = system.flow.advance_tangents(time, x, identity, duration, steps)
    step = 1e-7
    for i, direction in enumerate(identity):
        up, down = (
            system.flow.advance(time, x + sign * step * direction, duration, steps)
            for sign in (1.0, -1.0)
        )
        # differences: truncation step² times third derivatives of up to 1e7, rounding 1e-15 / step
        assert (up - down) / (2.0 * step) == pytest.approx(tangents[:, i], rel=1e-6, abs=1e-6)


def test_impacts_scale_areas_by_the_square_of_the_restitution() -> None:
    damping, restitution = 0.02, 0.8
    system = impact_oscillator(damping, restitution, 2.8, 0.0)
    x, areas = system.start, []
    for i in range(40):
        before = i * system.block_time
        x, tangents = system.flow.advance_tangents(
            before, x, np.eye(2), system.block_time, system.steps
        )
        areas.append(np.linalg.det(tangents) * math.exp(2.0 * damping * system.block_time))
    impacts = np.log(areas) / (2.0 * math.log(restitution))
    # a whole number each; the Runge-Kutta determinant is exact to h⁵ of 0.056
    assert impacts == pytest.approx(np.round(impacts), abs=1e-5)
    assert set(np.round(impacts)) == {1.0, 2.0}


def test_a_latch_at_onset_takes_the_rate_at_which_neighbours_arrive() -> None:
    """The state holds the speed at which a gap closed; free fall gives its derivative.

    From height y and speed u the gap closes with v² = u² + 2 y: ∂v/∂y = 1/v, ∂v/∂u = u/v.
    """
    latch = Event(
        guard=lambda t, x: float(x[0]),
        guard_gradient=lambda t, x: np.array([1.0, 0.0, 0.0]),
        jump=lambda t, x: np.array([x[0], x[1], -x[1]]),
        jump_jacobian=lambda t, x: np.array([[1.0, 0, 0], [0, 1.0, 0], [0, -1.0, 0]]),
    )
    fall = Flow(
        lambda t, x: np.array([x[1], -1.0, 0.0]),
        lambda t, x: np.array([[0.0, 1, 0], [0, 0, 0], [0, 0, 0]]),
        (latch,),
    )
    height, speed = 2.0, 0.5
    arrival = math.hypot(speed, math.sqrt(2.0 * height))
    x, tangents = fall.advance_tangents(0.0, np.array([height, speed, 0.0]), np.eye(3), 4.0, 3)
    assert x[2] == pytest.approx(arrival, rel=1e-14)
    assert tangents[2] == pytest.approx([1.0 / arrival, speed / arrival, 0.0], rel=1e-13)


def test_a_saltation_matrix_does_not_depend_on_how_the_guard_is_measured() -> None:
    ball = sawtooth_ball()
    (impact,) = ball.flow.events
    cubed = Event(
        lambda t, x: impact.guard(t, x) * (5.0 + x[1]) ** 2,
        lambda t, x: np.array([(5.0 + x[1]) ** 2, 2.0 * x[0] * (5.0 + x[1])]),
        impact.jump,
        impact.jump_jacobian,
        jump_rate=impact.jump_rate,
    )
    at = (3.3, np.array([0.0, -1.4]))
    assert saltation_matrix(ball.flow, cubed, *at) == pytest.approx(
        saltation_matrix(ball.flow, impact, *at), rel=1e-14
    )


def test_a_moving_guard_is_met_where_it_is() -> None:
    """A table that rises with speed s under a falling ball; elastic in the table's frame."""
    rise = 0.25
    bounce = Event(
        guard=lambda t, x: float(x[0]) - rise * t,
        guard_gradient=lambda t, x: np.array([1.0, 0.0]),
        jump=lambda t, x: np.array([x[0], 2.0 * rise - x[1]]),
        jump_jacobian=lambda t, x: np.array([[1.0, 0.0], [0.0, -1.0]]),
        guard_rate=lambda t, x: -rise,
    )
    free = Flow(
        lambda t, x: np.array([x[1], -1.0]),
        lambda t, x: np.array([[0.0, 1.0], [0.0, 0.0]]),
        (bounce,),
    )
    x, tangents = free.advance_tangents(0.0, np.array([1.0, 0.0]), np.eye(2), 3.0, 7)
    # in the table's frame it bounces between the same heights for ever
    height, speed = x[0] - 3.0 * rise, x[1] - rise
    assert 0.5 * speed**2 + height == pytest.approx(0.5 * rise**2 + 1.0, rel=1e-13)
    assert abs(np.linalg.det(tangents)) == pytest.approx(1.0, rel=1e-12)


def test_an_event_at_the_end_of_a_step_fires_once() -> None:
    count = []

    def jump(time: float, x: np.ndarray) -> np.ndarray:
        count.append(time)
        return np.array([1.0])

    clock = Event(
        lambda t, x: float(x[0]), lambda t, x: np.ones(1), jump, lambda t, x: np.zeros((1, 1))
    )
    down = Flow(lambda t, x: -np.ones(1), lambda t, x: np.zeros((1, 1)), (clock,))
    end = down.advance(0.0, np.array([1.0]), 4.0, 8)
    assert count == pytest.approx([1.0, 2.0, 3.0, 4.0], abs=1e-14)
    assert end == pytest.approx([1.0], abs=1e-14)


@pytest.mark.parametrize(("speed", "jumps"), [(1.0, 1), (-1.0, 0)])
def test_a_start_on_the_guard_counts_as_where_it_comes_to(speed: float, jumps: int) -> None:
    count = []

    def jump(time: float, x: np.ndarray) -> np.ndarray:
        count.append(time)
        return np.array([x[0], x[1], 1.0])

    latch = Event(
        lambda t, x: float(x[0]),
        lambda t, x: np.array([1.0, 0.0, 0.0]),
        jump,
        lambda t, x: np.diag([1.0, 1.0, 0.0]),
    )
    fall = Flow(
        lambda t, x: np.array([x[1], -1.0, 0.0]),
        lambda t, x: np.array([[0.0, 1, 0], [0, 0, 0], [0, 0, 0]]),
        (latch,),
    )
    fall.advance(0.0, np.array([0.0, speed, 0.0]), 5.0, 20)
    assert count == pytest.approx([2.0] * jumps)


def test_steps_longer_than_a_flight_are_refused() -> None:
    ball = sawtooth_ball()
    with pytest.raises(ValueError, match="two events of one guard in a step"):
        ball.flow.advance(0.0, ball.start, 30.0, 1)
