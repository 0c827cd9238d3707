"""Force elements and gears of a mechanism: springs, arrows, pitch circles and belts."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from jointplay.figures import colours, page
from jointplay.figures.mechanism_geometry import GROUND, Point, Pose, angle_of, world
from jointplay.records.arrays import Floats

TURNING = ("torsion-spring", "torque", "motor")
_COILS, _WIDTH = 6, 0.02
"""Windings of a spring, and half its width in extents of the mechanism."""
_ARROW = 0.12
"""Length of a force's arrow, in extents of the mechanism."""
_CIRCLE = np.linspace(0.0, 2.0 * math.pi, 121)


@dataclass(frozen=True)
class Element:
    """A force element: its type, the positions of its points [m], and a force's direction."""

    kind: str
    first: Point
    second: Point
    direction: Point | None


@dataclass(frozen=True)
class Wheels:
    """A gear or belt: the positions of its joints [m] and its ratio."""

    first: Point
    second: Point
    ratio: float


def elements(scene: Mapping[str, Any], pose: Pose) -> list[Element]:
    """Place the force elements of a scene."""
    found = []
    for element in (scene.get("forces") or {}).values():
        first, second = element["first"], element["second"]
        direction = None
        if element["type"] == "force":
            x, y = element["direction"]
            size = math.hypot(x, y) * (-1.0 if element["magnitude"] < 0.0 else 1.0)
            body = {"first": first, "second": second}.get(element.get("axes", "world"), GROUND)
            angle = angle_of(pose, body)
            c, s = math.cos(angle), math.sin(angle)
            direction = ((c * x - s * y) / size, (s * x + c * y) / size)
        ends = world(scene, pose, first), world(scene, pose, second)
        if element["type"] == "tension" and (length := math.dist(*ends)) > 0.0:
            size = -length if element["magnitude"] < 0.0 else length
            (x, y), (u, v) = ends
            direction = ((x - u) / size, (y - v) / size)
        found.append(Element(element["type"], *ends, direction))
    return found


def springs(drawn: list[Element], size: float) -> list[Floats]:
    """Return the lines of springs, (corners, 2) m each, in a mechanism of this extent [m]."""
    return [
        _zigzag(one, size) for one in drawn if one.direction is None and one.kind not in TURNING
    ]


def wheels(scene: Mapping[str, Any], pose: Pose) -> list[Wheels]:
    """Place the gears of a scene."""
    found = []
    for gear in (scene.get("gears") or {}).values():
        joints = (scene["joints"][gear[name]] for name in ("first", "second"))
        positions = [world(scene, pose, joint["journal"]) for joint in joints]
        found.append(Wheels(positions[0], positions[1], gear["ratio"]))
    return found


def draw_elements(axes: page.Axes, drawn: list[Element], size: float, metre: float) -> None:
    """Draw springs as zigzags, forces as arrows, and moments as turning arrows."""
    for element in drawn:
        x, y = element.second
        if element.direction is not None:
            dx, dy = (_ARROW * size * part for part in element.direction)
            axes.annotate(
                "",
                xy=(x / metre, y / metre),
                xytext=((x - dx) / metre, (y - dy) / metre),
                arrowprops={"arrowstyle": "-|>", "color": colours.COMPUTED, "linewidth": 1.0},
                zorder=6,
            )
        elif element.kind in TURNING:
            style: page.Style = {"color": colours.COMPUTED, "markersize": 13.0, "fillstyle": "none"}
            style |= {"linestyle": "none", "markeredgewidth": 0.9, "zorder": 6}
            axes.plot([x / metre], [y / metre], marker=_turn(), **style)
    for line in springs(drawn, size):
        axes.plot(*(line.T / metre), color=colours.COMPUTED, linewidth=0.9, zorder=3)


def draw_wheels(axes: page.Axes, drawn: list[Wheels], metre: float) -> None:
    """Draw the pitch circles of wheels side by side, and belts as a line between their joints."""
    style: page.Style = {"color": colours.AUXILIARY, "linewidth": 0.8, "zorder": 1}
    for pair in drawn:
        rims = circles(pair)
        for rim in rims:
            axes.plot(*(rim / metre), linestyle="-.", **style)
        if not rims:
            line = np.array([pair.first, pair.second]).T / metre
            axes.plot(*line, linestyle=":", **style)


def circles(pair: Wheels) -> list[np.ndarray]:
    """Return the pitch circles of wheels side by side, (2, points) m each; none of a belt."""
    apart = math.dist(pair.first, pair.second)
    if pair.ratio >= 0.0 or apart == 0.0:
        return []
    share = abs(pair.ratio) / (1.0 + abs(pair.ratio))
    radii = share * apart, (1.0 - share) * apart
    return [
        np.stack([x + radius * np.cos(_CIRCLE), y + radius * np.sin(_CIRCLE)])
        for (x, y), radius in zip((pair.first, pair.second), radii, strict=True)
    ]


def _turn() -> page.MarkerPath:
    """Make three quarters of a circle with an arrowhead, counter-clockwise."""
    from matplotlib.path import Path

    angles = np.linspace(-0.25 * math.pi, 1.25 * math.pi, 25)
    arc = [(math.cos(a), math.sin(a)) for a in angles]
    x, y = arc[-1]
    strokes = [arc, [(x - 0.45, y + 0.1), (x, y), (x + 0.1, y + 0.45)]]
    codes = [c for s in strokes for c in [Path.MOVETO, *[Path.LINETO] * (len(s) - 1)]]
    return Path([point for stroke in strokes for point in stroke], codes)


def _zigzag(element: Element, size: float) -> Floats:
    """Return the line of a spring, (corners, 2) m."""
    start, end = np.array(element.first), np.array(element.second)
    along = end - start
    length = float(np.hypot(*along))
    if length == 0.0:
        return np.stack([start, end])
    across = np.array([-along[1], along[0]]) / length * _WIDTH * size
    shares = np.array([0.0, 0.2, *np.linspace(0.25, 0.75, 2 * _COILS), 0.8, 1.0])
    sides = np.array([0.0, 0.0, *([1.0, -1.0] * _COILS), 0.0, 0.0])
    return np.asarray(start + np.outer(shares, along) + np.outer(sides, across))
