"""Cams in runs: closed forms of the ideal ones, the ledger and lifting off of those with lash."""

from typing import Any

import numpy as np
import pytest

from jointplay.solver.joints import JOINTS
from tests.solver.cams import (
    CIRCLE,
    ECCENTRICITY,
    RADIUS,
    ROLLER,
    SPEED,
    follower,
    pitch_table,
    rocker,
    valve,
)
from tests.solver.completed_runs import run

TURN = 2.0 * np.pi / SPEED


def test_a_flat_face_on_an_eccentric_circle_rises_by_e_less_e_cosine() -> None:
    found = run(valve(follower("flat", CIRCLE)), TURN, output_step=TURN / 50)
    turned = SPEED * found.time
    lift = ECCENTRICITY * (1.0 - np.cos(turned))
    height = found["tappet.y"] - 0.02 - (RADIUS - ECCENTRICITY)  # F is below the centre of mass
    np.testing.assert_allclose(height, lift, rtol=0.0, atol=1e-12)
    # Newton: the cam carries weight, inertia and the spring from 0.2 m, 0.25 m long when free
    face = RADIUS - ECCENTRICITY * np.cos(turned)
    spring = 2e3 * (0.25 - (0.2 - face))
    inertia = 0.2 * SPEED**2 * ECCENTRICITY * np.cos(turned)
    force = spring + 0.2 * 9.81 + inertia
    np.testing.assert_allclose(found["cam.force_y"], force, rtol=1e-9)
    # virtual work: the motor's torque times its speed raises the tappet; the shaft is balanced
    torque = force * ECCENTRICITY * np.sin(turned)
    np.testing.assert_allclose(found["motor.torque"], torque, rtol=0.0, atol=1e-9)


def test_a_roller_on_an_eccentric_circle_is_a_rod_from_its_centre() -> None:
    constant = {"type": "constant", "value": RADIUS + ROLLER}
    exact = run(valve(follower("roller", constant, cam="C")), TURN, output_step=TURN / 50)
    turned = SPEED * exact.time
    reach = RADIUS + ROLLER
    across = ECCENTRICITY * np.sin(turned)
    height = np.sqrt(reach**2 - across**2) - ECCENTRICITY * np.cos(turned)
    np.testing.assert_allclose(exact["tappet.y"] - 0.02, height, rtol=0.0, atol=1e-12)
    table = run(valve(follower("roller", pitch_table())), TURN, output_step=TURN / 50)
    # a cubic spline through 64 knots
    np.testing.assert_allclose(table["tappet.y"], exact["tappet.y"], rtol=0.0, atol=3e-8)
    np.testing.assert_allclose(table["cam.force_y"], exact["cam.force_y"], rtol=1e-3)


@pytest.mark.parametrize("shape", ["flat", "roller"])
def test_a_follower_is_a_lash_from_the_outline_that_its_cam_is_drawn_by(shape: str) -> None:
    profile = CIRCLE if shape == "flat" else pitch_table()
    joint = follower(shape, profile, lash=1e-4)
    outline, moved = JOINTS[joint["type"]].model_validate(joint).curves()
    assert (outline.end, outline.filled, moved.end, moved.filled) == (0, True, 1, False)
    ideal = run(valve(follower(shape, profile)), TURN, output_step=TURN / 36)
    for nth, height in enumerate(ideal["tappet.y"] - 0.02):
        upwards = np.pi / 2.0 - SPEED * ideal.time[nth]  # in the cam's axes
        up = np.array([np.cos(upwards), np.sin(upwards)])
        if shape == "flat":
            apart = height - outline.points @ up
        else:
            apart = np.hypot(*(outline.points - height * up).T) - np.hypot(*moved.points[0])
        # points are a degree apart, so that one of them is touched
        assert (apart.argmin() + 10 * nth) % 360 == 90
        assert apart.min() == pytest.approx(1e-4, abs=1e-12)


@pytest.mark.parametrize("shape", ["flat", pytest.param("roller", marks=pytest.mark.long)])
def test_a_follower_strikes_lifts_off_and_its_ledger_closes(shape: str) -> None:
    profile = CIRCLE if shape == "flat" else pitch_table()
    joint = follower(shape, profile, lash=1e-4, friction={"coefficient": 0.1})
    scene = valve(joint)
    scene["drivers"]["motor"]["speed"] = 400.0  # too fast for the spring
    found = run(scene, 0.04, tolerance=1e-7)
    ledger = found.statistics["energy"]
    assert abs(ledger["residual"]) <= 10.0 * 1e-7 * ledger["gross_work"]
    assert ledger["friction_loss"] > 0.0 < ledger["contact_loss"]
    assert len(found.contacts("cam")) > 1
    assert found.peaks["cam.penetration"].minimum < -1e-3


def test_two_descriptions_of_one_cam_move_their_follower_alike() -> None:
    """An eccentric circle about the shaft, and a circle about its own centre."""
    play: dict[str, Any] = {"lash": 1e-4, "friction": {"coefficient": 0.1}}
    round_one = {"type": "constant", "value": RADIUS}
    one = run(valve(follower("flat", CIRCLE, **play)), 0.02, tolerance=1e-9)
    two = run(valve(follower("flat", round_one, cam="C", **play)), 0.02, tolerance=1e-9)
    assert len(one.contacts("cam")) == len(two.contacts("cam")) > 0
    for channel in ("tappet.y", "tappet.vy", "cam.normal_force", "motor.torque"):
        tiny = 1e-6 * np.ptp(one[channel])
        np.testing.assert_allclose(one[channel], two[channel], rtol=0.0, atol=tiny)


@pytest.mark.long
@pytest.mark.parametrize("lash", [0.0, 1e-4])
@pytest.mark.parametrize("shape", ["flat", "roller"])
def test_both_formulations_follow_a_cam_alike(shape: str, lash: float) -> None:
    """A shaft that runs on, with a rocker in place of the tappet: nothing is driven."""
    profile = CIRCLE if shape == "flat" else pitch_table(24)
    scene = rocker(follower(shape, profile, lash=lash, friction={"coefficient": 0.1}))
    one, two = (
        run(scene, 0.03, tolerance=1e-9, output_step=1e-3, formulation=name)
        for name in ("reduced", "lagrange")
    )
    assert len(one.impacts) == len(two.impacts)
    assert bool(len(one.impacts)) == (lash > 0.0)
    for channel in ("shaft.theta", "tappet.theta", "shaft.omega", "cam.force_y"):
        tiny = 1e-5 * np.ptp(one[channel])
        np.testing.assert_allclose(one[channel], two[channel], rtol=0.0, atol=tiny)
    for found in (one, two):
        ledger = found.statistics["energy"]
        # steps pass over the knots of a table, where the path's third derivative jumps
        share = 1e-8 if shape == "flat" else 3e-7
        assert abs(ledger["residual"]) <= share * ledger["gross_work"]


def test_a_round_cam_with_much_lash_rubs_at_its_surface() -> None:
    surface, lash, speed, weight, coefficient = 0.01, 0.01, 10.0, 10.0, 0.2
    profile = {"type": "constant", "value": surface + lash}
    law = {"law": "stiffness-and-dissipation", "stiffness": {"law": "power", "stiffness": 1e9}}
    law["dissipation"] = {"law": "hunt-crossley-unlatched", "loss": 1e3}
    friction = {"coefficient": coefficient, "static_velocity": 0.0}
    scene = valve(follower("flat", profile, lash=lash, contact=law, friction=friction))
    scene["drivers"]["motor"]["speed"] = speed
    scene |= {"gravity": [0.0, -weight], "forces": {}, "start": {"guides": {"cam": {}}}}
    scene["bodies"]["tappet"]["mass"] = 1.0
    scene["start"]["guides"]["cam"]["offset"] = -lash - 1e-6
    found = run(scene, 0.05, output_step=0.05)
    assert found["cam.slip_velocity"][-1] == pytest.approx(surface * speed, rel=1e-3)
    # it has settled but for ten tolerances
    assert found["cam.normal_force"][-1] == pytest.approx(weight, rel=1e-5)
    torque = coefficient * weight * surface
    assert found["motor.torque"][-1] == pytest.approx(torque, rel=1e-3)
