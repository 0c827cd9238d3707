"""Oscillators and pendulums drawn at random, whose periodic orbits are found from their start."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from pydantic import BaseModel

from benchmarks.basin_scenes import cubic_oscillator, shaking
from benchmarks.continuation import scene as impact_oscillator
from benchmarks.known_orbits import NATURAL, pendulum, with_dry_friction
from jointplay.solver.laws.dissipation import LAWS
from jointplay.solver.laws.friction import LAWS as FRICTION_LAWS

Draw = Callable[[np.random.Generator], dict[str, Any]]
"""Returns the scene and the parameter of a continuation's job."""


def swinging(random: np.random.Generator) -> dict[str, Any]:
    """Return a driven pendulum, its drive and its damping."""
    found = pendulum()
    found["parameters"]["strength"]["default"] = random.uniform(0.1, 1.07)
    found["forces"]["damper"]["damping"] = NATURAL * random.uniform(0.2, 1.0)
    return {"scene": found, "parameter": "strength"}


def shaken(random: np.random.Generator) -> dict[str, Any]:
    """Return Duffing's oscillator at some frequency."""
    wave = shaking(random.uniform(0.05, 2.0), random.uniform(0.5, 1.6))
    found = cubic_oscillator(random.uniform(0.05, 0.4), random.uniform(0.0, 1.0), shaking=wave)
    return with_strength(found, "shaking", "magnitude", "N")


def rubbing(random: np.random.Generator) -> dict[str, Any]:
    """Return an oscillator with dry friction."""
    found = with_dry_friction(random.uniform(1.1, 2.0), 10.0 ** random.uniform(-3.0, -1.0))
    found["forces"]["rubbing"]["magnitude"] = random.uniform(0.02, 0.2)
    return {"scene": found, "parameter": "drive"}


def striking(random: np.random.Generator) -> dict[str, Any]:
    """Return an impact oscillator whose stop has a law of the registry."""
    stop = 10.0 ** random.uniform(5.0, 9.0)
    found = impact_oscillator(stop)
    contact = found["joints"]["stop"]["clearance"]["contact"]
    contact["dissipation"] = drawn_dissipation(random, stop)
    for parameter, value in (("speed", random.uniform(16.0, 30.0)), ("amplitude", 0.005)):
        found["parameters"][parameter]["default"] = value
    return {"scene": found, "parameter": "amplitude"}


OSCILLATORS: dict[str, Draw] = {
    "pendulum": swinging,
    "Duffing": shaken,
    "dry friction": rubbing,
    "impact oscillator": striking,
}


def drawn_dissipation(random: np.random.Generator, damping: float) -> dict[str, Any]:
    """Return a law of the registry for a contact of about 1 kg; `damping` in N s/m at most."""
    sizes = {
        "restitution": random.uniform(0.3, 0.95),
        "damping": damping * random.uniform(0.01, 0.3),
        "effective_mass": 1.0,
        "loss": random.uniform(0.05, 0.5),
        "relaxation_time": 10.0 ** random.uniform(-5.0, -3.0),
    }
    return _law(random, LAWS, sizes)


def drawn_friction(random: np.random.Generator, most: float) -> dict[str, Any]:
    """Return a friction law of the registry whose coefficient is `most` at most."""
    sliding = most * random.uniform(0.2, 0.8)
    sizes = {
        "coefficient": sliding,
        "static_coefficient": most,
        "kinetic_coefficient": sliding,
        "bristle_stiffness": 10.0 ** random.uniform(3.0, 4.0),
    }
    return _law(random, FRICTION_LAWS, sizes)


def with_strength(found: dict[str, Any], force: str, field: str, unit: str) -> dict[str, Any]:
    """Return a scene whose force has the parameter `strength`, and that."""
    strength = found["forces"][force][field]
    declared = {"help": "Strength of a force.", "unit": unit, "default": strength}
    declared["targets"] = [{"path": f"/forces/{force}/{field}"}]
    return {"scene": found | {"parameters": {"strength": declared}}, "parameter": "strength"}


def _law(
    random: np.random.Generator, registry: Mapping[str, type[BaseModel]], sizes: dict[str, float]
) -> dict[str, Any]:
    name = str(random.choice([law for law in registry if law != "none"]))
    fields = {one: size for one, size in sizes.items() if one in registry[name].model_fields}
    return {"law": name} | fields
