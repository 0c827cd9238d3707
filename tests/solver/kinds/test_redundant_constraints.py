"""Redundant constraints: what agrees for good is run, what does not is refused with its joints."""

import math
from typing import Any

import numpy as np
import pytest

from jointplay.records.failure import InvalidInput, SimulationFailed
from jointplay.solver.kinds import admit
from jointplay.solver.runs.ideal.following import follow
from jointplay.solver.runs.ideal.turn import turn
from jointplay.solver.runs.simulate import Simulation
from jointplay.solver.scene.document import Scene
from tests.solver.closed_loops import parallel_cranks
from tests.solver.kinds.refusals import assert_points

WEIGHT = 20.0 * 9.81


def pins(**pairs: str) -> dict[str, Any]:
    """Return revolute joints by name, "bearing journal" each."""
    return {
        name: dict(zip(("bearing", "journal"), pair.split(), strict=True), type="revolute")
        for name, pair in pairs.items()
    }


def side_rods() -> dict[str, Any]:
    """Return two equal wheels, coupled by side rods on pins a quarter of a turn apart."""
    wheel = {"mass": 100, "inertia": 5, "points": {"o": [0, 0], "a": [0.3, 0], "b": [0, 0.3]}}
    rod = {"mass": 20, "inertia": 4, "points": {"p1": [-0.75, 0], "p2": [0.75, 0]}}
    return {
        "name": "side-rods",
        "bodies": {"w1": wheel, "w2": wheel, "ra": rod, "rb": rod},
        "ground": {"points": {"O": [0, 0], "P": [1.5, 0]}},
        "joints": pins(
            o1="ground.O w1.o",
            o2="ground.P w2.o",
            a1="w1.a ra.p1",
            a2="w2.a ra.p2",
            b1="w1.b rb.p1",
            b2="w2.b rb.p2",
        ),
        "gravity": [0, -9.81],
        "start": {"angles": {"w1": 0.5, "w2": 0.5, "ra": 0.0}},
        "drivers": {"m": {"joint": "o1", "position": 0.5, "speed": 2.0 * math.pi}},
    }


def lift() -> dict[str, Any]:
    """Return a plate on two Scott-Russell linkages: pins that stay above one another's drivers."""
    angle = 0.6981317007977318
    bodies: dict[str, Any] = {
        "plate": {"mass": 5.0, "inertia": 0.5, "points": {"l": [-0.75, 0], "r": [0.75, 0]}}
    }
    joints: dict[str, Any] = {}
    angles = {}
    for k, corner in (("1", "l"), ("2", "r")):
        points = {"a": [-0.5, 0], "m": [0, 0], "b": [0.5, 0]}
        bodies[f"long{k}"] = {"mass": 2.0, "inertia": 1.0 / 6.0, "points": points}
        points = {"a": [-0.25, 0], "b": [0.25, 0]}
        bodies[f"short{k}"] = {"mass": 1.0, "inertia": 1.0 / 48.0, "points": points}
        angles |= {f"long{k}": math.pi - angle, f"short{k}": angle}
        linkage = {f"s{k}": f"ground.O{k} short{k}.a", f"m{k}": f"long{k}.m short{k}.b"}
        joints |= pins(**linkage, **{f"p{k}": f"plate.{corner} long{k}.b"})
        joints[f"a{k}"] = {"type": "pin-in-slot", "slot": "ground.O1", "pin": f"long{k}.a"}
        joints[f"a{k}"]["axis"] = [1, 0]
    return {
        "name": "lift",
        "bodies": bodies,
        "ground": {"points": {"O1": [0, 0], "O2": [1.5, 0]}},
        "joints": joints,
        "gravity": [0, -9.81],
        "start": {"angles": angles},
    }


def of(scene: dict[str, Any], duration: float = 2.0) -> dict[str, Any]:
    return {"kind": "simulate", "scene": scene, "duration": duration, "output_step": 0.01}


def test_driven_side_rods_turn_as_one() -> None:
    job = of(side_rods()) | {"channels": ["w1.theta", "w2.theta", "m.torque"], "certificate": False}
    simulation = Simulation(admit(job))
    rows = np.concatenate([piece.samples for piece in simulation.slices()])
    first, second, torque = rows.T
    assert len(rows) == 201
    np.testing.assert_allclose(second, first, rtol=0, atol=1e-12)
    # the rods move on circles without turning, so that nothing but their weight works
    wanted = WEIGHT * 0.3 * (np.cos(first) - np.sin(first))
    np.testing.assert_allclose(torque, wanted, rtol=0, atol=1e-9)


def test_side_rods_are_held_where_their_driver_stands() -> None:
    scene = side_rods()
    scene["drivers"]["m"]["speed"] = 0.0
    simulation = Simulation(admit(of(scene) | {"channels": ["m.torque"], "certificate": False}))
    torque = np.concatenate([piece.samples for piece in simulation.slices()])
    wanted = WEIGHT * 0.3 * (math.cos(0.5) - math.sin(0.5))
    np.testing.assert_allclose(torque, wanted, rtol=0, atol=1e-9)


def test_side_rods_are_pulled_by_a_slider_at_constant_speed_up_to_their_dead_point() -> None:
    scene = side_rods()
    bar = {"mass": 1.0, "inertia": 0.1, "points": {"s": [0, 0], "w": [1.0, 0]}}
    scene["bodies"] |= {"slide": {"mass": 1.0, "inertia": 0.1, "points": {"c": [0, 0]}}, "bar": bar}
    scene["joints"] |= pins(s="slide.c bar.s", w="w1.a bar.w")
    guide = {"type": "prismatic", "guide": "ground.O", "slider": "slide.c", "axis": [1, 0]}
    scene["joints"]["guide"] = guide
    scene["start"] = {"angles": {"w1": 1.0, "w2": 1.0, "ra": 0.0, "rb": 0.0, "bar": 0.2}}
    begin = 0.3 * math.cos(1.0) - math.sqrt(1.0 - (0.3 * math.sin(1.0)) ** 2)
    scene["drivers"] = {"m": {"joint": "guide", "position": begin, "speed": 0.1}}
    found = turn(Scene.model_validate(scene))
    assert found is not None
    assert found.lost is not None
    assert found.lost.time == pytest.approx((-0.7 - begin) / 0.1, rel=1e-9)  # bar and pin in line
    assert admit(of(scene, 0.5)).samples == 51


def test_one_side_rod_alone_comes_to_its_dead_points() -> None:
    scene = side_rods()
    for part, names in (("bodies", ["rb"]), ("joints", ["b1", "b2"])):
        scene[part] = {name: one for name, one in scene[part].items() if name not in names}
    with pytest.raises(SimulationFailed, match="more than one assembly") as failed:
        list(Simulation(admit(of(scene))).slices())
    assert failed.value.time == pytest.approx((math.pi - 0.5) / (2.0 * math.pi), abs=1e-6)


def test_side_rods_are_admitted_beside_play_elsewhere() -> None:
    scene = side_rods()
    hung = {"mass": 1.0, "inertia": 0.1, "points": {"top": [0, 0.2]}}
    scene["bodies"] = scene["bodies"] | {"hung": hung}
    clearance = {"radial_clearance": 1e-4, "bearing_radius": 0.01}
    clearance |= {"contact": {"law": "lankarani-nikravesh", "restitution": 0.8}}
    scene["joints"] |= pins(loose="ground.O hung.top")
    scene["joints"]["loose"]["clearance"] = clearance
    assert admit(of(scene)).joints == ("loose",)
    # as many rows as coordinates, of which one says what others say, and one moves freely
    found = follow(Scene.model_validate(scene), [0.0, 0.1])
    assert found.lost is None
    np.testing.assert_allclose(found.poses[1, [2, 5]], 0.5 + 0.2 * math.pi, rtol=0, atol=1e-9)


@pytest.mark.parametrize("length", [0.5, 2.0])
def test_what_agrees_only_where_it_starts_is_refused_with_its_joints(length: float) -> None:
    # a third crank in the direction of the others, whose circle bends away from theirs
    scene = parallel_cranks(3)
    angle = scene["start"]["angles"]["B0"]
    missing = (1.0 - length) * math.cos(angle), (1.0 - length) * math.sin(angle)
    scene["ground"]["points"]["A2"] = [2.0 + missing[0], missing[1]]
    points = {"a": [-length / 2.0, 0.0], "b": [length / 2.0, 0.0]}
    scene["bodies"]["B2"] = scene["bodies"]["B2"] | {"points": points}
    scene["start"].pop("angular_velocities", None)
    scene["drivers"] = {"m": {"joint": "A0", "position": angle, "speed": 1.0}}
    with pytest.raises(InvalidInput) as refused:
        admit(of(scene))
    assert_points(refused.value, "/scene/joints", "over-constrained")
    for name in ("A2", "P2"):
        assert f"'{name}'" in str(refused.value)


@pytest.mark.parametrize("driven", [False, True])
def test_what_is_held_twice_to_first_order_is_named(driven: bool) -> None:
    scene = lift()
    if driven:
        angle = scene["start"]["angles"]["short1"]
        scene["drivers"] = {"m": {"joint": "s1", "position": angle, "speed": 0.1}}
    with pytest.raises(InvalidInput) as refused:
        admit(of(scene))
    assert_points(refused.value, "/scene/joints", "'p1' and 'p2' of 'plate'")
    assert "Let 'p1' or 'p2' be a pin in a slot" in str(refused.value)


def test_what_was_held_twice_goes_with_a_slot() -> None:
    scene = lift()
    slot = {"type": "pin-in-slot", "slot": "plate.r", "pin": "long2.b", "axis": [1, 0]}
    scene["joints"]["p2"] = slot
    assert admit(of(scene)).joints == ()


def geared(**second: Any) -> dict[str, Any]:
    """Return two wheels, both driven, whose gear of ratio -2 agrees with one speed; a pendulum."""
    wheel = {"mass": 1.0, "inertia": 0.1, "points": {"o": [0, 0]}}
    bob = {"mass": 1.0, "inertia": 0.1, "points": {"top": [0, 0.2]}}
    return {
        "name": "geared",
        "bodies": {"w1": wheel, "w2": wheel, "bob": bob},
        "ground": {"points": {"O": [0, 0], "P": [1, 0]}},
        "joints": pins(o1="ground.O w1.o", o2="ground.P w2.o", hung="ground.O bob.top"),
        "gears": {"g": {"first": "o1", "second": "o2", "ratio": -2.0}},
        "drivers": {"m1": {"joint": "o1", "speed": 3.0}, "m2": {"joint": "o2", **second}},
        "gravity": [0, -9.81],
    }


def test_drivers_that_agree_run_beside_a_part_that_moves_freely() -> None:
    job = of(geared(speed=-6.0)) | {"channels": ["w2.theta", "bob.theta"], "certificate": False}
    simulation = Simulation(admit(job))
    second, bob = np.concatenate([piece.samples for piece in simulation.slices()]).T
    np.testing.assert_allclose(second, -0.06 * np.arange(201), rtol=0, atol=1e-10)
    assert np.ptp(bob) == 0.0  # it hangs below its pin


@pytest.mark.parametrize(
    "second",
    [
        {"speed": -5.0},
        {"motion": {"type": "start-up", "start_speed": -6.0, "speed": -7.0, "length": 1.0}},
        {"motion": {"type": "sinusoidal", "amplitude": 6.0, "frequency": 1.0, "phase": math.pi}},
    ],
    ids=["at once", "later", "where one bends"],
)
def test_drivers_that_fight_are_refused_beside_a_part_that_moves_freely(
    second: dict[str, Any],
) -> None:
    # one of them was left out: the wheels then turned as no gear lets them
    with pytest.raises(InvalidInput) as refused:
        admit(of(geared(**second)))
    assert_points(refused.value, "/scene/drivers", "'m1' and 'm2' is prescribed twice")


def test_a_driver_of_what_joints_hold_is_refused_beside_a_part_that_moves_freely() -> None:
    scene = geared(speed=-6.0)
    scene["ground"]["points"]["Q"] = [1, 0.5]
    scene["bodies"]["w2"] = scene["bodies"]["w2"] | {"points": {"o": [0, 0], "rim": [0, 0.5]}}
    scene["joints"] |= pins(stuck="ground.Q w2.rim")
    scene["gears"], scene["drivers"] = {}, {"m2": scene["drivers"]["m2"]}
    with pytest.raises(InvalidInput) as refused:
        admit(of(scene))
    assert_points(refused.value, "/scene/joints", "among those of 'o2' and 'stuck'")


def test_two_drivers_of_a_crank_are_refused_beside_a_part_that_moves_freely() -> None:
    scene = geared(speed=-6.0)
    scene["gears"], scene["drivers"]["m1"] = {}, {"body": "w2", "speed": -6.5}
    with pytest.raises(InvalidInput) as refused:
        admit(of(scene))
    assert_points(refused.value, "/scene/drivers", "'m2' and 'm1' is prescribed twice")


def test_drivers_that_fight_at_one_point_of_a_study_are_refused_there() -> None:
    scene = geared(speed=-6.0)
    clearance = {"radial_clearance": 1e-4, "bearing_radius": 0.01}
    clearance |= {"contact": {"law": "lankarani-nikravesh", "restitution": 0.8}}
    scene["joints"]["hung"]["clearance"] = clearance
    path = "/drivers/m2/speed"
    scene["parameters"] = {"speed": {"help": "Speed.", "targets": [{"path": path}]}}
    sweep = {"kind": "sweep", "scene": scene, "duration": 0.1}
    assert admit(sweep | {"grid": {"speed": [-6.0]}})
    with pytest.raises(InvalidInput) as refused:
        admit(sweep | {"grid": {"speed": [-6.0, -5.0]}})
    assert_points(refused.value, "/grid/speed/1", "'m1' and 'm2' is prescribed twice")
