"""Fields of documents that choose a member of a registry, as the registry is when they are read.

A registry is a mutable mapping: who adds a member to it, from whatever file, has it admitted by
name and described in JSON Schemas, without a change anywhere else.
"""

from collections.abc import Mapping
from typing import Any, cast

from pydantic import BaseModel, GetCoreSchemaHandler, GetJsonSchemaHandler, ValidationError
from pydantic_core import CoreSchema, InitErrorDetails, PydanticKnownError, core_schema

JsonSchema = dict[str, Any]


class NameIn:
    """Annotation of a string that must be a name in a registry, or one of some further words."""

    def __init__(self, registry: Mapping[str, Any], *further: str) -> None:
        self.registry, self.further = registry, further

    @property
    def names(self) -> list[str]:
        """Every string that is allowed by now."""
        return [*self.further, *self.registry]

    def __get_pydantic_core_schema__(self, _source: Any, _: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(self._check)

    def __get_pydantic_json_schema__(self, _: CoreSchema, _h: GetJsonSchemaHandler) -> JsonSchema:
        return {"type": "string", "enum": self.names}

    def _check(self, value: Any) -> str:
        if isinstance(value, str) and value in self.names:
            return value
        raise PydanticKnownError("literal_error", {"expected": quoted(self.names)})


class MemberOf:
    """Annotation of an object whose tag names the model of a registry that it is.

    Without a tag it is the registry's first member, unless a tag is `required`. Errors lie at the
    member's own fields, as if there were no choice.
    """

    def __init__(
        self, registry: Mapping[str, type[BaseModel]], tag: str, *, required: bool = False
    ) -> None:
        self.registry, self.tag, self.required = registry, tag, required

    def __get_pydantic_core_schema__(self, _source: Any, _: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(self._chosen)

    def __get_pydantic_json_schema__(
        self, _: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchema:
        members = {name: _referred(model) for name, model in self.registry.items()}
        return handler(core_schema.tagged_union_schema(members, self.tag))

    def _chosen(self, value: Any) -> BaseModel:
        fallback = None if self.required else next(iter(self.registry))
        if isinstance(value, Mapping):
            name = value.get(self.tag, fallback)
        else:
            name = getattr(value, self.tag, fallback)
        if not isinstance(name, str) or name not in self.registry:
            error = InitErrorDetails(
                type="literal_error",
                loc=(self.tag,),
                input=name,
                ctx={"expected": quoted(list(self.registry))},
            )
            raise ValidationError.from_exception_data(self.tag, [error])
        return self.registry[name].model_validate(value)


def _referred(model: type[BaseModel]) -> CoreSchema:
    """Return a model's schema so that JSON Schemas define it once, under its name."""
    name = f"{model.__module__}.{model.__qualname__}:{id(model)}"
    return cast(CoreSchema, {**model.__pydantic_core_schema__, "ref": name})


def quoted(names: list[str]) -> str:
    """Return names as a sentence lists alternatives: 'a', 'b' or 'c'."""
    *others, last = [f"'{name}'" for name in names]
    return f"{', '.join(others)} or {last}" if others else last
