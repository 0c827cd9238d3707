"""The ideal mechanism followed through its drivers' motion, and dragged by a point."""

import math
from typing import Any

import numpy as np
import pytest

from jointplay.records.failure import InvalidInput, LimitExceeded
from jointplay.solver.kinds import admit
from jointplay.solver.kinds.assembled import assembled_scene, resolved_scene
from jointplay.solver.mechanics.assembly import assemble, shortest_link
from jointplay.solver.mechanics.dragging import drag
from jointplay.solver.mechanics.observe import body_values
from jointplay.solver.runs.ideal.following import follow
from jointplay.solver.runs.ideal.motion import IdealMotion
from jointplay.solver.runs.ideal.path import Path
from jointplay.solver.runs.ideal.turn import turn
from jointplay.solver.scene import presets
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.drivers_time import drivers_time
from jointplay.solver.scene.periods import drivers_period
from tests.two_assemblies import arm, five_bar, link, revolute, toggle

DETERMINED = [
    *("four-bar", "jansen-leg", "quick-return", "seven-bar-press", "slider-crank"),
    *("toggle", "five-bar"),
]
SWINGING = {"type": "sinusoidal", "amplitude": 0.5, "frequency": 4.0, "phase": math.pi / 2}


def scene_named(name: str) -> Scene:
    own = {"toggle": toggle, "five-bar": five_bar}
    return resolved_scene(own[name]() if name in own else {"preset": name})


def four_bar(crank: float, coupler: float, follower: float, ground: float) -> dict[str, Any]:
    return {
        "name": "bars",
        "ground": {"points": {"A": [0.0, 0.0], "D": [ground, 0.0]}},
        "bodies": {
            "crank": link(crank / 2, "A", "B"),
            "coupler": link(coupler / 2, "B", "C"),
            "follower": link(follower / 2, "D", "C"),
        },
        "joints": {
            "A": revolute("ground.A", "crank.A"),
            "B": revolute("crank.B", "coupler.B"),
            "C": revolute("coupler.C", "follower.C"),
            "D": revolute("ground.D", "follower.D"),
        },
        "drivers": {"motor": {"joint": "A", "position": 0.5, "speed": 2.0}},
        "start": {"angles": {"coupler": 0.5, "follower": 1.5}},
    }


@pytest.mark.parametrize("name", DETERMINED)
def test_poses_are_those_of_the_ideal_motion(name: str) -> None:
    scene = scene_named(name)
    period = drivers_period(scene).seconds
    assert period is not None
    times = np.linspace(0.0, 1.7 * period, 100)
    motion = IdealMotion(scene, period, times[-1])
    local = motion.local(np.ones(len(times)), times)
    bodies = motion.at(times, local).bodies
    expected = np.stack([body_values(bodies[name])[:3] for name in scene.bodies])
    found = follow(scene, times.tolist())
    assert found.lost is None
    got = found.poses.reshape(len(times), -1, 3)
    np.testing.assert_allclose(got, expected.transpose(2, 0, 1), rtol=0, atol=1e-11)


@pytest.mark.parametrize("name", presets.names())
def test_every_preset_is_followed_from_the_pose_in_which_it_is_run(name: str) -> None:
    try:
        scene = scene_named(name)
    except InvalidInput:  # it needs a parameter
        return
    time = drivers_time(scene, shortest_link(scene))
    found = follow(scene, [0.0, 0.5 if time is None else 0.5 * time.seconds])
    assert found.lost is None
    assert np.array_equal(found.poses[0], assemble(scene).pose)
    moved = bool((found.poses[1] != found.poses[0]).any())
    assert moved == (time is not None)


@pytest.mark.parametrize("last", [3.0, 1e9])
def test_a_mechanism_is_followed_to_where_its_links_do_not_reach(last: float) -> None:
    crank, coupler, follower, ground = 0.3, 0.25, 0.3, 0.4
    scene = resolved_scene(four_bar(crank, coupler, follower, ground))
    found = follow(scene, [0.0, 0.1, last])
    # coupler and follower are in one line: the law of cosines
    cosine = (crank**2 + ground**2 - (coupler + follower) ** 2) / (2 * crank * ground)
    assert found.lost is not None
    assert len(found.poses) == 2
    assert found.lost.time == pytest.approx((math.acos(cosine) - 0.5) / 2.0, rel=1e-9)
    assert "dead point at t = 0.6456" in found.lost.detail


def test_a_crank_turned_by_the_end_of_long_drives_counts_its_turns() -> None:
    found = follow(resolved_scene(arm(position=0.2, speed=3.0)), [0.0, 50.0])
    assert found.poses[-1][2] == pytest.approx(150.2)
    with pytest.raises(LimitExceeded, match="4096 poses"):
        follow(resolved_scene(arm(speed=3.0)), [1000.0])


def test_an_instant_out_of_reach_is_refused_after_a_few_turns(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    paths = []
    go = Path.follow

    def follow_and_count(path: Path, until: float, most: float = math.inf) -> bool:
        whole = go(path, until, most)
        paths.append(len(path.times))
        return whole

    monkeypatch.setattr(Path, "follow", follow_and_count)
    with pytest.raises(LimitExceeded, match="4096 poses"):
        follow(resolved_scene(arm(speed=3.0)), [1e6])
    assert len(paths) == 1
    assert paths[0] < 1000


def test_a_motion_that_is_a_function_places_what_it_drives() -> None:
    scene = resolved_scene(arm(position=0.2, motion=SWINGING))
    found = follow(scene, [0.0, math.pi / 4])
    assert found.poses[:, 2].tolist() == pytest.approx([0.7, -0.3])


def test_a_motion_ends_with_its_table_and_must_cover_the_start() -> None:
    table = {"type": "table", "knots": [0, 1, 3], "values": [0, 1, 0.3], "outside": "refused"}
    found = follow(resolved_scene(arm(motion=table)), [0.0, 2.9, 3.5])
    assert found.lost is not None
    assert (len(found.poses), found.lost.time) == (2, pytest.approx(3.0, abs=1e-3))
    assert "given up to t = 3 s" in found.lost.detail
    late = arm(motion=table | {"knots": [1, 2, 3]})
    for look in (resolved_scene, lambda scene: assembled_scene(scene, is_whole=False), _admitted):
        with pytest.raises(InvalidInput, match="begins at 0"):
            look(late)


def _admitted(scene: dict[str, Any]) -> None:
    admit({"kind": "simulate", "scene": scene, "duration": 1.0})


def test_an_open_mechanism_stays_where_it_starts() -> None:
    found = follow(resolved_scene(four_bar(0.1, 0.1, 0.1, 0.9)), [0.0, 1.0])
    assert found.lost is not None
    assert (len(found.poses), found.lost.time) == (1, 0.0)
    assert "do not close at t = 0" in found.lost.detail


@pytest.mark.parametrize(
    ("driver", "seconds", "repeats"),
    [
        ({"speed": -2.0}, math.pi, True),
        ({"motion": SWINGING}, math.pi / 2, True),
        ({"motion": {"type": "ramp", "end": 0.5, "length": 2.0}}, 2.0, False),
        ({"motion": {"type": "ramp", "end": 0.5, "length": 1e-9}}, 1e-9, False),
        ({"motion": {"type": "ramp", "end": 0.5, "length": 1e9}}, 1e9, False),
        ({"motion": {"type": "polynomial", "coefficients": [0.0, 3.0]}}, 2 * math.pi / 3, False),
        ({"speed": 0.0}, None, False),
    ],
)
def test_drivers_take_a_turn_a_period_or_until_they_rest(
    driver: dict[str, Any], seconds: float | None, repeats: bool
) -> None:
    found = drivers_time(resolved_scene(arm(**driver)), 0.1)
    if seconds is None:
        assert found is None
        return
    assert found is not None
    assert (found.seconds, found.repeats) == (pytest.approx(seconds, rel=0.03), repeats)


def test_a_driven_slider_goes_as_far_as_a_link_and_drivers_come_round_together() -> None:
    scene = arm(speed=1.0)
    scene["joints"]["O"] = {
        "type": "prismatic",
        "guide": "ground.O",
        "slider": "arm.O",
        "axis": [1, 0],
    }
    scene["drivers"]["motor"]["speed"] = 0.1
    found = drivers_time(resolved_scene(scene), 0.25)
    assert found is not None
    assert (found.seconds, found.repeats) == (2.5, False)
    pair = five_bar()
    for name, speed in (("m1", 10.0), ("m2", 0.01)):
        pair["drivers"][name] = {"joint": f"P{name[1]}", "position": 1.5, "speed": speed}
    found = drivers_time(resolved_scene(pair), 0.25)
    assert found is not None
    assert (found.seconds, found.repeats) == (pytest.approx(200 * math.pi), True)
    assert found.quickest == pytest.approx(math.pi / 5)
    pair["drivers"]["m2"]["speed"] = 4.0
    found = drivers_time(resolved_scene(pair), 0.25)
    assert found is not None
    assert (found.seconds, found.repeats) == (pytest.approx(math.pi), True), "both are back"
    pair["drivers"]["m2"]["speed"] = math.sqrt(10.0)
    found = drivers_time(resolved_scene(pair), 0.25)
    assert found is not None
    assert (found.seconds, found.repeats) == (pytest.approx(2 * math.pi / 10**0.5), False)


@pytest.mark.parametrize("position", [(0.0, 0.1), (-3.0, -4.0), (0.02, -0.08)])
def test_an_arm_is_dragged_towards_a_position(position: tuple[float, float]) -> None:
    scene = resolved_scene(arm(position=0.3, speed=1.0))
    found = drag(scene, assemble(scene).pose, "arm.E", position)
    end = 0.1 * math.cos(found[2]), 0.1 * math.sin(found[2])
    nearest = abs(math.hypot(*position) - 0.1)
    assert math.dist(end, position) == pytest.approx(nearest, abs=1e-6)


def test_a_point_is_dragged_along_the_path_that_the_joints_leave() -> None:
    scene = resolved_scene(four_bar(0.1, 0.3, 0.3, 0.35))  # its crank turns fully
    turn = follow(scene, np.linspace(0.0, math.pi, 400).tolist()).poses
    path = turn[:, 3:5]  # of the coupler's centre
    scene.bodies["coupler"].points["M"] = [0.0, 0.0]
    pose = turn[0]
    for aim in path[::8]:
        pose = drag(scene, pose, "coupler.M", (float(aim[0]), float(aim[1])))
        assert np.linalg.norm(pose[3:5] - aim) < 1e-5
    away = path[0] + (0.05, 0.02)  # off the path: as near as it comes
    pose = drag(scene, turn[0], "coupler.M", (float(away[0]), float(away[1])))
    nearest = np.linalg.norm(path - away, axis=1).min()
    assert np.linalg.norm(pose[3:5] - away) == pytest.approx(nearest, rel=1e-3)


def test_a_toggle_is_dragged_closed_at_every_step() -> None:
    scene = scene_named("toggle")
    pose = assemble(scene).pose
    for k in range(12):
        pose = drag(scene, pose, "upper.K", (-0.05 + 0.01 * k, 0.2))
        x, y, theta = pose.reshape(-1, 3)[list(scene.bodies).index("ram")]
        assert (x, theta) == (pytest.approx(0.0, abs=1e-9), pytest.approx(0.0, abs=1e-9))
        knee = pose[6:8] + 0.1 * np.array([math.cos(pose[8]), math.sin(pose[8])])
        assert np.linalg.norm(knee - (x, y + 0.05)) == pytest.approx(0.22, abs=1e-9)


def test_an_open_mechanism_is_not_torn_further_apart() -> None:
    scene = resolved_scene(four_bar(0.1, 0.1, 0.1, 0.9))
    pose = assemble(scene).pose
    one, other = (
        drag(scene, pose, "crank.B", position) for position in ((0.87, 0.77), (-0.9, 0.2))
    )
    np.testing.assert_array_equal(one, other)


def test_a_start_in_the_play_is_no_dead_point_of_the_ideal_mechanism() -> None:
    beside = {"type": "pin-in-slot", "slot": "ground.S", "pin": "mass.P", "axis": [0.0, 1.0]}
    contact = {"law": "lankarani-nikravesh", "stiffness": 1e8, "restitution": 0.8}
    play = {"wall_clearance": 0.01, "pin_radius": 0.01, "contact": contact}
    slide = {"type": "prismatic", "axis": [1.0, 0.0]}
    shaken = {
        "joint": "shaker",
        "motion": {"type": "sinusoidal", "amplitude": 2e-3, "frequency": 20},
    }
    document = {
        "name": "stopped",
        "ground": {"points": {"O": [0.0, 0.0], "S": [-0.005, 0.0]}},
        "bodies": {
            name: {"mass": 1, "inertia": 1e-3, "points": {"P": [0, 0]}} for name in ("base", "mass")
        },
        "joints": {
            "shaker": slide | {"guide": "ground.O", "slider": "base.P"},
            "guide": slide | {"guide": "ground.O", "slider": "mass.P"},
            "stop": beside | {"clearance": play},
        },
        "drivers": {"shake": shaken},
        "start": {"points": {"mass.P": [0.0, 0.0]}},
    }
    scene = Scene.model_validate(document)
    assert assemble(scene).pose[3] == 0.0
    found = turn(scene)
    assert found is not None
    assert found.lost is None
    quarter = math.pi / 2 / 20
    poses = follow(scene, [0.0, quarter]).poses
    assert poses[:, 0] == pytest.approx([0.0, 2e-3], abs=1e-12)  # the shaken base
    assert poses[:, 3] == pytest.approx(
        [-0.005] * 2, abs=1e-12
    )  # the pin in the middle of its slot
