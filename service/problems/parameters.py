"""Sentences on parameters of a request: what would be right, in the words for fields of a body."""

from collections.abc import Iterator, Mapping
from math import inf
from typing import Any

from fastapi import Request
from fastapi.dependencies.models import Dependant
from pydantic import BaseModel

from jointplay.records.suggestions import instead
from jointplay.service.problems import clipped
from jointplay.solver.scene.sentences import SENTENCES

_BOUNDS = ("greater_than", "greater_than_equal", "less_than", "less_than_equal")
_SAME = (*_BOUNDS, "finite_number", "string_too_long", "string_too_short")
_SENTENCES = {kind: SENTENCES[kind] for kind in _SAME} | {
    "missing": "The parameter '{field}' is required.",
    "repeated": "'{field}' is given more than once; give it once, with commas between names.",
    "extra_forbidden": "There is no field '{field}' here.",
    "timezone_aware": "'{field}' needs an offset, such as the Z of 2026-01-01T00:00:00Z.",
    "float_parsing": SENTENCES["float_type"],
    "int_parsing": SENTENCES["int_type"],
    "enum": SENTENCES["literal_error"],
    "literal_error": SENTENCES["literal_error"],
    "value_error": "{error}",
}
"""By pydantic's type of error, with its context."""
_NO_UNITS = {"unit": "", "in_unit": "", "of_unit": "", "meant": "."}


def sentence(error: Mapping[str, Any], request: Request) -> str:
    """Return what one of pydantic's errors says of a parameter of a request."""
    kind = error["type"]
    if kind == "extra_forbidden" and error["loc"][0] == "query":
        name = str(error["loc"][-1])
        known = sorted(set(query_names(request.scope["route"].dependant)))
        return clipped(f"There is no parameter {name!r} here; {instead(name, known)}")
    given = _number(error["input"]) if kind in _BOUNDS else ""
    values = {"field": error["loc"][-1], "given": given} | _NO_UNITS | error.get("ctx", {})
    said = _SENTENCES[kind].format(**values) if kind in _SENTENCES else error["msg"]
    return clipped(said.rstrip(".") + ".")


def _number(given: Any) -> float:
    """Return a number as one of floating point; infinity in place of a longer whole number."""
    try:
        return float(given)
    except OverflowError:
        return inf if given > 0 else -inf


def query_names(dependant: Dependant) -> Iterator[str]:
    """Yield the query parameters that an address takes, those of its dependencies too."""
    for parameter in dependant.query_params:
        model = parameter.field_info.annotation
        if isinstance(model, type) and issubclass(model, BaseModel):
            yield from (field.alias or name for name, field in model.model_fields.items())
        else:
            yield parameter.alias
    for inner in dependant.dependencies:
        yield from query_names(inner)
