"""Numbers of a scene's document that defaults of its parameters replace: what a check tells."""

import math
from typing import Any, NamedTuple

from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.parameters import value_at


class Replaced(NamedTuple):
    """A number, or a word, that the document has at a pointer, and the one that is taken."""

    pointer: str
    parameter: str
    written: float | str
    taken: float | str


def replaced(written: Any, scene: Scene) -> list[Replaced]:
    """Return what defaults change; `written` : the document, of which `scene` was made."""
    setting = {
        target.path: name
        for name, parameter in scene.parameters.items()
        if parameter.default is not None
        for target in parameter.targets
    }
    both = {path: (value_at(written, path), value_at(scene, path)) for path in setting}
    return [
        Replaced(path, setting[path], before, taken)
        for path, (before, taken) in both.items()
        if before not in (None, taken)
        and (isinstance(before, str) or not math.isclose(before, taken))  # rounding is no change
    ]
