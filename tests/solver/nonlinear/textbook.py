"""Systems whose exponents are known: exactly, or from the literature."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from tests.solver.nonlinear.flow import Event, Flow

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Map:
    """x → step(x) with its Jacobian; `exponent` is the largest, per iteration."""

    step: Callable[[Floats], Floats]
    jacobian: Callable[[Floats], Floats]
    start: Floats
    exponent: float

    def orbit(self, count: int, skipped: int = 0) -> Floats:
        """Return (count, d) states after some that are skipped."""
        x, states = self.start, []
        for _ in range(skipped + count):
            x = self.step(x)
            states.append(x)
        return np.array(states[skipped:])


def linear(matrix: list[list[float]]) -> Map:
    """x → A x: the logarithm of the spectral radius."""
    a = np.array(matrix)
    radius = float(np.abs(np.linalg.eigvals(a)).max())
    return Map(lambda x: a @ x, lambda x: a, np.ones(len(a)), math.log(radius))


def logistic(rate: float, exponent: float = math.nan) -> Map:
    """x → r x (1 - x); at r = 4 conjugate to the tent map, exponent log 2."""
    return Map(
        lambda x: rate * x * (1.0 - x),
        lambda x: np.array([rate * (1.0 - 2.0 * x)]),
        np.array([0.3]),
        exponent,
    )


LOGISTIC_4 = logistic(4.0, math.log(2.0))

HENON = Map(
    lambda x: np.array([1.0 - 1.4 * x[0] ** 2 + x[1], 0.3 * x[0]]),
    lambda x: np.array([[-2.8 * x[0], 1.0], [0.3, 0.0]]),
    np.array([0.1, 0.1]),
    0.41922,  # Sprott 2003, Chaos and Time-Series Analysis, appendix A
)

GOLDEN_CAT = math.log(0.5 * (3.0 + math.sqrt(5.0)))
CAT = Map(
    lambda x: np.array([x[0] + x[1], x[0] + 2.0 * x[1]]) % 1.0,
    lambda x: np.array([[1.0, 1.0], [1.0, 2.0]]),
    np.array([0.3, 0.1 * math.sqrt(2.0)]),
    GOLDEN_CAT,  # Arnold and Avez 1968: hyperbolic automorphism of the torus
)


def delayed_logistic(rate: float) -> Map:
    """x → r x (1 - y), y → x: for r a little above 2 a closed curve, rotation number near 1/6."""
    return Map(
        lambda x: np.array([rate * x[0] * (1.0 - x[1]), x[0]]),
        lambda x: np.array([[rate * (1.0 - x[1]), -rate * x[0]], [1.0, 0.0]]),
        np.array([0.5, 0.45]),
        0.0,
    )


def circle(rotation: float, bend: float) -> Map:
    """A circle map conjugate to the rigid rotation θ → θ + ρ by θ = s + b sin(2πs)/(2π), b < 1.

    In turns; its rotation number is ρ, its exponent 0, and its steps are uneven.
    """
    turn = 2.0 * math.pi

    def straighten(angle: float) -> float:
        s = angle
        for _ in range(60):  # Newton's iteration, damped: the slope is between 1 - b and 1 + b
            s -= (s + bend * math.sin(turn * s) / turn - angle) / (1.0 + bend)
        for _ in range(4):
            residual = s + bend * math.sin(turn * s) / turn - angle
            s -= residual / (1.0 + bend * math.cos(turn * s))
        return s

    def step(x: Floats) -> Floats:
        s = straighten(float(x[0])) + rotation
        return np.array([(s + bend * math.sin(turn * s) / turn) % 1.0])

    def jacobian(x: Floats) -> Floats:
        s = straighten(float(x[0]))
        slope = 1.0 + bend * math.cos(turn * (s + rotation))
        return np.array([[slope / (1.0 + bend * math.cos(turn * s))]])

    return Map(step, jacobian, np.array([0.1]), 0.0)


@dataclass(frozen=True)
class Driven:
    """A flow, cut into blocks of time; `exponent` is the largest, per unit of time."""

    flow: Flow
    start: Floats
    block_time: float
    steps: int
    exponent: float

    def section(self, count: int, skipped: int = 0) -> Floats:
        """Return (count, d) states at the ends of blocks."""
        x, states = self.start, []
        for i in range(skipped + count):
            x = self.flow.advance(i * self.block_time, x, self.block_time, self.steps)
            states.append(x)
        return np.array(states[skipped:])

    def advance_pair(self, time: float, states: Floats) -> Floats:
        """Take a motion and its companion through one block by the same sequence of steps."""
        return np.array([self.flow.advance(time, x, self.block_time, self.steps) for x in states])


LORENZ = Driven(
    Flow(
        lambda t, x: np.array(
            [10.0 * (x[1] - x[0]), x[0] * (28.0 - x[2]) - x[1], x[0] * x[1] - 8.0 / 3.0 * x[2]]
        ),
        lambda t, x: np.array(
            [[-10.0, 10.0, 0.0], [28.0 - x[2], -1.0, -x[0]], [x[1], x[0], -8.0 / 3.0]]
        ),
    ),
    np.array([-5.0, -6.0, 22.0]),
    0.5,
    25,
    0.9056,  # Sprott 2003, appendix A
)


def duffing(amplitude: float, exponent: float = math.nan) -> Driven:
    """ẍ + 0.05 ẋ + x³ = B cos t, one block a period (Ueda 1979, J. Stat. Phys. 20:181)."""
    return Driven(
        Flow(
            lambda t, x: np.array([x[1], -0.05 * x[1] - x[0] ** 3 + amplitude * math.cos(t)]),
            lambda t, x: np.array([[0.0, 1.0], [-3.0 * x[0] ** 2, -0.05]]),
        ),
        np.array([2.5, 0.0]),
        2.0 * math.pi,
        60,
        exponent,
    )


UEDA = duffing(7.5, 0.1034)  # Sprott 2003, appendix A; 200 000 periods give 0.1031 ± 0.0002


@cache
def ueda_section() -> Floats:
    """Return 600 sections (600, 2) of the Ueda attractor."""
    return UEDA.section(600, 20)


def sawtooth_ball() -> Driven:
    """A ball on a table that strikes like a saw: an impact oscillator that is a cat map.

    Height y, velocity u, gravity 2, so that a flight that starts with u takes the time u. The table
    stands at y = 0 and returns u⁺ = 1 + (-u⁻ + t mod 1) mod 1, from 1 to 2. With φ = t mod 1 and
    w = u⁺ mod 1 the impacts follow φ' = φ + w, w' = w + φ' (mod 1): the cat map, whose invariant
    measure is uniform. Its exponent an impact, over the mean flight of 3/2, is that of the flow.
    """

    def jump(time: float, x: Floats) -> Floats:
        return np.array([0.0, 1.0 + (-x[1] + time % 1.0) % 1.0])

    impact = Event(
        guard=lambda t, x: float(x[0]),
        guard_gradient=lambda t, x: np.array([1.0, 0.0]),
        jump=jump,
        jump_jacobian=lambda t, x: np.array([[0.0, 0.0], [0.0, -1.0]]),
        jump_rate=lambda t, x: np.array([0.0, 1.0]),
    )
    fall = Flow(
        lambda t, x: np.array([x[1], -2.0]),
        lambda t, x: np.array([[0.0, 1.0], [0.0, 0.0]]),
        (impact,),
    )
    start = np.array([0.0, 1.0 + 0.1 * math.sqrt(3.0)])
    return Driven(fall, start, 1.5, 2, GOLDEN_CAT / 1.5)


def impact_oscillator(damping: float, restitution: float, frequency: float, stop: float) -> Driven:
    """ẍ + 2ζẋ + x = cos ωt, x ≤ stop, ẋ⁺ = -r ẋ⁻ (Shaw and Holmes 1983, J. Sound Vib. 90:129).

    Where one impact a period is stable with complex multipliers, their modulus is the root of the
    determinant r² exp(-2ζT), and the exponent log(r)/T - ζ.
    """
    period = 2.0 * math.pi / frequency
    impact = Event(
        guard=lambda t, x: stop - float(x[0]),
        guard_gradient=lambda t, x: np.array([-1.0, 0.0]),
        jump=lambda t, x: np.array([stop, -restitution * x[1]]),
        jump_jacobian=lambda t, x: np.array([[0.0, 0.0], [0.0, -restitution]]),
    )
    return Driven(
        Flow(
            lambda t, x: np.array([x[1], math.cos(frequency * t) - x[0] - 2.0 * damping * x[1]]),
            lambda t, x: np.array([[0.0, 1.0], [-1.0, -2.0 * damping]]),
            (impact,),
        ),
        np.array([stop - 1.0, 0.0]),
        period,
        40,
        math.log(restitution) / period - damping,
    )
