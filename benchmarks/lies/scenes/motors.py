"""A slider-crank that a motor drives, loose in a pin and in its guide."""

from typing import Any

from benchmarks.lies.draw import Draw
from benchmarks.lies.scenes.drives import motor, turning
from benchmarks.lies.scenes.surfaces import contact, coulomb


def slider_crank(draw: Draw) -> tuple[dict[str, Any], float]:
    """Return a motor with a flywheel, a rod loose at the slider, and the slider in its guide."""
    crank, speed = draw.size(0.01, 0.1), draw.size(10.0, 200.0)
    rod, mass = crank * draw.even(2.5, 5.0), draw.size(0.05, 5.0)
    radius, clearance = crank * draw.even(0.1, 0.3), crank * draw.size(5e-4, 1e-2)
    inertia = mass * crank**2 * draw.size(1.0, 30.0)
    scene = {
        "name": "motor-and-slider",
        "gravity": [0.0, draw.one_of(0.0, -9.81)],
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {
            "crank": {
                "mass": 1.0,
                "inertia": inertia,
                "points": {"O": [0.0, 0.0], "pin": [crank, 0.0]},
            },
            "rod": {
                "mass": mass,
                "inertia": mass * rod**2 / 12.0,
                "points": {"big": [-0.5 * rod, 0.0], "small": [0.5 * rod, 0.0]},
            },
            "slider": {
                "mass": mass * draw.size(0.3, 3.0),
                "inertia": mass * crank**2 * draw.size(0.1, 1.0),
                "points": {"pin": [0.0, 0.0]},
            },
        },
        "joints": {
            "O": {"type": "revolute", "bearing": "ground.O", "journal": "crank.O"},
            "P": {"type": "revolute", "bearing": "crank.pin", "journal": "rod.big"},
            "Q": {
                "type": "revolute",
                "bearing": "rod.small",
                "journal": "slider.pin",
                "clearance": {
                    "radial_clearance": clearance,
                    "bearing_radius": radius,
                    "contact": contact(draw),
                    "friction": coulomb(draw),
                },
            },
            "guide": {
                "type": "prismatic",
                "guide": "ground.O",
                "slider": "slider.pin",
                "axis": [1.0, 0.0],
                "clearance": {
                    "wall_clearance": clearance * draw.size(0.3, 3.0),
                    "length": crank * draw.even(0.5, 2.0),
                    "height": crank * draw.even(0.3, 1.0),
                    "contact": contact(draw),
                },
            },
        },
        "forces": {"motor": motor(draw, "crank.O", inertia, speed)},
        "start": turning(draw, "crank", speed, 0.2),
    }
    return scene, 0.3 / speed
