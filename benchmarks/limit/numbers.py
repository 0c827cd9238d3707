"""Numbers of presses for the program in C++, from their scenes and from the solver's lanes.

Error scales, limits of steps and starts are the solver's own: both have the same problem to solve.
"""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from benchmarks.press_joints import fit
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.drivers import SteadyDriver

COORDINATES = ("slider7.s", "link6.theta", "link2.theta", "link3.theta")
FIELDS: dict[str, tuple[int, ...]] = {
    **dict.fromkeys(("radial", "bearing_radius", "stiffness", "hysteresis"), ()),
    **dict.fromkeys(("friction", "static_velocity", "ramp"), ()),
    **dict.fromkeys(("impact_floor", "restart", "end", "largest_step", "full"), ()),
    "weight": (8,),
    "y": (8,),
    **dict.fromkeys(("time", "step", "memory", "fastest"), ()),
    "contact": (2,),
    "impact_rate": (2,),
    **dict.fromkeys(("attempts", "accepted", "onsets"), ()),
}
PRESS = np.dtype([(name, np.float64, shape) for name, shape in FIELDS.items()])
"""A run: `Press` of press.hpp."""
INERTIA = 7
"""Numbers that the program works out itself."""


def mechanism(scene: Scene) -> NDArray[np.float64]:
    """Return what all presses have in common: `Mechanism` of press.hpp."""
    bodies, ground = scene.bodies, scene.ground.points
    found: list[float] = []
    for body, driver, pivot in (("crank1", "drive1", "O1"), ("crank4", "drive4", "O4")):
        drive = scene.drivers[driver]
        assert isinstance(drive, SteadyDriver)
        found += [_length(scene, body, "pivot", "pin"), *ground[pivot], drive.position, drive.speed]
    ends = (("link6", "C", "D"), ("link2", "A", "C"), ("link3", "B", "C"))
    found += [_length(scene, *link) for link in ends]
    found += [math.hypot(*bodies[body].points[near]) for body, _, near in ends]
    found += [bodies[body].mass for body in ("slider7", "link6", "link2", "link3")]
    found += [bodies[body].inertia for body in ("link6", "link2", "link3")]
    return np.array([*found, *scene.gravity, *[0.0] * INERTIA])


def _length(scene: Scene, body: str, first: str, second: str) -> float:
    points = scene.bodies[body].points
    return float(np.hypot(*np.subtract(points[first], points[second])))


def presses(kernel: Kernel, problems: Sequence[LaneProblem]) -> NDArray[np.void]:
    """Return runs at their start, (problems,) of `PRESS`."""
    if kernel.coordinates != COORDINATES:
        raise ValueError(f"the press has other coordinates: {kernel.coordinates}")
    found = np.zeros(len(problems), PRESS)
    for press, problem in zip(found, problems, strict=True):
        clearance, law, friction = fit(problem.scene, "A")
        press["radial"] = clearance.radial_clearance
        press["bearing_radius"] = clearance.bearing_radius
        press["stiffness"] = law.contact_stiffness(clearance)
        press["hysteresis"] = 0.75 * (1.0 - law.restitution**2)
        press["friction"] = friction.coefficient
        press["static_velocity"], press["ramp"] = friction.static_velocity, friction.ramp_slope()
        press["end"] = problem.duration
        lane = Bundle(kernel, [problem], watch=False).lane(0)
        for name in ("largest_step", "full", "step", "fastest"):
            press[name] = lane.number(name)
        for name in ("impact_floor", "restart"):
            press[name] = lane[name][0]
        for name, block in (("weight", "weight"), ("y", "y"), ("contact", "mode")):
            press[name] = lane[block]
        press["impact_rate"] = lane["impact_rate"]
    return found
