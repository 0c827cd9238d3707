"""The page that explains scenes: its example grows through stages that are all admitted."""

import json
import re
from pathlib import Path
from typing import Any, get_args

import jsonschema
import pytest

from jointplay.solver.joints import JOINTS, Gear, starts
from jointplay.solver.kinds import admit
from jointplay.solver.scene import document, drivers, presets
from jointplay.solver.scene.schema import scene_schema
from tests.solver.completed_runs import run

PAGE = (Path(__file__).resolve().parents[3] / "docs" / "scene.md").read_text()
BLOCKS = re.findall(r"^```json\n(.*?)^```", PAGE, re.DOTALL | re.MULTILINE)
OWN = {
    name
    for module in (document, starts, drivers)
    for name, value in vars(module).items()
    if isinstance(value, type)
} | {
    part.__name__
    for joint in (*JOINTS.values(), Gear)
    for part in (joint, *get_args(getattr(joint.model_fields.get("clearance"), "annotation", None)))
}
"""Parts of a scene whose fields the page explains; those of laws and elements are in the schema."""


def merged(before: Any, patch: Any) -> Any:
    """Merge as RFC 7386 does."""
    if not isinstance(patch, dict):
        return patch
    found = dict(before) if isinstance(before, dict) else {}
    for name, value in patch.items():
        found[name] = merged(found.get(name), value)
    return found


def stages() -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = [{}]
    for block in BLOCKS:
        found.append(merged(found[-1], json.loads(block)))
    return found[1:]


def test_every_stage_is_a_scene_and_the_last_one_runs() -> None:
    freedom = []
    for scene in stages():
        jsonschema.validate(scene, scene_schema())
        admission = admit({"kind": "simulate", "scene": scene, "duration": 0.1})
        freedom.append((admission.period is not None, admission.joints))
    nothing: tuple[str, ...] = ()
    assert freedom == [(False, nothing)] * 2 + [(True, nothing)] + [(True, ("small",))] * 3
    ended = run(stages()[-1], 0.02)
    assert ended.statistics["onsets"] > 0
    stroke, place = ended.peaks["stroke"], ended.peaks["slider.x"]
    assert stroke.maximum == pytest.approx(place.maximum - 0.3, abs=1e-9)


def test_it_names_every_field_of_a_scene() -> None:
    own = {
        field
        for name, definition in scene_schema()["$defs"].items()
        if name in OWN
        for field in definition["properties"]
    } | scene_schema()["properties"].keys()
    assert len(own) > 50
    assert [field for field in sorted(own) if f"{field}`" not in PAGE] == []


def test_the_schema_accepts_every_preset_and_refuses_what_is_none() -> None:
    jsonschema.Draft202012Validator.check_schema(scene_schema())
    validator = jsonschema.Draft202012Validator(scene_schema())
    for name in presets.names():
        validator.validate(presets.document(name))
    scene = presets.document("pendulum")
    scene["bodies"]["rod"]["mass"] = 0.0
    assert [list(error.path) for error in validator.iter_errors(scene)] == [
        ["bodies", "rod", "mass"]
    ]
