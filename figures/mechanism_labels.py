"""Names beside bodies and joints, where they cover neither, nor each other."""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Final

import numpy as np

from jointplay.figures import colours, page
from jointplay.figures.mechanism_geometry import (
    Geometry,
    JointMark,
    Point,
    distance,
)
from jointplay.figures.mechanism_marks import BLOCK_SIZE
from jointplay.records.arrays import Floats

_DISTANCE = 7.0  # points from the middle of a mark to its name
_BLOCK_DISTANCE = BLOCK_SIZE / 2.0 + 2.0
_SIZE = 6.0
_LINE = 1.2 * _SIZE
_LINES_ABOVE = {"top": 0.0, "center": 0.5, "bottom": 1.0}
"""Share of the further lines of a name that are above its position, by its alignment there."""
_STYLES: Final = (
    (True, {"color": colours.MARKED, "weight": "bold"}),
    (False, {"color": colours.GEOMETRY}),
)
"""Looks of names by whether joints have play."""
_LETTER_WIDTH = 0.62 * _SIZE  # of the typeface, on average
_NEAR = 0.03
"""A body this close to a joint, in extents of the mechanism, is in the way of its name."""
_UP, _DOWN = math.pi / 2.0, -math.pi / 2.0
# straight down first: a support apart, the space below a joint is where one looks for its name
_DIRECTIONS = (_DOWN, _UP, *(math.pi * quarter / 4.0 for quarter in (-1, -3, 1, 3, 0, 4)))
_BESIDE = (_UP, math.pi, 0.0, *(math.pi * quarter / 4.0 for quarter in (3, 1, -3, -1)))
"""Directions of a block's name from the block."""
_ALONG = (0.0, 0.15, -0.15, 0.3, -0.3)
"""Positions of a name along its body, from the middle, in lengths of the body."""


_Box = tuple[float, float, float, float]
"""Left, low, right and high edge, in points."""


@dataclass(frozen=True)
class _LabelPosition:
    """A name `apart` points from a point [m], in a direction [rad]; `merit` is better if larger."""

    point: Point
    angle: float
    apart: float
    merit: float

    @property
    def alignment(self) -> tuple[str, str]:
        """Horizontal and vertical alignment of the text, so that it grows away from the point."""
        x, y = math.cos(self.angle), math.sin(self.angle)
        return (
            "center" if abs(x) < 0.4 else ("left" if x > 0.0 else "right"),
            "center" if abs(y) < 0.4 else ("bottom" if y > 0.0 else "top"),
        )

    def box(self, lines: Sequence[str], points_per_metre: float) -> _Box:
        """Left, low, right and high edge of lines of text [points], estimated."""
        horizontal, vertical = self.alignment
        width = page.in_font(_LETTER_WIDTH) * max(map(len, lines))
        height = page.in_font(_LINE) * len(lines)
        x = self.point[0] * points_per_metre + self.apart * math.cos(self.angle)
        y = self.point[1] * points_per_metre + self.apart * math.sin(self.angle)
        left = x - {"left": 0.0, "center": 0.5, "right": 1.0}[horizontal] * width
        low = y - {"bottom": 0.0, "center": 0.5, "top": 1.0}[vertical] * height
        return left, low, left + width, low + height


def draw_labels(
    axes: page.Axes,
    shape: Geometry,
    curves: Iterable[Floats],
    metre: float,
    points_per_metre: float,
) -> None:
    """Name every joint, those that coincide together, and every body in italics.

    Parameters
    ----------
    curves
        Each (n, 2) m, of lines that names had better not cross.
    metre
        Metres in one unit of the axes.
    points_per_metre
        Printer's points that one metre of the mechanism takes.
    """
    written: list[_Box] = []
    lines = [_dots(points * points_per_metre) for points in curves]
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    points = metre * points_per_metre
    frame = (left * points, low * points, right * points, high * points)

    def write(styles: Mapping[str, page.Style], positions: Iterator[_LabelPosition]) -> None:
        def merit(position: _LabelPosition) -> tuple[int, float]:
            box = position.box([*styles], points_per_metre)
            faults = sum(_overlap(box, other) for other in written) + (not _within(box, frame))
            faults += sum(_is_crossed(box, line) for line in lines)
            return -faults, position.merit

        best = max(positions, key=merit)
        written.append(best.box([*styles], points_per_metre))
        horizontal, vertical = best.alignment
        x, y = best.apart * math.cos(best.angle), best.apart * math.sin(best.angle)
        y += page.in_font(_LINE) * (len(styles) - 1) * _LINES_ABOVE[vertical]
        for text, style in styles.items():
            note = axes.annotate(
                text,
                xy=(best.point[0] / metre, best.point[1] / metre),
                xytext=(x, y),
                textcoords="offset points",
                ha=horizontal,
                va=vertical,
                fontsize=page.in_font(_SIZE),
                zorder=6,
                **style,
            )
            note.set_in_layout(False)
            y -= page.in_font(_LINE)

    for point, joints in shape.positions():
        names = {
            ", ".join(joint.name for joint in joints if joint.play == play): style
            for play, style in _STYLES
        }
        names.pop("", None)
        write(names, _joint_positions(shape, point, joints))
    for name in shape.bodies:
        write({name: {"color": colours.GEOMETRY, "style": "italic"}}, _body_positions(shape, name))


def _joint_positions(
    shape: Geometry, point: Point, joints: list[JointMark]
) -> Iterator[_LabelPosition]:
    """Around a joint: the farther in angle from bodies, supports and rails, the better."""
    taken = [
        math.atan2(end[1] - point[1], end[0] - point[0])
        for _, segment in shape.segments()
        if distance(point, segment) < _NEAR * shape.size
        for end in segment
        if math.dist(end, point) > _NEAR * shape.size
    ]
    on_block = any(shape.is_block(body) for joint in joints for body in joint.bodies)
    for joint in joints:
        if joint.axis is not None:
            taken += [joint.axis, joint.axis + math.pi]
        elif joint.grounded and not on_block:
            taken.append(_DOWN)
    if on_block:
        taken.append(_UP)  # where the block's own name is
    for angle in _DIRECTIONS:
        free = min((_angle_between(angle, other) for other in taken), default=math.pi)
        yield _LabelPosition(
            point, angle, _BLOCK_DISTANCE if on_block else _DISTANCE, round(free, 6)
        )


def _body_positions(shape: Geometry, name: str) -> Iterator[_LabelPosition]:
    """Beside a block and its rail; along a long body on both sides, better far from others."""
    corners = shape.corners_of(name)
    if len(corners) < 2:
        axes = (joint.axis for joint in shape.joints if name in joint.bodies)
        rails = [axis for axis in axes if axis is not None]
        for farther, angle in product((0.0, 1.0), _BESIDE):
            free = min((abs(math.sin(angle - rail)) for rail in rails), default=1.0)
            apart = _BLOCK_DISTANCE + farther * page.in_font(_LINE)
            yield _LabelPosition(corners[0], angle, apart, round(free - farther, 6))
        return
    along = np.subtract(corners[1], corners[0])
    angle = math.atan2(along[1], along[0])
    others = [segment for other, segment in shape.segments() if other != name]
    for side in sorted((angle + _UP, angle + _DOWN), key=math.sin, reverse=True):
        for share in _ALONG:
            x, y = (np.mean(corners, axis=0) + share * along).tolist()
            reach = 2.0 * _NEAR * shape.size
            beside = (x + reach * math.cos(side), y + reach * math.sin(side))
            room = min((distance(beside, segment) for segment in others), default=math.inf)
            enough = min(room / shape.size, 2.0 * _NEAR)
            yield _LabelPosition((x, y), side, _DISTANCE, round(enough, 3))


def _dots(points: Floats) -> Floats:
    """Return positions (n, 2) along a curve, a printer's point from one to the next."""
    along = np.append(0.0, np.cumsum(np.hypot(*np.diff(points, axis=0).T)))
    positions = np.arange(0.0, along[-1], 1.0)
    return np.stack([np.interp(positions, along, one) for one in points.T], axis=1)


def _is_crossed(box: _Box, line: Floats) -> bool:
    low, high = box[:2], box[2:]
    return bool(((low < line) & (line < high)).all(axis=1).any())


def _within(box: _Box, frame: _Box) -> bool:
    return frame[0] <= box[0] and frame[1] <= box[1] and box[2] <= frame[2] and box[3] <= frame[3]


def _overlap(one: _Box, other: _Box) -> bool:
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]


def _angle_between(one: float, other: float) -> float:
    return abs(math.remainder(one - other, 2.0 * math.pi))
