"""Perturbed starts: reproducible, independent, and as wide as asked."""

import math

import numpy as np
import pytest

from jointplay.solver.runs.starts import Perturbation, perturbed_start, start_scales
from jointplay.solver.scene import presets
from jointplay.solver.scene.document import Scene

POSITION, SPEED = np.array([1.0, -2.0]), np.array([0.5, 0.0])
SCALES = np.array([1e-3, 2e-3]), np.array([3e-3, 4e-3])


def start(spread: float, seed: int, member: int) -> np.ndarray:
    state, scales = np.concatenate([POSITION, SPEED]), np.concatenate(SCALES)
    return perturbed_start(state, scales, Perturbation(spread, seed), member).reshape(2, 2)


def test_the_first_member_starts_as_the_scene_does() -> None:
    assert start(0.5, 7, 0).tolist() == [POSITION.tolist(), SPEED.tolist()]


def test_a_member_depends_on_the_seed_and_its_number_alone() -> None:
    once = [start(1.0, 7, member) for member in (5, 3, 4)]
    again = [start(1.0, 7, member) for member in (3, 4, 5)]
    assert np.array_equal(once[0], again[2])
    assert np.array_equal(once[1], again[0])
    assert not np.array_equal(start(1.0, 7, 3), start(1.0, 8, 3))
    assert not np.array_equal(start(1.0, 7, 3), start(1.0, 3, 7))
    assert start(1.0, 2**53 - 1, 100_000 - 1).shape == (2, 2)


def test_the_numbers_of_a_member_stay_what_they_are() -> None:
    """Results are repeated by their job: the generator's stream is part of the format."""
    found = (start(1.0, 1, 1) - [POSITION, SPEED]) / SCALES
    generator = np.random.Generator(np.random.Philox(key=np.array([1, 1], np.uint64)))
    # rounding of adding a millionth to one
    assert found == pytest.approx(generator.standard_normal((2, 2)), abs=1e-12)


def test_starts_spread_as_asked_in_every_coordinate() -> None:
    members = 4000
    found = np.array([start(0.1, 1, member) for member in range(1, members)])
    deviates = (found - [POSITION, SPEED]) / SCALES
    # four standard errors of a standard deviation, sigma/sqrt(2 n), and of a mean, sigma/sqrt(n)
    assert deviates.std(axis=0) == pytest.approx(0.1, rel=4 / math.sqrt(2 * members))
    assert deviates.mean(axis=0) == pytest.approx(0.0, abs=4 * 0.1 / math.sqrt(members))
    flat = deviates.reshape(members - 1, 4)
    apart = np.corrcoef(flat, rowvar=False)[~np.eye(4, dtype=bool)]
    assert np.abs(apart).max() < 4 / math.sqrt(members)


def test_scales_are_the_finest_clearance_and_what_it_is_per_time_unit() -> None:
    document = presets.document("seven-bar-press")
    document["joints"]["B"]["clearance"]["radial_clearance"] = 2e-4
    scene = Scene.model_validate(document)
    position, speed = np.split(start_scales(scene, ["link2.theta", "slider7.s"], period=2.0), 2)
    longest = 2 * 0.5572845  # link 6
    assert position == pytest.approx([2e-4 / longest, 2e-4], rel=1e-12)  # rounding
    assert speed == pytest.approx(position * math.pi, rel=1e-12)
