"""The mechanism at a pose: bodies with their points, joints, and which of them have clearance."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from jointplay.figures import page, sampling, saving, scene_facts
from jointplay.figures.adjustment import drawn
from jointplay.figures.kind import NotDrawable, RunFigure, Selection
from jointplay.figures.mechanism_cams import cam_curves, draw_cams
from jointplay.figures.mechanism_elements import (
    circles,
    draw_elements,
    draw_wheels,
    elements,
    wheels,
)
from jointplay.figures.mechanism_geometry import Pose, geometry
from jointplay.figures.mechanism_labels import draw_labels
from jointplay.figures.mechanism_marks import draw_bodies, draw_gravity, draw_joints, draw_rails
from jointplay.figures.options import Options
from jointplay.figures.quantity import scale
from jointplay.records.figure_form import Form
from jointplay.records.run import Source

_MARGIN = 0.1
"""White around the mechanism, in its largest extent."""
_LEAST_HEIGHT, _MOST_HEIGHT = 45.0, 90.0  # mm
_FRAME_WIDTH, _FRAME_HEIGHT = 12.0, 16.0  # mm that axes labels and the legend take


def draw_mechanism(
    scene: Mapping[str, Any], pose: Pose, options: Options | None = None
) -> page.Figure:
    """Draw a scene at a pose.

    Parameters
    ----------
    scene
        The scene document, checked.
    pose
        By body: x and y of the centre of mass [m] and angle [rad].
    options
        Of its page.

    Raises
    ------
    NotDrawable
        The pose lacks a body, or an option means nothing for this figure.
    """
    if missing := [name for name in scene["bodies"] if name not in pose]:
        raise NotDrawable(f"The pose does not say where {', '.join(missing)} is.")
    return drawn(lambda: _draw(scene, pose), options)


def render_mechanism(
    scene: Mapping[str, Any], pose: Pose, form: Form, options: Options | None = None
) -> bytes:
    """Draw a scene at a pose and give the bytes of a file."""
    with page.style():
        return saving.save(draw_mechanism(scene, pose, options), form)


def _draw(scene: Mapping[str, Any], pose: Pose) -> page.Figure:
    shape, curves, gears = geometry(scene, pose), cam_curves(scene, pose), wheels(scene, pose)
    wide = [curve for pair in curves for curve in pair] + [c for g in gears for c in circles(g)]
    more = [(x, y) for curve in wide for x, y in curve.T.tolist()]
    shape = replace(shape, fixed_points=(*shape.fixed_points, *more))
    (left, right), (low, high) = shape.extent
    metres = scale("m", shape.corners)
    margin = _MARGIN * max(right - left, high - low)
    width, height = right - left + 2.0 * margin, high - low + 2.0 * margin
    frame = page.COLUMN_WIDTH - _FRAME_WIDTH
    height = max(height, width * (_LEAST_HEIGHT - _FRAME_HEIGHT) / frame)
    width = max(width, height * frame / (_MOST_HEIGHT - _FRAME_HEIGHT))
    figure, ((axes,),) = page.panels(1, 1, frame * height / width + _FRAME_HEIGHT)
    axes.set_aspect("equal")
    axes.locator_params(nbins=6)
    for set_limits, middle, span in (
        (axes.set_xlim, (left + right) / 2.0, width),
        (axes.set_ylim, (low + high) / 2.0, height),
    ):
        set_limits((middle - span / 2.0) / metres.factor, (middle + span / 2.0) / metres.factor)
    draw_rails(axes, shape, metres.factor)
    draw_cams(axes, curves, metres.factor)
    draw_wheels(axes, gears, metres.factor)
    draw_bodies(axes, shape, metres.factor)
    draw_joints(axes, shape, metres.factor)
    draw_elements(axes, elements(scene, pose), shape.size, metres.factor)
    points = frame * 72.0 / 25.4  # of a printer
    draw_labels(axes, shape, metres.factor, points / width)
    draw_gravity(axes, shape)
    axes.set_xlabel(metres.label("x"))
    axes.set_ylabel(metres.label("y"))
    page.legend(figure, axes)
    return figure


def _channels(source: Source, selection: Selection) -> tuple[str, ...]:
    bodies = scene_facts.scene(source).get("bodies")
    if not bodies:
        raise NotDrawable("The results carry no scene to draw.")
    names = [f"{body}.{coordinate}" for body in bodies for coordinate in ("x", "y", "theta")]
    return scene_facts.stored(source, names)


def _draw_first(source: Source, selection: Selection) -> page.Figure:
    """Draw the first sample of the window."""
    names = _channels(source, selection)
    first, _ = sampling.window(source, selection)
    ((_, row),) = source.blocks(names, first, first + 1)
    at = {name: float(values[0]) for name, values in row.items()}
    scene = scene_facts.scene(source)
    pose = {one: (at[f"{one}.x"], at[f"{one}.y"], at[f"{one}.theta"]) for one in scene["bodies"]}
    return _draw(scene, pose)


MECHANISM = RunFigure(
    name="mechanism",
    title="The mechanism at the first sample of the window",
    uses=("start", "stop"),
    channels=_channels,
    draw=_draw_first,
)
