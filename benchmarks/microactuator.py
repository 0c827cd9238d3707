"""A microactuator that travels by impacts: a box with dry friction, and a mass in it that strikes.

Example 9.3 and 9.4 of Dankowicz and Schilder 2013, Recipes for Continuation, which COCO's demo
`stickslip` is: a mass on a spring in a box, pulled with V^2 sin^2(w t) / (1 - q)^2, strikes the
box, five times as heavy, at q = 0.5; the box sticks to the ground, and slides after an impact.
The demo prints no numbers that could be found. Its equations are solved by shooting with another
integrator, and beside that by the product, in a scene of the same bodies: friction turns over
within a ramp and the wall gives way, both of which are extrapolated to zero.
"""

import math
import time
from typing import Any

import numpy as np
from scipy.interpolate import BPoly, PPoly

from benchmarks.continuation import to_the_limit
from benchmarks.known_orbits import followed
from benchmarks.microactuator_shooting import (
    BOX,
    DAMPING,
    FREQUENCY,
    FRICTION,
    RESTITUTION,
    WALL,
    known_grazing,
    known_orbit,
    known_stuck,
)
from jointplay.records.arrays import Floats
from jointplay.records.branch import Branch

NAMES = "q at phase 0", "its rate", "multiplier", "other multiplier"
SPAN = -0.4, 0.58
"""m, over which the pull is known."""
PIECES, ROOM = 63, 1.0
RAMPS, STOPS = (4e-3, 2e-3, 1e-3), (1e9, 1e10, 1e11)
"""m/s and N/m^1.5 that are extrapolated."""
SOFT, BEFORE = 1e4, 1e-3
"""N/m^1.5 of a wall that is grazed, and how far before grazing, in V, a branch begins."""
EXCITED = 0.7
"""V of the orbit that is compared, which is unstable."""


def pull() -> dict[str, Any]:
    """Return 1 / (1 - q)^2 as a function of q, within 1e-13 of itself."""
    knots = np.linspace(*SPAN, PIECES + 1)
    derivatives = [[math.factorial(k + 1) / (1.0 - q) ** (k + 2) for k in range(4)] for q in knots]
    pieces = PPoly.from_bernstein_basis(BPoly.from_derivatives(knots, derivatives)).c
    return {
        "type": "piecewise-polynomial",
        "knots": knots.tolist(),
        "coefficients": pieces[::-1].T.tolist(),
        "outside": "held",
    }


def scene(square: float, ramp: float, stop: float) -> dict[str, Any]:
    """Return the box and its mass, V^2 the parameter; friction turns over within +-ramp, m/s.

    `stop` : stiffness of the wall, N/m^1.5.
    """
    slide = {"type": "prismatic", "axis": [1.0, 0.0]}
    turning = {"type": "revolute"}
    origin = {"O": [0.0, 0.0]}
    contact = {
        "law": "stiffness-and-dissipation",
        "stiffness": {"law": "power", "stiffness": stop, "exponent": 1.5},
        "dissipation": {"law": "exact", "restitution": RESTITUTION},
    }
    room = {"radial_clearance": ROOM, "bearing_radius": 2.0 * ROOM, "contact": contact}
    wall = {"bearing": "box.wall", "journal": "mass.O", "clearance": room}
    targets = [
        {"path": "/forces/steady/magnitude", "factor": 0.5},
        {"path": "/forces/turning/magnitude", "factor": -0.5},
    ]
    return {
        "name": "microactuator",
        "ground": {"points": origin},
        "bodies": {
            "box": {"mass": BOX, "inertia": 1.0, "points": origin | {"wall": [WALL - ROOM, 0.0]}},
            "mass": {"mass": 1.0, "inertia": 1.0, "points": origin},
            "hand": {"mass": 1e-9, "inertia": 1e-9, "points": origin},
        },
        "joints": {
            "track": slide | {"guide": "ground.O", "slider": "box.O"},
            "guide": slide | {"guide": "box.O", "slider": "mass.O"},
            "pivot": turning | {"bearing": "box.O", "journal": "hand.O"},
            "wall": turning | wall,
        },
        "drivers": {"motor": {"joint": "pivot", "speed": 2.0 * FREQUENCY}},
        "forces": _forces(square, ramp),
        "start": {"joints": {"wall": {"eccentricity": [0.8, 0.0]}}},
        "parameters": {
            "square": {"help": "V^2.", "unit": "N m^2", "default": square, "targets": targets}
        },
    }


def _forces(square: float, ramp: float) -> dict[str, Any]:
    """Return spring, pull and friction.

    sin^2 is half of 1 - cos(2 w t): one half of the pull stays along the box, the other turns with
    a hand, and the guide of the mass takes what of it is across.
    """
    ends = {"first": "box.O", "second": "mass.O"}
    along = {"type": "force", "direction": [1.0, 0.0]}
    pulls = along | ends | {"over": {"quantity": "x", **ends}, "course": pull()}
    knots = {"knots": [-9.0, -ramp, ramp, 9.0], "values": [1.0, 1.0, -1.0, -1.0]}
    turned = {"type": "table", "outside": "held", **knots}
    rubbing = {"first": "ground.O", "second": "box.O", "magnitude": FRICTION * BOX}
    return {
        "spring": {"type": "spring-damper", **ends, "stiffness": 1.0, "damping": DAMPING},
        "steady": pulls | {"magnitude": 0.5 * square},
        "turning": pulls | {"first": "hand.O", "axes": "first", "magnitude": -0.5 * square},
        "rubbing": along | rubbing | {"over": {"quantity": "x", "rate": True}, "course": turned},
    }


def branch_at(excited: float, until: float, count: int, state: Floats, **scene_of: float) -> Branch:
    """Return a branch of so many orbits from V on, found from q and its rate at phase 0.

    `scene_of` : of the scene, besides V.
    """
    (branch,) = followed(
        {
            "scene": scene(excited**2, **scene_of),
            "parameter": "square",
            "values": {"from": excited**2, "to": until**2, "count": count},
            "settle": 0,
            "state": [0.0, float(state[0]), 0.0, float(state[1])],
        }
    )
    return branch


def grazings(known: float) -> Floats:
    """Return V of grazing for two ramps; no stiffness of the wall matters.

    The motion loses its stability before, at a fold, and the branch comes back from there.
    """
    begin, end = known - BEFORE, known + 5.0 * BEFORE
    state, found = known_stuck(begin), []
    for ramp in RAMPS[:2]:
        branch = branch_at(begin, end, 30, state, ramp=ramp, stop=SOFT)
        found.append(next(one.value for one in branch.special if one.label == "GR"))
    return np.sqrt(found)


def numbers(state: Floats, ramp: float, stop: float) -> list[float]:
    """Return q and its rate at phase 0, and both multipliers, of the orbit with one impact."""
    branch = branch_at(EXCITED, EXCITED * 1.0001, 2, state, ramp=ramp, stop=stop)
    names = "state.mass.s", "rate.mass.s", "multiplier_1.real", "multiplier_2.real"
    return [float(branch.column(name)[0]) for name in names]


def main() -> None:
    """Print the grazing, and an unstable orbit with impacts, beside those of shooting."""
    begun = time.process_time()
    powers = np.vander(np.array(RAMPS) / RAMPS[0], increasing=True)
    known = known_grazing()
    at_ramps = grazings(known)
    found = np.linalg.solve(powers[:2, :2], at_ramps)[0]
    print(f"grazing at V {at_ramps.tolist()}, limit {found:.9f}", end="")
    print(f"  by shooting {known:.9f}  apart {found - known:.0e}")
    state, multipliers = known_orbit(EXCITED)
    at_stops = [
        np.linalg.solve(powers, [numbers(state, ramp, stop) for ramp in RAMPS])[0] for stop in STOPS
    ]
    _, limit = to_the_limit(STOPS, at_stops)
    for name, one, other in zip(NAMES, limit, [*state, *multipliers], strict=True):
        print(f"V {EXCITED}, {name:18}{one:14.8f}  by shooting {other:14.8f}", end="")
        print(f"  apart {one - other:.0e}")
    print(f"{time.process_time() - begun:.1f} s of one core")


if __name__ == "__main__":
    main()
