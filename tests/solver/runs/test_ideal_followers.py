"""Followers without play that their cams pull: told with when, how hard, and the remedy."""

from typing import Any

import numpy as np
import pytest

from jointplay.records.failure import SimulationFailed
from jointplay.records.peak import Peak
from jointplay.solver.kinds import admit
from jointplay.solver.runs.followers import first_pulls, pulled
from jointplay.solver.runs.simulate import Simulation
from tests.solver.cams import CIRCLE, ECCENTRICITY, SPEED, follower, pitch_table, valve

TURN = 2.0 * np.pi / SPEED
MASS, GRAVITY = 0.2, 9.81


def completed(scene: dict[str, Any], duration: float = TURN, **job: Any) -> Simulation:
    simulation = Simulation(admit({"kind": "simulate", "scene": scene, "duration": duration} | job))
    for _ in simulation.slices():
        pass
    return simulation


def facts(simulation: Simulation) -> dict[str, Any]:
    certificate = simulation.certificate()
    assert certificate is not None
    return certificate.facts


def unsprung(shape: str, profile: dict[str, Any], speed: float, **how: Any) -> dict[str, Any]:
    """Return a tappet that its weight alone presses on its cam."""
    scene = valve(follower(shape, profile), **how) | {"forces": {}}
    if how.get("driven", True):
        scene["drivers"]["motor"]["speed"] = speed
    else:
        scene["start"] = {"angles": {"shaft": 0.0}, "angular_velocities": {"shaft": speed}}
    return scene


def test_a_face_is_pulled_where_its_cam_falls_faster_than_it() -> None:
    speed = 40.0
    found = facts(completed(unsprung("flat", CIRCLE, speed), 2.0 * np.pi / speed))
    # its acceleration is e ω² cos ωt: pulled where that is below -g, most at half a turn
    first = np.arccos(-GRAVITY / (ECCENTRICITY * speed**2)) / speed
    (pull,) = found["pulling"]
    assert pull["joint"] == "cam"
    assert pull["first"] == pytest.approx(first, abs=2.0 * np.pi / speed / 2000)
    assert pull["largest"] == pytest.approx(MASS * (ECCENTRICITY * speed**2 - GRAVITY), rel=1e-9)
    assert pull["time"] == pytest.approx(np.pi / speed, abs=1e-6)
    assert "give it a lash" in pull["detail"]
    assert pull["detail"] in found["note"]


def test_a_run_that_ends_early_tells_what_was_pulled_before() -> None:
    speed, jams = 40.0, np.radians(150.0)
    scene = unsprung("flat", CIRCLE, speed)
    line = [0.0, -ECCENTRICITY * np.cos(jams) - 0.1]  # a rod of 0.1 m does not reach it beyond
    scene["ground"]["points"]["L"] = line
    scene["bodies"] |= {
        "rod": {"mass": 0.1, "inertia": 1e-4, "points": {"a": [0.0, 0.05], "b": [0.0, -0.05]}},
        "slide": {"mass": 0.1, "inertia": 1e-4, "points": {"c": [0.0, 0.0]}},
    }
    scene["joints"] |= {
        "A": {"type": "revolute", "bearing": "shaft.C", "journal": "rod.a"},
        "B": {"type": "revolute", "bearing": "slide.c", "journal": "rod.b"},
        "line": {"type": "prismatic", "guide": "ground.L", "slider": "slide.c", "axis": [1.0, 0.0]},
    }
    job = {"kind": "simulate", "scene": scene, "duration": 0.1, "output_step": 1e-3}
    simulation = Simulation(admit(job))
    with pytest.raises(SimulationFailed) as failed:
        list(simulation.slices())
    assert failed.value.time == pytest.approx(jams / speed, rel=1e-6)
    (pull,) = facts(simulation)["pulling"]
    assert pull["joint"] == "cam"
    assert pull["time"] == pytest.approx(0.065, abs=1e-9)  # the last sample, hardest pulled


@pytest.mark.parametrize("shape", ["flat", "roller"])
def test_a_follower_that_is_pressed_on_is_not_pulled(shape: str) -> None:
    profile = CIRCLE if shape == "flat" else pitch_table()
    scene = valve(follower(shape, profile))
    simulation = completed(scene, channels=["cam.normal_force", "cam.force_x", "cam.force_y"])
    assert facts(simulation)["pulling"] == []
    *components, force = simulation.summary().peaks.values()
    assert force.minimum > 0.0
    along = max(abs(peak.maximum) for peak in components)
    assert along <= force.maximum <= np.hypot(*(peak.maximum for peak in components))


def test_a_cam_that_nothing_drives_tells_it_too() -> None:
    scene = unsprung("flat", CIRCLE, 60.0, driven=False)
    scene["bodies"]["shaft"]["inertia"] = 5e3  # so that it hardly slows down
    found = facts(completed(scene, 0.5, output_step=1e-4))  # in slices, most of them with a pull
    (pull,) = found["pulling"]
    first = np.arccos(-GRAVITY / (ECCENTRICITY * 60.0**2)) / 60.0
    assert pull["first"] == pytest.approx(first, abs=1.1e-4)
    assert pull["largest"] == pytest.approx(MASS * (ECCENTRICITY * 60.0**2 - GRAVITY), rel=1e-5)
    assert pull["detail"] in found["note"]


def test_a_pull_that_is_rounding_is_not_the_first() -> None:
    times, push = np.arange(6.0), np.array([-1e-15, 3.0, -1e-12, 5.0, -1.0, -2.0])
    first: list[list[float]] = []
    for k in range(0, len(times), 2):  # in slices
        first = first_pulls(times[k : k + 2], push[k : k + 2], first)
    assert first == first_pulls(times, push, [])
    (found,) = pulled({"cam": Peak(-2.0, 5.0, 5.0, 3.0)}, {"cam": first})
    assert (found.first, found.largest, found.time) == (4.0, 2.0, 5.0)
    assert "from 4 s on" in found.detail
