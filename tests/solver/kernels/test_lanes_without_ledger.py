"""Lanes that add up no works and impulses move as the others do, to the bit."""

from dataclasses import replace

import numpy as np
import pytest

from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem
from jointplay.solver.runs.lane_results import statistics_of
from tests.solver.readable_mechanics import preset

WORKS = ("total", "gross", "stored_start", "potential_start")


@pytest.fixture(scope="module", params=["tsitouras", "rodas"])
def bundles(request: pytest.FixtureRequest) -> tuple[Bundle, Bundle]:
    """Return two impacting slider-cranks, with a ledger and without."""
    scenes = [preset("slider-crank", clearance=clearance) for clearance in (1e-4, 5e-4)]
    kernel = ready_kernel(scenes[0], "reduced", request.param)
    problems = [LaneProblem(scene, 0.012, 1e-6, 1e-3, 13, 0, 0.0) for scene in scenes]
    found = []
    for ledger in (True, False):
        bundle = Bundle(kernel, [replace(problem, ledger=ledger) for problem in problems])
        while bundle.advance(10_000):
            pass
        found.append(bundle)
    return found[0], found[1]


def test_the_motion_is_the_same(bundles):
    kept, left_out = bundles
    for lane in range(2):
        assert kept.lane(lane).steps == left_out.lane(lane).steps > 100
        assert kept.runs[lane]["onsets"] == left_out.runs[lane]["onsets"] > 0
        rows = [bundle.lane(lane).row().view(np.int64) for bundle in bundles]
        assert np.array_equal(*rows)


def test_only_a_ledger_has_works(bundles):
    kept, left_out = (statistics_of(bundle, 0)["energy"] for bundle in bundles)
    assert kept["gross_work"] > 0.0
    assert kept["contact_loss"] > 0.0
    assert left_out["gross_work"] == left_out["contact_loss"] == left_out["driver_work"] == 0.0


def test_lanes_with_and_without_stand_side_by_side(bundles):
    kept, _ = bundles
    scene = preset("slider-crank", clearance=1e-4)
    problem = LaneProblem(scene, 0.012, 1e-6, 1e-3, 13, 0, 0.0)
    mixed = Bundle(kept.kernel, [problem, replace(problem, ledger=False)])
    while mixed.advance(10_000):
        pass
    for name in WORKS:
        assert np.array_equal(mixed.lane(0)[name], kept.lane(0)[name])


@pytest.mark.parametrize("watch", [False, True])
def test_steps_are_looked_into_for_extremes_alone(bundles, watch):
    scene = preset("slider-crank", clearance=1e-4)
    problem = LaneProblem(scene, 0.002, 1e-6, 1e-3, 0, 0, 0.0, ledger=watch)
    bundle = Bundle(bundles[0].kernel, [problem], watch=watch)
    while bundle.advance(10_000):
        pass
    lane = bundle.lane(0)
    assert lane.steps > 10
    assert lane["lengthening"].any() == watch
    assert lane["ledger"].any() == watch
