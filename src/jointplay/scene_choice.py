"""A scene as it is named: a preset, a document or the path of one; and its parameters set."""

import os
from collections.abc import Iterable, Mapping
from os import PathLike
from pathlib import Path
from typing import Any

from jointplay.records.strict_json import parse
from jointplay.records.suggestions import did_you_mean

Scene = str | PathLike[str] | Mapping[str, Any]


class NotAScene(ValueError):
    """Raised for what is no scene, or has no such parameter; a sentence says what is wrong."""


def scene_document(scene: Scene) -> Mapping[str, Any]:
    """Return a scene as a job has it: a preset by name, or the document that was given or named.

    A text that ends in ``.json`` or has a slash in it is a path.

    Raises
    ------
    NotAScene
        There is no such file, or it holds something else.
    """
    if isinstance(scene, str) and not (scene.endswith(".json") or "/" in scene or os.sep in scene):
        return {"preset": scene}
    if isinstance(scene, Mapping):
        return scene
    try:
        document = parse(Path(scene).read_bytes())
    except OSError as error:
        raise NotAScene(f"{scene}: {error.strerror}.") from error
    if not isinstance(document, dict):
        raise NotAScene(f"{scene}: a scene is a JSON object.")
    return document


def with_parameters(
    scene: Mapping[str, Any], values: Mapping[str, Any], fields: Iterable[str] = ()
) -> dict[str, Any]:
    """Return a scene, or a preset by name, with some parameters set; nothing else is checked.

    A scene given whole has no list of values beside it: there the declared defaults are the
    values. One of `fields`, which are given beside parameters, may be meant by an unknown name.

    Raises
    ------
    NotAScene
        It declares no such parameter.
    """
    declared = scene.get("parameters", {})
    if not values or not isinstance(declared, Mapping):
        return dict(scene)  # admission says what is wrong with it, here and below
    if "bodies" not in scene:
        return {**scene, "parameters": {**declared, **values}}
    if unknown := [name for name in values if name not in declared]:
        known = ", ".join(declared) or "none"
        near = did_you_mean(unknown[0], [*declared, *fields])
        meant = near or f"it has {known}."
        raise NotAScene(f"{unknown[0]}: the scene declares no such parameter; {meant}")
    changed = {
        name: {**one, "default": values[name]} if name in values and isinstance(one, dict) else one
        for name, one in declared.items()
    }
    return {**scene, "parameters": changed}
