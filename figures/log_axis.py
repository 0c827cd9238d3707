"""Numbers along a logarithmic axis, without mathematics, which names of channels switch off."""

import math

from jointplay.figures import page
from jointplay.figures.quantity import power_of_ten

_FEW_DECADES, _SOME_DECADES = 0.7, 2.0
"""Below the first numbers are spread as on a linear axis; up to the second 1, 2 and 5 are shown."""
_PLAINEST, _PLAIN = 1e-3, 1e5
"""Numbers between these are written out."""


def number(axis: page.Axis, intervals: int = 6) -> None:
    """Give a logarithmic axis, whose ends are known, numbers that stand apart."""
    from matplotlib.ticker import LogLocator, MaxNLocator, NullFormatter, NullLocator

    low, high = sorted(axis.get_view_interval())
    decades = math.log10(high / low)
    if decades < _FEW_DECADES:
        axis.set_major_locator(MaxNLocator(intervals, steps=[1, 2, 2.5, 5, 10]))
        axis.set_minor_locator(NullLocator())
    elif decades <= _SOME_DECADES:
        axis.set_major_locator(LogLocator(10.0, subs=(1.0, 2.0, 5.0)))
        axis.set_minor_locator(LogLocator(10.0, subs=range(1, 10)))
    else:
        axis.set_major_locator(LogLocator(10.0, numticks=intervals))
        axis.set_minor_locator(LogLocator(10.0, subs=(1.0,), numticks=99))
    plain = low >= _PLAINEST and high <= _PLAIN
    axis.set_major_formatter(lambda value, _: f"{value:g}" if plain else _as_power(value))
    axis.set_minor_formatter(NullFormatter())


def _as_power(value: float) -> str:
    """Write a number as a power of ten, with what stands before it."""
    if value <= 0.0:
        return ""
    exponent = math.floor(math.log10(value) + 1e-9)
    before = f"{value / 10.0**exponent:.3g}"
    power = power_of_ten(exponent)
    return power if before == "1" else f"{before}·{power}"
