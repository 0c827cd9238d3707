"""Suggestions for a name that does not exist."""

from collections.abc import Iterable
from difflib import get_close_matches

from jointplay.records.quantity_terms import in_other_terms

MOST_LISTED = 20
NEAR = 0.75
"""Share of letters in common, as difflib counts it, from which a name may have been meant."""
LONGEST = 100
"""Characters of a name for which a nearest one is looked for: comparing takes their square."""


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """Return the question after the nearest known name, or nothing where none is near."""
    if len(name) > LONGEST:
        return ""
    names = list(known)
    near = (
        [other for other in names if other.casefold() == name.casefold()][:1]
        or in_other_terms(name, names)
        or get_close_matches(name, names, n=1, cutoff=NEAR)
    )
    meant = " or ".join(f"'{one}'" for one in near)
    return f"did you mean {meant}?" if near else ""


def instead(name: str, known: Iterable[str]) -> str:
    """Return the end of a sentence about an unknown name: what was meant, or what there is."""
    names = sorted(known) if isinstance(known, set | frozenset) else list(known)
    listed = ", ".join(names[:MOST_LISTED]) + (", …" if len(names) > MOST_LISTED else "")
    return did_you_mean(name, names) or f"there are: {listed or 'none'}."


def unknown(kind: str, name: str, known: Iterable[str]) -> str:
    """Return a sentence that names an unknown thing and what there is instead."""
    return f"There is no {kind} '{name}'; {instead(name, known)}"
