"""The unit in which a number of a scene counts, by a JSON pointer to it."""

from collections.abc import Iterator, Mapping
from functools import cache
from typing import Any

from jointplay.solver.scene.document import Scene


def unit_at(document: Mapping[str, Any], path: str) -> str | None:
    """Return the unit of the value that a JSON pointer leads to; None where the schema has none.

    document : a scene's, whose laws and types say which numbers there are.
    """
    schema, value = _schema(), document
    nodes = [schema]
    for key in path.strip("/").split("/"):
        nodes = [
            inner
            for node in nodes
            for one in _meant(schema, node, value)
            for inner in _inside(one, key)
        ]
        value = _value(value, key)
    units = {one["unit"] for node in nodes for one in _meant(schema, node, value) if "unit" in one}
    return str(units.pop()) if len(units) == 1 else None


@cache
def _schema() -> dict[str, Any]:
    return Scene.model_json_schema()


def _meant(schema: Mapping[str, Any], node: Mapping[str, Any], value: Any) -> Iterator[Any]:
    """Yield a part of the schema and, of its alternatives, those that the value may be."""
    if "$ref" in node:
        node = schema["$defs"][node["$ref"].rpartition("/")[2]]
    yield node
    alternatives = [*node.get("anyOf", ()), *node.get("oneOf", ())]
    told = node.get("discriminator")
    if told and isinstance(value, Mapping):
        chosen = told["mapping"].get(value.get(told["propertyName"]))
        alternatives = [{"$ref": chosen}] if chosen else []
    for one in alternatives:
        yield from _meant(schema, one, value)


def _inside(node: Mapping[str, Any], key: str) -> Iterator[Any]:
    """Yield what a part of the schema says of what stands in it under a key."""
    if key in node.get("properties", {}):
        yield node["properties"][key]
    else:
        yield from node.get("patternProperties", {}).values()
        if key.isdigit() and isinstance(node.get("items"), Mapping):
            yield node["items"]


def _value(node: Any, key: str) -> Any:
    if isinstance(node, list | tuple):
        return node[int(key)] if key.isdigit() and int(key) < len(node) else None
    return node.get(key) if isinstance(node, Mapping) else None
