"""The signs that a mechanism is drawn with."""

import math
from itertools import cycle

import numpy as np

from jointplay.figures import colours, page
from jointplay.figures.mechanism_geometry import WITH_CLEARANCE, Geometry, among, distance

TINTS = ("#9CC9E8", "#A8DDC9", "#F5C99B", "#E3B8D2", "#CFCFCF", "#EFE59A")
"""Lighter Okabe-Ito colours, for the faces of bodies under black marks and text."""
EDGE = "#404040"
_RAIL = 0.14
"""Half the length of a slider's rail, in extents of the mechanism."""
BLOCK_SIZE = 15.0  # points
_GRAVITY_BOX, _GRAVITY_LENGTH = 22.0, 16.0  # points


def draw_rails(axes: page.Axes, shape: Geometry, metre: float) -> None:
    """Draw the straight line that each prismatic joint slides along."""
    for joint in shape.joints:
        if joint.axis is None:
            continue
        x, y = joint.position
        along = np.array([-_RAIL, _RAIL]) * shape.size
        axes.plot(
            (x + along * math.cos(joint.axis)) / metre,
            (y + along * math.sin(joint.axis)) / metre,
            color=colours.AUXILIARY,
            linewidth=0.6,
            linestyle=(0, (6, 2, 1, 2)),
            zorder=1,
        )


def draw_bodies(axes: page.Axes, shape: Geometry, metre: float) -> None:
    """Draw each body through its points, and a dot at every point that no joint marks."""
    marked = [joint.position for joint in shape.joints]
    for tint, (name, points) in zip(cycle(TINTS), shape.bodies.items(), strict=False):
        corners = np.array(shape.corners_of(name)) / metre
        if len(corners) > 2:
            axes.fill(*corners.T, facecolor=tint, edgecolor=EDGE, linewidth=0.6, zorder=2)
        elif len(corners) == 2:
            for colour, width in ((EDGE, 4.2), (tint, 3.2)):
                axes.plot(
                    *corners.T, color=colour, linewidth=width, solid_capstyle="round", zorder=2
                )
        else:
            _draw_block(axes, shape, name, tint, metre)
        loose = [
            position
            for position in points.values()
            if not among(position, marked, 1e-2 * shape.size)
        ]
        if loose and len(corners) > 1:
            axes.plot(*(np.array(loose).T / metre), ".", color=EDGE, markersize=2.5, zorder=4)


def draw_joints(axes: page.Axes, shape: Geometry, metre: float) -> None:
    """Draw a circle for each joint that turns, a square for each weld, and supports."""
    black: page.Style = {"color": colours.GEOMETRY, "markersize": 4.0}
    white: page.Style = {"markerfacecolor": "white"}
    play: page.Style = {"color": colours.MARKED, "markersize": 5.5, "markeredgewidth": 1.4}
    styles: dict[str, page.Style] = {
        "ideal joint": black | white,
        "driven joint": black | {"markerfacecolor": colours.GEOMETRY},
        WITH_CLEARANCE: play | white | {"zorder": 5},  # around others in its place
        "weld": {"markersize": 3.5, "markerfacecolor": EDGE, "color": EDGE, "marker": "s"},
    }
    for joint in shape.joints:
        on_block = any(shape.is_block(body) for body in joint.bodies)
        if joint.axis is None and joint.grounded and not on_block:
            style: page.Style = {
                "markersize": 13.0,
                "color": EDGE,
                "fillstyle": "none",
                "zorder": 1,
            }
            x, y = joint.position
            axes.plot([x / metre], [y / metre], marker=_support(), markeredgewidth=0.6, **style)
    common: page.Style = {"marker": "o", "linestyle": "none", "markeredgewidth": 0.8, "zorder": 5.1}
    for name, style in styles.items():
        positions = [joint.position for joint in shape.joints if joint.style == name]
        if positions:
            axes.plot(*(np.array(positions).T / metre), **(common | style), label=name)


def draw_gravity(axes: page.Axes, shape: Geometry) -> None:
    """Show where gravity pulls, in the corner that is farthest from the mechanism."""
    from matplotlib.offsetbox import AnchoredOffsetbox, DrawingArea
    from matplotlib.patches import FancyArrow
    from matplotlib.text import Text

    size = math.hypot(*shape.gravity)
    if size == 0.0:
        return
    x, y = shape.gravity[0] / size, shape.gravity[1] / size
    middle, half = _GRAVITY_BOX / 2.0, _GRAVITY_LENGTH / 2.0
    area = DrawingArea(_GRAVITY_BOX, _GRAVITY_BOX)
    arrow = FancyArrow(
        middle - half * x,
        middle - half * y,
        2.0 * half * x,
        2.0 * half * y,
        width=0.5,
        head_width=3.5,
        length_includes_head=True,
        color=colours.AUXILIARY,
        linewidth=0.0,
    )
    beside = Text(
        middle + 5.5 * y, middle - 5.5 * x, "g", color=colours.AUXILIARY, ha="center", va="center"
    )
    for artist in (arrow, beside):
        area.add_artist(artist)
    axes.add_artist(AnchoredOffsetbox(_free_corner(shape), child=area, frameon=False, pad=0.1))


def _free_corner(shape: Geometry) -> str:
    (left, right), (low, high) = shape.extent
    corners = {
        "upper right": (right, high),
        "lower right": (right, low),
        "upper left": (left, high),
        "lower left": (left, low),
    }
    segments = [segment for _, segment in shape.segments()]
    return max(
        corners,
        key=lambda name: min(distance(corners[name], segment) for segment in segments),
    )


def _draw_block(axes: page.Axes, shape: Geometry, name: str, tint: str, metre: float) -> None:
    """Draw a body without extension: a block along its rail, or a disc."""
    rails = [
        joint.axis for joint in shape.joints if joint.axis is not None and name in joint.bodies
    ]
    marker: page.MarkerPath | str = _block(rails[0]) if rails else "o"
    x, y = next(iter(shape.bodies[name].values()), shape.centres[name])
    axes.plot(
        [x / metre],
        [y / metre],
        marker=marker,
        color=EDGE,
        markersize=BLOCK_SIZE,
        markerfacecolor=tint,
        markeredgewidth=0.6,
        zorder=2,
    )


def _support() -> page.MarkerPath:
    """Make a triangle below its joint, on hatched ground."""
    from matplotlib.path import Path

    strokes = [[(0.0, 0.0), (-0.6, -0.75), (0.6, -0.75), (0.0, 0.0)], [(-0.9, -0.75), (0.9, -0.75)]]
    strokes += [[(x, -0.75), (x - 0.2, -1.0)] for x in (-0.6, -0.2, 0.2, 0.6)]
    codes = [
        code for stroke in strokes for code in [Path.MOVETO, *[Path.LINETO] * (len(stroke) - 1)]
    ]
    return Path([point for stroke in strokes for point in stroke], codes)


def _block(angle: float) -> page.MarkerPath:
    """Make a rectangle along a direction [rad]."""
    from matplotlib.path import Path

    cosine, sine = math.cos(angle), math.sin(angle)
    corners = [(-1.0, -0.55), (1.0, -0.55), (1.0, 0.55), (-1.0, 0.55), (-1.0, -0.55)]
    turned = [(cosine * x - sine * y, sine * x + cosine * y) for x, y in corners]
    return Path(turned, closed=True)
