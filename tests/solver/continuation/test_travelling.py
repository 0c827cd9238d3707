"""Orbits of mechanisms that travel: their place is cyclic, and need not come back."""

import math
from typing import Any

import numpy as np
import pytest

from benchmarks.basin_scenes import ON_THE_MASS, shaking, sliding
from benchmarks.known_orbits import followed
from benchmarks.limit_cycles import SPRING, varied
from jointplay.local import run

DRAG, PUSH, SHAKEN, FREQUENCY = 0.3, 0.05, 0.2, 2.0
"""N s/m, N, N and rad/s; of 1 kg."""
PERIOD = 2.0 * math.pi / FREQUENCY


def travelling(**forces: Any) -> dict[str, Any]:
    """Return a mass with drag that is pushed one way and shaken, its drag the parameter."""
    push = {"type": "force", **ON_THE_MASS, "magnitude": PUSH, "direction": [1.0, 0.0]}
    shaken = shaking(SHAKEN, FREQUENCY)
    scene = sliding("travelling", DRAG, push=push, shaking=shaken, **forces)
    return varied(scene, "/forces/damper/damping", DRAG)


def test_a_mass_that_travels_has_the_orbit_and_multiplier_of_its_closed_form() -> None:
    values = {"from": DRAG, "to": 2.0 * DRAG, "count": 10}
    job = {"scene": travelling(), "parameter": "strength", "values": values, "settle": 30}
    (branch,) = followed(job)
    drag = branch.column("value")
    rate = PUSH / drag + (SHAKEN / (drag + 1j * FREQUENCY)).real
    # runs err by 1e-11 of the speed at each step, some hundred of them
    assert branch.column("rate.mass.s") == pytest.approx(rate, abs=1e-9)
    assert branch.column("multiplier_1.real") == pytest.approx(np.exp(-drag * PERIOD), abs=1e-8)
    assert not branch.column("multiplier_2.real").any()
    place = branch.column("state.mass.s")
    assert (place == place[0]).all()
    state = [float(branch.column(f"{name}.mass.s")[0]) for name in ("state", "rate")]
    history = run(
        {
            "kind": "simulate",
            "scene": travelling(),
            "duration": PERIOD,
            "state": state,
            "tolerance": 1e-10,
        }
    ).history
    gone = float(history["mass.x"].values[-1]) - state[0]
    assert gone == pytest.approx(PUSH / DRAG * PERIOD, abs=1e-8)


def test_a_place_that_a_spring_holds_comes_back() -> None:
    values = {"from": DRAG, "to": 2.0 * DRAG, "count": 3}
    job = {"scene": travelling(spring=SPRING), "parameter": "strength", "values": values}
    (branch,) = followed(job | {"settle": 2})
    assert float(branch.column("multiplier_2.real")[0]) != 0.0
    assert float(branch.column("residual").max()) < 1e-9
