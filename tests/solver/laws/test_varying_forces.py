"""Forces that vary: both formulations, periods, what is refused."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from jointplay.records.failure import InvalidInput, SimulationFailed
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kinds import admit
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem
from jointplay.solver.laws.force import Ends
from jointplay.solver.laws.force.distance import distance
from jointplay.solver.mechanics.courses import acting_between
from jointplay.solver.runs.lane_results import failure_of
from jointplay.solver.runs.left_domains import left_domain
from jointplay.solver.scene.periods import common_period
from tests.solver.completed_runs import run
from tests.solver.driven_motions import carried
from tests.solver.mechanics.test_mechanics import assert_formulations_agree
from tests.solver.readable_mechanics import at_start, scene_of

SINE = {"type": "sinusoidal", "amplitude": 1.0, "frequency": 3.0}
BUMP = {
    "type": "table",
    "knots": [-2.0, 0.0, 0.5, 1.0, 2.0],
    "values": [0.0, 1.0, 3.0, 2.0, 0.0],
    "outside": "held",
}
DRIVE = {"type": "sinusoidal", "amplitude": 0.7, "frequency": 5.0, "phase": 0.4}


def laden() -> dict[str, Any]:
    """Return a pendulum on a moving crank with every kind of element between them."""
    scene = carried(DRIVE)
    scene["ground"]["points"]["W"] = [1.0, 0.3]
    pair = {"first": "carrier.O", "second": "bob.P"}
    force, torque = {"type": "force", "magnitude": 3.0}, {"type": "torque", "moment": 2.0}
    scene["forces"] = {
        "push": force
        | pair
        | {"direction": [1.0, 2.0], "axes": "second", "course": BUMP}
        | {"over": {"quantity": "y", "first": "ground.W"}, "only": "falling", "full_rate": 0.5},
        "pull": force | pair | {"direction": [1.0, -1.0], "axes": "first"},
        "load": torque | pair | {"course": BUMP, "over": {"quantity": "angle"}},
        "wave": torque | pair | {"course": SINE},
        "far": torque | pair | {"course": BUMP, "over": {"quantity": "distance"}},
        "brake": force
        | pair
        | {"direction": [0.0, 1.0], "course": BUMP}
        | {"over": {"quantity": "driver", "driver": "motor", "rate": True}},
        "magnet": {"type": "tension", "magnitude": 2.0, "course": BUMP}
        | pair
        | {"over": {"quantity": "distance"}},
        "coil": {"type": "torsion-spring", "stiffness": 4.0, "damping": 0.3} | pair,
        "drive": {"type": "motor", "stall_torque": 1.0, "no_load_speed": 20.0} | pair,
    }
    return scene


@pytest.mark.parametrize("seed", range(8))
def test_both_formulations_agree_and_power_goes_where_the_ledger_says(seed: int) -> None:
    random = np.random.default_rng(seed)
    start = at_start(scene_of(laden()))
    instant = replace(
        start,
        position={name: random.normal() for name in start.position},
        speed={name: random.normal() for name in start.speed},
        driven={name: random.normal() for name in start.driven},
    )
    assert_formulations_agree(instant)
    motion = instant.reduced()
    kinetic_power = 0.0
    for name, body in motion.bodies.items():
        part = instant.scene.bodies[name]
        kinetic_power += part.mass * float(np.dot(body.velocity, body.acceleration))
        kinetic_power -= part.mass * float(np.dot(body.velocity, instant.scene.gravity))
        kinetic_power += part.inertia * body.spin * body.angular_acceleration
    put_in = motion.driver_effort["motor"] * motion.driver_speed["motor"]
    taken = sum(element.power for element in motion.forces.elements.values())
    # rounding of a dozen terms of some ten watts
    assert kinetic_power == pytest.approx(put_in - taken, abs=1e-9)


def test_a_force_over_a_distance_is_finite_where_the_points_meet() -> None:
    scene = scene_of(laden())
    ends = Ends((0.0, 0.0), (0.3, -0.4), (1.0, 2.0))
    acting = acting_between(scene, "far", lambda _first, _second: ends, {})
    assert (acting.argument, acting.argument_rate) == (0.0, 0.0)
    apart = distance(ends._replace(gap=(3.0, 4.0)))
    assert apart.length == 5.0
    assert [*apart.direction, apart.rate] == pytest.approx([0.6, 0.8, -0.14], rel=1e-15)


ENDS = {"type": "table", "knots": [-0.5, 0.0, 0.5], "values": [1.0, 0.0, 1.0], "outside": "refused"}


def pushed(course: dict[str, Any], over: dict[str, Any]) -> dict[str, Any]:
    """Return a block that a force pushes along a slide, from rest."""
    points = {"points": {"O": [0.0, 0.0]}}
    slide = {"type": "prismatic", "guide": "ground.O", "slider": "block.O", "axis": [1.0, 0.0]}
    ends = {"first": "ground.O", "second": "block.O"}
    push = {"type": "force", "magnitude": 2.0, "direction": [1.0, 0.0]}
    return {
        "name": "pushed",
        "ground": points,
        "bodies": {"block": {"mass": 1.0, "inertia": 1.0} | points},
        "joints": {"slide": slide},
        "forces": {
            "push": push | ends,
            "spring": push | ends | {"course": course, "over": over},
        },
    }


def test_a_run_ends_where_a_course_refuses_its_argument() -> None:
    with pytest.raises(SimulationFailed) as failed:
        run(pushed(ENDS, {"quantity": "x"}), 5.0)
    assert failed.value.code == "outside-of-a-function"
    assert 0.4 < failed.value.time < 1.0
    for words in ("course of force 'spring'", "from -0.5 to 0.5", "came to 0.5", "more knots"):
        assert words in str(failed.value)


@pytest.mark.parametrize("hangs", [False, True])
def test_a_run_ends_where_a_driver_brings_a_course_to_what_it_refuses(hangs: bool) -> None:
    """Only the driver feels that torque: samples were no numbers, and so was the ledger."""
    origin = {"points": {"O": [0.0, 0.0]}}
    body = {"mass": 1.0, "inertia": 1.0, "points": {"O": [0.0, 0.0], "P": [0.1, 0.0]}}
    ends, over = {"first": "ground.O", "second": "crank.O"}, {"quantity": "angle"}
    joint = {"type": "revolute", "bearing": "ground.O", "journal": "crank.O"}
    hung = {"type": "revolute", "bearing": "crank.P", "journal": "rod.P"}
    scene = {
        "name": "turned",
        "ground": origin,
        "bodies": {"crank": body} | ({"rod": body} if hangs else {}),
        "joints": {"main": joint} | ({"pin": hung} if hangs else {}),
        "drivers": {"motor": {"joint": "main", "speed": 4.0}},
        "forces": {"f": {"type": "torque", "moment": 1.0, "course": ENDS, "over": over} | ends},
    }
    with pytest.raises(SimulationFailed) as failed:
        run(scene, 3.0)
    assert failed.value.code == "outside-of-a-function"
    assert failed.value.time == pytest.approx(0.5 / 4.0, rel=1e-6)
    assert "force 'f'" in str(failed.value)
    assert "from -0.5 to 0.5" in str(failed.value)


def test_a_duration_beyond_a_refused_course_is_refused() -> None:
    with pytest.raises(InvalidInput) as refused:
        run(pushed(ENDS | {"knots": [0.0, 0.2, 1.0]}, {"quantity": "time"}), 5.0)
    (problem,) = refused.value.problems
    assert problem.pointer == "/scene/forces/spring/course/knots"
    assert "given from 0 to 1, but time, s, goes from 0 to 5" in problem.detail


def test_a_sweep_longer_than_a_refused_course_is_refused() -> None:
    scene = pushed(ENDS | {"knots": [0.0, 0.2, 1.0]}, {"quantity": "time"})
    mass = {
        "help": "mass",
        "unit": "kg",
        "default": 1.0,
        "targets": [{"path": "/bodies/block/mass"}],
    }
    scene["parameters"] = {"mass": mass}
    sweep = {"kind": "sweep", "scene": scene, "grid": {"mass": [1.0, 2.0]}}
    admit(sweep | {"duration": 1.0})
    with pytest.raises(InvalidInput) as refused:
        admit(sweep | {"duration": 1.5})
    (problem,) = refused.value.problems
    assert problem.pointer == "/scene/forces/spring/course/knots"
    assert "but time, s, goes from 0 to 1.5" in problem.detail


def started(scene: dict[str, Any], duration: float) -> Bundle:
    """Return a bundle whose first lane has a scene to run, without a look at what it refuses."""
    document = scene_of(scene)
    kernel = ready_kernel(document, "reduced", "tsitouras")
    return Bundle(kernel, [LaneProblem(document, duration, 1e-6, duration, 2, 0, 0.0)])


def test_a_run_ends_where_a_motion_refuses_its_time() -> None:
    scene = carried(ENDS | {"knots": [0.0, 0.5, 1.0]})
    bundle = started(scene, 2.0)
    while bundle.advance(1000):
        pass
    failure = failure_of(bundle, 0, 1e-6, scene_of(scene))
    assert failure.code == "outside-of-a-function"
    assert failure.time == pytest.approx(1.0, rel=1e-6)
    assert "motion of driver" in str(failure)


def test_an_argument_that_begins_at_an_end_has_not_left() -> None:
    for quantity, knots in (("time", [0.0, 0.5, 10.0]), ("x", [0.0, 0.5, 1.0])):
        scene = pushed(ENDS | {"knots": knots}, {"quantity": quantity})
        bundle = started(scene, 0.9)
        bundle.advance(1)
        found = left_domain(bundle, 0, scene_of(scene))
        assert bundle.lane(0).time > 0.0
        assert found == ""


def test_a_scene_that_never_repeats_gives_its_own_period() -> None:
    rising = {"type": "ramp", "end": 1.0, "length": 0.7}
    scene = pushed(rising, {"quantity": "time"}) | {"period": 0.25}
    found = run(scene, 2.0, tolerance=1e-9)
    np.testing.assert_allclose(found.section_time, 0.25 * np.arange(9), rtol=0.0, atol=1e-12)
    # behind the ramp it is 2 N + 2 N on 1 kg
    speed = found.sections["block.vx"][-4:]
    np.testing.assert_allclose(np.diff(speed), 4.0 * 0.25, rtol=1e-9)
    alone = run(pushed(rising, {"quantity": "time"}), 2.0, tolerance=1e-9)
    assert not len(alone.section_time)
    # the same motion, but for the times at which local time begins anew
    assert found.last("block.x") == pytest.approx(alone.last("block.x"), rel=1e-12)
    admitted = admit({"kind": "poincare", "scene": scene, "settle": 1, "record": 4})
    assert admitted.period == 0.25


def test_the_period_is_that_of_driver_and_force_together() -> None:
    # 5 and 3 rad/s repeat together after 2 pi
    assert common_period(scene_of(laden())).seconds == pytest.approx(2.0 * np.pi, rel=1e-12)
    scene = laden()
    scene["forces"]["wave"]["course"] = BUMP
    assert "force 'wave' never repeats" in common_period(scene_of(scene)).note


@pytest.mark.parametrize("ideal", [False, True])
def test_a_torsion_spring_counts_the_whole_turns_of_a_driven_crank(ideal: bool) -> None:
    scene = carried(DRIVE)
    scene["drivers"]["motor"] = {"joint": "J", "speed": 10.0}
    coil = {"type": "torsion-spring", "first": "ground.O", "second": "carrier.O"}
    scene["forces"] = {"coil": coil | {"stiffness": 2.0}}
    if ideal:
        scene["joints"]["P"] = {"type": "fixed", "base": "carrier.P", "part": "bob.P"}
        del scene["start"]
    found = run(scene, 2.5, output_step=0.1)  # four periods
    np.testing.assert_allclose(found["coil.angle"], 10.0 * found.time, rtol=1e-14, atol=1e-14)
    assert found.peaks["coil.moment"].minimum == pytest.approx(-50.0, rel=1e-12)


@pytest.mark.parametrize(
    ("force", "pointer", "words"),
    [
        ({"direction": [0.0, 0.0]}, "/direction", "no length"),
        ({"course": {"type": "cosine"}}, "/course/type", "'sinusoidal'"),
        ({"course": BUMP | {"values": [1.0]}}, "/course/values", "at least 2"),
        ({"course": BUMP | {"knots": [0.0, 0.0, 1.0, 2.0, 3.0]}}, "/course/knots", "Knot 1"),
        ({"only": "falling"}, "/only", "while something is falling"),
        ({"only": "rising"}, "/only", "while something is rising"),
        ({"over": {"quantity": "distance"}}, "/over", "does not vary; give one"),
        ({"over": {"quantity": "y", "first": "ground.X"}, "course": BUMP}, "/over/first", "point"),
        ({"over": {"driver": "motor"}, "course": SINE}, "/over/driver", "no 'driver'"),
        ({"over": {"quantity": "driver"}, "course": SINE}, "/over/driver", "Name the driver"),
        (
            {"over": {"quantity": "driver", "driver": "moto"}, "course": SINE},
            "/over/driver",
            "'motor'",
        ),
        (
            {"over": {"quantity": "driver", "driver": "motor"}, "course": BUMP},
            "/course",
            "this course does not repeat",
        ),
        ({"over": {"rate": True}, "course": SINE}, "/over/rate", "Time has no rate"),
    ],
)
def test_what_cannot_vary_so_is_refused_at_its_field(
    force: dict[str, Any], pointer: str, words: str
) -> None:
    scene = carried(DRIVE)
    given = {"type": "force", "first": "ground.O", "second": "bob.P", "magnitude": 1.0}
    scene["forces"] = {"push": given | {"direction": [1.0, 0.0]} | force}
    with pytest.raises(InvalidInput) as refused:
        admit({"kind": "simulate", "scene": scene, "duration": 1.0})
    (problem,) = refused.value.problems
    assert problem.pointer == f"/scene/forces/push{pointer}"
    assert words in problem.detail


def turned(last: float, over: dict[str, Any]) -> dict[str, Any]:
    """Return a driven pendulum with a torque over an angle that repeats after the last knot."""
    scene = carried(DRIVE)
    del scene["drivers"]["motor"]["motion"]
    scene["drivers"]["motor"]["speed"] = 3.0
    pair = {"first": "carrier.O", "second": "bob.P"}
    course = BUMP | {"knots": [0.0, 0.5, 1.0, 2.0, last], "outside": "periodic"}
    scene["forces"] = {
        "load": {"type": "torque", "moment": 1.0, "over": over, "course": course} | pair
    }
    return scene


@pytest.mark.parametrize("over", [{"quantity": "driver", "driver": "motor"}, {"quantity": "angle"}])
def test_knots_of_a_course_end_a_turn_that_they_give_to_seven_digits(over: dict[str, Any]) -> None:
    load = scene_of(turned(6.2831853, over)).forces["load"]
    assert load.course.knots[-1] == 2.0 * np.pi
    assert scene_of(turned(6.2832, over)).forces["load"].course.knots[-1] == 6.2832
    rate = over | {"rate": True}
    assert scene_of(turned(6.2831853, rate)).forces["load"].course.knots[-1] == 6.2831853


def test_what_nearly_repeats_every_turn_is_told_with_its_digits() -> None:
    job = {"kind": "simulate", "duration": 1.0}
    over = {"quantity": "driver", "driver": "motor"}
    assert admit(job | {"scene": turned(6.2831853, over)})
    with pytest.raises(InvalidInput, match=r"every turn, 6\.28318531 rad; .* after 6\.2832 rad"):
        admit(job | {"scene": turned(6.2832, over)})
