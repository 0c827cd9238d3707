"""One frame of the film, as a figure: the mechanism, and its joints with play magnified."""

from jointplay.figures import page
from jointplay.figures.animation.instants import instants
from jointplay.figures.animation.pace import Pace
from jointplay.figures.animation.reel import Reel, channels
from jointplay.figures.kind import RunFigure, Selection
from jointplay.records.run import Source


def _draw(source: Source, selection: Selection) -> page.Figure:
    first = instants(source, selection, Pace()).first()
    return Reel(source, selection, first).figure


ANIMATION = RunFigure(
    name="animation",
    title="The mechanism and its joints with play, magnified: the first frame of its film",
    uses=("joints", "start", "stop"),
    channels=channels,
    draw=_draw,
)
