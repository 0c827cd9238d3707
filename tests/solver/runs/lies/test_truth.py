"""The independent program against closed forms, and the solver at a fine tolerance against it."""

import math
from typing import Any

import numpy as np
import pytest

from benchmarks.lies.covered import PROGRAMS
from benchmarks.lies.draw import anywhere
from benchmarks.lies.job import random_job
from benchmarks.lies.run import Finished, finish
from benchmarks.lies.truth import true_channels

ENOUGH = 60_000
ROUNDING = 1e-11
"""Noise in an acceleration that vanishes, rad/s^2."""


def _finished(preset: str, duration: float, **parameters: Any) -> Finished:
    scene = {"preset": preset, "parameters": parameters}
    job = {"kind": "simulate", "scene": scene, "duration": duration, "tolerance": 1e-13}
    found = finish(job | {"output_step": duration / 50, "certificate": False})
    assert isinstance(found, Finished)
    return found


def _true(finished: Finished, program: tuple[float, float] = PROGRAMS[0]) -> dict[str, np.ndarray]:
    first = dict(zip(finished.names, finished.samples[0], strict=True))
    found = true_channels(finished.scene, first, finished.time, *program, ENOUGH)
    assert found is not None
    return found.values


@pytest.mark.parametrize("program", PROGRAMS)
def test_a_pendulum_swings_for_its_elliptic_integral(program: tuple[float, float]) -> None:
    # a rod of 1 m from the level: T = 4 K(sin 45°) sqrt(I / (m g a)), I = 1/3 kg m^2, a = 0.5 m
    period = 4.0 * 1.8540746773013719 * math.sqrt((1.0 / 3.0) / (9.81 * 0.5))
    found = _true(_finished("pendulum", period), program)
    assert found["rod.theta"][-1] == pytest.approx(0.0, abs=1e-9)
    # the start is at rest, so energy stays zero, of 4.9 J that come and go
    np.testing.assert_allclose(found["energy.kinetic"], -found["energy.potential"], atol=1e-10)


def test_a_ball_rises_as_high_as_it_fell_where_the_law_loses_nothing() -> None:
    end = 0.025
    found = _true(_finished("bouncing-journal", end, restitution=1.0, friction=0.0))
    energy = found["energy.kinetic"] + found["energy.potential"]
    apart = found["bearing.penetration"] < 0.0
    np.testing.assert_allclose(energy[apart], 0.0, atol=1e-13)  # J, of 0.01 J
    # it falls through 1 mm; Hertz's impact lasts 2.943 depth / speed (Johnson 1985, eq. 11.25)
    fall = math.sqrt(2e-3 / 9.81)
    speed = 9.81 * fall
    depth = (1.25 * speed**2 / 1e9) ** 0.4
    lasting = found["journal.vy"][-1] / 9.81 + end - 2.0 * fall
    assert lasting == pytest.approx(2.943 * depth / speed, rel=0.02)  # the weight lengthens it


@pytest.mark.parametrize(
    ("preset", "duration", "parameters"),
    [
        ("bouncing-journal", 0.1, {"velocity_x": 0.1, "spin": 30.0}),
        ("slider-crank", 0.004, {}),
        ("seven-bar-press", 0.03, {"friction": 0.1, "slip_velocity": "as-published"}),
    ],
)
def test_the_solver_finds_the_same_channels(
    preset: str, duration: float, parameters: dict[str, Any]
) -> None:
    finished = _finished(preset, duration, **parameters)
    true = _true(finished)
    assert set(true) == set(finished.names)
    _compare(finished, true)


@pytest.mark.parametrize("kind", ["swung guide", "slot of a yoke, motor", "flat cam"])
def test_the_solver_finds_the_same_channels_between_walls_and_at_cams(kind: str) -> None:
    job = random_job(anywhere(np.random.default_rng(1)), [kind]).job
    job |= {"method": "auto", "tolerance": 1e-13, "certificate": False}
    finished = finish(job | {"output_step": job["duration"] / 50})
    assert isinstance(finished, Finished)
    assert sum(map(len, finished.onsets.values())) > 1
    true = _true(finished)
    assert set(true) >= set(finished.names)
    _compare(finished, true)


def _compare(finished: Finished, true: dict[str, np.ndarray]) -> None:
    largest = dict.fromkeys(finished.units, 0.0)
    for name, unit in zip(finished.names, finished.units, strict=True):
        largest[unit] = max(largest[unit], float(np.abs(true[name]).max()))
    for column, (name, unit) in enumerate(zip(finished.names, finished.units, strict=True)):
        # steps of both are good to 1e-12; each impact multiplies an error by about ten
        np.testing.assert_allclose(
            finished.samples[:, column], true[name], rtol=0.0, atol=1e-7 * largest[unit] + ROUNDING
        )
