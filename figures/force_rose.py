"""Force roses: contact force by its direction in the bearing, which is where the bearing wears."""

from typing import Final

import numpy as np

from jointplay.figures import bearing_angles, colours, page, scene_facts
from jointplay.figures.kind import RunFigure, Selection, at_most
from jointplay.figures.quantity import scale
from jointplay.records.arrays import Floats
from jointplay.records.run import Source

_SECTORS: Final = 36
_MOST_JOINTS: Final = 4
_PANEL_HEIGHT: Final = 48.0  # mm
_BETWEEN: Final = 22.5 + 45.0 * np.arange(8)
"""Directions [deg] in which numbers of forces may stand, between two that are named."""
_OUTERMOST: Final = 0.8
"""Radius of the last number, of the rim's: beyond it would stand among the directions."""
_AROUND: Final = 20.0
"""Degrees to either side that a number covers."""
_CAPTION: Final = (
    "Direction: of the force on the bearing's wall, seen from the bearing's body. Mean: in each"
    " 10°, over all of the time. Contacts between samples count where they began."
)


def _joints(source: Source, selection: Selection) -> tuple[str, ...]:
    return at_most(_MOST_JOINTS, tuple(scene_facts.chosen_joints(source, selection)), "joints")


def _channels(source: Source, selection: Selection) -> tuple[str, ...]:
    joints = _joints(source, selection)
    names = [name for joint in joints for name in bearing_angles.channels(source, joint)]
    return scene_facts.stored(source, tuple(dict.fromkeys(names)))


def _draw(source: Source, selection: Selection) -> page.Figure:
    joints = _joints(source, selection)
    height = _PANEL_HEIGHT * len(joints) + page.caption_height(_CAPTION)
    figure, grid = page.panels(len(joints), 2, height, projection="polar")
    page.caption(figure, _CAPTION)
    for (left, right), joint in zip(grid, joints, strict=True):
        found = bearing_angles.loads(source, joint, selection, _SECTORS)
        _rose(left, found.edges, found.mean, f"{joint}: mean force", colours.COMPUTED)
        _rose(right, found.edges, found.largest, f"{joint}: largest force", colours.MARKED)
    return figure


def _rose(axes: page.Axes, edges: Floats, forces: Floats, quantity: str, colour: str) -> None:
    """Draw a sector for each direction, as long as its force."""
    from matplotlib.ticker import MaxNLocator

    newtons = scale("N", forces)
    axes.bar(
        edges[:-1], forces / newtons.factor, np.diff(edges), align="edge", color=colour, linewidth=0
    )
    axes.set_xticks(np.arange(8) * np.pi / 4.0)
    outermost = _OUTERMOST * axes.get_ylim()[1]
    numbers = MaxNLocator(3, steps=[1, 2, 5, 10]).tick_values(0.0, outermost)
    axes.set_yticks([one for one in numbers if 0.0 < one <= outermost])
    axes.set_rlabel_position(_emptiest(edges, forces))  # type: ignore[attr-defined]  # of polar axes
    axes.tick_params(pad=-1.0)
    axes.grid(linewidth=0.3)
    page.corner_text(axes, newtons.label(quantity))


def _emptiest(edges: Floats, forces: Floats) -> float:
    """Give the direction [deg] between two named ones in which forces are smallest."""
    middles = np.degrees(edges[:-1] + edges[1:]) / 2.0
    near = [
        float(forces[np.abs((middles - place + 180.0) % 360.0 - 180.0) < _AROUND].sum())
        for place in _BETWEEN
    ]
    return float(_BETWEEN[int(np.argmin(near))])


FORCE_ROSE = RunFigure(
    name="force-rose",
    title="Contact force by its direction in each bearing, for wear",
    uses=("joints", "start", "stop"),
    channels=_channels,
    draw=_draw,
)
