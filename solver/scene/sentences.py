"""Schema errors as sentences: which field, and what would be right, with its unit."""

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Literal, get_args, get_origin

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import ErrorDetails

from jointplay.records.failure import Problem
from jointplay.records.strict_json import INTEGER_DIGITS
from jointplay.records.suggestions import did_you_mean, instead
from jointplay.solver.quantities.registry import MemberOf
from jointplay.solver.scene import presets, start_numbers
from jointplay.solver.scene.unions import is_form

TYPES = frozenset({"float", "str", "none"})
"""Parts of a location that name a branch of a union, not a key of the document."""

MOST_HINTS = 100
"""Unknown fields for which the one that may be meant is looked for; it takes a millisecond each."""

SENTENCES = {
    "missing": "The field '{field}' is required.",
    "greater_than": "'{field}' must be greater than {gt:g}{unit}, not {given:g}.",
    "greater_than_equal": "'{field}' must be at least {ge:g}{unit}, not {given:g}.",
    "less_than": "'{field}' must be less than {lt:g}{unit}, not {given:g}.",
    "less_than_equal": "'{field}' must be at most {le:g}{unit}, not {given:g}.",
    "finite_number": "'{field}' must be a finite number{in_unit}.",
    "float_type": "'{field}' must be a number{in_unit}.",
    "int_type": "'{field}' must be a whole number{of_unit}{meant}",
    "int_from_float": "'{field}' must be a whole number{of_unit}.",
    "string_type": "'{field}' must be a string.",
    "list_type": "'{field}' must be a list{of_pairs}.",
    "tuple_type": "'{field}' must be a list.",
    "dict_type": "'{field}' must be an object.",
    "model_type": "'{field}' must be an object{with_fields}.",
    "literal_error": "'{field}' must be {expected}{meant}",
    "too_short": "'{field}' has {actual_length} entries, and needs at least {min_length}.",
    "too_long": "'{field}' has more entries than the {max_length} that it may have.",
    "string_too_long": "'{field}' may have at most {max_length} characters.",
    "string_too_short": "'{field}' must not be empty.",
    "string_pattern_mismatch": (
        "'{field}' must begin with a letter and have at most 32 letters, digits, - or _."
    ),
    "start number": (
        "'{field}' must lead to a number of the start, for example /start/joints/stop/rate/0, or to"
        " the position of a driver: /drivers/motor/position."
    ),
    "pointer": "'{field}' must be a JSON pointer into the scene, for example /drivers/motor/speed.",
    "onset": "'{field}' must be a joint or a contact of one, for example A or guide.corner_1.",
    "reference": "'{field}' must be body.point, for example crank.pin or ground.O.",
}
"""Sentences by pydantic's type of error, with its context; a reference is a string with a point."""

SINGULAR = {" periods": " period"}
"""Units that are words, as they stand behind a number and behind 1."""


def schema_problems(
    error: ValidationError, root: type[BaseModel], document: object
) -> list[Problem]:
    """Return one problem for each wrong field; `root` is the model that a document was held to."""
    found: dict[str, str] = {}
    hints = 0
    for item in error.errors(include_url=False):
        location = [str(part) for part in item["loc"]]
        keys = _keys(location)
        pointer = "".join("/" + part.replace("~", "~0").replace("/", "~1") for part in keys)
        field = next((part for part in reversed(keys) if not part.isdigit()), "the document")
        if item["type"] == "extra_forbidden":
            hints += 1
            sentence = f"There is no field '{field}' here."
            if hints <= MOST_HINTS:
                sentence = _out_of_form(field, keys, root, document)
        else:
            sentence = _sentence(
                item, field, _unit(keys, root, document), _reached(keys, root, document)
            )
        if item["type"] == "missing":
            sentence += _of_parameter(pointer, document)
        found.setdefault(pointer, sentence)  # the first of a union's complaints says enough
    return [Problem(pointer, sentence) for pointer, sentence in found.items()]


def _out_of_form(field: str, keys: list[str], root: type[BaseModel], document: object) -> str:
    """Return what is wrong with a field that the object there must not have."""
    _, models = _reached(keys[:-1], root, document)
    known = {name for model in models for name, _ in _fields(model)}
    if field in known:  # of another form of the object
        return f"The field '{field}' does not go with the others here; leave it or them out."
    if len(keys) == 1 and (place := _in_the_scene(field, document)):
        return f"'{field}' belongs to the scene; give it as {place}."
    return f"There is no field '{field}' here; {instead(field, known)}"


Location = tuple[list[FieldInfo], list[type[BaseModel]]]
"""The last fields on the way to a location of a document, and the models that are meant there."""


def _sentence(item: ErrorDetails, field: str, unit: str, location: Location) -> str:
    """Return what is wrong with a field; `unit` has a space before."""
    kind, context = item["type"], item.get("ctx", {})
    if kind not in SENTENCES:
        return f"{item['msg']}."
    if kind == "missing" and isinstance(item["loc"][-1], int):
        return f"'{field}' has {item['loc'][-1]} entries, and needs more."
    pattern = context.get("pattern", "")
    if pattern == start_numbers.PATTERN:
        kind = "start number"
    elif pattern.startswith("^(/"):
        kind = "pointer"
    elif pattern.endswith("?$"):
        kind = "onset"
    elif r"\." in pattern:
        kind = "reference"
    if any(context.get(bound) == 1 for bound in ("ge", "gt", "le", "lt")):
        unit = SINGULAR.get(unit, unit)
    units = {"unit": unit, "in_unit": unit and f", in{unit}", "of_unit": unit and f" of{unit}"}
    units |= {"of_pairs": _of_pairs(location[0]), "with_fields": _with_fields(location[1])}
    more = units | {"meant": _meant_number(item) if kind == "int_type" else _meant_word(item)}
    return SENTENCES[kind].format(field=field, given=item["input"], **more, **context)


def _of_pairs(fields: Sequence[FieldInfo]) -> str:
    """Return what a list must be of, where fields hold pairs of numbers: positions, directions."""
    inside: list[Any] = [*fields]
    while inside:
        part = inside.pop()
        told = getattr(part, "metadata", ())
        lengths = [getattr(one, f"{end}_length", None) for end in ("min", "max") for one in told]
        if lengths.count(2) == 2:
            return " of 2 numbers"
        inside += [*getattr(part, "__args__", ()), *getattr(part, "__metadata__", ())]
        inside += [part.annotation] if isinstance(part, FieldInfo) else []
    return ""


def _with_fields(models: Sequence[type[BaseModel]]) -> str:
    """Return what an object must have, where one model is meant."""
    needed = [f"'{name}'" for model in models for name, f in _fields(model) if f.is_required()]
    return f" with {' and '.join(needed)}" if len(models) == 1 and needed else ""


def _of_parameter(pointer: str, document: object) -> str:
    """Return what else to say of a missing field, if a parameter of the scene would set it."""
    path = pointer.removeprefix("/scene")
    scene = document.get("scene", document) if isinstance(document, Mapping) else None
    declared = scene.get("parameters") if isinstance(scene, Mapping) else None
    for name, parameter in declared.items() if isinstance(declared, Mapping) else ():
        targets = parameter.get("targets") if isinstance(parameter, Mapping) else None
        listed = targets if isinstance(targets, list) else []
        if path in [one.get("path") for one in listed if isinstance(one, Mapping)]:
            return (
                f" The parameter '{name}' replaces it, but a scene is complete without parameters."
            )
    return ""


def _in_the_scene(field: str, document: object) -> str:
    """Return the pointer to which a field of a job belongs: parameters, or one of them; or ""."""
    scene = document.get("scene") if isinstance(document, Mapping) else None
    if not isinstance(scene, Mapping):
        return ""
    if field == "parameters":
        return "/scene/parameters"
    name, declared = scene.get("preset"), scene.get("parameters")
    is_preset = isinstance(name, str) and name in presets.names()
    if is_preset:
        declared = presets.document(str(name)).get("parameters")
    if not isinstance(declared, Mapping) or field not in declared:
        return ""
    return f"/scene/parameters/{field}" + ("" if is_preset else "/default")


def _meant_number(item: ErrorDetails) -> str:
    """Return the end of a sentence on a wrong number: how a whole one is written."""
    given = item["input"]
    is_whole = isinstance(given, float) and given.is_integer()
    if is_whole and abs(given) >= 10.0**INTEGER_DIGITS:
        return f", of at most {INTEGER_DIGITS} digits."
    return f", written without a point or an exponent: {given:.0f}." if is_whole else "."


def _meant_word(item: ErrorDetails) -> str:
    """Return the end of a sentence on a wrong word: which of the expected may have been meant."""
    context = item.get("ctx", {})
    given = item["input"]
    words = re.findall("'([^']+)'", context.get("expected", ""))
    near = did_you_mean(given, words) if isinstance(given, str) else ""
    return f"; {near}" if near else "."


def _keys(location: list[str]) -> list[str]:
    """Return a location without the branches of unions that it names."""
    keys: list[str] = []
    for index, part in enumerate(location):
        last = index == len(location) - 1
        kind = last and (part in TYPES or part == "[key]") and index > 1
        if not (is_form(part) or kind):
            keys.append(part)
    return keys


def _unit(keys: Sequence[str], root: type[BaseModel], document: object) -> str:
    """Return the unit of a field by its keys, with a space before; empty where there is none."""
    fields, _ = _reached(keys, root, document)
    extras = [extra for f in fields if isinstance(extra := f.json_schema_extra, dict)]
    units = {str(extra.get("unit", "1")) for extra in extras}
    unit = units.pop() if len(units) == 1 else "1"
    return "" if unit == "1" else f" {unit}"


def _reached(keys: Sequence[str], root: type[BaseModel], document: object) -> Location:
    """Return the last fields on the way along keys, and the models that a document means there."""
    models, value, is_key = [root], document, False
    fields: list[FieldInfo] = []
    for part in keys:
        named = [f for model in models for name, f in _fields(model) if name == part]
        value = _inside(value, part)
        if is_key or not named:  # a key of an object, an index
            is_key = False
        else:
            fields = named
            is_key = any(get_origin(f.annotation) is dict for f in fields)
            models = list(_directly([part for f in fields for part in (f.annotation, *f.metadata)]))
        models = models if is_key else _meant(models, value)
    return fields, models


def _inside(value: object, part: str) -> object:
    if isinstance(value, Mapping):
        return value.get(part)
    is_item = isinstance(value, list) and part.isdigit() and int(part) < len(value)
    return value[int(part)] if is_item and isinstance(value, list) else None


def _meant(models: list[type[BaseModel]], value: object) -> list[type[BaseModel]]:
    """Return which of a union's models an object means: by what it says of its kind, and has."""
    if len(models) < 2 or not isinstance(value, Mapping):
        return models
    told = [
        model
        for model in models
        if all(
            name not in value or value[name] in get_args(field.annotation)
            for name, field in _fields(model)
            if get_origin(field.annotation) is Literal
        )
    ] or models
    known = [sum(name in value for name, _ in _fields(model)) for model in told]
    return [model for model, count in zip(told, known, strict=True) if count == max(known)]


def _fields(model: type[BaseModel]) -> Iterator[tuple[str, FieldInfo]]:
    """Yield the fields of a model by the names that they have in documents."""
    for name, field in model.model_fields.items():
        yield field.alias or name, field


def _directly(annotations: list[Any]) -> Iterator[type[BaseModel]]:
    """Yield the models that annotations name, without those in their fields."""
    for item in annotations:
        if isinstance(item, type) and issubclass(item, BaseModel):
            yield item
        elif isinstance(item, MemberOf):
            yield from item.registry.values()
        else:
            inside = [*getattr(item, "__args__", ()), *getattr(item, "__metadata__", ())]
            yield from _directly(inside)
