"""A scene checked and put together, for the commands that look at it before it is run."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import typer

from jointplay.command_line import job_document

if TYPE_CHECKING:
    from solver.admission import Admission
    from solver.assembly import Assembly

SCENE: Any = typer.Argument(
    metavar="SCENE.json|PRESET", help="A scene document, or the name of a preset."
)


@dataclass(frozen=True)
class AssembledScene:
    """A scene that can be simulated, with its parameters set."""

    document: dict[str, Any]
    admission: "Admission"
    assembly: "Assembly"

    def pose(self) -> dict[str, tuple[float, float, float]]:
        """Return x, y [m] and theta [rad] of every body at t = 0."""
        rows = self.assembly.pose.reshape(-1, 3).tolist()
        return {
            body: (x, y, theta)
            for body, (x, y, theta) in zip(self.document["bodies"], rows, strict=True)
        }


def assemble_scene(source: str, settings: Sequence[str]) -> AssembledScene:
    """Return the scene, or raise `InvalidInput` with everything that is wrong with it."""
    from solver.admission import admit
    from solver.assembly import assemble
    from solver.scene.document import Scene

    job = job_document.job_document(source, settings=settings, options={"duration": 1e-3})
    admission = admit(job)
    assembly = assemble(Scene.model_validate(admission.scene))
    return AssembledScene(admission.scene, admission, assembly)
