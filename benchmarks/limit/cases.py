"""Mechanisms whose runs are measured."""

from benchmarks.busy_lanes import CLEARANCES, PRESSES
from benchmarks.limit.product import Case
from benchmarks.press import CASE

PRESS = Case("seven-bar-press", tuple(CASE | {"clearance": c} for c in CLEARANCES), 2.0)
SLIDER_CRANK = Case(
    "slider-crank",
    tuple({"clearance": 1e-4 + 4e-4 * i / (PRESSES - 1)} for i in range(PRESSES)),
    0.012,
)
