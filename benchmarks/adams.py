"""A lane-wise Adams method beside Tsitouras 5, on the press of `benchmarks.peers`, in one run.

    python -m benchmarks adams

Variable step and order, predict-evaluate-correct-evaluate (`benchmarks.adams_step`); contacts begin
and end on located onsets and openings, which start it anew. Eight presses, radial clearance 0.3 to
0.6 mm; medians over them of the errors at 0.03 s against runs at 1e-13 (largest of coordinates and
of speeds), and of the energy astray after a revolution (share of what contacts and friction took).
Processor time a revolution and lane, alone (0.5 mm) and with eight lanes busy: the best of repeated
runs, all methods in turn; last, the time with lanes busy in that of Tsitouras 5 at equal errors, by
each of the three, between its measured tolerances. All keep the ledger; none looks for peaks.
"""

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from benchmarks.adams_lanes import Adams, adams_of
from benchmarks.peers import CHECK_TIME, REVOLUTION, errors, problem
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kernels.loop.bundle import Bundle
from jointplay.solver.kernels.loop.failures import ledger_of
from jointplay.solver.kernels.loop.state import Counter

OURS = "Tsitouras 5"
TOLERANCES = (1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10)
HIGHEST_ORDERS = (4, 5, 8)
CLEARANCES = tuple(float(clearance) for clearance in np.linspace(3e-4, 6e-4, 8))
REPEATS = 7

Run = Callable[[Bundle], tuple[float, np.ndarray]]
"""Advances a bundle to its end; processor seconds, and evaluations of the slopes in each lane."""


def by_tsitouras(bundle: Bundle) -> tuple[float, np.ndarray]:
    """Run a bundle as it is."""
    begun = time.process_time()
    while bundle.advance(10_000_000):
        pass
    seconds = time.process_time() - begun
    attempts = bundle.table("steps")[0] + bundle.counters[Counter.REJECTIONS]
    return seconds, (bundle.kernel.tableau.stages - 1) * attempts


def by_adams(adams: Adams) -> Run:
    """Return what runs a bundle by the Adams method."""

    def run(bundle: Bundle) -> tuple[float, np.ndarray]:
        work = adams.begin(bundle)
        begun = time.process_time()
        adams.finish(bundle, work)
        seconds = time.process_time() - begun
        return seconds, 2.0 * work[adams.recorder.layout["attempts"]]

    return run


def bundle_of(
    kernel: Kernel, tolerance: float, clearances: tuple[float, ...], end: float
) -> Bundle:
    """Return presses about to start."""
    return Bundle(kernel, [problem(c, tolerance, end) for c in clearances], watch=False)


def states_at_check(kernel: Kernel, run: Run, tolerance: float) -> np.ndarray:
    """Return coordinates and speeds (states, presses) at `CHECK_TIME`."""
    bundle = bundle_of(kernel, tolerance, CLEARANCES, CHECK_TIME)
    run(bundle)
    return bundle.table("y0", kernel.states).copy()


def astray(bundle: Bundle) -> float:
    """Return the median over the lanes of the energy that a run lost track of."""
    ledgers = [ledger_of(bundle, lane) for lane in range(len(CLEARANCES))]
    taken = [each["contact_loss"] + each["friction_loss"] for each in ledgers]
    return float(np.median([abs(e["residual"]) / t for e, t in zip(ledgers, taken, strict=True)]))


@dataclass(frozen=True)
class Row:
    """A method at a tolerance: evaluations a lane, errors and energy astray, seconds."""

    evaluations: float
    errors: tuple[float, float, float]
    alone: float
    busy: float


def measure(kernel: Kernel, runs: dict[str, Run], tolerance: float) -> dict[str, Row]:
    """Measure all methods at a tolerance, in turn."""
    alone: dict[str, list[float]] = {name: [] for name in runs}
    busy: dict[str, list[float]] = {name: [] for name in runs}
    made: dict[str, float] = {}
    lost: dict[str, float] = {}
    for _ in range(REPEATS):
        for name, run in runs.items():
            alone[name].append(run(bundle_of(kernel, tolerance, (5e-4,), REVOLUTION))[0])
            bundle = bundle_of(kernel, tolerance, CLEARANCES, REVOLUTION)
            seconds, evaluations = run(bundle)
            busy[name].append(seconds / len(CLEARANCES))
            made[name], lost[name] = float(np.mean(evaluations)), astray(bundle)
    reference = states_at_check(kernel, by_tsitouras, 1e-13)
    rows = {}
    for name, run in runs.items():
        found = states_at_check(kernel, run, tolerance)
        apart = [errors(one, other) for one, other in zip(found.T, reference.T, strict=True)]
        position, velocity = np.median(apart, axis=0)
        all_errors = (float(position), float(velocity), lost[name])
        rows[name] = Row(made[name], all_errors, min(alone[name]), min(busy[name]))
    return rows


def in_ours(row: Row, ours: list[Row]) -> list[float]:
    """Return a row's time in that of ours at equal errors; not a number where none are."""
    ratios = []
    for kind in range(3):
        known = sorted((each.errors[kind], each.busy) for each in ours)
        place, times = np.log(known).T
        at = np.interp(np.log(row.errors[kind]), place, times, left=np.nan, right=np.nan)
        ratios.append(float(row.busy / np.exp(at)))
    return ratios


def main() -> None:
    """Print the table."""
    kernel = ready_kernel(problem(5e-4, 1e-6, REVOLUTION).scene, "reduced")
    runs: dict[str, Run] = {OURS: by_tsitouras}
    runs |= {f"Adams to order {k}": by_adams(adams_of(kernel, k)) for k in HIGHEST_ORDERS}
    table = {tolerance: measure(kernel, runs, tolerance) for tolerance in TOLERANCES}
    ours = [rows[OURS] for rows in table.values()]
    print("tolerance  method             evaluations  position  velocity    astray", end="")
    print("  ms alone   busy   of ours at equal errors")
    for name in runs:
        for tolerance, rows in table.items():
            row = rows[name]
            print(f"{tolerance:9.0e}  {name:18} {row.evaluations:11.0f}", end="")
            print("".join(f"{error:10.1e}" for error in row.errors), end="")
            print(f"{1e3 * row.alone:10.2f} {1e3 * row.busy:6.2f}   ", end="")
            print(*(f"{ratio:5.2f}" for ratio in in_ours(row, ours) if name != OURS))


if __name__ == "__main__":
    main()
