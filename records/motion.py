"""The motion of a point as one small number: the label that maps over two parameters show.

Colours are those of Okabe and Ito (2008) as far as they go.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from jointplay.records.arrays import Floats
from jointplay.records.point import PointStatus

MOTION, ATTRACTOR = "motion", "attractor"
LABELS = (MOTION, ATTRACTOR)
"""Quantities of maps that are labels; all others are values."""
NAMES = ("waiting", "failed", "undecided", "quasi-periodic", "chaotic", "equilibrium")
"""Names of the first codes; those behind them are period-1, period-2 and so on."""
WAITING, FAILED, UNDECIDED, QUASI_PERIODIC, CHAOTIC, EQUILIBRIUM = range(len(NAMES))
MIXED = 255
"""Code of a cell of several points where no label is that of more than half of them."""
LONGEST = 200
"""Longest period that has a code of its own; longer ones share that of the next."""

COLOURS = {
    WAITING: "#ffffff",
    FAILED: "#000000",
    UNDECIDED: "#8f8f8f",
    QUASI_PERIODIC: "#56b4e9",
    CHAOTIC: "#b0468a",
    EQUILIBRIUM: "#1f3a5f",
    MIXED: "#dedede",
}
"""As #rrggbb."""
PERIODS = (
    "#009e73",
    "#7fbf3f",
    "#e3d02f",
    "#e69f00",
    "#d55e00",
    "#8c5a2b",
    "#0072b2",
    "#5b4a9c",
)
"""Colours of period-1, period-2 and so on; a ninth has the first colour once more, lighter."""

Labels = NDArray[np.uint8]


def motions(
    status: NDArray[np.uint8], verdict: Floats, period: Floats, names: Sequence[str]
) -> Labels:
    """Return the codes of points.

    Parameters
    ----------
    status
        (points,) codes of `PointStatus`.
    verdict
        (points,) positions in `names`; NaN where there is none.
    period
        (points,) sections after which the motion recurs; NaN: not known.
    names
        Of the verdicts.
    """
    found = np.full(len(status), WAITING, np.uint8)
    found[status == PointStatus.failed] = FAILED
    done = status == PointStatus.done
    found[done] = UNDECIDED
    for name in {"quasi-periodic", "chaotic", "equilibrium"}.intersection(names):
        found[done & (verdict == names.index(name))] = NAMES.index(name)
    periodic = done & (verdict == names.index("periodic")) & (period >= 1.0)
    found[periodic] = len(NAMES) + np.minimum(period[periodic], LONGEST + 1.0) - 1.0
    return found


def name_of(code: int) -> str:
    """Return a code in words."""
    if code == MIXED:
        return "mixed"
    if code < len(NAMES):
        return NAMES[code]
    period = code - len(NAMES) + 1
    return f"period-{period}" if period <= LONGEST else f"longer than period-{LONGEST}"


def colour_of(code: int) -> str:
    """Return the colour of a code, as #rrggbb."""
    if code in COLOURS:
        return COLOURS[code]
    turn, index = divmod(code - len(NAMES), len(PERIODS))
    if not turn:
        return PERIODS[index]
    parts = (255 - (255 - part) * 3 // 5 for part in bytes.fromhex(PERIODS[index][1:]))
    return "#" + bytes(parts).hex()
