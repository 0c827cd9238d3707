"""Fields of the kinds of jobs, as the solver describes them; loading it loads no solver."""

import json
from pathlib import Path
from typing import Any, Final

KINDS: Final[dict[str, Any]] = json.loads(Path(__file__).with_suffix(".json").read_bytes())
"""By name; see `jointplay.solver.kinds.description`, which a test compares it with."""

REQUEST: Final = ("cache", "expires")
"""Fields of a request to a service that stand in the job's document, and are none of the job."""


_SHORT: Final = 100


def help_of(field: dict[str, Any], *, short: bool = False) -> str:
    """Return a sentence about a field, with its unit and its choices; `short` : for a terminal."""
    text, *clauses = field["help"].split("; ")
    for clause in clauses:
        if short and len(text) + len(clause) > _SHORT:
            break
        text += f"; {clause}"
    choices = [*field.get("words", ()), *field.get("choices", ())]
    if choices and not all(choice in text for choice in choices):
        text += f"; {'one of' if field['form'] == 'text' else 'of'} {', '.join(choices)}"
    if field.get("unit") and field["unit"] not in text.split():
        text += f" [{field['unit']}]"
    if text.partition(":")[0] not in choices:
        text = text[:1].upper() + text[1:]
    return f"{text}."
