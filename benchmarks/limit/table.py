"""The table of ratios."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from benchmarks.limit.product import Measured
from benchmarks.limit.turns import Samples

C, EXACT, PRODUCT, WHEEL = "C", "C, exact sines", "product", "wheel"
"""Programs."""


@dataclass(frozen=True)
class Row:
    """A way of the product, and what it is compared with."""

    way: str
    title: str
    without: str = ""
    """The same way without what this one has more."""
    goal: str = ""


ROWS = (
    Row("study", "a lane of a study, first revolution", goal="1.15 of C"),
    Row("study, extremes", "  with extremes of all channels", "study", "2 of bare"),
    Row("study, foretold", "  that were known beforehand", "study"),
    Row("steady", "a lane of a study, steady", goal="1.15 of C"),
    Row("steady, extremes", "  with extremes of all channels", "steady", "1.5 of bare"),
    Row("steady, exponents", "  with exponents", "steady", "1.10 to 1.16 of bare"),
    Row("alone", "alone, first revolution", goal="1.25 of scalar C"),
    Row("alone, extremes", "  with extremes of all channels", "alone"),
    Row("alone, kept steps", "  with kept steps", "alone"),
    Row("job", "a job, with extremes and kept steps", "alone"),
    Row("job, certificate", "  with its certificate", "job"),
)
COLUMNS = ("ms", "/ C", "/ C, a step", "/ C, exact sines", "/ bare", "/ the wheel", "goal")
NOTHING = "-"


def quartiles(values: Sequence[float]) -> str:
    """Return the median and, in brackets, the quartiles."""
    low, middle, high = np.percentile(values, (25, 50, 75))
    return f"{middle:.2f} ({low:.2f}-{high:.2f})"


def ratio(
    ours: Sequence[Measured] | None, theirs: Sequence[Measured] | None, *, by: str = "periods"
) -> str:
    """Return the ratio, turn by turn, of the times that a period or a step took."""
    if not ours or not theirs:
        return NOTHING
    pairs = zip(ours, theirs, strict=True)
    return quartiles([_each(a, by) / _each(b, by) for a, b in pairs])


def _each(measured: Measured, by: str) -> float:
    amount: float = getattr(measured, by)
    return measured.seconds / amount


def table(samples: Samples) -> Iterator[str]:
    """Yield lines: a row for each way of the product that was measured.

    Times are those of the processor for a period, ratios those of times for a period. A goal is
    shown where the ratio is that it is for.
    """
    ours, limit, exact, wheel = (samples.get(who, {}) for who in (PRODUCT, C, EXACT, WHEEL))
    yield line("", COLUMNS)
    for row in ROWS:
        measured = ours.get(row.way)
        if not measured:
            continue
        took = 1e3 * float(np.median([_each(one, "periods") for one in measured]))
        beside, bare = limit.get(row.way), ours.get(row.without)
        cells = (
            f"{took:#.3g}",
            ratio(measured, beside),
            ratio(measured, beside, by="steps"),
            ratio(measured, exact.get(row.way)),
            ratio(measured, bare),
            ratio(measured, wheel.get(row.way)),
            row.goal if beside or bare else "",
        )
        yield line(row.title, cells)


def line(title: str, cells: Sequence[str]) -> str:
    """Return a line of the table."""
    first, *others, last = cells
    ratios = "".join(f"{cell:>18}" for cell in others)
    return f"{title:<38}{first:>8}{ratios}   {last}".rstrip()
