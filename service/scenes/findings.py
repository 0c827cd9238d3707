"""Findings of a check of a scene: whether it can be put together and move."""

import math
from typing import Any

from jointplay.figures.scene_facts import clearances
from jointplay.solver.kinds.assembled import AssembledScene
from jointplay.solver.mechanics.assemblies import Assemblies, assemblies
from jointplay.solver.runs.ideal.dead_point import positions
from jointplay.solver.runs.ideal.turn import in_words, turn
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.overshoots import Overshoot, overshoots

ALIKE = 1e-6
"""Sine of half the difference of two angles, and share of the largest distance from the origin of
that of two positions, up to which they are one."""

PLACED = ("angles", "points")
"""Fields of a start that tell an assembly."""


def assemblies_of(scene: AssembledScene) -> Assemblies:
    """Return the ways to put the scene together; seconds for a large one."""
    return assemblies(Scene.model_validate(scene.document))


def start_of(scene: AssembledScene, found: Assemblies, k: int) -> dict[str, Any]:
    """Return the `start` with which one of the assemblies is taken, to nine digits.

    It has the angles of all bodies, in the turns that are given or taken, and a point of each that
    only slides to another position.
    """
    document = scene.document
    turns = {body: pose[2] for body, pose in scene.pose().items()}
    turns |= document["start"].get("angles", {})
    angles = {
        body: turns[body] + math.remainder(angle - turns[body], 2.0 * math.pi)
        for body, angle in found.angles[k].items()
    }
    first, other = found.positions[0], found.positions[k]
    largest = max((math.hypot(*at) for at in [*first.values(), *other.values()]), default=0.0)
    points = {}
    for body, (x, y) in other.items():
        turned = abs(math.sin(0.5 * (angles[body] - found.angles[0][body]))) > ALIKE
        own = document["bodies"][body]["points"]
        if not turned and own and math.dist((x, y), first[body]) > ALIKE * largest:
            name, (u, v) = next(iter(own.items()))
            c, s = math.cos(angles[body]), math.sin(angles[body])
            points[f"{body}.{name}"] = [_rounded(x + c * u - s * v), _rounded(y + s * u + c * v)]
    start = {name: given for name, given in document["start"].items() if name not in PLACED}
    start = {"angles": {body: _rounded(angle) for body, angle in angles.items()}} | start
    return {name: given for name, given in (start | {"points": points}).items() if given}


def _rounded(value: float) -> float:
    return float(f"{round(value, 12):z.9g}")


def overshoots_of(scene: AssembledScene) -> list[Overshoot]:
    """Return the smooth tables that leave the values they are given."""
    return overshoots(Scene.model_validate(scene.document))


def findings_of(scene: AssembledScene, found: Assemblies) -> dict[str, Any]:
    """Return what a check tells, as JSON has it; `problems` say why it cannot be run."""
    assembly, admission = scene.assembly, scene.admission
    return {
        "scene": scene.document["name"],
        "bodies": list(scene.document["bodies"]),
        "joints_with_clearance": list(clearances(scene.document)),
        "freedom": assembly.freedom_with_play,
        "ideal_freedom": assembly.freedom,
        "redundant": assembly.redundant_with_play,
        "ideal_redundant": assembly.redundant,
        "residual": assembly.residual,
        "pose": {body: list(pose) for body, pose in scene.pose().items()},
        "given": [
            {**taken._asdict(), "kept": taken.off <= assembly.reported} for taken in assembly.given
        ],
        "assemblies": found.angles,
        "positions": found.positions,
        "held": found.held,
        "starts": [start_of(scene, found, k) for k in range(len(found.angles))],
        "period": None if admission is None else admission.period,
        "channels": None if admission is None else len(admission.channels),
        "turn": turn_of(Scene.model_validate(scene.document)),
        "overshoots": [one._asdict() for one in overshoots_of(scene)],
        "replaced": [one._asdict() for one in scene.replaced],
        "hints": [one._asdict() for one in scene.hints],
        "problems": scene.problems,
    }


def turn_of(scene: Scene) -> dict[str, Any] | None:
    """Return whether the ideal mechanism turns through; None if nothing turns it."""
    found = turn(scene)
    if found is None:
        return None
    margin = None
    if found.margin is not None:
        margin = found.margin._asdict() | {"drivers": positions(scene, found.margin.time)}
    return {
        "span": found.span,
        "reached": found.reached,
        "jams": found.lost is not None,
        "drivers": positions(scene, found.reached),
        "margin": margin,
        "detail": in_words(scene, found),
    }
