"""Driven linkages are followed on their branch, up to their dead points: against closed forms."""

import math
from typing import Any

import numpy as np
import pytest

from jointplay.records.failure import SimulationFailed
from jointplay.solver.kinds import admit
from jointplay.solver.mechanics.assembly import assemble
from jointplay.solver.runs.ideal.constraints import Constraints
from jointplay.solver.runs.ideal.dead_point import lost_at
from jointplay.solver.runs.ideal.path import Path
from jointplay.solver.runs.ideal.turn import turn
from jointplay.solver.runs.simulate import Simulation
from jointplay.solver.scene import presets
from jointplay.solver.scene.document import Scene
from tests.solver.linkages import KINDS, TURN, Dyad, Linkage, drawn

SAMPLES = 60
SEED = 5


def ran(document: dict[str, Any], duration: float, *channels: str) -> tuple[Any, ...]:
    """Return times, samples and the failure, if any."""
    job = {"kind": "simulate", "scene": document, "duration": duration, "certificate": False}
    job |= {"output_step": duration / SAMPLES, "channels": list(channels)}
    simulation = Simulation(admit(job))
    times, rows, failure = [], [], None
    try:
        for piece in simulation.slices():
            times.append(piece.sample_time)
            rows.append(piece.samples)
    except SimulationFailed as failed:
        failure = failed
    return np.concatenate(times), np.concatenate(rows), failure


def assert_followed(linkage: Linkage) -> None:
    """Compare a turn of a linkage with intersections of circles, and its dead point."""
    dead, _ = linkage.dead_point()
    scene = Scene.model_validate(linkage.document())
    path = Path(Constraints(scene), assemble(scene).pose, TURN)
    if math.isfinite(dead):
        assert path.follow(dead * (1.0 - 1e-6))
        assert not path.follow(TURN)
        assert path.end.time == pytest.approx(dead, abs=1e-8)
        assert "dead point" in lost_at(path, scene).detail
    else:
        assert path.follow(TURN)
        assert path.end.time == TURN
    times = np.linspace(0.0, path.end.time, SAMPLES)
    bodies = list(scene.bodies)
    for time, pose in zip(times, path.poses(times), strict=True):
        positions = linkage.positions(float(time))
        for dyad in linkage.dyads:
            k = 3 * bodies.index(f"{dyad.name}1")
            arm = complex(*scene.bodies[f"{dyad.name}1"].points["pin"])
            found = complex(*pose[k : k + 2]) + arm * np.exp(1j * pose[k + 2])
            # rounding of 1e-16 m, which half the way to a dead point multiplies by 1e6 at its end
            assert abs(found - positions[f"{dyad.name}P"]) < (1e-9 if time < times[-1] else 1e-5)


@pytest.mark.parametrize("kind", KINDS)
def test_random_linkages_keep_their_branch(kind: str) -> None:
    random = np.random.default_rng([SEED, KINDS.index(kind)])
    for _ in range(10):
        assert_followed(drawn(random, kind))


@pytest.mark.long
@pytest.mark.parametrize("kind", KINDS)
def test_many_random_linkages_keep_their_branch(kind: str) -> None:
    random = np.random.default_rng([SEED + 1, KINDS.index(kind)])
    for _ in range(125):
        assert_followed(drawn(random, kind))


A, B, C, D = 4.1 + 3.75j, 1.244 + 0.196j, -2.32 - 2.293j, 0.165 + 1.322j
E = B + (-3.835 + 1.461j)
"""A four-bar of a public discussion, near its change point: m."""
CHANGING = {0.5: 3.234719 - 0.377272j, 1.0: 1.407931 + 0.565559j, 2.0: -0.156936 + 4.370393j}
"""Where E is at these times, s: intersections of circles, m."""


def changing(pairs: int, sense: float = -1.0) -> Linkage:
    """Return that four-bar with equal pairs of links on the same pins."""
    crank = B - A
    found = Linkage(abs(crank), float(np.angle(crank)), sense)
    side = math.copysign(1.0, ((D - B).conjugate() * (C - B)).imag)
    for name in "ab"[:pairs]:
        lengths = abs(C - B), abs(D - C)
        found.dyads.append(Dyad(name, "B", D - A, *lengths, side, (E - B) / (C - B)))
    return found


@pytest.mark.parametrize("pairs", [1, 2])
@pytest.mark.parametrize("duration", [0.8, 2.0])
def test_loops_that_come_near_their_change_point_together_do_not_flip(
    pairs: int, duration: float
) -> None:
    linkage = changing(pairs)
    document = linkage.document()
    document["recorded"] = [f"{dyad.name}1.E" for dyad in linkage.dyads]
    channels = [f"{point}.{axis}" for point in document["recorded"] for axis in "xy"]
    times, rows, failure = ran(document, duration, *channels)
    assert failure is None
    for time, row in zip(times, rows, strict=True):
        true = linkage.positions(float(time))["aE"]
        np.testing.assert_allclose(row, [true.real, true.imag] * pairs, rtol=0, atol=1e-9)
    for time, position in CHANGING.items():
        if time in times:
            there = rows[int(np.argmin(np.abs(times - time)))]
            assert complex(*there[:2]) + A == pytest.approx(position, abs=1e-6)


@pytest.mark.parametrize("ratio", [1.02, 1.0005, 1.0 + 1e-7])
def test_opposed_sliders_of_rods_hardly_longer_than_the_crank_do_not_flip(ratio: float) -> None:
    rod = {"mass": 0.3, "inertia": 1e-3}
    rod["points"] = {"pin": [-0.05 * ratio, 0.0], "slider": [0.05 * ratio, 0.0]}
    bodies: dict[str, Any] = {
        "crank": {"mass": 1.0, "inertia": 1e-2, "points": {"O": [0.0, 0.0], "pin": [0.1, 0.0]}}
    }
    joints = {"O": {"type": "revolute", "bearing": "ground.O", "journal": "crank.O"}}
    for side in ("left", "right"):
        bodies[f"{side}_rod"] = rod
        bodies[side] = {"mass": 0.2, "inertia": 1e-4, "points": {"pin": [0.0, 0.0]}}
        joints |= {
            f"{side}_A": {"type": "revolute", "bearing": "crank.pin", "journal": f"{side}_rod.pin"},
            f"{side}_B": {
                "type": "revolute",
                "bearing": f"{side}.pin",
                "journal": f"{side}_rod.slider",
            },
            f"{side}_guide": {
                "type": "prismatic",
                "guide": "ground.O",
                "slider": f"{side}.pin",
                "axis": [1.0, 0.0],
            },
        }
    document = {
        "name": "opposed",
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": bodies,
        "joints": joints,
        "drivers": {"motor": {"joint": "O", "position": 0.3, "speed": 1.0}},
        "start": {"angles": {"left_rod": math.pi}},
    }
    times, rows, failure = ran(document, TURN, "left.x", "right.x")
    assert failure is None
    angle = 0.3 + times
    # l² - r² sin² = (l - r)(l + r) + r² cos², without cancellation
    reach = np.sqrt(0.01 * (ratio - 1.0) * (ratio + 1.0) + (0.1 * np.cos(angle)) ** 2)
    for column, sense in ((0, -1.0), (1, 1.0)):
        wanted = 0.1 * np.cos(angle) + sense * reach
        np.testing.assert_allclose(rows[:, column], wanted, rtol=0, atol=1e-10)


@pytest.mark.parametrize(("sense", "dead"), [(-1.0, 2.8543806), (1.0, 2.1724)])
def test_a_dead_point_is_located_and_named_with_its_angle(sense: float, dead: float) -> None:
    linkage = changing(1, sense)
    located, _ = linkage.dead_point()
    assert located == pytest.approx(dead, abs=1e-4)
    *_, failure = ran(linkage.document(), 4.0, "a1.x")
    assert failure.time == pytest.approx(located, abs=1e-10)
    angle = linkage.angle + sense * located
    assert f"{angle:.6g} rad ({math.degrees(angle):.6g} deg)" in failure.detail
    assert "'a1' and 'a2' lock" in failure.detail
    *_, failure = ran(linkage.document(), located - 2e-3, "a1.x")
    assert failure is None


def test_a_turn_that_jams_tells_where_and_how_far_links_are_short() -> None:
    linkage = changing(1)
    found = turn(Scene.model_validate(linkage.document()))
    assert found is not None
    assert found.lost is not None
    assert found.reached == pytest.approx(linkage.dead_point()[0], abs=1e-10)
    assert found.margin is not None
    # the crank's pin is farthest from D in line with A and D
    short = abs(B - A) + abs(D - A) - abs(C - B) - abs(D - C)
    assert found.margin.size == pytest.approx(short, rel=1e-9)
    apart = np.angle((B - A) / -(D - A))
    assert found.margin.time == pytest.approx(apart % TURN, abs=1e-9)


@pytest.mark.parametrize("spare", [1e-2, 1e-4, 1e-6])
def test_a_turn_that_goes_through_tells_how_near_a_dead_point_is(spare: float) -> None:
    linkage = Linkage(0.1, 0.3, 2.0)
    linkage.dyads.append(Dyad("a", "B", 0.25 + 0.0j, 0.2, 0.15 + spare, 1.0))
    found = turn(Scene.model_validate(linkage.document()))
    assert found is not None
    assert found.lost is None
    assert found.margin is not None
    # stretched where the crank points away from D
    assert found.margin.size == pytest.approx(spare, rel=1e-6)
    assert found.margin.time == pytest.approx((math.pi - 0.3) / 2.0, abs=1e-6)


def test_a_dead_point_that_is_far_from_its_first_guess_is_not_told() -> None:
    random = np.random.default_rng(8)
    for k in range(228):
        linkage = drawn(random, KINDS[k % len(KINDS)])
    found = turn(Scene.model_validate(linkage.document()))
    assert found is not None
    assert (found.lost, found.margin) == (None, None)  # without the bound 1.1 m


def test_poses_are_few_where_nothing_is_near() -> None:
    press = Scene.model_validate(presets.document("seven-bar-press"))
    for scene, most, span in (
        (press, 30, 2.0),
        (Scene.model_validate(changing(1).document()), 60, 2.8),
    ):
        path = Path(Constraints(scene), assemble(scene).pose, span)
        assert path.follow(span)
        assert len(path.times) <= most


@pytest.mark.parametrize(("turned", "sound"), [(0.05, True), (0.2, False)])
def test_a_step_is_taken_only_from_near_its_pose(turned: float, sound: bool) -> None:
    scene = Scene.model_validate(presets.document("slider-crank"))
    pose = assemble(scene).pose
    guess = pose.copy()
    guess[2] += turned  # of the crank, which its driver holds
    found, at_once, _ = Path(Constraints(scene), pose, 1.0).closed(guess, 0.0)
    np.testing.assert_allclose(found, pose if sound else guess, rtol=0, atol=1e-12)
    assert at_once == sound


def test_a_fast_driver_is_not_skipped_by_a_slow_one() -> None:
    # two cranks of one period, one of which turns forty times in it
    slow, fast = Linkage(0.1, 0.0, 1.0), Linkage(0.1, 0.0, 40.0)
    fast.dyads.append(Dyad("q", "B", 0.3 - 0.2j, 0.35, 0.3, 1.0))
    document = _joined(slow.document(), fast.document())
    times, rows, failure = ran(document, TURN, "qq1.pin.x", "qq1.pin.y")
    assert failure is None
    for time, row in zip(times, rows, strict=True):
        true = fast.positions(float(time))["qP"]
        np.testing.assert_allclose(row, [true.real, true.imag], rtol=0, atol=1e-11)


def _joined(first: dict[str, Any], second: dict[str, Any]) -> dict[str, Any]:
    """Return two linkages side by side; names of the second's parts begin with q."""

    def renamed(reference: str) -> str:
        body, point = reference.split(".")
        return f"ground.q{point}" if body == "ground" else f"q{body}.{point}"

    joints = {
        f"q{name}": joint | {end: renamed(joint[end]) for end in ("bearing", "journal")}
        for name, joint in second["joints"].items()
    }
    points = {f"q{name}": position for name, position in second["ground"]["points"].items()}
    driver = second["drivers"]["motor"] | {"joint": "qA"}
    return first | {
        "bodies": first["bodies"] | {f"q{n}": body for n, body in second["bodies"].items()},
        "joints": first["joints"] | joints,
        "ground": {"points": first["ground"]["points"] | points},
        "drivers": first["drivers"] | {"second": driver},
        "recorded": [renamed(point) for point in second["recorded"]],
    }
