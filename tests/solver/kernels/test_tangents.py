"""Tangent vectors of runs: against neighbours, and across contacts."""

import math
from itertools import cycle

import numpy as np
import pytest

from jointplay.solver.kernels.target import own_target
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.scene import presets
from tests.solver.completed_runs import CASE_3
from tests.solver.kernels.tangent_runs import bundle_of, grown, growth, problem
from tests.solver.readable_mechanics import preset, scene_of
from tests.solver.runs.test_determinism import PROBLEMS, finish

LANES = own_target().lanes

# what a run with tangents leaves alone


def test_tangents_change_no_bit_of_a_run() -> None:
    plain = finish(bundle_of(PROBLEMS, carried=False), cycle([10**7]))
    assert finish(bundle_of(PROBLEMS), cycle([10**7])) == plain


def test_growth_does_not_depend_on_company_slices_or_who_had_the_lane_before() -> None:
    chosen = [PROBLEMS[0], PROBLEMS[2], PROBLEMS[7]]

    def all_growth(bundle: Bundle, lane: int, budget: int) -> bytes:
        rows = []
        while bundle.advance(budget):
            rows.append(growth(bundle, lane))
        return np.concatenate([*rows, growth(bundle, lane)]).tobytes()

    alone = [all_growth(bundle_of([p]), 0, 10**7) for p in chosen]
    assert len(set(alone)) == 3
    for lane, budget in ((0, 7), (1, 33), (2, 10**7)):
        assert all_growth(bundle_of(chosen), lane, budget) == alone[lane]
    used = bundle_of([PROBLEMS[5], PROBLEMS[6]])
    while used.advance(100) == 2:
        pass
    free = int(np.argmin(used.block("active")[0, :2]))
    used.load(free, chosen[1])
    assert all_growth(used, free, 50) == alone[1]


def test_a_checkpoint_keeps_the_tangent() -> None:
    whole, first, second = (bundle_of([PROBLEMS[2]]) for _ in range(3))
    first.advance(40)
    second.restore(first.state("lanes"), "lanes")
    whole.advance(10**7)
    second.advance(10**7)
    assert growth(second).tobytes() == growth(whole).tobytes()


# neighbours over the same smooth steps

STEPS = 20
NEAR = 1e-6
"""Distance of neighbours in the scene's scales: 5e-10 m on a clearance of 0.5 mm. The press has a
coordinate of 2 m, rounded to 4e-16 m at every step; the slope of a contact 1e-6 m deep is that
between the neighbours within (5e-10 / 1e-6)^2."""
AGREEMENT = 5e-6


def contact_of(bundle: Bundle) -> bool:
    """Whether a joint of lane 0 has closed by half a micrometre and goes on closing."""
    return any(
        bundle.lane(0).number(f"mode{j}") > 0.0
        and bundle.lane(0).number(f"penetration{j}") > 5e-7
        and bundle.lane(0).number(f"penetration_rate{j}") > 0.0
        for j in range(len(bundle.kernel.pairs))
    )


@pytest.mark.parametrize(
    ("name", "parameters", "contact", "longest"),
    [
        ("seven-bar-press", CASE_3, True, 1e-6),
        ("seven-bar-press", CASE_3, False, 1e-4),
        ("slider-crank", {}, True, 1e-7),
        pytest.param(
            *("slider-crank", {"clearance": 0.0, "clearance_guide": 2e-4}, True, 1e-7),
            marks=pytest.mark.long,
        ),
        ("bouncing-journal", {"velocity_x": 0.1, "spin": 3.0}, True, 1e-6),
        ("pendulum", {}, False, 1e-2),
    ],
)
def test_a_tangent_is_the_difference_of_neighbours_that_take_the_same_steps(
    name: str, parameters: dict[str, float], contact: bool, longest: float
) -> None:
    base = bundle_of([problem(preset(name, **parameters), 1.0, 1e-8)])
    while not contact_of(base) if contact else base.lane(0).time < 3e-3:
        base.advance(1)
    kernel, states, joints = base.kernel, base.kernel.states, len(base.kernel.pairs)
    random = np.random.default_rng(5)
    # one direction a lane; lengths and rates by the scene's scales
    scales = 1e-8 / base.lane(0)["weight"][:, None] / 1e-8
    directions = random.uniform(-1.0, 1.0, (states, LANES)) * scales
    directions /= np.linalg.norm(directions / scales, axis=0)
    rates = random.uniform(-1e-10, 1e-10, (joints, LANES))

    def displaced(by: float) -> Bundle:
        bundle = bundle_of([base_problem] * LANES)
        work = bundle.groups[0].work
        work[:] = base.groups[0].work[:, :1]
        for lane in map(bundle.lane, range(LANES)):
            lane["largest_step"] = lane["end"] = math.inf
            lane["y"] += by * directions[:, lane.index]
            lane["impact_rate"] += by * rates[:, lane.index]
            lane["stage"], lane["stage_time"] = lane["y"], lane["time"]
        kernel.module.right_hand_side(work)
        for lane in map(bundle.lane, range(LANES)):
            lane["k1_"] = lane["slope"]
        return bundle

    base_problem = problem(preset(name, **parameters), 1.0, 1e-8)
    middle, ahead, behind = displaced(0.0), displaced(NEAR / 1e-8), displaced(-NEAR / 1e-8)
    tangents = middle.tangents
    assert tangents is not None
    for lane in map(middle.lane, range(LANES)):
        lane["tangent"], lane["tangent_impact_rate"] = (
            each[:, lane.index] for each in (directions, rates)
        )
    for _ in range(STEPS):
        for bundle in (middle, ahead, behind):
            work, at = bundle.groups[0].work, kernel.layout
            work[at["step"]] = longest
            kernel.module.attempt(work)
            work[at["accept"]] = 1.0
        tangents.module.tangent_step(middle.groups[0].work)
        for bundle in (middle, ahead, behind):
            kernel.module.take(bundle.groups[0].work)
    difference = (ahead.block("y") - behind.block("y"))[:, :LANES]
    expected = difference / (2.0 * NEAR / 1e-8)
    carried = middle.block("tangent")[:, :LANES]
    error = np.abs((carried - expected) / scales).max(axis=0)
    assert (error < AGREEMENT * np.abs(carried / scales).max(axis=0)).all()
    assert (np.abs((carried - directions) / scales).max(axis=0) > 100.0 * AGREEMENT).all()


# across contacts


def test_speed_after_bounces_is_proportional_to_the_speed_before() -> None:
    # without gravity nothing but the impact sets a scale: K δ^n (1 + h δ̇ / δ̇⁻) returns the same
    # share of any speed, so dv / dv0 = v / v0 however often the journal has bounced; a latched
    # rate that did not follow the speed would change the share
    scene = preset("bouncing-journal", gravity_y=0.0, restitution=0.7, velocity_y=-0.1)
    bundle = bundle_of([problem(scene, 0.2, 1e-11)])
    begin = np.zeros(bundle.kernel.states)
    begin[4] = 1.0
    bundle.lane(0)["tangent"] = begin
    while bundle.runs["onsets"][0] < 4 or bundle.lane(0).number("mode0") > 0.0:
        assert bundle.advance(1)
    speed, along = bundle.lane(0).number("y4"), bundle.lane(0).number("tangent4")
    assert 0.1 < speed / -0.1 < 0.9
    # during an impact the tangent is mostly a shift in time by t dv / v, here 100 times dv, and
    # this is what its steps, about 130 a bounce, are accurate to
    assert along == pytest.approx(speed / -0.1, rel=1e-3)


def test_a_floored_impact_rate_does_not_follow_the_tangent() -> None:
    slow = preset("bouncing-journal", gravity_y=0.0, velocity_y=-0.05, impact_rate_floor=0.1)
    fast = preset("bouncing-journal", gravity_y=0.0, velocity_y=-0.2, impact_rate_floor=0.1)
    latched = []
    for scene in (slow, fast):
        bundle = bundle_of([problem(scene, 0.2, 1e-8)])
        while bundle.runs["onsets"][0] < 1:
            assert bundle.advance(1)
        latched.append(float(bundle.lane(0).number("tangent_impact_rate0")))
    assert latched[0] == 0.0
    assert latched[1] != 0.0


@pytest.mark.parametrize("slip", ["material", "as-published"])
def test_tangents_are_finite_from_a_journal_in_the_middle_of_its_bearing(slip: str) -> None:
    # there the normal turns infinitely fast, and the slip velocity as published changes by 1e300²
    document = presets.document("bouncing-journal")
    document["joints"]["bearing"]["clearance"]["friction"]["slip_velocity"] = slip
    document["start"]["velocities"]["journal"] = [0.1, 0.0]
    scene = scene_of(document | {"parameters": {}})
    rows = grown(scene, 0.05, 1e-6)
    assert np.isfinite(rows).all()
    assert rows[-1, 0] == 0.05


def test_where_friction_jumps_nothing_is_said_of_growth() -> None:
    same = {"static_velocity": 1e-3, "dynamic_velocity": 1e-3}
    rough, smooth = (preset("bouncing-journal", friction=mu, **same) for mu in (0.1, 0.0))
    assert np.isnan(grown(rough, 0.05, 1e-6)[:, 1]).all()
    assert np.isfinite(grown(smooth, 0.05, 1e-6)).all()


@pytest.mark.parametrize(
    ("tangent", "growth_of_it"),
    [(0.0, -math.inf), (1e-305, -math.inf), (math.nan, math.nan), (math.inf, math.nan)],
)
def test_a_tangent_that_is_lost_says_so_ever_after(tangent: float, growth_of_it: float) -> None:
    bundle = bundle_of([problem(preset("bouncing-journal"), 1.0, 1e-6)])
    bundle.lane(0)["tangent"][1] = tangent
    bundle.lane(0)["tangent"][[0, 2, 3, 4, 5]] = 0.0
    bundle.advance(10**6)
    found = growth(bundle)[:, 1]
    assert len(found) > 3
    np.testing.assert_array_equal(found, growth_of_it)


def test_the_length_of_a_tangent_is_told_even_where_its_square_would_overflow() -> None:
    scene = preset("bouncing-journal", gravity_y=0.0)
    bundle = bundle_of([problem(scene, 1.0, 1e-6)])
    bundle.lane(0)["tangent"] *= 1e200
    bundle.advance(10**6)
    assert growth(bundle)[0, 1] == pytest.approx(math.log(1e200), rel=0.05)
