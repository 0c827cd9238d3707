"""Points whose starts vary: one that cannot start as it says has no result."""

from collections.abc import Iterable

import numpy as np

from jointplay.records.point import PointEnd
from jointplay.solver.mechanics.assembly import ASSEMBLED, assemble, shortest_link
from jointplay.solver.mechanics.start.given import Taken
from jointplay.solver.runs.study.plan import Study
from jointplay.solver.scene.document import Scene


def end_of_start(study: Study, point: int) -> PointEnd | None:
    """Return the end of a point that cannot start as it says; None: it can."""
    if not study.scenes.starts_vary:
        return None
    sentence = obstacle(study.point_scene(point), (leaf.path for leaf in study.scenes.leaves))
    if not sentence:
        return None
    peaks = np.full((len(study.channels), 4), np.nan)
    return PointEnd(point, "start-not-held", sentence, 0.0, peaks, {"steps": 0.0}, {})


def concerns(given: Taken, pointer: str) -> bool:
    """Return whether what a scene gives of its start is, or has, the number at a pointer."""
    return f"{pointer}/".startswith(f"{given.pointer}/")


def obstacle(scene: Scene, varied: Iterable[str]) -> str:
    """Return why a scene does not start as numbers of it say, as a sentence; empty: it does.

    varied : JSON pointers to these numbers.
    """
    pointers, assembly = [*varied], assemble(scene)
    if assembly.residual / shortest_link(scene) > ASSEMBLED:
        return "The mechanism does not close at this start."
    for one in assembly.misfits:
        if any(concerns(one, pointer) for pointer in pointers):
            return one.sentence
    return ""
