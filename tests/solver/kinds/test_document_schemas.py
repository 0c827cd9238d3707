"""The schemas of documents: every number says its unit, every field its default."""

from collections.abc import Iterator
from typing import Any

import pytest
from pydantic import TypeAdapter

from jointplay.solver.kinds import KINDS, any_job
from jointplay.solver.scene.document import Scene

UNIT_ELSEWHERE = {
    "Target.factor": "its parameter's unit over the field's",
    "Parameter.default": "its own field `unit`",
    "Parameter.minimum": "its own field `unit`",
    "Parameter.maximum": "its own field `unit`",
    "Output.factor": "a pure number",
    "Output.offset": "its channel's unit",
    "Reported.value": "its own field `unit`",
    "Reported.parameters": "the declared parameter's unit",
    "PresetScene.parameters": "the declared parameter's unit",
}


def bare_numbers(node: Any, place: str) -> Iterator[str]:
    """Yield the places of numbers without a unit."""
    if isinstance(node, dict):
        if node.get("type") in ("number", "integer") and "unit" not in node:
            yield place
        for value in node.values():
            yield from bare_numbers(value, place)
    elif isinstance(node, list):
        for value in node:
            yield from bare_numbers(value, place)


def definitions(schema: dict[str, Any]) -> dict[str, dict[str, Any]]:
    """Return the objects that a schema describes, by name."""
    return {**schema.get("$defs", {}), schema["title"]: schema}


def fields_without_unit(schema: dict[str, Any]) -> set[str]:
    return {
        f"{owner}.{field}"
        for owner, definition in definitions(schema).items()
        for field, node in definition.get("properties", {}).items()
        if "unit" not in node
        for _ in bare_numbers(node, field)
    }


def test_every_number_of_a_scene_has_a_unit() -> None:
    assert fields_without_unit(Scene.model_json_schema()) <= UNIT_ELSEWHERE.keys()


@pytest.mark.parametrize("kind", KINDS)
def test_every_number_of_a_job_has_a_unit(kind: str) -> None:
    assert fields_without_unit(KINDS[kind].document.model_json_schema()) <= UNIT_ELSEWHERE.keys()


@pytest.mark.parametrize("kind", KINDS)
def test_every_field_of_a_job_is_required_or_shows_its_default(kind: str) -> None:
    silent = {
        f"{owner}.{field}"
        for owner, definition in definitions(KINDS[kind].document.model_json_schema()).items()
        for field, node in definition.get("properties", {}).items()
        if field not in definition.get("required", ()) and "default" not in node
    }
    assert silent == set()


def test_the_check_for_units_finds_a_number_without_one() -> None:
    schema = Scene.model_json_schema()
    del schema["$defs"]["Body"]["properties"]["mass"]["unit"]
    assert "Body.mass" in fields_without_unit(schema)


def test_a_job_of_any_kind_is_told_by_its_kind() -> None:
    schema = TypeAdapter(any_job()).json_schema()
    assert schema["discriminator"]["mapping"].keys() == KINDS.keys()
    scene = {"preset": "pendulum"}
    parsed = TypeAdapter(any_job()).validate_python({"kind": "poincare", "scene": scene})
    assert type(parsed) is KINDS["poincare"].document
