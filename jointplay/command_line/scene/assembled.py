"""A scene put together, for the commands that look at it before it is run."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, cast

from jointplay.command_line.job_document import is_scene_file, job_document

if TYPE_CHECKING:
    from jointplay.records.failure import InvalidInput, Problem
    from jointplay.solver.kinds import Admission
    from jointplay.solver.mechanics.assembly import Assembly


@dataclass(frozen=True)
class AssembledScene:
    """A scene with its parameters set, as far as it can be put together.

    Either `admission` says how it would be run, or `refusal` why it cannot be.
    """

    document: dict[str, Any]
    assembly: "Assembly"
    admission: "Admission | None"
    refusal: "InvalidInput | None"

    @property
    def problems(self) -> "list[Problem]":
        """Reasons that keep it from being run."""
        return [] if self.refusal is None else list(self.refusal.problems)

    def pose(self) -> dict[str, tuple[float, float, float]]:
        """Return x, y [m] and theta [rad] of every body at t = 0."""
        rows = self.assembly.pose.reshape(-1, 3).tolist()
        return {
            body: (x, y, theta)
            for body, (x, y, theta) in zip(self.document["bodies"], rows, strict=True)
        }


def assemble_scene(source: str, settings: Sequence[str]) -> AssembledScene:
    """Return the scene; one that cannot be run is returned too, if its parts fit together.

    Raises
    ------
    InvalidInput
        With everything that keeps the scene from being read. Pointers lead into the document
        that was given: into the scene's own if ``source`` is the file of a scene.
    """
    from pydantic import ValidationError

    from jointplay.records.failure import InvalidInput, Problem
    from jointplay.solver.kinds import admit
    from jointplay.solver.kinds.mechanism import resolve
    from jointplay.solver.kinds.simulate import SimulateJob
    from jointplay.solver.mechanics.assembly import assemble

    given = job_document(source, settings=settings, options={})
    job = {"kind": "simulate", "duration": 1e-3}  # whatever the job is, its scene is looked at
    job |= {"scene": given["scene"]} if "scene" in given else {}
    try:
        found = cast("Admission", admit(job))
    except InvalidInput as error:
        refusal = error
    else:
        return AssembledScene(found.scene_document(), assemble(found.scene), found, None)
    if is_scene_file(source):
        refusal = InvalidInput(
            Problem(pointer.removeprefix("/scene"), detail) for pointer, detail in refusal.problems
        )
    try:
        scene, document, _ = resolve(SimulateJob.model_validate(job))
    except (ValidationError, InvalidInput):
        raise refusal from None
    return AssembledScene(document, assemble(scene), None, refusal)
