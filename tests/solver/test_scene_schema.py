"""The scene's schema: every float says its unit."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from solver.jobs import SimulateJob
from solver.scene.document import Scene

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
        if node.get("type") == "number" and "unit" not in node:
            yield place
        for value in node.values():
            yield from bare_numbers(value, place)
    elif isinstance(node, list):
        for value in node:
            yield from bare_numbers(value, place)


def fields_without_unit(schema: dict[str, Any]) -> set[str]:
    definitions = {**schema.get("$defs", {}), schema["title"]: schema}
    return {
        f"{owner}.{field}"
        for owner, definition in definitions.items()
        for field, node in definition.get("properties", {}).items()
        if "unit" not in node
        for _ in bare_numbers(node, field)
    }


def test_every_float_of_a_scene_has_a_unit() -> None:
    assert fields_without_unit(Scene.model_json_schema()) <= UNIT_ELSEWHERE.keys()


def test_every_float_of_a_job_has_a_unit() -> None:
    assert fields_without_unit(SimulateJob.model_json_schema()) <= UNIT_ELSEWHERE.keys()


def test_the_check_for_units_finds_a_float_without_one() -> None:
    schema = Scene.model_json_schema()
    del schema["$defs"]["Body"]["properties"]["mass"]["unit"]
    assert "Body.mass" in fields_without_unit(schema)
