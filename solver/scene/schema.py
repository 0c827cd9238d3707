"""The JSON Schema of a scene, for editors and for programs that write scenes."""

import re
from typing import Any

from jointplay.records.remarks import REMARKS
from jointplay.solver.scene.document import Scene

DIALECT = "https://json-schema.org/draft/2020-12/schema"


def scene_schema() -> dict[str, Any]:
    """Return it, with the laws, elements and functions there are by now; numbers have a `unit`.

    What needs more than one field, as names that must exist, it cannot say: admission does.
    """
    found: dict[str, Any] = _with_remarks(Scene.model_json_schema())
    return {"$schema": DIALECT} | found


def _with_remarks(schema: Any) -> Any:
    """Let every object that takes no other fields have remarks."""
    if isinstance(schema, list):
        return [_with_remarks(one) for one in schema]
    if not isinstance(schema, dict):
        return schema
    found = {name: _with_remarks(one) for name, one in schema.items()}
    if found.get("additionalProperties") is False:
        found["patternProperties"] = {f"^({'|'.join(map(re.escape, REMARKS))})$": {}}
    return found
