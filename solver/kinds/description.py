"""The fields of every kind as data, for a command line and clients that load no solver.

`python -m jointplay.solver.kinds.description` prints it; what it printed is `job_fields.json` of
the package `jointplay`.
"""

import json
import sys
from collections.abc import Mapping
from typing import Any

from pydantic import BaseModel

from jointplay.solver.distributions import DISTRIBUTIONS
from jointplay.solver.kinds import KINDS
from jointplay.solver.kinds.job import Job, MechanismJob
from jointplay.solver.kinds.section import ChannelSection, CrankSection, OnsetSection
from jointplay.solver.kinds.section_study import SectionStudyJob
from jointplay.solver.scene import start_numbers

ELSEWHERE = ("kind", "scene")
SHARED = (Job, SectionStudyJob)
"""Documents that those of several kinds extend: their fields are nobody's own."""
SECTIONS: dict[str, type[BaseModel]] = {
    "crank_angle": CrankSection,
    "onset": OnsetSection,
    "channel": ChannelSection,
}
"""Forms of a section, by the field that only they have."""


def description() -> dict[str, Any]:
    """Return kinds by name, each with a sentence and its fields, those of its own first.

    A field has its ``help``, the ``form`` of its values (number, integer, flag, text, names,
    numbers, values, grid, axis, distributions, section or other), and where there are any its
    ``unit``, ``choices``, ``words`` that may stand in place of such a value, ``members``, the
    numbers that each distribution is made of, or the fields of each form of a section, and what
    ``varied`` may name, the usual first, if that is not a parameter alone; ``own`` fields are those
    of no other kind's documents.  A kind that can be asked for by one option of a command line has
    its ``option``: the ``fields`` that it stands for, the ``form`` in which they are typed, and its
    ``name`` if that is not the kind's.  ``results`` are the parts of a job's address where its
    results are.
    """
    found: dict[str, Any] = {}
    for name, kind in KINDS.items():
        schema = kind.document.model_json_schema()
        own = _own_fields(kind.document)
        starts_first = "attractors" in kind.results  # most basins are over numbers of the start
        rest = [f for f in schema["properties"] if f not in own and f not in ELSEWHERE]
        fields = {
            field: _field(schema["properties"][field], starts_first)
            | ({"own": True} if field in own else {})
            | ({"required": True} if field in schema["required"] else {})
            for field in own + rest
        }
        option = _option({field: fields[field] for field in own})
        named = {"name": kind.option} if kind.option else {}
        found[name] = {
            "help": schema["description"],
            **({} if option is None else {"option": option | named}),
            "fields": fields,
            "results": list(kind.results),
        }
    return found


def _option(own: Mapping[str, dict[str, Any]]) -> dict[str, Any] | None:
    """Return the option by which a kind is asked for, given its own fields.

    It stands for what a document must have: values or distributions by parameter, a parameter and
    its values, the first of several axes, a number of points, or nothing. None: that cannot be
    typed.
    """
    forms = {name: field["form"] for name, field in own.items()}
    needed = [name for name, field in own.items() if "required" in field]
    grids = [name for name, form in forms.items() if form == "grid"]
    asked = [forms[name] for name in needed]
    if grids and not needed:
        return {"fields": grids[:1], "form": "grid"}
    if asked == ["text", "values"]:
        return {"fields": needed, "form": "values"}
    if asked == ["distributions"]:
        return {"fields": needed, "form": "distributions"}
    if asked and {*asked} == {"axis"}:
        return {"fields": needed[:1], "form": "axis"}
    if asked in ([], ["integer"]):
        return {"fields": needed, "form": "integer" if needed else "flag"}
    return None


def _own_fields(document: type[MechanismJob]) -> list[str]:
    """Return the fields that a document does not share with those of its family."""
    bases = [base for base in reversed(document.__mro__) if issubclass(base, MechanismJob)]
    own = [base for base in bases if not any(issubclass(one, base) for one in SHARED)]
    found = dict.fromkeys(name for base in own for name in base.__annotations__)
    return [name for name in found if name not in ELSEWHERE]


def _field(schema: dict[str, Any], starts_first: bool) -> dict[str, Any]:
    forms = schema.get("anyOf") or schema.get("oneOf") or [schema]
    both = ["start", "parameter"] if starts_first else ["parameter", "start"]
    varied = both if any(_is(form, "AlongStart") for form in forms) else []
    forms = [form for form in forms if form.get("type") != "null" and not _is(form, "AlongStart")]
    words = [form["const"] for form in forms if "const" in form]
    (form, *others) = [form for form in forms if "const" not in form]
    items = form.get("items", {})
    kind = "other"
    sections = _sections(forms)
    if _is(form, "Range"):
        kind = "values"
    elif sections:
        kind = "section"
    elif not others:
        kind = {"number": "number", "integer": "integer", "boolean": "flag", "string": "text"}.get(
            form.get("type", ""), "other"
        )
        kind = {"string": "names", "number": "numbers"}.get(items.get("type", ""), kind)
        kind = "axis" if _is(form, "Along") or _is(form, "AlongSecond") else kind
        values = [one.get("oneOf", [{}])[0] for one in form.get("patternProperties", {}).values()]
        kind = "grid" if any(_is(one, "Range") for one in values) else kind
        kind = "distributions" if any(_is(one, "Uniform") for one in values) else kind
        varied = ["start"] if start_numbers.PATTERN in form.get("patternProperties", {}) else varied
    facts = {
        "unit": schema.get("unit", items.get("unit")),
        "choices": [one for one in form.get("enum", items.get("enum", [])) if one not in words],
        "words": words,
        "members": _members() if kind == "distributions" else sections,
        "varied": varied,
    }
    found = {"help": schema.get("description", ""), "form": kind}
    return found | {name: fact for name, fact in facts.items() if fact not in (None, [], {}, "1")}


def _members() -> dict[str, list[str]]:
    """Return the numbers of each distribution, in the order in which they are typed."""
    return {
        name: [field for field in model.model_fields if field != "distribution"]
        for name, model in DISTRIBUTIONS.items()
    }


def _sections(forms: list[dict[str, Any]]) -> dict[str, list[str]]:
    """Return the fields of each form of a section that there is among some schemas."""
    return {
        name: list(model.model_fields)
        for name, model in SECTIONS.items()
        if any(_is(form, model.__name__) for form in forms)
    }


def _is(schema: dict[str, Any], model: str) -> bool:
    return str(schema.get("$ref", "")).rpartition("/")[2] == model


if __name__ == "__main__":
    sys.stdout.write(json.dumps(description(), indent=1) + "\n")
