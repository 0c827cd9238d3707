"""A scene put together, for those who look at it before it is run."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, cast

from pydantic import ValidationError

from jointplay.records.failure import InvalidInput, Problem
from jointplay.records.remarks import without_remarks
from jointplay.solver.joints.curves import joint_curves
from jointplay.solver.kinds import admit
from jointplay.solver.kinds.hints import hints
from jointplay.solver.kinds.mechanism import resolve
from jointplay.solver.kinds.simulate import SimulateJob
from jointplay.solver.mechanics.assembly import Assembly, assemble
from jointplay.solver.runs.admission import Admission
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.domains import domain_problems
from jointplay.solver.scene.replaced import Replaced, replaced


@dataclass(frozen=True)
class AssembledScene:
    """A scene with its parameters set, as far as it can be put together.

    Either `admission` says how it would be run, or `refusal` why it cannot be.
    """

    document: dict[str, Any]
    assembly: Assembly
    admission: Admission | None
    refusal: InvalidInput | None
    written: Mapping[str, Any]
    """The document that was given, or the preset by name."""

    @property
    def problems(self) -> list[Problem]:
        """Reasons that keep it from being run."""
        return [] if self.refusal is None else list(self.refusal.problems)

    @property
    def replaced(self) -> list[Replaced]:
        """Numbers of the document that defaults of its parameters replace."""
        return replaced(self.written)

    @property
    def hints(self) -> list[Problem]:
        """Parts of the document that may be meant otherwise."""
        return hints(self.written, Scene.model_validate(self.document), self.pose())

    def drawn(self) -> dict[str, Any]:
        """Return the document with the `curves` that its joints are drawn by."""
        joints = Scene.model_validate(self.document).joints
        return self.document | {"curves": joint_curves(joints)}

    def pose(self) -> dict[str, tuple[float, float, float]]:
        """Return x, y [m] and theta [rad] of every body at t = 0."""
        rows = self.assembly.pose.reshape(-1, 3).tolist()
        return {
            body: (x, y, theta)
            for body, (x, y, theta) in zip(self.document["bodies"], rows, strict=True)
        }


def assembled_scene(scene: Mapping[str, Any] | None, *, is_whole: bool) -> AssembledScene:
    """Return a scene; one that cannot be run is returned too, if its parts fit together.

    Parameters
    ----------
    scene
        As a job has it: a preset with parameters, or a document.
    is_whole
        Whether pointers of problems shall lead into the scene, and not into a job that has it.

    Raises
    ------
    InvalidInput
        With everything that keeps the scene from being read.
    """
    job = _job(scene)
    try:
        found = cast("Admission", admit(job))
    except InvalidInput as error:
        refusal = error
    else:
        document, assembly = found.scene_document(), assemble(found.scene)
        return AssembledScene(document, assembly, found, None, job["scene"])
    if is_whole:
        refusal = InvalidInput(
            Problem(pointer.removeprefix("/scene"), detail) for pointer, detail in refusal.problems
        )
    try:
        resolved, document = _resolved(job)
    except (ValidationError, InvalidInput):
        raise refusal from None
    return AssembledScene(document, assemble(resolved), None, refusal, job["scene"])


def resolved_scene(scene: Mapping[str, Any]) -> Scene:
    """Return a scene with its parameters set that has a pose at t = 0.

    Raises
    ------
    InvalidInput
        With everything that keeps it from that; pointers lead into a document whose field `scene`
        it is.
    """
    job = _job(scene)
    try:
        return _resolved(job)[0]
    except (ValidationError, InvalidInput):
        admit(job)  # says all that is wrong
        raise


def _resolved(job: dict[str, Any]) -> tuple[Scene, dict[str, Any]]:
    """Return a job's scene, whose drivers say where they begin, and its document."""
    scene, document, _ = resolve(SimulateJob.model_validate(job))
    problems = list(domain_problems(scene, 0.0))
    if problems:
        raise InvalidInput(problems)
    return scene, document


def _job(scene: Mapping[str, Any] | None) -> dict[str, Any]:
    """Return a job with a scene: whatever the job is, its scene is looked at."""
    job: dict[str, Any] = {"kind": "simulate", "duration": 1e-3}
    return job if scene is None else job | {"scene": without_remarks(scene)}
