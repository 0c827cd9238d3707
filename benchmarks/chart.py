"""Charts: points beside those of a diagram, a million of them planned, and their pictures."""

import argparse
import json
import resource
import statistics
import subprocess
import sys
import time
from typing import Any

import numpy as np

from jointplay.records import pyramid
from jointplay.records.coarse_to_fine import TILE, coarse_to_fine, over_axes
from jointplay.service.charts import colouring
from jointplay.service.charts.grids import colours_of
from jointplay.solver.kinds import Study, admit, parse
from jointplay.solver.runs.study.run import StudyRun

SHARED: dict[str, Any] = {
    "scene": {"preset": "slider-crank"},
    "settle": 30,
    "record": 20,
    "indicators": ["recurrence"],
    "tolerance": 1e-6,
}
VALUES = {"from": 1e-4, "to": 5e-4, "count": 128}
ALONG = {"parameter": "clearance", "values": VALUES}
TURNS = 3
TILES = 20


def computing(job: dict[str, Any]) -> float:
    """Return the processor seconds of the points of a study, computed by this process."""
    study = admit(job)
    assert isinstance(study, Study)
    begun = time.process_time()
    for block in range(len(study.blocks)):
        for _ in StudyRun(study, block).slices():
            pass
    return time.process_time() - begun


def points() -> None:
    """Print what a point of a chart costs, in turns with a diagram's."""
    speed = {"parameter": "speed", "values": [10.0]}
    diagram = SHARED | {"kind": "bifurcation", "values": VALUES, "parameter": "clearance"}
    diagram["scene"] = {"preset": "slider-crank", "parameters": {"speed": 10.0}}
    chart = SHARED | {"kind": "chart", "along": ALONG, "by": speed}
    computing(chart)  # compiles
    both = [(computing(diagram), computing(chart)) for _ in range(TURNS)]
    one, other = (statistics.median(column) for column in zip(*both, strict=True))
    count = VALUES["count"]
    print(f"a point of a diagram, ms of one core   {1e3 * one / count:8.2f}")
    print(f"a point of a chart                     {1e3 * other / count:8.2f}")
    print(f"ratio, median of {TURNS} turns               {other / one:8.2f}")


def planned(side: int) -> None:
    """Print what it takes to admit a chart, and to plan it again."""
    axes = {
        name: {"parameter": parameter, "values": {"from": low, "to": high, "count": side}}
        for name, parameter, low, high in (
            ("along", "speed", 10.0, 40.0),
            ("by", "amplitude", 1e-3, 2e-2),
        )
    }
    job = SHARED | {"kind": "chart", "scene": {"preset": "impact-oscillator"}} | axes
    begun = time.process_time()
    admitted = admit(job)
    assert isinstance(admitted, Study)
    between = time.process_time()
    parse(json.loads(json.dumps(admitted.job)))
    ended = time.process_time()
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(
        f"{side}^2 points: admitted in {between - begun:5.2f} s, planned again in"
        f" {ended - between:5.2f} s, {most:5.0f} MB, {len(admitted.blocks)} blocks"
    )


def tiles(side: int) -> None:
    """Print the milliseconds of a tile whose level is at hand, and of making a level."""
    shape = (side, side)
    labels = np.random.default_rng(1).integers(1, 12, side * side).astype(np.uint8)
    laid = over_axes(labels, coarse_to_fine(shape), shape)
    begun = time.process_time()
    level = pyramid.in_majority(laid, 2)
    made = time.process_time() - begun
    begun = time.process_time()
    for _ in range(TILES):
        colouring.picture_of_labels(level[:TILE, :TILE], colours_of("attractor"))
    one = (time.process_time() - begun) / TILES
    print(
        f"{side}^2 points: a level of labels {1e3 * made:6.0f} ms, a tile of it {1e3 * one:5.1f} ms"
    )


def main() -> None:
    """Print all of it."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks chart", description=__doc__)
    parser.add_argument("--planned", type=int, help="plan this many points squared, and no more")
    given = parser.parse_args()
    if given.planned is not None:
        planned(given.planned)
        return
    points()
    for side in (1000, 2000):  # each in a process of its own: the memory is its own, too
        subprocess.run(
            [sys.executable, "-m", "benchmarks.chart", "--planned", str(side)], check=True
        )
    tiles(1000)


if __name__ == "__main__":
    main()
