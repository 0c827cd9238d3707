"""Chart: the kind of motion, the attractor, or a quantity, over two axes."""

from jointplay.figures import page
from jointplay.figures.chart_map import KINDS, ChartMap, offered
from jointplay.figures.kind import NotDrawable, Selection, StudyFigure, at_most
from jointplay.records.study import StudySource

_HEIGHT = 70.0  # mm


def _chosen(source: StudySource, selection: Selection) -> tuple[str, ...]:
    if source.kind not in KINDS:
        raise NotDrawable(f"A chart is drawn of a job of kind {' or '.join(KINDS)}.")
    known = offered(source)
    names = at_most(1, selection.channels, "quantities")
    if unknown := [name for name in names if name not in known]:
        sentence = f"There is no quantity {unknown[0]!r}; there are {', '.join(known)}."
        raise NotDrawable(sentence, "channels")
    return names or (known[0],)


def _draw(source: StudySource, selection: Selection) -> page.Figure:
    shown = ChartMap(source, *_chosen(source, selection))
    height = _HEIGHT + page.AXIS_HEIGHT + page.legend_rows(shown.legend) * page.LEGEND_HEIGHT
    figure, ((axes,),) = page.panels(1, 1, height + page.caption_height(shown.caption))
    page.caption(figure, shown.caption)
    shown.draw(figure, axes)
    page.legend_of_marks(figure, shown.legend)
    return figure


CHART = StudyFigure(
    name="chart",
    title="Chart: the kind of motion, or a quantity, over two parameters",
    uses=("channels",),
    channels=_chosen,
    draw=_draw,
)
