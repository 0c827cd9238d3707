"""Remarks in documents: read by people and editors, and by nobody else."""

import codecs
import copy
import json

import jsonschema
import pytest

from jointplay import jobs
from jointplay.records.failure import InvalidInput
from jointplay.records.remarks import without_remarks
from jointplay.records.strict_json import parse
from jointplay.scene_choice import NotAScene
from jointplay.solver.kinds import admit
from jointplay.solver.scene import presets
from jointplay.solver.scene.schema import scene_schema


def remarked(document):
    """Return a document with a remark in every object."""
    if isinstance(document, dict):
        inner = {name: remarked(value) for name, value in document.items()}
        return {"$schema": "scene.schema.json", "_comment": ["why", {"a": 1}]} | inner
    return [remarked(one) for one in document] if isinstance(document, list) else document


@pytest.mark.parametrize("name", ["pendulum", "slider-crank"])
def test_a_job_with_remarks_is_the_job_without_them(name):
    job = {"kind": "simulate", "scene": presets.document(name), "duration": 0.1}
    before = copy.deepcopy(job)
    assert admit(remarked(job)).digest == admit(job).digest
    assert without_remarks(remarked(job)) == job == before


def test_editors_take_remarks_and_refuse_other_fields():
    schema = scene_schema()
    scene = presets.document("pendulum")
    jsonschema.validate(scene | {"$schema": "scene.schema.json", "_comment": "mine"}, schema)
    with pytest.raises(jsonschema.ValidationError, match="colour"):
        jsonschema.validate(scene | {"colour": "red"}, schema)
    with pytest.raises(InvalidInput, match="colour"):
        admit({"kind": "simulate", "scene": scene | {"colour": "red"}, "duration": 0.1})


def test_a_byte_order_mark_is_passed_over():
    assert parse(codecs.BOM_UTF8 + b'{"a": 1}') == {"a": 1}


def test_the_path_of_a_scene_is_told_from_a_preset(tmp_path):
    path = tmp_path / "mine.json"
    path.write_text(json.dumps(presets.document("pendulum")))
    by_text = jobs.simulate(str(path), duration=1.0)
    assert by_text == jobs.simulate(path, duration=1.0)
    assert by_text["scene"]["name"] == "pendulum"
    with pytest.raises(NotAScene, match=r"nothing\.json: No such file"):
        jobs.simulate("nothing.json", duration=1.0)
    assert jobs.simulate("nothing", duration=1.0)["scene"] == {"preset": "nothing"}
