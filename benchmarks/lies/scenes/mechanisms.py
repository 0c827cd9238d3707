"""A slider-crank of random size, loose at both pins of its rod."""

from collections.abc import Sequence
from typing import Any

from benchmarks.lies.draw import Draw
from benchmarks.lies.scenes.bearing import bearing


def slider_crank(draw: Draw) -> tuple[dict[str, Any], float]:
    """Return a driven crank, a rod with play at either end, a slider on an inclined guide."""
    crank = draw.size(0.01, 0.2)
    rod = crank * draw.even(2.5, 6.0)
    speed = draw.size(3.0, 300.0)
    mass = draw.size(0.1, 3.0)
    bearings = [bearing(draw, crank * draw.size(1e-3, 2e-2)) for _ in range(2)]
    slope = draw.one_of(0.0, 0.2)
    motor = {"position": draw.even(0.0, 6.28), "speed": speed}
    return loose_slider_crank((crank, rod), mass, bearings, motor, slope), 0.3 / speed


def loose_slider_crank(
    lengths: tuple[float, float],
    mass: float,
    bearings: Sequence[dict[str, Any]],
    motor: dict[str, float],
    slope: float = 0.0,
) -> dict[str, Any]:
    """Return the scene of a slider-crank, its rod loose at both pins.

    Parameters
    ----------
    lengths
        Those of crank and rod, m.
    mass
        That of the rod, and of the slider, kg.
    bearings
        Fields "clearance" of the pins at crank and slider.
    motor
        Position, rad, and speed, rad/s, of the crank.
    slope
        That of the guide.
    """
    crank, rod = lengths
    return {
        "name": "loose-slider-crank",
        "gravity": [0.0, -9.81],
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {
            "crank": {
                "mass": 1.0,
                "inertia": 1e-3,
                "points": {"O": [0.0, 0.0], "pin": [crank, 0.0]},
            },
            "rod": {
                "mass": mass,
                "inertia": mass * rod * rod / 12.0,
                "points": {"big": [-rod / 2.0, 0.0], "small": [rod / 2.0, 0.0]},
            },
            "slider": {"mass": mass, "inertia": 1e-3, "points": {"pin": [0.0, 0.0]}},
        },
        "joints": {
            "O": {"type": "revolute", "bearing": "ground.O", "journal": "crank.O"},
            "P": {
                "type": "revolute",
                "bearing": "crank.pin",
                "journal": "rod.big",
                "clearance": bearings[0],
            },
            "Q": {
                "type": "revolute",
                "bearing": "rod.small",
                "journal": "slider.pin",
                "clearance": bearings[1],
            },
            "guide": {
                "type": "prismatic",
                "guide": "ground.O",
                "slider": "slider.pin",
                "axis": [1.0, slope],
            },
        },
        "drivers": {"motor": {"joint": "O", **motor}},
    }
