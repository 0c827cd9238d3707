"""What accuracy costs: the error of every method and tolerance over its evaluations."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from jointplay.figures import page
from jointplay.figures.quantity import power_of_ten

_HEIGHT = 110.0  # mm
_LEGEND_COLUMNS = 3  # names of methods are long
_STYLES = (
    (page.BLUE, "o", "-"),
    (page.VERMILION, "s", "--"),
    (page.GREEN, "^", "-."),
    (page.BLACK, "D", ":"),
    (page.GREY, "v", "-"),
)
"""Colour, mark and dashes: told apart in grey, too."""


@dataclass(frozen=True)
class Cost:
    """One run: evaluations of the equations, error, and energy gone astray as a share of losses.

    `error` and `astray` are none where a run did not come to the end or nothing was lost;
    `admitted` says whether jobs may ask for it.
    """

    evaluations: int
    error: float | None
    astray: float | None
    admitted: bool


def draw_work_precision(
    methods: Mapping[str, Sequence[Cost]], uncertainty: float, most_astray: float, form: page.Form
) -> bytes:
    """Return a figure of two panels: the error, and the energy gone astray, over the cost.

    Parameters
    ----------
    methods
        By name, at most five, their runs from the coarsest to the finest.
    uncertainty
        Of the reference: errors below are not known.
    most_astray
        Share of energy beyond which a method is refused.
    form
        "png" or "svg".
    """
    with page.style():
        figure, grid = page.panels(2, 1, _HEIGHT, share_x=True)
        (above,), (below,) = grid
        for (name, runs), (colour, mark, dashes) in zip(methods.items(), _STYLES, strict=False):
            for axes, quantity in ((above, "error"), (below, "astray")):
                found = [
                    (run.evaluations, value, run.admitted)
                    for run in runs
                    if (value := getattr(run, quantity))
                ]
                axes.plot(
                    [evaluations for evaluations, _, _ in found],
                    [value for _, value, _ in found],
                    color=colour,
                    linestyle=dashes,
                    label=name,
                )
                for admitted, inside in ((True, colour), (False, "white")):
                    axes.plot(
                        [evaluations for evaluations, _, each in found if each is admitted],
                        [value for _, value, each in found if each is admitted],
                        color=colour,
                        linestyle="",
                        marker=mark,
                        markerfacecolor=inside,
                        markeredgewidth=0.6,
                    )
        for axes, label in ((above, "error"), (below, "energy astray / losses")):
            axes.set_xscale("log")
            axes.set_yscale("log")
            axes.set_ylabel(label)
            for axis in (axes.xaxis, axes.yaxis):
                axis.set_major_formatter(lambda value, _: power_of_ten(round(math.log10(value))))
                axis.set_minor_formatter(lambda value, _: "")
        low = min(above.get_ylim()[0], uncertainty)
        above.axhspan(0.1 * low, uncertainty, color=page.SHADE, linewidth=0.0)
        above.set_ylim(bottom=low)
        below.axhline(most_astray, color=page.GREY, linewidth=0.6, linestyle="--")
        below.set_xlabel("evaluations; what jobs may not ask for is open")
        figure.align_ylabels()
        names = above.get_legend_handles_labels()
        figure.legend(*names, loc="outside upper center", ncols=_LEGEND_COLUMNS)
        return page.save(figure, form)
