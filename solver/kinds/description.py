"""The fields of every kind as data, for a command line and clients that load no solver.

`python -m jointplay.solver.kinds.description` prints it; what it printed is `job_fields.json` of
the package `jointplay`.
"""

import json
import sys
from typing import Any

from jointplay.solver.kinds import KINDS
from jointplay.solver.kinds.job import Job, MechanismJob
from jointplay.solver.kinds.section_study import SectionStudyJob

ELSEWHERE = ("kind", "scene")
SHARED = (Job, SectionStudyJob)
"""Documents that those of several kinds extend: their fields are nobody's own."""


def description() -> dict[str, Any]:
    """Return kinds by name, each with a sentence and its fields, those of its own first.

    A field has its ``help``, the ``form`` of its values (number, integer, flag, text, names,
    numbers or other), and where there are any its ``unit``, ``choices``, and ``words`` that may
    stand in place of such a value; ``own`` fields are those of no other kind's documents.
    """
    found = {}
    for name, kind in KINDS.items():
        schema = kind.document.model_json_schema()
        own = _own_fields(kind.document)
        rest = [f for f in schema["properties"] if f not in own and f not in ELSEWHERE]
        found[name] = {
            "help": schema["description"],
            "fields": {
                field: _field(schema["properties"][field])
                | ({"own": True} if field in own else {})
                | ({"required": True} if field in schema["required"] else {})
                for field in own + rest
            },
        }
    return found


def _own_fields(document: type[MechanismJob]) -> list[str]:
    """Return the fields that a document does not share with those of its family."""
    bases = [base for base in reversed(document.__mro__) if issubclass(base, MechanismJob)]
    own = [base for base in bases if not any(issubclass(one, base) for one in SHARED)]
    found = dict.fromkeys(name for base in own for name in base.__annotations__)
    return [name for name in found if name not in ELSEWHERE]


def _field(schema: dict[str, Any]) -> dict[str, Any]:
    forms = schema.get("anyOf") or schema.get("oneOf") or [schema]
    forms = [form for form in forms if form.get("type") != "null"]
    words = [form["const"] for form in forms if "const" in form]
    (form, *others) = [form for form in forms if "const" not in form]
    items = form.get("items", {})
    kind = "other"
    if not others:
        kind = {"number": "number", "integer": "integer", "boolean": "flag", "string": "text"}.get(
            form.get("type", ""), "other"
        )
        kind = {"string": "names", "number": "numbers"}.get(items.get("type", ""), kind)
    facts = {
        "unit": schema.get("unit", items.get("unit")),
        "choices": [one for one in form.get("enum", items.get("enum", [])) if one not in words],
        "words": words,
    }
    found = {"help": schema.get("description", ""), "form": kind}
    return found | {name: fact for name, fact in facts.items() if fact not in (None, [], "1")}


if __name__ == "__main__":
    sys.stdout.write(json.dumps(description(), indent=1) + "\n")
