"""Starts that no pose can have: at the dead point that comes nearest, in the nearest assembly."""

import math
from typing import Any

import pytest

from tests.solver.mechanics.start.mechanisms import bar, put_together, revolute, slider_crank

ORDERS = [(0, 1, 2), (1, 2, 0), (2, 1, 0)]


def listed(document: dict[str, Any], order: tuple[int, ...]) -> dict[str, Any]:
    """Return the same mechanism with its bodies in another order."""
    names = list(document["bodies"])
    document["bodies"] = {names[k]: document["bodies"][names[k]] for k in order}
    return document


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_rod_that_is_given_too_steep_is_as_steep_as_it_can_be(
    side: float, order: tuple[int, ...]
) -> None:
    start = {"angles": {"rod": side * 0.6}, "angular_velocities": {"rod": 3.0}}
    document = listed(slider_crank(start, crank=0.1, rod=0.25), order)
    found, pose, rates = put_together(document)
    # steepest where the crank of 0.2 m stands upright below the rod of 0.5 m; off by the square
    # of what the crank is off by, which is up to the root of rounding
    assert pose["rod"][2] == pytest.approx(side * math.asin(0.4), abs=1e-12)
    assert math.cos(pose["crank"][2]) == pytest.approx(0.0, abs=1e-5)
    # no motion turns the rod there
    assert rates["rod"][2] == 0.0
    assert [one.pointer for one in found.misfits] == [
        "/start/angles/rod",
        "/start/angular_velocities/rod",
    ]


@pytest.mark.parametrize("order", ORDERS)
def test_a_rocker_that_is_given_beyond_its_dead_point_stands_there(order: tuple[int, ...]) -> None:
    document = {
        "name": "rocker",
        "ground": {"points": {"O": [0, 0], "Q": [0.5, 0]}},
        "bodies": {"rocker": bar(0.15), "coupler": bar(0.2), "crank": bar(0.05)},
        "joints": {
            "O": revolute("ground.O", "rocker.a"),
            "A": revolute("rocker.b", "coupler.a"),
            "B": revolute("crank.b", "coupler.b"),
            "Q": revolute("ground.Q", "crank.a"),
        },
        "start": {"angles": {"rocker": 1.5}},
    }
    _, pose, _ = put_together(listed(document, order))
    # coupler and crank in line, 0.4 + 0.1 m: an isosceles triangle with sides 0.5, 0.5, 0.3
    assert pose["rocker"][2] == pytest.approx(math.acos(0.15 / 0.5), abs=1e-12)


@pytest.mark.parametrize("order", ORDERS)
def test_of_equally_near_assemblies_that_nearest_to_zero_is_taken_in_any_order(
    order: tuple[int, ...],
) -> None:
    # the guide keeps the slider from its angle, and the crank may lie to either side: at 0.56 rad,
    # or at 2.66 rad, which was the only one among the eight nearest poses in the order (1, 2, 0)
    document = {
        "name": "slanted",
        "ground": {"points": {"O": [0, 0], "guide": [0.2, 0.0451]}},
        "bodies": {
            "crank": bar(0.1) | {"points": {"a": [-0.1, 0.01], "b": [0.1, 0]}},
            "rod": bar(0.1082),
            "slider": {"mass": 1.0, "inertia": 0.1, "points": {"c": [0.01, 0]}},
        },
        "joints": {
            "guide": {
                "type": "prismatic",
                "guide": "ground.guide",
                "slider": "slider.c",
                "axis": [1, -0.01],
            },
            "A": revolute("crank.b", "rod.a"),
            "O": revolute("ground.O", "crank.a"),
            "B": revolute("rod.b", "slider.c"),
        },
        "start": {"angles": {"rod": -0.256, "slider": -0.0075}},
    }
    _, pose, _ = put_together(listed(document, order))
    assert pose["rod"][2] == pytest.approx(-0.256, abs=1e-9)
    assert 0.5 < pose["crank"][2] < 0.6
