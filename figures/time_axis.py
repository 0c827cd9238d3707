"""The axis of time: its scale, and the spans in which a motion is not converged."""

from collections.abc import Sequence
from typing import Final

from jointplay.figures import colours, page
from jointplay.figures.quantity import scale
from jointplay.records.arrays import Floats
from jointplay.records.certificate import unconverged
from jointplay.records.run import Source

LABEL: Final = "not converged"


class TimeAxis:
    """Time [s] across the panels of a figure, whose curves have these (k,) times each."""

    def __init__(self, source: Source, times: Sequence[Floats]) -> None:
        self.scale = scale("s", *times)
        self.label = self.scale.label("time")
        self.unconverged = _gaps(source, float(times[0][0]), float(times[0][-1]))
        """(start, stop) of spans [s]: there values are one of many."""

    def shown(self, time: Floats) -> Floats:
        """Return times [s] as the axis shows them."""
        return time / self.scale.factor

    def shade(self, axes: page.Axes) -> None:
        """Shade in a panel what is not converged."""
        label = LABEL
        for start, stop in self.unconverged:
            ends = start / self.scale.factor, stop / self.scale.factor
            axes.axvspan(*ends, color=colours.UNKNOWN, linewidth=0.0, zorder=0.5, label=label)
            label = "_"


def _gaps(source: Source, start: float, stop: float) -> list[tuple[float, float]]:
    certificate = source.certificate()
    return [] if certificate is None else unconverged(certificate.attributes, start, stop)
