"""Suggestions for a name that does not exist."""

from collections.abc import Iterable
from difflib import get_close_matches

MOST_LISTED = 12
LONGEST = 100
"""Characters of a name for which a nearest one is looked for: comparing takes their square."""


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """Return the question after the nearest known name, or nothing where none is near."""
    if len(name) > LONGEST:
        return ""
    names = list(known)
    near = [other for other in names if other.casefold() == name.casefold()] or (
        get_close_matches(name, names, n=1)
    )
    return f"did you mean '{near[0]}'?" if near else ""


def unknown(kind: str, name: str, known: Iterable[str]) -> str:
    """Return a sentence that names an unknown thing and what there is instead."""
    names = list(known)
    listed = ", ".join(names[:MOST_LISTED]) + (", …" if len(names) > MOST_LISTED else "")
    hint = did_you_mean(name, names) or f"there are: {listed or 'none'}."
    return f"There is no {kind} '{name}'; {hint}"
