"""From a client's document to a parsed job, and from that to the filled-in document."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from typing import Any

from pydantic import ValidationError

from jointplay.records.failure import InvalidInput, Problem
from jointplay.records.suggestions import did_you_mean
from jointplay.solver.admission.mechanism import Echo
from jointplay.solver.admission.methods import chosen
from jointplay.solver.jobs import KINDS, Job, MechanismJob, PresetScene
from jointplay.solver.scene import presets
from jointplay.solver.scene.sentences import schema_problems


def parse(document: object) -> MechanismJob:
    """Return the job of the kind that a document names.

    Raises
    ------
    InvalidInput
        With every field that is missing, unknown or out of its bounds.
    """
    if not isinstance(document, Mapping):
        raise InvalidInput([Problem("", "A job is a JSON object with a kind and a scene.")])
    kinds = ", ".join(f"'{kind}'" for kind in KINDS)
    if "kind" not in document:
        raise InvalidInput([Problem("/kind", f"The field 'kind' is required: one of {kinds}.")])
    kind = document["kind"]
    model = KINDS.get(kind) if isinstance(kind, str) else None
    if model is None:
        meant = did_you_mean(kind, KINDS) if isinstance(kind, str) else ""
        sentence = f"'kind' must be one of {kinds}" + (f"; {meant}" if meant else ".")
        raise InvalidInput([Problem("/kind", sentence)])
    try:
        return model.model_validate(dict(document))
    except ValidationError as error:
        raise InvalidInput(schema_problems(error, model)) from None


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
    """Return the SHA-256 of a filled-in job without its label, and of the preset it names."""
    spec = {key: value for key, value in document.items() if key != "label"}
    if "preset" in document["scene"]:
        spec["preset"] = presets.digest(document["scene"]["preset"])
    canonical = json.dumps(spec, sort_keys=True, separators=(",", ":"), allow_nan=False)
    return hashlib.sha256(canonical.encode()).hexdigest()
