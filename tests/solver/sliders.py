"""Scenes of sliders in guides with play."""

from typing import Any

LENGTH, HEIGHT = 0.1, 0.05


def block(stiffness: float = 1e8, restitution: float = 0.9, **clearance: Any) -> dict[str, Any]:
    """Return a block of 1 kg between two walls on the ground, along x, without gravity."""
    law = {"law": "lankarani-nikravesh", "stiffness": stiffness, "restitution": restitution}
    play = {"wall_clearance": 1e-3, "length": LENGTH, "height": HEIGHT, "contact": law}
    return {
        "name": "block",
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {"block": {"mass": 1.0, "inertia": 2e-3, "points": {"S": [0.0, 0.0]}}},
        "joints": {
            "guide": {
                "type": "prismatic",
                "guide": "ground.O",
                "slider": "block.S",
                "axis": [1.0, 0.0],
                "clearance": play | clearance,
            }
        },
    }


def thrown(scene: dict[str, Any], x: float, y: float, spin: float = 0.0) -> dict[str, Any]:
    """Return a block's scene with a velocity at the start, m/s and rad/s."""
    start = {"velocities": {"block": [x, y]}, "angular_velocities": {"block": spin}}
    return scene | {"start": start}


def swinging() -> dict[str, Any]:
    """Return a block in a guide that is fixed in a link on a pin, aslant in all ways."""
    scene = block(friction={"coefficient": 0.2})
    scene["gravity"] = [0.0, -9.81]
    points = {"A": [-0.2, 0.0], "G": [0.1, 0.02]}
    scene["bodies"]["link"] = {"mass": 2.0, "inertia": 0.05, "points": points}
    scene["bodies"]["block"]["points"]["S"] = [0.01, -0.02]
    guide = scene["joints"]["guide"] | {"guide": "link.G", "axis": [1.0, 0.3], "angle": 0.4}
    pin = {"type": "revolute", "bearing": "ground.O", "journal": "link.A"}
    return scene | {"joints": {"pin": pin, "guide": guide}}


def bead(restitution: float = 1.0) -> dict[str, Any]:
    """Return a bead of 1 kg about a pin in a slot on the ground, along x, with friction."""
    law = {"law": "lankarani-nikravesh", "stiffness": 1e8, "restitution": restitution}
    play = {"wall_clearance": 1e-3, "pin_radius": 0.01, "contact": law}
    play["friction"] = {"coefficient": 0.3}
    slot = {"type": "pin-in-slot", "slot": "ground.O", "pin": "bead.P", "axis": [2.0, 0.0]}
    return {
        "name": "bead",
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {"bead": {"mass": 1.0, "inertia": 5e-5, "points": {"P": [0.0, 0.0]}}},
        "joints": {"slot": slot | {"clearance": play}},
        "start": {"velocities": {"bead": [0.3, 0.5]}, "angular_velocities": {"bead": 40.0}},
    }


def hanging() -> dict[str, Any]:
    """Return a bar that hangs by a pin in a slot of the ground, free to slide and to swing."""
    slot = {"type": "pin-in-slot", "slot": "ground.O", "pin": "bar.P", "axis": [1.0, 0.2]}
    return {
        "name": "hanging",
        "gravity": [0.0, -9.81],
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {"bar": {"mass": 2.0, "inertia": 0.06, "points": {"P": [-0.3, 0.01]}}},
        "joints": {"slot": slot},
        "start": {"angles": {"bar": -0.5}},
    }


def rocker(wall_clearance: float) -> dict[str, Any]:
    """Return a driven crank whose pin slides in the slot of a rocker, as in a shaper."""
    law = {"law": "lankarani-nikravesh", "stiffness": 1e8}
    play = {"wall_clearance": wall_clearance, "pin_radius": 0.01, "contact": law}
    slot = {"type": "pin-in-slot", "slot": "rocker.A", "pin": "crank.P", "axis": [1.0, 0.0]}
    return {
        "name": "rocker",
        "gravity": [0.0, -9.81],
        "ground": {"points": {"O": [0.0, 0.0], "A": [-0.5, 0.0]}},
        "bodies": {
            "crank": {"mass": 1.0, "inertia": 1e-3, "points": {"O": [0.0, 0.0], "P": [0.2, 0.0]}},
            "rocker": {"mass": 2.0, "inertia": 0.05, "points": {"A": [-0.3, 0.0]}},
        },
        "joints": {
            "O": {"type": "revolute", "bearing": "ground.O", "journal": "crank.O"},
            "A": {"type": "revolute", "bearing": "ground.A", "journal": "rocker.A"},
            "slot": slot | {"clearance": play | {"friction": {"coefficient": 0.1}}},
        },
        "drivers": {"motor": {"joint": "O", "speed": 10.0}},
    }
