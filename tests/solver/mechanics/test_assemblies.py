"""Assemblies: a drawing that needs no angles, and the ways in which a mechanism closes."""

import math
from typing import Any

import numpy as np
import pytest

from jointplay.solver.mechanics.assemblies import assemblies
from jointplay.solver.mechanics.assembly import assemble
from jointplay.solver.scene import presets
from jointplay.solver.scene.document import Scene
from tests.solver.cams import ECCENTRICITY, RADIUS, ROLLER, follower, pitch_table, valve

PINS = {"O": (0.0, 0.0), "A": (0.1, 0.17), "B": (0.8, 0.7), "C": (1.0, 0.0)}
BARS = {"crank": ("O", "A"), "coupler": ("A", "B"), "rocker": ("B", "C")}


def drawn() -> Scene:
    """Return a four-bar whose points are given as they are drawn, less each body's centre."""
    bodies: dict[str, Any] = {}
    for body, ends in BARS.items():
        centre = np.mean([PINS[pin] for pin in ends], axis=0)
        points = {pin: (np.array(PINS[pin]) - centre).tolist() for pin in ends}
        bodies[body] = {"mass": 1.0, "inertia": 0.1, "points": points}
    pairs = {"O": "ground crank", "A": "crank coupler", "B": "coupler rocker", "C": "ground rocker"}
    joints = {
        pin: dict(
            zip(("bearing", "journal"), (f"{body}.{pin}" for body in pair.split()), strict=True),
            type="revolute",
        )
        for pin, pair in pairs.items()
    }
    ground = {"points": {pin: list(PINS[pin]) for pin in "OC"}}
    drivers = {"motor": {"joint": "O", "speed": 1.0}}
    parts = {"ground": ground, "bodies": bodies, "joints": joints, "drivers": drivers}
    return Scene.model_validate({"name": "drawn", **parts})


def test_a_drawing_needs_no_start_angles() -> None:
    found = assemble(drawn())
    assert found.residual <= 1e-15  # a few roundings of 1 m
    np.testing.assert_allclose(found.pose[2::3], 0.0, atol=1e-14)


def test_a_four_bar_closes_in_two_ways_mirrored_in_its_diagonal() -> None:
    found = assemblies(drawn())
    assert found.held == []
    first, second = found.angles
    a, b, c = (np.array(PINS[pin]) for pin in "ABC")
    diagonal = math.atan2(*(c - a)[::-1])
    for body, bar in (("coupler", b - a), ("rocker", b - c)):
        drawn_at = math.atan2(*bar[::-1])
        turn = 2.0 * (diagonal - drawn_at)  # to its mirror image
        assert first[body] == pytest.approx(0.0, abs=1e-12)
        assert math.remainder(second[body] - turn, 2.0 * math.pi) == pytest.approx(0.0, abs=1e-9)


def test_points_of_a_drawing_choose_the_assembly() -> None:
    scene = drawn()
    a, b, c = (np.array(PINS[pin]) for pin in "ABC")
    along = (c - a) / np.linalg.norm(c - a)
    mirrored = a + 2.0 * along * ((b - a) @ along) - (b - a)
    positions = {"coupler.A": a, "coupler.B": mirrored, "rocker.B": mirrored, "rocker.C": c}
    rough = {name: np.round(position, 2).tolist() for name, position in positions.items()}
    document = scene.model_dump() | {"start": {"points": rough}}
    found = assemble(Scene.model_validate(document))
    angles = dict(zip(scene.bodies, found.pose[2::3], strict=True))
    assert found.residual <= 1e-15
    _, second = assemblies(scene).angles
    for body in ("coupler", "rocker"):
        assert math.remainder(angles[body] - second[body], 2.0 * math.pi) == pytest.approx(0.0)


def test_what_moves_is_held_where_it_starts() -> None:
    found = assemblies(Scene.model_validate(presets.document("andrews-squeezer")))
    assert found.held == ["K1.theta"]
    assert {round(angles["K1"], 12) for angles in found.angles} == {-0.061713890014}
    # K4 with K5, and K6 with K7, each close in two ways
    assert len(found.angles) == 4


@pytest.mark.parametrize("drawn_at", [0.03, -0.03])
def test_a_roller_also_closes_on_the_other_side_of_its_cam(drawn_at: float) -> None:
    scene = valve(follower("roller", pitch_table()))
    scene["start"] = {"points": {"tappet.F": [0.0, drawn_at]}}
    found = assemblies(Scene.model_validate(scene))
    sides = [centre["tappet"][1] - 0.02 for centre in found.positions]  # of the roller
    reach = RADIUS + ROLLER  # of the pitch circle, whose centre is below that of the shaft
    both = sorted([reach - ECCENTRICITY, -reach - ECCENTRICITY], key=lambda y: abs(y - drawn_at))
    assert sides == pytest.approx(both, abs=1e-6)  # the table's
