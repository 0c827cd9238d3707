"""Words of the OpenAPI document: fields that have a unit, and files."""

from typing import Any, Final

from pydantic import Field

BINARY: Final = {"schema": {"type": "string", "format": "binary"}}
"""Content of an answer that is a file."""


def in_unit(unit: str, description: str | None = None, **more: Any) -> Any:  # as Field returns
    """Declare a field with its SI unit; ``1`` for a pure number."""
    return Field(description=description, json_schema_extra={"unit": unit}, **more)
