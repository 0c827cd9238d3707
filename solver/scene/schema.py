"""The JSON Schema of a scene, for editors and for programs that write scenes."""

from typing import Any

from jointplay.solver.scene.document import Scene

DIALECT = "https://json-schema.org/draft/2020-12/schema"


def scene_schema() -> dict[str, Any]:
    """Return it, with the laws, elements and functions there are by now; numbers have a `unit`.

    What needs more than one field, as names that must exist, it cannot say: admission does.
    """
    return {"$schema": DIALECT} | Scene.model_json_schema()
