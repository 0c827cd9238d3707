"""Verdicts of random points beside an independent program, which scipy's DOP853 confirms."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from benchmarks.verdicts import independent
from benchmarks.verdicts.mechanisms import Oscillator, Pendulum
from benchmarks.verdicts.run import by_another_program

EXACT = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-13}
PERIODS = 12


@pytest.mark.parametrize(
    "mechanism", [Pendulum(), Oscillator()], ids=["driven pendulum", "impact oscillator"]
)
def test_no_verdict_is_wrong(mechanism):
    found = by_another_program(mechanism, 6, seed=7)
    assert found["points"] == 6
    assert found["wrong"] == 0
    assert found["right"] >= 4


def test_the_program_of_the_pendulum_is_right():
    damping, weight, moment, speed = numbers = (4.0, 88.0, 90.0, 2.0 * math.pi)
    sections, growth = independent.pendulum(0.1, -1.0, numbers, PERIODS)

    def rates(time, state):
        theta, omega = state
        push = moment * math.cos(speed * time) - damping * omega - weight * math.sin(theta)
        return omega, push

    found = solve_ivp(rates, (0.0, PERIODS), (0.1, -1.0), t_eval=[1.0, PERIODS], **EXACT)
    assert sections[[0, -1]] == pytest.approx(found.y.T, abs=2e-7)
    near = solve_ivp(rates, (0.0, PERIODS), (0.1 + 1e-6, -1.0), t_eval=[PERIODS], **EXACT)
    apart = (near.y[:, -1] - found.y[:, -1]) / [1e-6, 1e-6 * speed]
    assert growth.sum() == pytest.approx(math.log(np.hypot(*apart)), abs=0.01)


def test_the_program_of_the_oscillator_is_right():
    """Beside events where the mass meets the stop and leaves it."""
    spring, damping, radius, speed, gap, stop, loss = numbers = (
        *(400.0, 2.0, 5e-3, 25.0, 0.01),
        *(1e9, 0.27),
    )
    sections, _ = independent.oscillator(0.0, 0.3, numbers, PERIODS)

    def push(time, state, struck):
        depth = max(state[0] - gap, 0.0)
        force = max(stop * depth**1.5 * (1.0 + loss * state[1] / struck), 0.0) if struck else 0.0
        drive = spring * (radius * math.cos(speed * time) - state[0])
        return state[1], drive - damping * state[1] - force

    def passes(_time, state, _struck):
        return state[0] - gap

    passes.terminal = True
    time, state, struck, end = 0.0, np.array([0.0, 0.3]), 0.0, PERIODS * 2.0 * math.pi / speed
    impacts = 0
    while time < end:
        passes.direction = -1.0 if struck else 1.0
        found = solve_ivp(push, (time, end), state, events=passes, args=(struck,), **EXACT)
        time, state = found.t[-1], found.y[:, -1]
        struck, impacts = (0.0, impacts) if struck else (state[1], impacts + 1)
    assert impacts > PERIODS / 2
    assert sections[-1] == pytest.approx(state, abs=1e-6)
