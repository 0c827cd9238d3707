"""From a client's document to a parsed job, and from that to the filled-in document."""

import hashlib
import json
from collections.abc import Mapping
from typing import Any

from pydantic import ValidationError

from jointplay.records.failure import InvalidInput, Problem
from jointplay.records.suggestions import did_you_mean
from jointplay.solver.kinds.job import Job, MechanismJob, PresetScene
from jointplay.solver.kinds.kind import J, Kind
from jointplay.solver.kinds.meant_fields import with_meant_fields
from jointplay.solver.kinds.mechanism import Echo
from jointplay.solver.kinds.methods import chosen
from jointplay.solver.scene import presets
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.parameters import wrong_values
from jointplay.solver.scene.sentences import schema_problems

LATER = {"energies": True}
"""Defaults of fields that jobs had not from the start: digests are without them."""


def kind_of(document: object, kinds: Mapping[str, Kind[Any]]) -> Kind[Any]:
    """Return the kind that a document names; InvalidInput where it names none."""
    if not isinstance(document, Mapping):
        raise InvalidInput.at("", "A job is a JSON object with a kind and a scene.")
    names = ", ".join(f"'{name}'" for name in kinds)
    if "kind" not in document:
        raise InvalidInput.at("/kind", f"The field 'kind' is required: one of {names}.")
    name = document["kind"]
    if isinstance(name, str) and name in kinds:
        return kinds[name]
    meant = did_you_mean(name, kinds) if isinstance(name, str) else ""
    sentence = f"'kind' must be one of {names}" + (f"; {meant}" if meant else ".")
    raise InvalidInput.at("/kind", sentence)


def job_of(document: Any, kind: Kind[J]) -> J:
    """Return the parsed job; InvalidInput with every field that is missing, unknown or wrong."""
    model: Any = kind.document
    try:
        job: J = model.model_validate(dict(document))
    except ValidationError as error:
        problems = schema_problems(error, model, document)
        told = {one.pointer for one in problems}
        others = [one for one in _wrong_preset(document) if one.pointer not in told]
        raise InvalidInput(with_meant_fields([*problems, *others], document, model)) from None
    return job


def _wrong_preset(document: Mapping[str, Any]) -> list[Problem]:
    """Return what is wrong with a preset and its parameters, told with a job's other errors."""
    scene = document.get("scene")
    if not (isinstance(scene, Mapping) and isinstance(scene.get("preset"), str)):
        return []
    try:
        preset = Scene.model_validate(presets.document(scene["preset"]))
    except InvalidInput as error:
        return list(error.problems)
    values = scene.get("parameters")
    return wrong_values(preset, values) if isinstance(values, Mapping) else []


def filled(
    job: MechanismJob, scene_document: Mapping[str, Any], echo: Echo, **found: Any
) -> dict[str, Any]:
    """Return the job's document with defaults filled in; `found` overrides its fields.

    `scene_document` stands for a scene that was given whole, `echo` for a preset's parameters.
    """
    document = job.model_dump(mode="json", by_alias=True, exclude={"scene", "accuracy"})
    if isinstance(job.scene, PresetScene):
        document["scene"] = {"preset": job.scene.preset, "parameters": echo}
    else:
        document["scene"] = scene_document
    if isinstance(job, Job):
        document["method"], document["tolerance"] = chosen(job)
    return document | found


def digest(document: Mapping[str, Any]) -> str:
    """Return the SHA-256 of a filled-in job without its label, and of the preset it names.

    The order of its keys counts: bodies, drivers and axes are numbered by it.
    """
    spec = {
        key: value
        for key, value in document.items()
        if key != "label" and not (key in LATER and value == LATER[key])
    }
    if "preset" in document["scene"]:
        spec["preset"] = presets.digest(document["scene"]["preset"])
    canonical = json.dumps(spec, separators=(",", ":"), allow_nan=False)
    return hashlib.sha256(canonical.encode()).hexdigest()
