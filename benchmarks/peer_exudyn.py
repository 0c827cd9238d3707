"""EXUDYN on the press: a kinematic tree of four freedoms, contact as a Python user function.

Optional: `pip install exudyn`. The tree is a form that its explicit solvers accept, for they close
no loops: the slider, the long link on it, the two links with journals on that. The cranks
only carry their pins along known circles. What pins do to links is in the user function, as users
write it: in plain Python, the impact rate latched by the stage that first finds a penetration.
EXUDYN locates no onsets, and a step that it rejects may have latched a rate: errors fall slowly
with the tolerance (and fast where restitution is 1, for that force knows no impact rate).
"""

import math
import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np

from benchmarks.press_joints import fit, pin
from jointplay.solver.mechanics.impact_floors import MOST
from jointplay.solver.mechanics.view import view
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.drivers import SteadyDriver

LONGEST_STEP, FIRST_STEP, SHORTEST_STEP = 1e-3, 1e-7, 1e-14
"""s; the first two as other peers have."""
CARRIED_AT = {"slider7": "D", "link6": "D", "link2": "C", "link3": "C"}
"""The tree's bodies, in the order of our coordinates, and the point that carries each."""

Pin = Callable[[float], tuple[float, float, float, float]]
"""Time -> position (m) and velocity (m/s)."""
Law = Callable[[float, float, float, float, float], tuple[float, float, float]]
"""Eccentricity, its rate and the journal's spin -> force (N) and moment (N m) on the journal."""
UserFunction = Callable[[Any, float, int, Any, Any], list[float]]


def bar(press: Scene, body: str, first: str, second: str) -> float:
    """Return how far, m, the second point of a bar is from the first, along its axis."""
    (x1, y1), (x2, y2) = (press.bodies[body].points[point] for point in (first, second))
    assert y1 == y2 == 0.0
    return float(x2 - x1)


def drive_of(press: Scene, joint: str) -> tuple[Pin, float]:
    """Return how the crank at a joint with play carries its pin, and the crank's spin, rad/s."""
    crank, point = pin(press, joint).bearing.split(".")
    for driver in press.drivers.values():
        assert driver.joint is not None
        hinge = pin(press, driver.joint)
        body, pivot = hinge.journal.split(".")
        if body == crank:
            break
    assert isinstance(driver, SteadyDriver)
    x0, y0 = press.ground.points[hinge.bearing.split(".")[1]]
    length, begun, speed = bar(press, crank, pivot, point), driver.position, driver.speed

    def carried(t: float) -> tuple[float, float, float, float]:
        x, y = length * math.cos(begun + speed * t), length * math.sin(begun + speed * t)
        return x0 + x, y0 + y, -speed * y, speed * x

    return carried, speed


def law_of(press: Scene, joint: str, crank_spin: float) -> Law:
    """Return the force of a joint with play; it keeps the impact rate from call to call."""
    clearance, contact, rubbing = fit(press, joint)
    play, bearing = clearance.radial_clearance, clearance.bearing_radius
    journal, turning = bearing - play, bearing * crank_spin
    stiffness = contact.contact_stiffness(clearance)
    hysteresis = 0.75 * (1.0 - contact.restitution**2)
    floor = contact.impact_rate_floor or MOST  # its impacts are far above either
    friction = rubbing.coefficient
    static, dynamic = rubbing.static_velocity, rubbing.dynamic_velocity
    impact_rate = 0.0

    def law(ex: float, ey: float, vx: float, vy: float, spin: float) -> tuple[float, float, float]:
        nonlocal impact_rate
        distance = math.sqrt(ex * ex + ey * ey)
        depth = distance - play
        if depth <= 0.0:
            impact_rate = 0.0
            return 0.0, 0.0, 0.0
        nx, ny = ex / distance, ey / distance
        rate = vx * nx + vy * ny
        if impact_rate == 0.0:
            impact_rate = max(rate, floor)
        damped = 1.0 + hysteresis * rate / impact_rate
        normal = max(stiffness * depth * math.sqrt(depth) * damped, 0.0)
        slip = nx * vy - ny * vx + journal * spin - turning
        share = min(max((abs(slip) - static) / (dynamic - static), 0.0), 1.0)
        along = -math.copysign(friction * share * normal, slip)
        return -normal * nx - along * ny, along * nx - normal * ny, journal * along

    return law


def forces_of(press: Scene, calls: list[int]) -> UserFunction:
    """Return the generalised forces of both contacts as a user function that counts its calls."""
    sine, cosine = math.sin, math.cos
    (pin_a, spin_a), (pin_b, spin_b) = drive_of(press, "A"), drive_of(press, "B")
    law_a = law_of(press, "A", spin_a)
    law_b = law_of(press, "B", spin_b)
    length6 = bar(press, "link6", "D", "C")
    length2, length3 = bar(press, "link2", "C", "A"), bar(press, "link3", "C", "B")
    x0, y0 = press.ground.points["O1"]

    def forces(_system: Any, t: float, _item: int, q: Any, q_t: Any) -> list[float]:
        calls[0] += 1
        travel, angle6, turned2, turned3 = q
        speed, spin6, spin2, spin3 = q_t
        spin2, spin3 = spin2 + spin6, spin3 + spin6
        x6, y6 = length6 * cosine(angle6), length6 * sine(angle6)
        x2, y2 = length2 * cosine(angle6 + turned2), length2 * sine(angle6 + turned2)
        x3, y3 = length3 * cosine(angle6 + turned3), length3 * sine(angle6 + turned3)
        x, y, vx, vy = x0 + travel + x6, y0 + y6, speed - spin6 * y6, spin6 * x6
        px, py, ux, uy = pin_a(t)
        rate = vx - spin2 * y2 - ux, vy + spin2 * x2 - uy
        ax, ay, moment = law_a(x + x2 - px, y + y2 - py, *rate, spin2)
        on2 = x2 * ay - y2 * ax + moment
        px, py, ux, uy = pin_b(t)
        rate = vx - spin3 * y3 - ux, vy + spin3 * x3 - uy
        bx, by, moment = law_b(x + x3 - px, y + y3 - py, *rate, spin3)
        on3 = x3 * by - y3 * bx + moment
        return [ax + bx, x6 * (ay + by) - y6 * (ax + bx) + on2 + on3, on2, on3]

    return forces


def plant(exudyn: Any, system: Any, press: Scene, calls: list[int], start: Any) -> Any:
    """Put the press into a system as a tree that starts in our state; return its node."""
    items, count = exudyn.itemInterface, len(CARRIED_AT)
    position, speed = linked(start, -1.0).reshape(2, count)
    node = system.AddNode(
        items.NodeGenericODE2(
            numberOfODE2Coordinates=count,
            referenceCoordinates=np.zeros(count),
            initialCoordinates=position,
            initialCoordinates_t=speed,
        )
    )
    slides, turns = exudyn.JointType.PrismaticX, exudyn.JointType.RevoluteZ
    to_c = [bar(press, "link6", "D", "C"), 0.0, 0.0]
    bodies = [press.bodies[name] for name in CARRIED_AT]
    hubs = [body.points[at] for body, at in zip(bodies, CARRIED_AT.values(), strict=True)]
    tree = items.ObjectKinematicTree(
        nodeNumber=node,
        jointTypes=[slides, turns, turns, turns],
        linkParents=[-1, 0, 1, 1],
        jointTransformations=exudyn.Matrix3DList([np.eye(3)] * count),
        jointOffsets=exudyn.Vector3DList([np.zeros(3), np.zeros(3), to_c, to_c]),
        linkMasses=[body.mass for body in bodies],
        linkCOMs=exudyn.Vector3DList([[-x, -y, 0.0] for x, y in hubs]),
        linkInertiasCOM=exudyn.Matrix3DList([np.diag([0.0, 0.0, b.inertia]) for b in bodies]),
        baseOffset=[*press.ground.points["O1"], 0.0],
        gravity=[*press.gravity, 0.0],
        forceUserFunction=forces_of(press, calls),
    )
    system.AddObject(tree)
    system.Assemble()
    return node


def linked(state: np.ndarray, sense: float) -> np.ndarray:
    """Return our state from the tree's (1), whose last two angles are to the long link; or -1."""
    other = np.array(state).reshape(2, len(CARRIED_AT))
    other[:, 2:] += sense * other[:, 1:2]
    return other.ravel()


def measure_exudyn(
    scene: Scene, start: np.ndarray, method: str, size: float, end: float
) -> tuple[float, float, np.ndarray] | None:
    """Run "DOPRI5" at a tolerance or "RK44" with a step, s; None where EXUDYN is not installed.

    Returns
    -------
    Processor seconds to `end`, evaluations, and the state there in our coordinates.
    """
    sys.exudynFast = True  # type: ignore[attr-defined]  # its faster build: no range checks
    try:
        import exudyn
    except ImportError:
        return None
    calls = [0]
    container = exudyn.SystemContainer()
    system = container.AddSystem()
    node = plant(exudyn, system, view(scene), calls, start)
    settings, kinds = exudyn.SimulationSettings(), exudyn.OutputVariableType
    settings.solution.file.write = False
    integration = settings.timeIntegration
    integration.endTime, integration.verboseMode = end, 0
    longest = size if method == "RK44" else LONGEST_STEP
    integration.numberOfSteps = round(end / longest)
    integration.automaticStepSize = method != "RK44"
    integration.initialStepSize, integration.minimumStepSize = FIRST_STEP, SHORTEST_STEP
    integration.relativeTolerance, integration.absoluteTolerance = size, 1e-3 * size
    integration.explicit.computeEndOfStepAccelerations = False  # an evaluation a step less
    begun = time.process_time()
    system.SolveDynamic(settings, solverType=getattr(exudyn.DynamicSolverType, method))
    seconds = time.process_time() - begun
    found = [system.GetNodeOutput(node, kind) for kind in (kinds.Coordinates, kinds.Coordinates_t)]
    return seconds, float(calls[0]), linked(np.concatenate(found), 1.0)
