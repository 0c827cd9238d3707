"""Names of special orbits, where they cover neither each other nor orbits."""

from collections.abc import Sequence
from itertools import product

import numpy as np

from jointplay.figures import colours, page
from jointplay.records.arrays import Floats
from jointplay.records.branch import Branch

_UNNAMED = "EP"
_TOGETHER = 0.02
"""Share of a panel within which special orbits are named together."""
_SIZE = 6.0  # points
_LETTER = np.array([0.62, 1.2])
"""Width and height of a letter, on average, in sizes."""
_APART = (3.0, 10.0)
"""Distances of a name from its mark along both axes, points; a line leads to the farther ones."""
_SIDES = ((1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0))
_OFFSETS = [apart * np.array(side) for apart, side in product(_APART, _SIDES)]

_LINE = {"arrowstyle": "-", "linewidth": 0.3, "patchA": None, "shrinkA": 0.0, "shrinkB": 1.0}
"""Look of the line that leads from a mark to its name."""

Placed = tuple[Branch, Floats, Floats]
"""A branch, and where a panel has its orbits along both axes."""

Named = tuple[Floats, str]
"""Where a panel has a special orbit, and its label."""


def name_special(axes: page.Axes, found: Sequence[Placed]) -> None:
    """Mark the special orbits of branches in a panel, and write their labels beside them."""
    low, high = _printed(axes, np.array([axes.get_xlim(), axes.get_ylim()]).T)
    orbits = _printed(axes, np.concatenate([np.array(placed[1:]).T for placed in found]))
    named = [
        (np.array([x[one.row], y[one.row]]), one.label)
        for branch, x, y in found
        for one in branch.special
        if one.label != _UNNAMED
    ]
    for position, _ in named:
        axes.plot(*position, "o", color=colours.MARKED, markersize=2.5, zorder=3.0)
    written: list[Floats] = []
    for position, text in _together(axes, named, _TOGETHER * (high - low)):
        size = page.in_font(_SIZE) * _LETTER * (len(text), 1.0)
        (at,) = _printed(axes, position[None])
        boxes = [np.array([near := at + o, near + np.sign(o) * size]) for o in _OFFSETS]
        boxes = [np.sort(box, axis=0) for box in boxes]
        faults = [
            (
                sum(_overlap(box, other) for other in written)
                + bool((box[0] < low).any() or (box[1] > high).any()),
                int(((orbits > box[0]) & (orbits < box[1])).all(axis=1).sum()),
            )
            for box in boxes
        ]
        best = faults.index(min(faults))
        written.append(boxes[best])
        x, y = _OFFSETS[best]
        axes.annotate(
            text,
            (position[0], position[1]),
            xytext=(x, y),
            textcoords="offset points",
            horizontalalignment="left" if x > 0.0 else "right",
            verticalalignment="bottom" if y > 0.0 else "top",
            fontsize=page.in_font(_SIZE),
            arrowprops=_LINE | {"relpos": (x < 0.0, y < 0.0)} if abs(x) > _APART[0] else None,
        )


def _together(axes: page.Axes, named: list[Named], reach: Floats) -> list[tuple[Floats, str]]:
    """Return positions and names, one for the labels within `reach`, points, of a position."""
    groups: list[tuple[Floats, list[str]]] = []
    for position, label in named:
        for other, labels in groups:
            first, second = _printed(axes, np.array([position, other]))
            if (abs(first - second) < reach).all():
                labels += [] if label in labels else [label]
                break
        else:
            groups.append((position, [label]))
    return [(position, ", ".join(labels)) for position, labels in groups]


def _printed(axes: page.Axes, positions: Floats) -> Floats:
    """Return (n, 2) positions on the page, points, as far as it is laid out."""
    shown: Floats = axes.transData.transform(positions) * 72.0 / axes.figure.dpi
    return shown


def _overlap(one: Floats, other: Floats) -> bool:
    return bool((one[0] < other[1]).all() and (other[0] < one[1]).all())
