"""A slider in a guide with play: impacts on the walls against closed forms, and the ledger."""

import math
from typing import Any

import numpy as np
import pytest

from jointplay.records.arrays import Floats
from tests.solver.completed_runs import run
from tests.solver.sliders import HEIGHT, LENGTH, bead, block, hanging, rocker, swinging, thrown

STIFFNESS, CLEARANCE = 1e8, 1e-3
SMOOTH = {"coefficient": 1e-12}
"""Friction that does nothing, so that all scenes share one kernel."""


def test_a_block_that_lands_flat_bounces_as_two_springs_of_hertz() -> None:
    speed, mass = 0.5, 1.0
    found = run(thrown(block(restitution=1.0, friction=SMOOTH), 0.3, speed), 0.012, tolerance=1e-8)
    # m v^2 / 2 = 2 K d^2.5 / 2.5; the contact lasts 2.9432750574 d / v (Johnson 1985, eq. 11.24)
    deepest = (1.25 * mass * speed**2 / (2.0 * STIFFNESS)) ** 0.4
    lasts = 2.9432750574 * deepest / speed
    for corner, onset in (
        ("guide.corner_1", CLEARANCE / speed),
        ("guide.corner_2", CLEARANCE / speed),
        ("guide.corner_3", 3.0 * CLEARANCE / speed + lasts),
        ("guide.corner_4", 3.0 * CLEARANCE / speed + lasts),
    ):
        first = found.contacts(corner)[0]
        assert first["onset"] == pytest.approx(onset, rel=1e-7)
        assert first["release"] - first["onset"] == pytest.approx(lasts, rel=1e-6)
        assert first["approach_rate"] == pytest.approx(speed, rel=1e-7)
        assert first["peak_force"] == pytest.approx(STIFFNESS * deepest**1.5, rel=1e-6)
        assert first["impulse"] == pytest.approx(mass * speed, rel=1e-6)
        assert found.peaks[f"{corner}.penetration"].maximum == pytest.approx(deepest, rel=1e-6)
    assert found.last("block.vx")[0] == pytest.approx(0.3, rel=1e-9)


def test_a_block_that_turns_is_thrown_back_by_two_opposite_corners() -> None:
    spin, inertia = 20.0, 2e-3
    found = run(
        thrown(block(restitution=1.0, friction=SMOOTH), 0.0, 0.0, spin), 0.004, tolerance=1e-8
    )
    assert [len(found.contacts(f"guide.corner_{k}")) for k in (1, 2, 3, 4)] == [1, 0, 1, 0]
    one, two = (found.contacts(f"guide.corner_{k}")[0] for k in (1, 3))
    # l sin(a) / 2 = c + h (1 - cos(a)) / 2, by fixed point
    angle = 0.0
    for _ in range(50):
        angle = math.asin(2.0 * (CLEARANCE + HEIGHT / 2.0 * (1.0 - math.cos(angle))) / LENGTH)
    assert one["onset"] == pytest.approx(angle / spin, rel=1e-7)
    assert one["impulse"] == pytest.approx(two["impulse"], rel=1e-6)
    assert found.last("block.omega")[0] == pytest.approx(-spin, rel=1e-6)
    arm = LENGTH / 2.0 * math.cos(angle) - HEIGHT / 2.0 * math.sin(angle)
    # while it turns on by 0.004 rad, the arm shrinks by a thousandth
    assert one["impulse"] == pytest.approx(inertia * spin / arm, rel=5e-3)


def test_a_block_starts_where_it_is_put_and_strikes_so_much_sooner() -> None:
    speed, offset, tilt = 0.5, 4e-4, 2e-3
    scene = thrown(block(restitution=1.0, friction=SMOOTH), 0.3, speed)
    scene["start"]["guides"] = {"guide": {"offset": offset, "tilt": tilt}}
    found = run(scene, 0.003, tolerance=1e-8)
    assert found["block.y"][0] == pytest.approx(offset, rel=1e-12)
    assert found["block.theta"][0] == pytest.approx(tilt, rel=1e-12)
    # the first corner is l sin(a) / 2 - h (1 - cos(a)) / 2 higher than the centred one
    higher = LENGTH / 2.0 * math.sin(tilt) - HEIGHT / 2.0 * (1.0 - math.cos(tilt))
    first = found.contacts("guide.corner_1")[0]
    assert first["onset"] == pytest.approx((CLEARANCE - offset - higher) / speed, rel=1e-7)


@pytest.mark.parametrize(
    "scene",
    ["block", "bead", pytest.param("swinging", marks=pytest.mark.long)],
)
def test_the_ledger_closes(scene: str) -> None:
    document, duration = {
        "block": (thrown(block(friction={"coefficient": 0.3}), 1.0, 0.5, 15.0), 0.02),
        "bead": (bead(restitution=0.9), 0.02),
        "swinging": (swinging(), 0.1),
    }[scene]
    found = run(document, duration)
    ledger = found.statistics["energy"]
    assert len(found.impacts) > 2
    assert ledger["friction_loss"] > 0.0 < ledger["contact_loss"]
    assert abs(ledger["residual"]) <= 10.0 * 1e-6 * ledger["gross_work"]


@pytest.mark.long
def test_a_bar_that_hangs_in_a_slot_keeps_its_energy() -> None:
    ledger = run(hanging(), 2.0).statistics["energy"]
    assert abs(ledger["residual"]) <= 10.0 * 1e-6 * ledger["gross_work"]


def test_friction_does_not_change_how_a_pin_bounces_between_the_walls_of_its_slot() -> None:
    found = run(bead(), 0.02, tolerance=1e-8)
    speed, mass = 0.5, 1.0
    deepest = (1.25 * mass * speed**2 / STIFFNESS) ** 0.4
    lasts = 2.9432750574 * deepest / speed
    for wall, onset in (
        ("slot.wall_1", CLEARANCE / speed),
        ("slot.wall_2", 3.0 * CLEARANCE / speed + lasts),
    ):
        first = found.contacts(wall)[0]
        assert first["onset"] == pytest.approx(onset, rel=1e-7)
        assert first["release"] - first["onset"] == pytest.approx(lasts, rel=1e-6)
        assert first["peak_force"] == pytest.approx(STIFFNESS * deepest**1.5, rel=1e-6)
    once = run(bead(), 0.007, tolerance=1e-8)  # what speed loses by rubbing turns the bead
    lost, gained = 0.3 - once.last("bead.vx")[0], once.last("bead.omega")[0] - 40.0
    assert abs(lost) > 0.01
    assert 5e-5 * gained == pytest.approx(0.01 * lost, rel=1e-6)


def test_a_pin_without_play_turns_the_rocker_as_the_drawing_says() -> None:
    found = run(rocker(0.0), 0.6, output_step=0.01)
    turned = 10.0 * found.time
    angle = np.arctan2(0.2 * np.sin(turned), 0.5 + 0.2 * np.cos(turned))
    np.testing.assert_allclose(found["rocker.theta"], angle, rtol=0.0, atol=1e-12)
    # Newton and Euler of the rocker about its pin: moments of weight and of the pin's force
    reach = np.hypot(0.2 * np.sin(turned), 0.5 + 0.2 * np.cos(turned))
    force = np.cos(angle) * found["slot.force_y"] - np.sin(angle) * found["slot.force_x"]
    moment = -reach * force - 2.0 * 9.81 * 0.3 * np.cos(angle)
    inertia = 0.05 + 2.0 * 0.3**2
    np.testing.assert_allclose(inertia * found["rocker.alpha"], moment, rtol=0.0, atol=1e-10)
    along = np.cos(angle) * found["slot.force_x"] + np.sin(angle) * found["slot.force_y"]
    np.testing.assert_allclose(along, 0.0, atol=1e-10)


DURATION = 0.02
TIME = np.linspace(0.0, DURATION, 100_001)
THROWS = np.random.default_rng(3).uniform(-1.0, 1.0, (40, 4))


def gaps(time: Floats, clearance: float, velocity: Floats, spin: float, speed: float) -> Floats:
    """Return penetrations of the corners of a block in free flight, (4, times) m.

    The guide turns at a speed, rad/s, about where the block starts.
    """
    turned, tilt = speed * time, (spin - speed) * time
    along, side = np.array([[1], [-1], [-1], [1]]), np.array([[1], [1], [-1], [-1]])
    ends = along * LENGTH / 2 * np.sin(tilt) + side * HEIGHT / 2 * np.cos(tilt)
    aside = time * (velocity[1] * np.cos(turned) - velocity[0] * np.sin(turned))
    return np.asarray(side * (aside + ends) - HEIGHT / 2 - clearance, np.float64)


@pytest.mark.parametrize(
    "draw", [*range(8), *(pytest.param(i, marks=pytest.mark.long) for i in range(8, len(THROWS)))]
)
def test_a_tumbling_block_first_touches_where_its_corners_do(draw: int) -> None:
    x, aside, spin, size = THROWS[draw] * [1.0, 1.0, 40.0, 1.0]
    clearance = 10.0 ** (size - 3.0)  # 0.1 to 10 mm
    flight = thrown(block(wall_clearance=clearance, friction=SMOOTH), x, aside, spin)
    check_first(flight, gaps(TIME, clearance, np.array([x, aside]), spin, 0.0))


@pytest.mark.long
@pytest.mark.parametrize("draw", range(len(THROWS)))
def test_a_block_in_a_guide_that_turns_first_touches_where_its_corners_do(draw: int) -> None:
    x, aside, spin, size = THROWS[draw] * [1.0, 1.0, 40.0, 1.0]
    clearance, speed = 10.0 ** (size - 3.0), 60.0 * x
    flight = thrown(block(wall_clearance=clearance, friction=SMOOTH), x, aside, spin)
    flight["bodies"]["link"] = {"mass": 1.0, "inertia": 1.0, "points": {"O": [0.0, 0.0]}}
    flight["joints"]["guide"]["guide"] = "link.O"
    flight["joints"]["pin"] = {"type": "revolute", "bearing": "ground.O", "journal": "link.O"}
    flight["drivers"] = {"motor": {"joint": "pin", "speed": speed}}
    check_first(flight, gaps(TIME, clearance, np.array([x, aside]), spin, speed))


def check_first(flight: dict[str, Any], expected: Floats) -> None:
    """Compare the first contact of a run with penetrations, (4, times) m."""
    found = run(flight, DURATION).impacts
    closed = np.argwhere(expected.T > 0.0)
    if not len(closed):
        assert not len(found)
        return
    instant, corner = closed[0]
    first = found[np.argmin(found["onset"])]
    assert first["joint"] == corner
    assert TIME[instant - 1] <= first["onset"] <= TIME[instant]


@pytest.mark.long
def test_a_rocker_with_play_moves_alike_in_both_formulations() -> None:
    one, two = (
        run(rocker(1e-3), 0.3, formulation=name, tolerance=1e-9) for name in ("reduced", "lagrange")
    )
    assert len(one.impacts) == len(two.impacts) > 10
    # 13 impacts at 1e-9 a step: 2e-10 rad and 2e-7 rad/s were found
    assert one.last("rocker.theta") == pytest.approx(two.last("rocker.theta"), abs=1e-8)
    assert one.last("rocker.omega") == pytest.approx(two.last("rocker.omega"), abs=1e-5)
