"""Fields of a job that have no effect beside its other fields: refused where they are given."""

from collections.abc import Iterable

from jointplay.records.failure import InvalidInput, Problem
from jointplay.solver.kinds.job import MechanismJob, PresetScene
from jointplay.solver.scene import presets
from jointplay.solver.scene.parameters import POINTER


def check_idle(job: MechanismJob, without: str, *fields: str) -> None:
    """Refuse (InvalidInput) fields that have no effect without another one, which is not given.

    A field with its default counts as not given: filled-in documents have all fields.
    """
    defaults = type(job).model_fields
    given = [name for name in fields if getattr(job, name) != defaults[name].default]
    if given:
        raise InvalidInput(
            Problem(
                f"/{name}", f"'{name}' has no effect without {without}; give that, or leave it out."
            )
            for name in given
        )


def check_varied(job: MechanismJob, varied: Iterable[str]) -> None:
    """Refuse (InvalidInput) values of a preset's parameters that a study varies.

    One that is the default counts as not given: filled-in documents have all of them.
    """
    if not isinstance(job.scene, PresetScene):
        return
    given, declared = job.scene.parameters, presets.document(job.scene.preset)["parameters"]
    idle = [
        name
        for name in varied
        if given.get(name) is not None and given[name] != declared[name].get("default")
    ]
    if idle:
        raise InvalidInput(
            Problem(f"{POINTER}/{name}", f"The study varies '{name}'; leave this value out.")
            for name in idle
        )
