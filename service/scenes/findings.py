"""Findings of a check of a scene: whether it can be put together and move."""

from typing import Any

from jointplay.figures.scene_facts import clearances
from jointplay.solver.kinds.assembled import AssembledScene
from jointplay.solver.mechanics.branches import Branches, branches
from jointplay.solver.scene.document import Scene


def branches_of(scene: AssembledScene) -> Branches:
    """Return the ways to put the scene together; seconds for a large one."""
    return branches(Scene.model_validate(scene.document))


def findings_of(scene: AssembledScene, found: Branches) -> dict[str, Any]:
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
        "assemblies": found.angles,
        "places": found.places,
        "held": found.held,
        "period": None if admission is None else admission.period,
        "channels": None if admission is None else len(admission.channels),
        "problems": scene.problems,
    }
