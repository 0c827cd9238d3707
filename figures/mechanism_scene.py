"""A scene at a pose: placed in the world, and drawn into a panel that shows all of it."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from jointplay.figures import page
from jointplay.figures.mechanism_curves import Curve, curves, draw_curves
from jointplay.figures.mechanism_elements import (
    Element,
    Wheels,
    circles,
    draw_elements,
    draw_wheels,
    elements,
    wheels,
)
from jointplay.figures.mechanism_geometry import Geometry, Point, Pose, geometry
from jointplay.figures.mechanism_guides import Guide, draw_guides, guides
from jointplay.figures.mechanism_marks import draw_bodies, draw_joints, draw_rails
from jointplay.figures.quantity import Scale, scale

_MARGIN = 0.1
"""White around the mechanism, in its largest extent."""
_LEAST_HEIGHT, _MOST_HEIGHT = 45.0, 90.0  # mm
_FRAME_WIDTH, _FRAME_HEIGHT = 12.0, 16.0  # mm that labels of axes and the legend take
_POINTS_A_MILLIMETRE = 72.0 / 25.4


@dataclass(frozen=True)
class PlacedScene:
    """All that is drawn of a scene at a pose; lengths in m, in the world."""

    shape: Geometry
    curves: list[Curve]
    gears: list[Wheels]
    elements: list[Element]
    guides: list[Guide]

    def within(self, corners: Iterable[Point]) -> "PlacedScene":
        """Return the same with an extent that holds these points, too."""
        points = (*self.shape.fixed_points, *corners)
        return replace(self, shape=replace(self.shape, fixed_points=points))

    @property
    def corners(self) -> list[Point]:
        """Lower left and upper right corner of its extent."""
        (left, right), (low, high) = self.shape.extent
        return [(left, low), (right, high)]


def place(scene: Mapping[str, Any], pose: Pose) -> PlacedScene:
    """Place a scene document, checked, with its curves at a pose of all its bodies."""
    drawn, gears = curves(scene, pose), wheels(scene, pose)
    wide = [curve.points for curve in drawn]
    wide += [circle.T for gear in gears for circle in circles(gear)]
    shape = geometry(scene, pose)
    walled = guides(scene, pose, shape.size)
    wide += [points for guide in walled for points in (guide.slider, *guide.walls)]
    placed = PlacedScene(shape, drawn, gears, elements(scene, pose), walled)
    return placed.within((x, y) for points in wide for x, y in points.tolist())


@dataclass(frozen=True)
class View:
    """The panel of a scene: middle [m], width and height [m] of what it shows, and its scale."""

    middle: Point
    width: float
    height: float
    metres: Scale

    @classmethod
    def of(cls, placed: PlacedScene) -> "View":
        """Choose a view that has the scene's proportions, neither too high nor too low."""
        (left, right), (low, high) = placed.shape.extent
        margin = _MARGIN * max(right - left, high - low)
        width, height = right - left + 2.0 * margin, high - low + 2.0 * margin
        height = max(height, width * (_LEAST_HEIGHT - _FRAME_HEIGHT) / _frame())
        width = max(width, height * _frame() / (_MOST_HEIGHT - _FRAME_HEIGHT))
        middle = (left + right) / 2.0, (low + high) / 2.0
        return cls(middle, width, height, scale("m", placed.shape.corners))

    @property
    def page_height(self) -> float:
        """Height of the panel on the page, with its labels and the legend [mm]."""
        return _frame() * self.height / self.width + _FRAME_HEIGHT

    @property
    def points_a_metre(self) -> float:
        """Points of a printer that one metre takes on the page."""
        return _frame() * _POINTS_A_MILLIMETRE / self.width

    def frame(self, axes: page.Axes) -> None:
        """Give a panel its limits and labels."""
        axes.set_aspect("equal")
        axes.locator_params(nbins=6)
        (x, y), half = self.middle, np.array([-0.5, 0.5])
        axes.set_xlim(*((x + self.width * half) / self.metres.factor))
        axes.set_ylim(*((y + self.height * half) / self.metres.factor))
        axes.set_xlabel(self.metres.label("x"))
        axes.set_ylabel(self.metres.label("y"))


def draw_placed(axes: page.Axes, placed: PlacedScene, metre: float) -> None:
    """Draw a scene, from the back to the front; `metre` [m] is one of the panel's units."""
    draw_rails(axes, placed.shape, metre)
    draw_curves(axes, placed.curves, metre)
    draw_wheels(axes, placed.gears, metre)
    draw_guides(axes, placed.guides, placed.shape, metre)
    draw_bodies(axes, placed.shape, metre)
    draw_joints(axes, placed.shape, metre)
    draw_elements(axes, placed.elements, placed.shape.size, metre)


def _frame() -> float:
    """Return the width of a panel without its labels [mm]."""
    return page.COLUMN_WIDTH - _FRAME_WIDTH
