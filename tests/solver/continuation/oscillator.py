"""The impact oscillator: where its orbits graze and what their multipliers are, in closed form."""

import cmath
import json
import math
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

from jointplay.solver.continuation.orbit import Curve
from jointplay.solver.continuation.passage import Section
from jointplay.solver.continuation.section_map import SectionMap
from jointplay.solver.continuation.settled import settle
from jointplay.solver.continuation.start import scaled
from jointplay.solver.integrators import method_for
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kinds import admit
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.scene.document import Scene

STIFFNESS, DAMPING, SHAKEN, GAP = 400.0, 2.0, 2.0, 0.01
"""N/m, N s/m, N and m, of a mass of 1 kg."""
TOLERANCE = 1e-11


def document(stop: float, restitution: float = 0.8) -> dict[str, Any]:
    """Return the scene with a stop that takes a share of the speed, whatever its stiffness."""
    study = admit({"kind": "poincare", "scene": {"preset": "impact-oscillator"}, "settle": 0})
    assert isinstance(study, Study)
    scene: dict[str, Any] = json.loads(study.point_scene(0).model_dump_json(exclude_none=True))
    scene["joints"]["stop"]["clearance"]["contact"] = {
        "law": "stiffness-and-dissipation",
        "stiffness": {"law": "power", "stiffness": stop, "exponent": 1.5},
        "dissipation": {"law": "exact", "restitution": restitution},
    }
    for name in ("stop_stiffness", "restitution"):
        del scene["parameters"][name]
    return scene


def curve(stop: float, speed: float, periods: int = 1) -> tuple[Curve, Section]:
    """Return the curve of orbits over speed, and a section near one."""
    written = document(stop)

    @cache
    def scene_at(value: float) -> Scene:
        written["drivers"]["motor"]["speed"] = value
        return Scene.model_validate(written)

    kernel = ready_kernel(scene_at(speed), "reduced", method_for("auto", TOLERANCE))
    size = kernel.states + len(kernel.pairs)
    bare = SectionMap(kernel, scene_at, periods, TOLERANCE, np.ones(size), 20.0)
    settled = settle(bare, speed, None, 100)
    found = scaled(bare, speed, settled)
    return replace(found, map=replace(found.map, periods=periods)), Section(speed, settled.state)


def grazing() -> list[float]:
    """Return the speeds at which the motion without impacts just touches the stop, rad/s."""
    squares = np.roots([1.0, DAMPING**2 - 2.0 * STIFFNESS, STIFFNESS**2 - (SHAKEN / GAP) ** 2])
    return sorted(math.sqrt(one) for one in squares)


def free_multipliers(speed: float) -> list[complex]:
    """Return the multipliers of the motion without impacts."""
    period = 2.0 * math.pi / speed
    turning = math.sqrt(STIFFNESS - DAMPING**2 / 4.0)
    one = cmath.exp((-DAMPING / 2.0 + 1j * turning) * period)
    return sorted([one, one.conjugate()], key=lambda each: -each.imag)
