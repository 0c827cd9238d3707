"""Tables in Markdown of what searches found, by scene, method and tolerance."""

import math
from collections.abc import Callable, Iterable, Sequence
from typing import Any, Protocol, TypeVar


class Judged(Protocol):
    """A job that was judged."""

    @property
    def kind(self) -> str:
        """The kind of scene."""

    @property
    def job(self) -> dict[str, Any]:
        """The job."""


Any_Judged = TypeVar("Any_Judged", bound=Judged)

KEYS: dict[str, Callable[[Judged], str]] = {
    "scene": lambda each: each.kind,
    "method": lambda each: each.job["method"],
    "tolerance": lambda each: decade(each.job.get("tolerance")),
    "all": lambda _each: "all",
}
"""Groupings of the tables."""


def grouped(key: str, judged: Iterable[Any_Judged]) -> dict[str, list[Any_Judged]]:
    """Return groups by one of KEYS, in order."""
    groups: dict[str, list[Any_Judged]] = {}
    for each in judged:
        groups.setdefault(KEYS[key](each), []).append(each)
    return dict(sorted(groups.items()))


def table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table."""
    lines = [heads, ["---"] * len(heads), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def percent(share: float) -> str:
    """Return a share as one reads it."""
    return f"{100.0 * share:.3f} %"


def decade(tolerance: float | None) -> str:
    """Return the range of a tolerance; with a fixed step there is none."""
    if tolerance is None:
        return "fixed step"
    power = math.ceil(math.log10(tolerance) - 1e-9)
    return f"1e{power - 1:03d} to 1e{power:03d}"
