"""Shares of drawn starts beside what is known of their basins, within three standard errors."""

import pytest

from benchmarks.basin_scenes import cubic_oscillator, shaking
from benchmarks.basins import ANCHORS
from jointplay.local import run
from jointplay.records.attractor_table import attractor_table
from jointplay.records.attractors import attractors_of


def compared(anchor, samples):
    study = run(anchor.job(samples), processes=1).study()
    return anchor.compared(attractors_of(study).found)


def agrees(found):
    return all(abs(apart) < 3.0 for _, apart in found.values())


@pytest.mark.parametrize("anchor", ANCHORS, ids=lambda anchor: anchor.name)
def test_a_small_sample_has_the_shares_that_are_known(anchor):
    found = compared(anchor, 96)
    assert agrees(found), found
    assert found.keys() == anchor.shares.keys()


@pytest.mark.long
@pytest.mark.parametrize("anchor", ANCHORS, ids=lambda anchor: anchor.name)
def test_a_large_sample_has_the_shares_that_are_known(anchor):
    found = compared(anchor, 4000)
    assert agrees(found), found


def chaotic(force, samples=32):
    """Return the attractors of a mass in two wells, which is shaken."""
    job = {
        "kind": "basin-stability",
        "scene": cubic_oscillator(0.5, -1.0, shaking=shaking(force)),
        "starts": {
            "/start/points/mass.centre/0": {"distribution": "uniform", "low": -1.8, "high": 1.8},
            "/start/velocities/mass/0": {"distribution": "uniform", "low": -1.0, "high": 1.0},
        },
        "samples": samples,
        "seed": 3,
        "settle": 50,
        "record": 120,
        "tolerance": 1e-6,
        "indicators": ["lyapunov", "recurrence"],
    }
    return attractor_table(run(job, processes=1).study())["attractors"]


def test_two_chaotic_attractors_are_told_apart():
    """Below 0.38 N chaos stays in either well: mirror images, half a period apart."""
    one, other = [one for one in chaotic(0.37) if one["name"].startswith("chaotic")]
    assert (one["name"], other["name"]) == ("chaotic A", "chaotic B")
    positions = sorted(found["mean"]["mass.s"] for found in (one, other))
    assert positions == pytest.approx([-0.75, 0.48], abs=0.03)  # by Runge-Kutta 4, 200 periods


def test_one_chaotic_attractor_is_one_however_slowly_it_is_crossed():
    """At 0.385 N chaos has left the wells just so: means of records are 1 apart, and one motion."""
    names = [one["name"] for one in chaotic(0.385)]
    assert [name for name in names if name.startswith("chaotic")] == ["chaotic"]
