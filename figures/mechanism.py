"""The mechanism at a pose: bodies with their points, joints, and which of them have clearance."""

from collections.abc import Mapping
from typing import Any

from jointplay.figures import page, sampling, saving, scene_facts
from jointplay.figures.adjustment import drawn
from jointplay.figures.kind import NotDrawable, RunFigure, Selection
from jointplay.figures.mechanism_elements import springs
from jointplay.figures.mechanism_geometry import Pose
from jointplay.figures.mechanism_labels import draw_labels
from jointplay.figures.mechanism_marks import draw_gravity
from jointplay.figures.mechanism_scene import View, draw_placed, place
from jointplay.figures.options import Options
from jointplay.records.figure_form import Form
from jointplay.records.run import Source


def draw_mechanism(
    scene: Mapping[str, Any], pose: Pose, options: Options | None = None
) -> page.Figure:
    """Draw a scene at a pose.

    Parameters
    ----------
    scene
        The scene document, checked, and the `curves` that its joints are drawn by, if any.
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


def render_mechanism(scene: Mapping[str, Any], pose: Pose, form: Form, options: Options) -> bytes:
    """Draw a scene at a pose and give the bytes of a file."""
    with page.style(options.font, options.font_size):
        return saving.save(draw_mechanism(scene, pose, options), form)


def _draw(scene: Mapping[str, Any], pose: Pose) -> page.Figure:
    placed = place(scene, pose)
    view = View.of(placed)
    figure, ((axes,),) = page.panels(1, 1, view.page_height)
    view.frame(axes)
    metre = view.metres.factor
    draw_placed(axes, placed, metre)
    lines = [curve.points for curve in placed.curves]
    lines += springs(placed.elements, placed.shape.size)
    draw_labels(axes, placed.shape, lines, metre, view.points_a_metre)
    draw_gravity(axes, placed.shape)
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
