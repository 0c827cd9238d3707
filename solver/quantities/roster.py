"""Fields of documents that choose a member of a roster, as the roster is when they are read.

A roster is a mutable mapping: who adds a member to it, from whatever file, has it admitted by name
and described in JSON Schemas, without a change anywhere else.
"""

from collections.abc import Mapping
from typing import Any, cast

from pydantic import BaseModel, GetCoreSchemaHandler, GetJsonSchemaHandler, ValidationError
from pydantic_core import CoreSchema, InitErrorDetails, PydanticKnownError, core_schema

JsonSchema = dict[str, Any]


class NameIn:
    """Annotation of a string that must be a name in a roster, or one of some further words."""

    def __init__(self, roster: Mapping[str, Any], *further: str) -> None:
        self.roster, self.further = roster, further

    @property
    def names(self) -> list[str]:
        """Every string that is allowed by now."""
        return [*self.further, *self.roster]

    def __get_pydantic_core_schema__(self, _source: Any, _: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(self._check)

    def __get_pydantic_json_schema__(self, _: CoreSchema, _h: GetJsonSchemaHandler) -> JsonSchema:
        return {"type": "string", "enum": self.names}

    def _check(self, value: Any) -> str:
        if isinstance(value, str) and value in self.names:
            return value
        raise PydanticKnownError("literal_error", {"expected": quoted(self.names)})


class MemberOf:
    """Annotation of an object whose tag names the model of a roster that it is.

    Without a tag it is the roster's first member, unless a tag is `required`. Errors lie at the
    member's own fields, as if there were no choice.
    """

    def __init__(
        self, roster: Mapping[str, type[BaseModel]], tag: str, *, required: bool = False
    ) -> None:
        self.roster, self.tag, self.required = roster, tag, required

    def __get_pydantic_core_schema__(self, _source: Any, _: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(self._chosen)

    def __get_pydantic_json_schema__(
        self, _: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchema:
        members = {name: _referred(model) for name, model in self.roster.items()}
        return handler(core_schema.tagged_union_schema(members, self.tag))

    def _chosen(self, value: Any) -> BaseModel:
        fallback = None if self.required else next(iter(self.roster))
        if isinstance(value, Mapping):
            name = value.get(self.tag, fallback)
        else:
            name = getattr(value, self.tag, fallback)
        if not isinstance(name, str) or name not in self.roster:
            error = InitErrorDetails(
                type="literal_error",
                loc=(self.tag,),
                input=name,
                ctx={"expected": quoted(list(self.roster))},
            )
            raise ValidationError.from_exception_data(self.tag, [error])
        return self.roster[name].model_validate(value)


def _referred(model: type[BaseModel]) -> CoreSchema:
    """Return a model's schema so that JSON Schemas define it once, under its name."""
    name = f"{model.__module__}.{model.__qualname__}:{id(model)}"
    return cast(CoreSchema, {**model.__pydantic_core_schema__, "ref": name})


def quoted(names: list[str]) -> str:
    """Return names as a sentence lists alternatives: 'a', 'b' or 'c'."""
    *others, last = [f"'{name}'" for name in names]
    return f"{', '.join(others)} or {last}" if others else last
