"""Schema errors as sentences: which field, and what would be right, with its unit."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from pydantic import BaseModel, ValidationError

from jointplay.records.failure import Problem
from jointplay.records.suggestions import did_you_mean
from jointplay.solver.quantities.roster import MemberOf
from jointplay.solver.scene.unions import is_form

JOINTS = frozenset({"revolute", "prismatic", "fixed"})
TYPES = frozenset({"float", "str", "none"})
"""Parts of a location that name a branch of a union, not a place in the document."""

Sentence = Callable[[str, str, Mapping[str, Any]], str]
"""Takes a field, its unit (with a space before) and pydantic's context."""


def _in(unit: str) -> str:
    return f", in{unit}" if unit else ""


def _of(unit: str) -> str:
    return f" of{unit}" if unit else ""


SENTENCES: dict[str, Sentence] = {
    "missing": lambda field, _unit, _c: f"The field '{field}' is required.",
    "greater_than": lambda field, unit, c: f"'{field}' must be greater than {c['gt']:g}{unit}.",
    "greater_than_equal": lambda field, unit, c: f"'{field}' must be at least {c['ge']:g}{unit}.",
    "less_than": lambda field, unit, c: f"'{field}' must be less than {c['lt']:g}{unit}.",
    "less_than_equal": lambda field, unit, c: f"'{field}' must be at most {c['le']:g}{unit}.",
    "finite_number": lambda field, unit, _c: f"'{field}' must be a finite number{_in(unit)}.",
    "float_type": lambda field, unit, _c: f"'{field}' must be a number{_in(unit)}.",
    "int_type": lambda field, unit, _c: f"'{field}' must be a whole number{_of(unit)}.",
    "int_from_float": lambda field, unit, _c: f"'{field}' must be a whole number{_of(unit)}.",
    "string_type": lambda field, _unit, _c: f"'{field}' must be a string.",
    "list_type": lambda field, _unit, _c: f"'{field}' must be a list.",
    "dict_type": lambda field, _unit, _c: f"'{field}' must be an object.",
    "model_type": lambda field, _unit, _c: f"'{field}' must be an object.",
    "literal_error": lambda field, _unit, c: f"'{field}' must be {c['expected']}.",
    "union_tag_invalid": lambda _f, _u, c: f"'type' must be one of {c['expected_tags']}.",
    "union_tag_not_found": lambda _f, _u, _c: (
        "The field 'type' is required: 'revolute', 'prismatic' or 'fixed'."
    ),
    "too_short": lambda field, _u, c: f"'{field}' needs at least {c['min_length']} entries.",
    "too_long": lambda field, _u, c: f"'{field}' may have at most {c['max_length']} entries.",
    "string_too_long": lambda field, _u, c: (
        f"'{field}' may have at most {c['max_length']} characters."
    ),
    "string_too_short": lambda field, _u, _c: f"'{field}' must not be empty.",
    "string_pattern_mismatch": lambda field, _u, c: (
        f"'{field}' must be body.point, for example crank.pin or ground.O."
        if r"\." in c["pattern"]
        else f"'{field}' must begin with a letter and have at most 32 letters, digits, - or _."
    ),
}


def schema_problems(error: ValidationError, root: type[BaseModel]) -> list[Problem]:
    """Return one problem for each wrong place; `root` is the model that was validated."""
    known, units = vocabulary(root)
    found: dict[str, str] = {}
    for item in error.errors(include_url=False, include_input=False):
        location = [str(part) for part in item["loc"]]
        place = _place(location)
        pointer = "".join("/" + part.replace("~", "~0").replace("/", "~1") for part in place)
        field = next((part for part in reversed(place) if not part.isdigit()), "the document")
        unit = f" {units[field]}" if units.get(field, "1") != "1" else ""
        if item["type"] == "extra_forbidden":
            sentence = _no_such_field(field, known)
        elif item["type"] in SENTENCES:
            sentence = SENTENCES[item["type"]](field, unit, item.get("ctx", {}))
        else:
            sentence = f"{item['msg']}."
        found.setdefault(pointer, sentence)  # the first of a union's complaints says enough
    return [Problem(pointer, sentence) for pointer, sentence in found.items()]


def _place(location: list[str]) -> list[str]:
    """Return a location without the branches of unions that it names."""
    place: list[str] = []
    for index, part in enumerate(location):
        last = index == len(location) - 1
        joint = part in JOINTS and place[-2:-1] == ["joints"]
        kind = last and (part in TYPES or part == "[key]") and index > 1
        if not (is_form(part) or joint or kind):
            place.append(part)
    return place


def _no_such_field(field: str, known: frozenset[str]) -> str:
    meant = did_you_mean(field, known - {field})
    return f"There is no field '{field}' here" + (f"; {meant}" if meant else ".")


def vocabulary(root: type[BaseModel]) -> tuple[frozenset[str], dict[str, str]]:
    """Return all field names below a model, and the unit of those that have one."""
    units: dict[str, str] = {}
    names: set[str] = set()
    for model in _models(root):
        for name, field in model.model_fields.items():
            name = field.alias or name
            names.add(name)
            for extra in (field.json_schema_extra, *(_extras(field.metadata))):
                if isinstance(extra, dict) and isinstance(extra.get("unit"), str):
                    units[name] = str(extra["unit"])
    return frozenset(names), units


def _extras(metadata: list[Any]) -> Iterator[Any]:
    for item in metadata:
        yield getattr(item, "json_schema_extra", None)


def _models(root: type[BaseModel]) -> Iterator[type[BaseModel]]:
    waiting: list[Any] = [root]
    seen: set[type[BaseModel]] = set()
    while waiting:
        item = waiting.pop()
        if isinstance(item, type) and issubclass(item, BaseModel):
            if item in seen:
                continue
            seen.add(item)
            yield item
            for field in item.model_fields.values():
                waiting.extend([field.annotation, *field.metadata])
        elif isinstance(item, MemberOf):
            waiting.extend(item.roster.values())
        else:
            waiting.extend([*getattr(item, "__args__", ()), *getattr(item, "__metadata__", ())])
