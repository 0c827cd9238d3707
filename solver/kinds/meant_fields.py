"""Fields of a job that were given as parameters of its scene, as clients do with a wrong name."""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from pydantic import BaseModel

from jointplay.records.failure import InvalidInput, Problem
from jointplay.records.suggestions import did_you_mean
from jointplay.solver.scene import presets
from jointplay.solver.scene.parameters import POINTER

OF_A_SCENE = ("kind", "scene", "parameters")
"""Fields of jobs of which none is meant by a parameter."""


def with_meant_fields(
    problems: Iterable[Problem], document: Any, model: type[BaseModel]
) -> list[Problem]:
    """Return a job's problems, those of unknown parameters with the field that may be meant.

    Parameters
    ----------
    problems
        What is wrong with the job.
    document
        The job as it was given.
    model
        That of jobs of its kind: its fields are looked at where no parameter has such a name.
    """
    meant = {f"{POINTER}/{name}": text for name, text in _meant(document, model)}
    return [Problem(one.pointer, meant.get(one.pointer, one.detail)) for one in problems]


def _meant(document: Any, model: type[BaseModel]) -> Iterator[tuple[str, str]]:
    """Yield the parameters that a preset has not but a field is called like, with a sentence."""
    scene = document.get("scene")
    preset = scene.get("preset") if isinstance(scene, Mapping) else None
    given = scene.get("parameters") if isinstance(scene, Mapping) else None
    if not (isinstance(preset, str) and isinstance(given, Mapping)):
        return
    try:
        declared = presets.document(preset).get("parameters", {})
    except InvalidInput:  # no such preset, which is told
        return
    fields = {field.alias or name for name, field in model.model_fields.items()}
    known = sorted(fields.difference(OF_A_SCENE))
    for name in given:
        if name not in declared and not did_you_mean(name, declared):
            near = did_you_mean(name, known)
            if near:
                yield name, f"There is no parameter '{name}'; of the fields of the job, {near}"
