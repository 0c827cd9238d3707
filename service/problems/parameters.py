"""Sentences on parameters of a request: what would be right, in the words for fields of a body."""

from collections.abc import Mapping
from typing import Any

from jointplay.service.problems import clipped
from jointplay.solver.scene.sentences import SENTENCES

_BOUNDS = ("greater_than", "greater_than_equal", "less_than", "less_than_equal")
_SENTENCES = {kind: SENTENCES[kind] for kind in (*_BOUNDS, "finite_number", "string_too_long")} | {
    "missing": "The parameter '{field}' is required.",
    "extra_forbidden": "There is no such parameter.",
    "float_parsing": SENTENCES["float_type"],
    "int_parsing": SENTENCES["int_type"],
    "enum": SENTENCES["literal_error"],
    "literal_error": SENTENCES["literal_error"],
    "value_error": "{error}",
}
"""By pydantic's type of error, with its context."""
_NO_UNITS = {"unit": "", "in_unit": "", "of_unit": "", "meant": "."}


def sentence(error: Mapping[str, Any]) -> str:
    """Return what one of pydantic's errors says of a parameter."""
    kind = error["type"]
    given = float(error["input"]) if kind in _BOUNDS else ""
    values = {"field": error["loc"][-1], "given": given} | _NO_UNITS | error.get("ctx", {})
    said = _SENTENCES[kind].format(**values) if kind in _SENTENCES else error["msg"]
    return clipped(said.rstrip(".") + ".")
