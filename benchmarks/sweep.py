"""A bifurcation diagram of the press over HTTP: 200 clearances of 150 periods, by 1 and 2 workers.

    python -m benchmarks sweep

Stiffness 5e9, friction 0.1, restitution 0.7, bearing radius 10 mm, limit velocities 1e-3 and
1e-2 m/s, tolerance 1e-6; the time runs from the request to the finished array, kernels warm.
Beside it, in the same run: the time in kernels alone, and SciPy on the paper's equations.
"""

import multiprocessing
import statistics
import tempfile
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

from benchmarks.paper_equations import SIMULATED, seconds_a_period
from benchmarks.press import CASE
from jointplay.client import Client
from jointplay.service.processes import running_service
from jointplay.solver.kinds import Study, admit
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.runs.study.run import StudyRun

VALUES, SETTLE, RECORD = 200, 100, 50
PERIODS = VALUES * (SETTLE + RECORD)
REPEATS = 3


def document(values: int = VALUES, settle: int = SETTLE, record: int = RECORD) -> dict[str, Any]:
    """Return the job."""
    return {
        "kind": "bifurcation",
        "scene": {"preset": "seven-bar-press", "parameters": CASE},
        "parameter": "clearance",
        "values": {"from": 1e-4, "to": 1e-3, "count": values, "spacing": "linear"},
        "settle": settle,
        "record": record,
        "tolerance": 1e-6,
    }


def over_http(workers: int, values: int = VALUES) -> list[float]:
    """Return the seconds from request to finished array of repeated jobs."""
    seconds = []
    with (
        tempfile.TemporaryDirectory() as folder,
        running_service(Path(folder), workers) as url,
        Client(url) as client,
    ):
        client.submit(document(16 * workers, 2, 2)).wait()
        for _ in range(REPEATS):
            job = document(values) | {"cache": False}  # computed each time, not found
            begun = time.perf_counter()
            found = client.submit(job).wait()
            seconds.append(time.perf_counter() - begun)
            if found.state != "succeeded":
                raise SystemExit(f"the job {found.state}: {found.error}")
    return seconds


def in_kernels() -> tuple[float, float, float]:
    """Return seconds in kernels, seconds in all, and the share of useful evaluations."""
    study = admit(document())
    assert isinstance(study, Study)
    spent = [0.0]
    original: Callable[[Bundle, int], int] = Bundle.advance

    def timed(bundle: Bundle, budget: int) -> int:
        begun = time.perf_counter()
        running = original(bundle, budget)
        spent[0] += time.perf_counter() - begun
        return running

    Bundle.advance = timed  # type: ignore[assignment, method-assign]
    useful = attempts = 0.0
    begun = time.perf_counter()
    for block in range(len(study.blocks)):
        run = StudyRun(study, block)
        for piece in run.slices():
            for end in piece.ended:
                useful += end.statistics["steps"] + end.statistics["rejections"]
        assert run.group is not None
        attempts += 8.0 * run.group.bundle.attempts
    total = time.perf_counter() - begun
    Bundle.advance = original  # type: ignore[assignment, method-assign]
    return spent[0], total, useful / attempts


def kernels_beside() -> float:
    """Return seconds in kernels where two processes compute the diagram at once, each all of it."""
    with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn")) as pool:
        both = [pool.submit(in_kernels) for _ in range(2)]
        return statistics.mean(each.result()[0] for each in both)


def with_scipy() -> float:
    """Return seconds a period on the paper's equations."""
    study = admit(document())
    assert isinstance(study, Study)
    return seconds_a_period(study.point_scene(VALUES // 2))


def main() -> None:
    """Print the table."""
    scipy = with_scipy()
    hours = scipy * PERIODS / 3600.0
    print(f"SciPy RK45 on the paper's equations: {scipy:.1f} s a period, scaled from"
          f" {SIMULATED:g} s of motion: {hours:.0f} h for the diagram")  # fmt: skip
    kernels, alone, useful = in_kernels()
    print(f"{VALUES} values x {SETTLE + RECORD} periods; medians of {REPEATS}, best in brackets")
    print(
        f"one process: {alone:.2f} s, of it in kernels {kernels:.2f} s,"
        f" {1e3 * kernels / PERIODS:.3f} ms a period; useful evaluations {useful:.1%}"
    )
    beside = kernels_beside()
    print(f"two processes at once, each all of it: {beside:.2f} s in kernels")
    medians = {}
    for workers, spent in ((1, kernels), (2, beside)):
        seconds = over_http(workers)
        medians[workers] = statistics.median(seconds)
        share = spent / (workers * medians[workers])
        print(
            f"{workers} worker{'s' if workers > 1 else ' '} over HTTP: {medians[workers]:6.2f} s"
            f" ({min(seconds):.2f}); in kernels {share:.0%}"
        )
    groups = -(-VALUES // 8)
    print(
        f"two workers are {medians[1] / medians[2]:.2f} times as fast as one; {groups} groups of"
        f" eight points allow {groups / -(-groups // 2):.2f}"
    )
    one, two = (statistics.median(over_http(workers, 2 * VALUES)) for workers in (1, 2))
    print(f"with {2 * VALUES} values: {one:.2f} and {two:.2f} s, {one / two:.2f} times")


if __name__ == "__main__":
    main()
