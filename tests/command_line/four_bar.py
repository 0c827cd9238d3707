"""A four-bar linkage as a user writes it, to be spoilt."""

from typing import Any


def four_bar() -> dict[str, Any]:
    """A crank of 0.1 m, a coupler of 0.4 m and a rocker of 0.3 m, on ground of 0.4 m."""
    bodies = {
        name: {
            "mass": 1.0,
            "inertia": 0.01,
            "points": {"a": [-length / 2, 0.0], "b": [length / 2, 0.0]},
        }
        for name, length in {"crank": 0.1, "coupler": 0.4, "rocker": 0.3}.items()
    }
    pins = {
        "O": ("ground.O", "crank.a"),
        "A": ("crank.b", "coupler.a"),
        "B": ("coupler.b", "rocker.b"),
        "P": ("ground.P", "rocker.a"),
    }
    return {
        "name": "four-bar",
        "ground": {"points": {"O": [0.0, 0.0], "P": [0.4, 0.0]}},
        "bodies": bodies,
        "joints": {
            name: {"type": "revolute", "bearing": bearing, "journal": journal}
            for name, (bearing, journal) in pins.items()
        },
        "drivers": {"motor": {"joint": "O", "speed": 10.0}},
        "start": {"angles": {"crank": 0.0, "coupler": 1.0, "rocker": 1.8}},
    }
