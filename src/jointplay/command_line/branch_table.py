"""Special orbits of branches, a line each."""

import textwrap
from collections.abc import Iterator, Mapping
from typing import Any


def branch_lines(found: Mapping[str, Any]) -> Iterator[str]:
    """Yield where the special orbits of a continuation's branches lie, and what happens there."""
    unit = "" if found["unit"] == "1" else f" {found['unit']}"
    for branch in found["branches"]:
        yield f"branch {branch['index']}"
        for one in branch["special"]:
            digits = max(3, min(12, _known(one["value"], one["bound"])))
            line = f"  {one['label']:2}  {found['parameter']} {one['value']:.{digits}g}{unit}"
            yield from textwrap.wrap(f"{line}  {one['note']}", 100, subsequent_indent="      ")


def _known(value: float, bound: float) -> int:
    """Return how many digits of a value its bound leaves."""
    if not value or not bound:
        return 10
    return sum(abs(value) > 10.0**exponent * bound for exponent in range(12))
