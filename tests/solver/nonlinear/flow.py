"""A flow with events, and how small differences pass through them: the saltation matrix.

Sources: Müller 1995, Chaos Solitons Fractals 5:1671; Leine and Nijmeijer 2004, Dynamics and
Bifurcations of Non-Smooth Mechanical Systems, ch. 7; Kong et al. 2023, arXiv 2306.06862, eq. (3).
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

Floats = NDArray[np.float64]
Scalar = Callable[[float, Floats], float]
Vector = Callable[[float, Floats], Floats]


def _nothing(time: float, state: Floats) -> Floats:
    return np.zeros(len(state))


def _zero(time: float, state: Floats) -> float:
    return 0.0


@dataclass(frozen=True)
class Event:
    """The state jumps from x to `jump`(t, x) where `guard`(t, x) falls through zero.

    An event belongs to the step (t₀, t₁] at whose end the guard is zero or below and at whose start
    it was above, or zero and rising. The derivatives: `guard_gradient` ∂g/∂x (d,), `guard_rate`
    ∂g/∂t, `jump_jacobian` ∂R/∂x (d, d), `jump_rate` ∂R/∂t (d,).
    """

    guard: Scalar
    guard_gradient: Vector
    jump: Vector
    jump_jacobian: Vector
    guard_rate: Scalar = _zero
    jump_rate: Vector = _nothing

    def speed(self, time: float, state: Floats, rate: Floats) -> float:
        """Return the total time derivative of the guard along ẋ = rate."""
        gradient = self.guard_gradient(time, state)
        return float((gradient * rate).sum()) + self.guard_rate(time, state)


@dataclass(frozen=True)
class Flow:
    """ẋ = `rate`(t, x), x (d,), with its `jacobian` (d, d) and events.

    Integrated by the classical Runge-Kutta method with equal steps; a step in which an event falls
    is split there.
    """

    rate: Vector
    jacobian: Vector
    events: tuple[Event, ...] = ()

    def advance(self, time: float, state: Floats, duration: float, steps: int) -> Floats:
        """Return the state (d,) after a duration, in equal steps."""
        return self.advance_tangents(time, state, np.empty((len(state), 0)), duration, steps)[0]

    def advance_tangents(
        self, time: float, state: Floats, tangents: Floats, duration: float, steps: int
    ) -> tuple[Floats, Floats]:
        """Return state (d,) and tangent vectors (d, k) after a duration, in equal steps.

        Tangents pass through the same Runge-Kutta formulas: they are exact derivatives of the
        computed states, but for the error of the method in the instant of an event.

        Raises
        ------
        ValueError
            If a guard is left and crossed again within one step: shorter steps are needed.
        """
        for i in range(steps):
            now = time + duration * i / steps
            end = time + duration * (i + 1) / steps
            fired: Event | None = None
            while True:
                arrived = self._step(now, state, tangents, end - now)
                crossing = self._first_crossing(now, state, end, arrived[0], fired)
                if crossing is None:
                    break
                fired, span = crossing
                state, tangents = self._step(now, state, tangents, span)
                now = min(now + span, end)
                state, tangents = self._pass(fired, now, state, tangents)
            state, tangents = arrived
        return state, tangents

    def _step(
        self, time: float, state: Floats, tangents: Floats, span: float
    ) -> tuple[Floats, Floats]:
        """Take one step of the classical Runge-Kutta method."""
        moving = tangents.shape[1] > 0
        x, v = state, tangents
        x_sum, v_sum = np.zeros_like(state), np.zeros_like(tangents)
        for share, weight, reach in (
            (0.0, 1.0, 0.5),
            (0.5, 2.0, 0.5),
            (0.5, 2.0, 1.0),
            (1.0, 1.0, 0.0),
        ):
            instant = time + share * span
            rate = self.rate(instant, x)
            x_sum = x_sum + weight * rate
            if moving:
                v_rate = self.jacobian(instant, x) @ v
                v_sum = v_sum + weight * v_rate
                v = tangents + reach * span * v_rate
            x = state + reach * span * rate
        return state + span / 6.0 * x_sum, tangents + span / 6.0 * v_sum

    def _first_crossing(
        self, now: float, state: Floats, end: float, arrived: Floats, fired: Event | None
    ) -> tuple[Event, float] | None:
        """Return the first event of a step and how long after its start; None: there is none."""
        nothing = np.empty((len(state), 0))
        first: tuple[Event, float] | None = None
        for event in self.events:
            reached = event.guard(end, arrived)
            if reached > 0.0:
                continue
            level = event.guard(now, state)
            if event is fired or level == 0.0:  # on the guard: which way it leaves decides
                rising = event.speed(now, state, self.rate(now, state)) > 0.0
                if rising and reached < 0.0:
                    raise ValueError(f"two events of one guard in a step at t = {now}: shorten it")
                continue
            if level < 0.0:
                continue

            def guard(span: float, event: Event = event) -> float:
                return event.guard(now + span, self._step(now, state, nothing, span)[0])

            span = float(brentq(guard, 0.0, end - now, xtol=1e-15 * abs(end), rtol=1e-15))
            if first is None or span < first[1]:
                first = event, span
        return first

    def _pass(
        self, event: Event, time: float, state: Floats, tangents: Floats
    ) -> tuple[Floats, Floats]:
        after = event.jump(time, state)
        if tangents.shape[1] == 0:
            return after, tangents
        return after, saltation_matrix(self, event, time, state) @ tangents


def saltation_matrix(flow: Flow, event: Event, time: float, state: Floats) -> Floats:
    """Return the derivative (d, d) of states after an event by states before it.

    S = R_x + (f⁺ - R_x f⁻ - R_t) g_xᵀ / (g_t + g_x f⁻): neighbours jump too, and reach the guard
    at another instant. The guard must be crossed, not grazed: S grows without bound there.
    """
    before = flow.rate(time, state)
    after = flow.rate(time, event.jump(time, state))
    jump = event.jump_jacobian(time, state)
    late = after - jump @ before - event.jump_rate(time, state)
    gradient = event.guard_gradient(time, state)
    return np.asarray(
        jump + np.outer(late, gradient) / event.speed(time, state, before), np.float64
    )
