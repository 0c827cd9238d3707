"""Shading of the times at which a motion is not converged: there its values are one of many."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from jointplay.figures import page

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from jointplay.records.run import Source

LABEL: Final = "not converged"


def gaps(source: Source, start: float, stop: float) -> list[tuple[float, float]]:
    """Give the spans of a window of time [s] in which the motion is not converged."""
    certificate = source.certificate()
    if certificate is None:
        return []
    found, reached = [], start
    for begin, end in certificate.attributes["converged"]:
        if begin > reached:
            found.append((reached, min(begin, stop)))
        reached = max(reached, end)
    found.append((reached, stop))
    return [(a, b) for a, b in found if a < b]


def shade(axes: Axes, spans: list[tuple[float, float]], factor: float) -> None:
    """Shade spans [s] of a panel over time, whose axis shows them divided by a factor."""
    for position, (start, stop) in enumerate(spans):
        axes.axvspan(
            start / factor,
            stop / factor,
            color=page.SHADE,
            linewidth=0.0,
            zorder=0.5,
            label="_" if position else LABEL,
        )
