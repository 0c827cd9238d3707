"""Colours of figures: each means the same in all of them.

They are those of Okabe and Ito (2008): distinct with any colour vision, most of them in grey, too.
"""

from typing import Final

COMPUTED: Final = "#0072B2"
"""Blue, what was computed: curves, paths, sections, bars."""
MARKED: Final = "#D55E00"
"""Vermilion, what is marked in it: impacts, joints with play, single instants and points."""
GEOMETRY: Final = "#000000"
"""Black, what was given: circles of clearance, zero lines, what failed."""
AUXILIARY: Final = "#767676"
"""Grey, what helps to read: thresholds, rails, gravity."""
UNKNOWN: Final = "#E8E8E8"
"""Light grey, behind what is not known: not converged, not finished."""

PERIODIC: Final = "#009E73"
QUASI_PERIODIC: Final = "#56B4E9"
CHAOTIC: Final = "#CC79A7"
EQUILIBRIUM: Final = "#1F3A5F"
UNDECIDED: Final = AUXILIARY
NO_VERDICT: Final = "#B4B4B4"
"""Verdicts: green, light blue, purple, dark blue, grey, and lighter grey without one."""

FORWARD: Final = COMPUTED
BACKWARD: Final = "#E69F00"
"""Directions of a continuation: as what has none, and orange."""

MAP: Final = "cividis"
"""Values over two parameters, dark if low, light if high."""
COMPARED: Final = (
    (COMPUTED, "-", "o"),
    (MARKED, "--", "s"),
    (PERIODIC, "-.", "^"),
    (GEOMETRY, ":", "D"),
    (AUXILIARY, "-", "v"),
)
"""Colour, dashes and mark of curves side by side, which the legend tells apart, in grey, too."""
