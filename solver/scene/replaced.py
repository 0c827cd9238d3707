"""Numbers of a scene's document that defaults of its parameters replace."""

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

from jointplay.solver.scene.parameters import value_at


class Replaced(NamedTuple):
    """A number, or a word, that the document has at a pointer, and the one that is taken."""

    pointer: str
    parameter: str
    written: float | str
    taken: float | str

    def __str__(self) -> str:
        """Return it as lines of commands have it."""
        return f"{self.parameter} puts {self.taken} in place of {self.written} at {self.pointer}"


def replaced(written: Mapping[str, Any]) -> list[Replaced]:
    """Return what defaults change in a sound scene, as its document is given; none in a preset's.

    Where two parameters set one number, the later one counts.
    """
    if "preset" in written:
        return []
    taken = {
        target["path"]: (name, _scaled(parameter["default"], target.get("factor", 1.0)))
        for name, parameter in written.get("parameters", {}).items()
        if parameter.get("default") is not None
        for target in parameter["targets"]
    }
    both = {path: (value_at(written, path), *taken[path]) for path in taken}
    return [
        Replaced(path, name, before, after)
        for path, (before, name, after) in both.items()
        if before is not None and not _alike(before, after)
    ]


def _scaled(default: float | str, factor: float) -> float | str:
    return default if isinstance(default, str) else default * factor


def _alike(before: float | str, after: float | str) -> bool:
    """Whether two values are one; rounding is no change."""
    if isinstance(before, str) or isinstance(after, str):
        return before == after
    return math.isclose(before, after)
