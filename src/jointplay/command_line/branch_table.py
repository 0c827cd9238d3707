"""Special orbits of branches, a line each."""

import textwrap
from collections.abc import Iterator, Mapping
from typing import Any


def branch_lines(found: Mapping[str, Any]) -> Iterator[str]:
    """Yield where the special orbits of a continuation's branches lie, and what happens there."""
    for branch in found["branches"]:
        if not branch["special"]:
            continue
        yield (
            f"curve {branch['index']} of {branch['of']}"
            if branch["of"]
            else (f"branch {branch['index']}")
        )
        for one in branch["special"]:
            line = f"  {one['label']:2}  {_number(found, one, '')}"
            line += f"  {_number(found, one, 'second')}" if branch["of"] else ""
            yield from textwrap.wrap(f"{line}  {one['note']}", 100, subsequent_indent="      ")


def _number(found: Mapping[str, Any], special: Mapping[str, Any], which: str) -> str:
    """Return a parameter of a special orbit with its unit, in the digits that are known."""
    name, unit = found[which or "parameter"], found[f"{which}_unit" if which else "unit"]
    value, bound = special[which or "value"], special[f"{which}_bound" if which else "bound"]
    digits = max(3, min(12, _known(value, bound)))
    return f"{name} {value:.{digits}g}" + ("" if unit == "1" else f" {unit}")


def _known(value: float, bound: float) -> int:
    """Return how many digits of a value its bound leaves."""
    if not value or not bound:
        return 10
    return sum(abs(value) > 10.0**exponent * bound for exponent in range(12))
