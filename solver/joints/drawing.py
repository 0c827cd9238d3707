"""Drawing of a joint: the marks that its type says itself, and the curves that it is drawn by."""

import math
from typing import Literal, NamedTuple

import numpy as np

from jointplay.records.arrays import Floats
from jointplay.solver.quantities.scalars import sine_cosine

ANGLES = np.linspace(0.0, 2.0 * math.pi, 361)
"""Angles of a turn at which curves are known: a cam is off by 4e-5 of its radius between two."""


class Drawing(NamedTuple):
    """The part of its marks that a type of joint says; see `records.joint_marks.Marks`."""

    sign: Literal["pin", "weld", ""] = "pin"
    supported: bool = False
    axis: str = ""
    size: str = ""
    block: tuple[str, str] | None = None
    positions: tuple[tuple[float, float], ...] = ((0.0, 0.0),)
    """Positions of its contact pairs, in their order."""
    picture: Literal["journal", "walls", "surface", ""] = ""
    caption: str = ""


class Curve(NamedTuple):
    """A curve that moves with one of a joint's bodies."""

    end: Literal[0, 1]
    """Whether that is the first body or the second."""
    points: Floats
    """(n, 2) m from the joint's point of that body, in the body's axes."""
    filled: bool = False
    """Whether it is the outline of something."""


def circle(radius: float) -> Floats:
    """Return points of a circle about the origin, (361, 2) m."""
    sine, cosine = sine_cosine(ANGLES)
    return radius * np.stack([cosine, sine], axis=1)
