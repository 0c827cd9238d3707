"""Any channels against any other: the first one across, a panel for each of the rest."""

from jointplay.figures import colours, page, sampling, scene_facts
from jointplay.figures.kind import NotDrawable, RunFigure, Selection, at_most
from jointplay.figures.quantity import scale
from jointplay.records.run import Source

_MOST_CHANNELS = 7
_PANEL_HEIGHT = 34.0  # mm
_SINGLE_HEIGHT = 60.0


def _chosen(source: Source, selection: Selection) -> tuple[str, ...]:
    if len(selection.channels) < 2:
        sentence = "Name two channels at least: the first is drawn across, the others up."
        raise NotDrawable(sentence, "channels")
    return scene_facts.stored(source, at_most(_MOST_CHANNELS, selection.channels))


def _draw(source: Source, selection: Selection) -> page.Figure:
    first, *others = _chosen(source, selection)
    time, values = sampling.in_a_plane(source, (first, *others), selection)
    label = sampling.called(source, selection, time) + sampling.beginning(source, time, selection)
    heights = [_SINGLE_HEIGHT if len(others) == 1 else _PANEL_HEIGHT] * len(others)
    figure, panels = page.stack(heights, 1)
    across = scale(scene_facts.channel(source, first).unit, values[first])
    for axes, name in zip(panels, others, strict=True):
        up = scale(scene_facts.channel(source, name).unit, values[name])
        x, y = values[first] / across.factor, values[name] / up.factor
        axes.plot(
            x,
            y,
            color=colours.COMPUTED,
            linewidth=0.5,
            rasterized=len(time) > page.MOST_VECTOR_POINTS,
            label=label,
        )
        axes.plot(x[:1], y[:1], "o", color=colours.MARKED, label="first sample")
        axes.set_ylabel(page.in_lines(up.label(name)))
    page.finish_stack(figure, panels, across.label(first), panels[0])
    return figure


XY = RunFigure(
    name="xy",
    title="Chosen channels against the first of them",
    uses=("channels", "start", "stop"),
    channels=_chosen,
    draw=_draw,
)
