"""Mechanisms with closed loops drawn at random, whose periodic orbits are found from their start.

Some have ideal joints only; in others a joint has play and dry friction, and opens or keeps its
contact.
"""

import json
import math
from typing import Any

import numpy as np

from benchmarks.random_mechanisms import (
    Draw,
    drawn_dissipation,
    drawn_friction,
    with_strength,
)
from jointplay.solver.kinds import admit
from jointplay.solver.runs.study.plan import Study

DOWN = -math.pi / 2.0


def swinging_four_bar(random: np.random.Generator) -> dict[str, Any]:
    """Return a four-bar that hangs, shaken by a moment at its crank."""
    moment = random.uniform(0.5, 4.0)
    found = _four_bar(random)
    wave = {"type": "sinusoidal", "amplitude": 1.0, "frequency": random.uniform(3.0, 9.0)}
    found["forces"] = {
        "drive": _between("torque", "ground.A", "crank.a", moment=moment, course=wave),
        "damper": _between(
            "torsion-spring", "ground.D", "rocker.a", damping=random.uniform(0.1, 0.6)
        ),
    }
    return with_strength(found, "drive", "moment", "N m")


def four_bar_with_a_pendulum(random: np.random.Generator) -> dict[str, Any]:
    """Return a crank-rocker at constant speed, with a damped pendulum at its coupler."""
    found = _crank_rocker(random)
    found["bodies"]["bob"] = _rod(random.uniform(0.1, 0.4))
    found["joints"]["P"] = _pin("coupler.middle", "bob.a")
    damping = random.uniform(0.002, 0.02)
    found["forces"] = {
        "damper": _between("torsion-spring", "coupler.middle", "bob.a", damping=damping)
    }
    found["start"]["angles"]["bob"] = DOWN
    return with_strength(found, "damper", "damping", "N m s")


def slider_crank_with_a_mass(random: np.random.Generator) -> dict[str, Any]:
    """Return a slider-crank at constant speed that shakes a mass on springs, one of them cubic."""
    crank = random.uniform(0.03, 0.1)
    rod = crank * random.uniform(2.5, 5.0)
    stiffness, speed = random.uniform(50.0, 200.0), random.uniform(4.0, 20.0)
    damping, magnitude = random.uniform(1.0, 5.0), 10.0 ** random.uniform(2.0, 5.0)
    slide = {"type": "prismatic", "guide": "ground.A", "axis": [1.0, 0.0]}
    cubic = {"type": "polynomial", "coefficients": [0.0, 0.0, 0.0, -1.0]}
    along = {"direction": [1.0, 0.0], "over": {"quantity": "x"}, "course": cubic}
    linear = "spring-damper"
    found = {
        "name": "slider-crank-with-a-mass",
        "ground": {"points": {"A": [0.0, 0.0], "rest": [-1.0, 0.0]}},
        "bodies": {
            "crank": _rod(crank),
            "rod": _rod(rod),
            "slider": {"mass": 0.5, "inertia": 1.0, "points": {"pin": [0.0, 0.0]}},
            "mass": {"mass": 1.0, "inertia": 1.0, "points": {"centre": [0.0, 0.0]}},
        },
        "joints": {
            "A": _pin("ground.A", "crank.a"),
            "B": _pin("crank.b", "rod.a"),
            "C": _pin("rod.b", "slider.pin"),
            "guide": slide | {"slider": "slider.pin"},
            "slide": slide | {"slider": "mass.centre"},
        },
        "drivers": {"motor": {"joint": "A", "speed": speed}},
        "forces": {
            "spring": _between(linear, "slider.pin", "mass.centre", stiffness=stiffness),
            "damper": _between(linear, "ground.rest", "mass.centre", damping=damping),
            "cubic": _between("force", "ground.A", "mass.centre", magnitude=magnitude, **along),
        },
        "start": {"points": {"slider.pin": [crank + rod, 0.0], "mass.centre": [0.0, 0.0]}},
    }
    return with_strength(found, "cubic", "magnitude", "N")


def pendulum_with_play(random: np.random.Generator) -> dict[str, Any]:
    """Return a crank-rocker at constant speed whose pendulum hangs on a pin with play."""
    drawn = four_bar_with_a_pendulum(random)
    clearance = {"radial_clearance": 10.0 ** random.uniform(-4.0, -3.0), "bearing_radius": 0.02}
    drawn["scene"]["joints"]["P"]["clearance"] = clearance
    _touch(random, clearance, 10.0 ** random.uniform(5.0, 7.0))
    return drawn


def slider_crank_with_play(random: np.random.Generator) -> dict[str, Any]:
    """Return the preset, with play at its crank pin."""
    return _preset(random, "slider-crank", speed=(180.0, 400.0), clearance=(5e-5, 2e-4))


def four_bar_with_play(random: np.random.Generator) -> dict[str, Any]:
    """Return the preset, with play at the pin of its follower, which opens or does not."""
    return _preset(random, "four-bar", speed=(30.0, 60.0), clearance=(1e-4, 5e-4))


def press_with_play(random: np.random.Generator) -> dict[str, Any]:
    """Return the seven-bar press, with play at both crank pins."""
    return _preset(random, "seven-bar-press-fitted", speed=(2.0, 4.0), clearance=(2e-4, 5e-4)) | {
        "settle": 40
    }


LOOPS: dict[str, Draw] = {
    "four-bar": swinging_four_bar,
    "four-bar, pendulum": four_bar_with_a_pendulum,
    "slider-crank, mass": slider_crank_with_a_mass,
    "pendulum, play": pendulum_with_play,
    "slider-crank, play": slider_crank_with_play,
    "four-bar, play": four_bar_with_play,
    "press, play": press_with_play,
}


def _preset(
    random: np.random.Generator, name: str, **ranges: tuple[float, float]
) -> dict[str, Any]:
    """Return a preset whose contacts have laws of the registry, its speed the parameter."""
    values = {one: random.uniform(*ends) for one, ends in ranges.items()}
    study = admit({"kind": "poincare", "scene": {"preset": name, "parameters": values}})
    assert isinstance(study, Study)
    found = json.loads(study.point_scene(0).model_dump_json(exclude_none=True))
    speed = {"help": "Speed.", "unit": "rad/s", "default": values["speed"]}
    targets = found["parameters"]["speed"]["targets"]
    found["parameters"] = {"speed": speed | {"targets": targets}}
    stiffness = 10.0 ** random.uniform(8.0, 10.0)
    for joint in found["joints"].values():
        if joint.get("clearance", {}).get("radial_clearance"):
            _touch(random, joint["clearance"], stiffness)
    return {"scene": found, "parameter": "speed", "tolerance": 1e-12, "settle": 100}


def _touch(random: np.random.Generator, clearance: dict[str, Any], stiffness: float) -> None:
    """Give a clearance laws of contact and friction."""
    clearance["contact"] = {
        "law": "stiffness-and-dissipation",
        "stiffness": {"law": "power", "stiffness": stiffness, "exponent": 1.5},
        "dissipation": drawn_dissipation(random, 1e4),
    }
    clearance["friction"] = drawn_friction(random, random.uniform(0.02, 0.15))


def _four_bar(random: np.random.Generator) -> dict[str, Any]:
    """Return a four-bar, crank and rocker of which hang down at the start."""
    ground = random.uniform(0.7, 1.0)
    return {
        "name": "four-bar",
        "gravity": [0.0, -9.81],
        "ground": {"points": {"A": [0.0, 0.0], "D": [ground, 0.0]}},
        "bodies": {
            "crank": _rod(random.uniform(0.2, 0.5)),
            "coupler": _rod(random.uniform(0.7, 1.0)),
            "rocker": _rod(random.uniform(0.4, 0.7)),
        },
        "joints": {
            "A": _pin("ground.A", "crank.a"),
            "B": _pin("crank.b", "coupler.a"),
            "D": _pin("ground.D", "rocker.a"),
            "C": _pin("coupler.b", "rocker.b"),
        },
        "start": {"angles": {"crank": DOWN, "coupler": 0.0, "rocker": DOWN}},
    }


def _crank_rocker(random: np.random.Generator) -> dict[str, Any]:
    """Return a four-bar whose crank can turn, and does; see Grashof 1883 for the lengths."""
    found = _four_bar(random)
    lengths = {"crank": (0.05, 0.15), "coupler": (0.7, 0.9), "rocker": (0.4, 0.6)}
    found["bodies"] = {name: _rod(random.uniform(*ends)) for name, ends in lengths.items()}
    found["ground"]["points"]["D"] = [random.uniform(0.7, 0.9), 0.0]
    found["drivers"] = {"motor": {"joint": "A", "speed": random.uniform(3.0, 12.0)}}
    return found


def _rod(length: float) -> dict[str, Any]:
    """Return a rod of 1 kg, its ends and its middle."""
    half = 0.5 * length
    points = {"a": [-half, 0.0], "b": [half, 0.0], "middle": [0.0, 0.0]}
    return {"mass": 1.0, "inertia": length * length / 12.0, "points": points}


def _pin(bearing: str, journal: str) -> dict[str, Any]:
    return {"type": "revolute", "bearing": bearing, "journal": journal}


def _between(kind: str, first: str, second: str, **fields: Any) -> dict[str, Any]:
    return {"type": kind, "first": first, "second": second, **fields}
