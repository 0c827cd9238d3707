"""Rules about numbers of one part of a document that must fit each other."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Rule:
    """A relation that must not hold, at the field that would be mended.

    `broken` takes the part, whose numbers are floats or columns (one row a point of a study), and
    returns a truth value or an array of them; `sentence` takes a part with the floats of one scene.
    """

    field: str
    broken: Callable[[Any], Any]
    sentence: Callable[[Any], str]
