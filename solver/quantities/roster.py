"""Fields of documents that name a member of a roster, as the roster is when they are read.

A roster is a mutable mapping: who adds a member to it, from whatever file, has it admitted by name
and listed in JSON Schemas, without a change anywhere else.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, PydanticKnownError, core_schema


class NameIn:
    """Annotation of a string that must be a name in a roster, or one of some further words."""

    def __init__(self, roster: Mapping[str, Any], *further: str) -> None:
        self.roster, self.further = roster, further

    @property
    def names(self) -> list[str]:
        """Every string that is allowed by now."""
        return [*self.further, *self.roster]

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(self._check)

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        return {"type": "string", "enum": self.names}

    def _check(self, value: Any) -> str:
        if isinstance(value, str) and value in self.names:
            return value
        raise PydanticKnownError("literal_error", {"expected": quoted(self.names)})


def quoted(names: list[str]) -> str:
    """Return names as a sentence lists alternatives: 'a', 'b' or 'c'."""
    *others, last = [f"'{name}'" for name in names]
    return f"{', '.join(others)} or {last}" if others else last
