"""The ideal mechanism at its limits: dead points, driver positions of many turns, refusals."""

import math
from typing import Any

import numpy as np
import pytest

from jointplay.records.failure import InvalidInput, LimitExceeded, SimulationFailed
from jointplay.solver.kinds import admit
from jointplay.solver.mechanics.assembly import assemble
from jointplay.solver.runs.ideal import motion
from jointplay.solver.runs.ideal.following import follow
from jointplay.solver.runs.ideal.reach import motion_reach
from jointplay.solver.runs.simulate import Simulation
from jointplay.solver.scene import presets
from jointplay.solver.scene.document import Scene


def slider_crank(crank: float, rod: float, speed: float = 2.0 * math.pi) -> dict[str, Any]:
    """Return an ideal slider-crank that starts stretched."""
    scene = presets.document("slider-crank")
    scene["bodies"]["crank"]["points"] = {"O": [-crank / 2, 0.0], "pin": [crank / 2, 0.0]}
    scene["bodies"]["rod"]["points"] = {"crank": [-rod / 2, 0.0], "slider": [rod / 2, 0.0]}
    scene["joints"]["P"]["clearance"] = None
    scene["drivers"]["motor"]["speed"] = speed
    scene["parameters"] = {}
    return scene


def job(scene: dict[str, Any], duration: float = 1.0) -> dict[str, Any]:
    return {"kind": "simulate", "scene": scene, "duration": duration, "output_step": 1e-3}


def test_a_run_into_a_dead_point_fails_there_and_keeps_what_came_before() -> None:
    # crank as long as the rod: at a quarter turn the slider is on the crank's axis, and free
    simulation = Simulation(admit(job(slider_crank(0.1, 0.1))))
    slices = simulation.slices()
    times = next(slices).sample_time
    with pytest.raises(SimulationFailed, match="dead point") as failed:
        next(slices)
    assert failed.value.code == "assembly-lost"
    assert failed.value.time == pytest.approx(0.25, abs=1e-8)
    np.testing.assert_allclose(times, 1e-3 * np.arange(len(times)), atol=1e-12)
    assert times[-1] == pytest.approx(0.25, abs=2e-3)
    peak = simulation.summary().peaks["slider.x"]
    assert peak.maximum == pytest.approx(0.2, abs=1e-12)  # stretched, at the start


def test_a_rod_too_short_to_turn_is_followed_until_it_pulls_tight() -> None:
    # the pin may rise to the rod's length: sin(theta) = 0.06 / 0.1
    simulation = Simulation(admit(job(slider_crank(0.1, 0.06))))
    with pytest.raises(SimulationFailed, match="do not reach") as failed:
        list(simulation.slices())
    assert failed.value.time == pytest.approx(math.asin(0.6) / (2.0 * math.pi), abs=1e-11)
    certificate = simulation.certificate()
    assert certificate is not None
    horizon = certificate.facts["horizon"]
    assert (
        failed.value.time - 2e-3 <= horizon <= failed.value.time
    )  # certified no longer than it ran
    assert certificate.facts["converged"] == [[0.0, horizon]]
    assert certificate.until.max() == horizon


def test_a_run_that_is_left_before_its_extremes_has_those_of_its_samples() -> None:
    document = job(slider_crank(0.1, 0.3)) | {"output_step": 100.0}  # samples at 0 and 0.3 s
    simulation = Simulation(admit(document | {"duration": 0.3}))
    samples = next(simulation.slices())
    assert samples.sample_time.tolist() == [0.0, 0.3]
    turned = simulation.summary().peaks["crank.theta"]
    assert (turned.minimum_time, turned.maximum_time) == (0.0, 0.3)
    assert turned.maximum == pytest.approx(0.3 * 2.0 * math.pi, rel=1e-14)


def test_whole_turns_in_a_drivers_position_change_nothing_but_the_angle() -> None:
    scene = slider_crank(0.05, 0.12)
    scene["drivers"]["motor"]["position"] = 0.7
    plain = assemble(Scene.model_validate(scene))
    scene["drivers"]["motor"]["position"] = 0.7 + 2.0 * math.pi * 100
    wound = assemble(Scene.model_validate(scene))
    assert wound.residual < 1e-12  # one rounding of an angle of 600 rad
    np.testing.assert_allclose(wound.pose[[3, 4, 6]], plain.pose[[3, 4, 6]], atol=1e-12)


def test_one_driver_too_many_is_named() -> None:
    scene = slider_crank(0.05, 0.12)
    scene["drivers"]["second"] = {"joint": "Q", "speed": 1.0}
    with pytest.raises(InvalidInput, match="'motor' and 'second' is prescribed twice"):
        admit(job(scene))


def test_sections_come_in_pieces_and_are_all_there() -> None:
    scene = slider_crank(0.05, 0.12, speed=2000.0 * math.pi)
    request = job(scene, duration=2.5) | {"output_step": 0.5, "channels": ["slider.x"]}
    admission = admit(request)
    assert admission.sections == 2501
    pieces = [found.sections for found in Simulation(admission).slices()]
    assert max(len(piece) for piece in pieces) <= 1000
    sections = np.concatenate(pieces)
    assert len(sections) == 2501
    np.testing.assert_allclose(sections, 0.17, atol=1e-12)  # stretched at each whole turn


def test_drivers_that_hardly_ever_come_round_are_run_for_300_turns_at_most() -> None:
    scene = slider_crank(0.05, 0.12, speed=1000.0)
    scene["bodies"]["wheel"] = {"mass": 1.0, "inertia": 1.0, "points": {"hub": [0.0, 0.0]}}
    pin = {"type": "revolute", "bearing": "ground.O", "journal": "wheel.hub"}
    scene["joints"]["W"] = pin
    scene["drivers"]["second"] = {"joint": "W", "speed": 999.0}
    turn = 2.0 * math.pi / 1000.0
    with pytest.raises(LimitExceeded, match="turns 301 times until all come round"):
        admit(job(scene, 301.0 * turn))
    assert admit(job(scene, 299.0 * turn)).period == pytest.approx(1000.0 * turn)


def twice_round() -> dict[str, Any]:
    """Return a platform on three bars that is in another assembly after one turn of its crank."""
    bars = {"crank": 1.4, "bar1": 1.42, "bar2": 2.17, "bar3": 2.16}
    bodies: dict[str, Any] = {
        name: {"mass": 1.0, "inertia": 0.1, "points": {"a": [0.0, 0.0], "b": [length, 0.0]}}
        for name, length in bars.items()
    }
    corners = {"b1": [-0.02, 0.64], "b2": [-0.68, -0.93], "b3": [1.0, -0.91]}
    bodies["platform"] = {"mass": 1.0, "inertia": 0.1, "points": corners}
    pins = {"O": "ground.O crank.a", "A1": "crank.b bar1.a"}
    pins |= {f"A{k}": f"ground.A{k} bar{k}.a" for k in (2, 3)}
    pins |= {f"B{k}": f"bar{k}.b platform.b{k}" for k in (1, 2, 3)}
    return {
        "name": "twice-round",
        "ground": {"points": {"O": [0.0, 0.0], "A2": [-0.83, 0.51], "A3": [-0.29, -0.98]}},
        "bodies": bodies,
        "joints": {
            name: dict(zip(("bearing", "journal"), pin.split(), strict=True), type="revolute")
            for name, pin in pins.items()
        },
        "drivers": {"motor": {"joint": "O", "speed": 2.0 * math.pi}},
        "start": {"angles": {"bar1": -2.02, "bar2": -1.23, "bar3": -0.12, "platform": -1.01}},
    }


def test_a_mechanism_that_comes_back_after_two_periods_goes_on() -> None:
    channels = [f"platform.{axis}" for axis in ("x", "y", "theta")]
    request = job(twice_round(), duration=4.3) | {"output_step": 0.05, "channels": channels}
    pieces = list(Simulation(admit(request)).slices())
    times = np.concatenate([piece.sample_time for piece in pieces])
    samples = np.concatenate([piece.samples for piece in pieces])
    scene = Scene.model_validate(twice_round())
    # step by step, without any period
    wanted = follow(scene, times.tolist()).poses[:, -3:]
    np.testing.assert_allclose(samples, wanted, rtol=0, atol=1e-9)
    sections = np.concatenate([piece.sections for piece in pieces])
    assert len(sections) == 5
    np.testing.assert_allclose(sections, wanted[:81:20], rtol=0, atol=1e-9)
    assert abs(sections[1] - sections[0]).max() > 0.1
    reach = motion_reach(scene)
    assert reach is not None
    found = reach.of("platform", "x")
    assert found is not None
    assert found.low <= samples[:, 0].min() < samples[:, 0].max() <= found.high


def test_a_run_up_to_where_a_mechanism_does_not_come_back_is_whole(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(motion, "MOST_PERIODS", 1)
    request = job(twice_round(), duration=1.0) | {"output_step": 0.05}
    samples = np.concatenate(
        [
            piece.samples
            for piece in Simulation(admit(request | {"channels": ["platform.x"]})).slices()
        ]
    )
    wanted = follow(Scene.model_validate(twice_round()), np.linspace(0.0, 1.0, 21).tolist())
    np.testing.assert_allclose(samples[:, 0], wanted.poses[:, -3], rtol=0, atol=1e-9)


def test_a_mechanism_that_does_not_come_back_ends_there(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(motion, "MOST_PERIODS", 1)
    simulation = Simulation(admit(job(twice_round(), duration=1.5) | {"output_step": 0.05}))
    with pytest.raises(SimulationFailed, match="has not come back") as failed:
        list(simulation.slices())
    assert failed.value.time == 1.0
