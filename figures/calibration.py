"""Course of a calibration's search, and the miss of every target with what fits equally well."""

from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from jointplay.figures import colours, log_axis, page
from jointplay.figures.kind import NotDrawable, Selection, StudyFigure
from jointplay.records.arrays import Floats
from jointplay.records.calibration_misfit import misfits
from jointplay.records.study import StudySource

_PANEL_HEIGHT: Final = 50.0  # mm


def _channels(source: StudySource, selection: Selection) -> tuple[str, ...]:
    if source.kind != "calibration":
        raise NotDrawable("A search and its targets are drawn of a calibration.")
    if 0 not in source.documents:
        raise NotDrawable("The calibration has found nothing yet: its search did not end.")
    return ()


def _draw(source: StudySource, selection: Selection) -> page.Figure:
    found = source.documents[0]
    targets = found["targets"]
    explained = _explained(found)
    height = 2.0 * (_PANEL_HEIGHT + page.AXIS_HEIGHT) + page.caption_height(explained)
    figure, ((search,), (misses,)) = page.panels(2, 1, height)
    costs = np.array(found["search"]["best_costs"], np.float64)
    search.plot(np.arange(len(costs)), costs, color=colours.COMPUTED)
    search.axhline(found["equally_good_cost"], color=colours.AUXILIARY, linestyle="--")
    search.set_yscale("log")
    log_axis.number(search.yaxis)
    search.locator_params(axis="x", integer=True)
    search.set_xlabel("generation")
    search.set_ylabel("lowest cost")
    for side in (-1.0, 1.0):
        misses.axhline(side, color=colours.AUXILIARY, linewidth=0.6, linestyle="--")
    for number, target in enumerate(targets, 1):
        ends = [_miss(target, target[end]) for end in ("lowest", "highest")]
        misses.plot([number, number], ends, color=colours.AUXILIARY, linewidth=1.2)
        inside = colours.COMPUTED if target["weight"] > 0.0 else "white"
        style: page.Style = {"markerfacecolor": inside, "markersize": 3.0, "markeredgewidth": 0.6}
        misses.plot([number], _miss(target, target["fitted"]), "o", color=colours.COMPUTED, **style)
    misses.set_xlim(0.0, len(targets) + 1.0)
    misses.locator_params(axis="x", integer=True)
    misses.set_xlabel("target, in the order of the document")
    misses.set_ylabel("miss over tolerance")
    page.caption(figure, explained)
    figure.align_ylabels()
    return figure


def _miss(target: Mapping[str, Any], value: float | None) -> Floats:
    """Return how far a value is off, in tolerances; NaN where there is none."""
    low, high = target["between"] or (target["value"], target["value"])
    at = np.nan if value is None else value
    below = 0.0 if low is None else np.minimum(at - low, 0.0)
    above = 0.0 if high is None else np.maximum(at - high, 0.0)
    return np.asarray((below + above) / target["tolerance"], np.float64)


def _explained(found: Mapping[str, Any]) -> str:
    """Say what dashed lines, bars and open marks are, and what the search did not reach."""
    search = found["search"]
    parts = {
        "Dashed above: costs below it are equally good. Bars: what these give.": True,
        "Open marks: targets that were not fitted.": not all(
            target["weight"] > 0.0 for target in found["targets"]
        ),
        "Nothing fits: misses are larger than tolerances explain.": misfits(found),
        "The search ended before its candidates were alike.": not search["settled"],
        "More may fit equally well than bars show.": search.get("spread_settled") is False,
    }
    return " ".join(sentence for sentence, said in parts.items() if said)


CALIBRATION = StudyFigure(
    name="calibration",
    title="Lowest cost over the generations, and the miss of every target",
    uses=(),
    channels=_channels,
    draw=_draw,
)
