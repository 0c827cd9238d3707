"""Starts at and beyond the wall of a bearing, contacts that hardly are, and that do not end."""

import math
from collections.abc import Iterator
from typing import Any

from benchmarks.extreme_cases.case import JOURNAL, PRESS, Case
from benchmarks.extreme_cases.motions import plain

CLEARANCE = 1e-3
LITTLE = 1e-5
"""Gravity, m/s^2."""


def cases() -> Iterator[Case]:
    """Yield the cases."""
    yield from _in_contact()
    yield from _grazing()
    for e, floor in ((0.3, 1e-3), (0.7, 1e-3), (0.3, 1e-9)):
        parameters = {"restitution": e, "impact_rate_floor": floor}
        name = f"journal, restitution {e:g}, floor {floor:g} m/s"
        yield Case("chattering", name, JOURNAL, 0.5, parameters)


def journal(eccentricity: list[float], rate: list[float]) -> dict[str, Any]:
    """Return the bouncing journal, started somewhere in its bearing (m) with a rate (m/s)."""
    scene = plain(JOURNAL)
    scene["start"]["joints"] = {"bearing": {"eccentricity": eccentricity, "rate": rate}}
    return scene


def _in_contact() -> Iterator[Case]:
    for name, y, vx, vy in (
        ("centred, at rest", 0.0, 0.0, 0.0),
        ("centred, moving", 0.0, 0.3, 0.0),
        ("touching, at rest", -CLEARANCE, 0.0, 0.0),
        ("touching above, at rest", CLEARANCE, 0.0, 0.0),
        ("touching, approaching", -CLEARANCE, 0.0, -0.1),
        ("touching, leaving", -CLEARANCE, 0.0, 0.1),
        ("touching, sliding", -CLEARANCE, 0.1, 0.0),
        ("deep, at rest", -1.5 * CLEARANCE, 0.0, 0.0),
        ("deep, approaching", -1.2 * CLEARANCE, 0.0, -0.5),
        ("deep, leaving", -1.5 * CLEARANCE, 0.0, 0.5),
    ):
        yield Case("start", f"journal {name}", journal([0.0, y], [vx, vy]), 0.05)
    scene = plain(PRESS)
    scene["start"]["joints"] = {
        "A": {"eccentricity": [5.5e-4, 0.0]},
        "B": {"eccentricity": [0.0, 5e-4]},
    }
    yield Case("start", "press, A deep, B touching", scene, 0.05)


def _grazing() -> Iterator[Case]:
    for rate in (1e-9, 1e-10):
        # a hundredth of a second away from the wall
        scene = journal([0.0, -CLEARANCE + 0.01 * rate], [0.0, -rate])
        scene["gravity"] = [0.0, 0.0]
        yield Case("grazing", f"journal, {rate:g} m/s", scene, 0.05)
    for rate in (-1e-10, 0.0, 1e-10, 1e-9):  # upwards, under so little gravity that it shows
        speed = math.sqrt(2.0 * LITTLE * CLEARANCE + rate * abs(rate))
        scene = journal([0.0, 0.0], [0.0, speed])
        scene["gravity"] = [0.0, -LITTLE]
        name = "misses" if rate < 0.0 else "meets"
        yield Case(
            "grazing", f"journal at rest where it {name} the wall, {rate:g} m/s", scene, 20.0
        )
