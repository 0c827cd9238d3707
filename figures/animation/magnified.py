"""Signs of a magnified joint: gaps and penetrations that can be seen, and arrows of forces.

Lengths of a picture are in radii of its bearing, or about that, whatever the joint measures.
"""

from typing import Final

import numpy as np

from jointplay.figures import colours, page
from jointplay.records.arrays import Floats

REACH: Final = 1.85
"""Half the width of a picture."""
GAP: Final = 0.385
"""Width that play is drawn with."""
DEEPEST: Final = 0.154
"""Depth that the largest penetration is drawn with."""
LONGEST: Final = 0.564
"""Length of the largest force's arrow."""
SHALLOWEST: Final = 1e-9
"""Penetration [m] up to which there is hardly one."""
WALL: Final = "#DDDDDD"


def deepest(depth: Floats) -> float:
    """Return the largest penetration [m]; infinite where there is none that is worth drawing."""
    found = float(np.nanmax(depth, initial=0.0))
    return found if found > SHALLOWEST else np.inf


def shown(distance: float, play: float, deepest: float) -> float:
    """Return how far from the middle something is drawn that is `distance` [m] from there.

    `play` is where it touches, `deepest` the largest penetration [m].
    """
    inside = min(distance / play, 1.0) * GAP
    return inside + min(max(distance - play, 0.0) / deepest, 1.4) * DEEPEST


def arrow(axes: page.Axes, tip: Floats, normal: Floats, share: float) -> None:
    """Draw a force against a normal of the wall, its head at `tip`, a share of the longest."""
    if not share > 0.0:
        return
    axes.annotate(
        "",
        xy=(tip[0], tip[1]),
        xytext=tuple(tip + LONGEST * share * normal),
        arrowprops={
            "arrowstyle": "-|>",
            "color": colours.MARKED,
            "linewidth": 1.2,
            "shrinkA": 0.0,
            "shrinkB": 0.0,
            "mutation_scale": 2.0 + 5.0 * share,
        },
        zorder=6,
    )
