"""Peers: what a user would write instead, beside a bare run of ours, at equal error, in one run.

    taskset -c 0 python -m benchmarks peers

One core, because threads of JAX that only wait take processor time on a second one.
The press with stiffness from its elastic constants, bearing radius 10 mm, restitution 0.9, friction
0.1, limit velocities 1e-3 and 1e-2 m/s, clearance 0.5 mm, over one revolution of 2 s on one core.
SciPy's methods and CVODE (if `pip install scikit-sundae` was done) get our compiled right-hand
side, diffrax (`pip install diffrax jax`) the same equations as a JAX function, vmapped over eight
clearances; all these restart at located onsets and releases. EXUDYN (`pip install exudyn`) gets the
press as a kinematic tree, contact in Python; the paper's equations are all in Python. Errors are
the largest of all coordinates and speeds at 0.03 s against a run at 1e-13. A peer is compared with
our cheapest run whose errors are no larger, alone or with eight lanes busy as the peer is. Times
are of the processor, a revolution and lane, without compiling.
"""

import statistics
import time
from dataclasses import dataclass, replace

import numpy as np

from benchmarks import press
from benchmarks.busy_lanes import CLEARANCES, busy_lanes
from benchmarks.paper_equations import seconds_a_period
from benchmarks.peer_diffrax import measure_diffrax
from benchmarks.peer_exudyn import measure_exudyn
from benchmarks.peer_legs import CompiledEquations, Leg, by_legs, cvode_leg, scipy_leg
from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.lanes.bundle import Bundle
from jointplay.solver.lanes.problem import LaneProblem
from jointplay.solver.scene.document import Scene

CASE = {
    "bearing_radius": 0.01,
    "restitution": 0.9,
    "friction": 0.1,
    "static_velocity": 1e-3,
    "dynamic_velocity": 1e-2,
}
REVOLUTION, CHECK_TIME = 2.0, 0.03
TOLERANCES = (1e-5, 1e-6, 1e-7, 1e-8, 1e-9)
EXUDYN_RUNS = (*(("DOPRI5", tolerance) for tolerance in (1e-4, 1e-6, 1e-8, 1e-10)), ("RK44", 1e-5))
"""Tolerances, and a fixed step in s."""
REPEATS = 9


@dataclass(frozen=True)
class Measured:
    """One way of computing the revolution."""

    name: str
    tolerance: float
    seconds: float
    evaluations: float
    position_error: float
    velocity_error: float


def problem(clearance: float, tolerance: float, duration: float) -> LaneProblem:
    """Return the case for one lane, without outputs."""
    found = press.problem(clearance, tolerance, duration, CASE)
    return replace(found, output_step=duration, samples=0, sections=0)


def ours(
    kernel: Kernel, tolerance: float, clearances: list[float], reference: np.ndarray
) -> Measured:
    """Measure bare runs, one alone or a queue for eight lanes; seconds a revolution and lane."""
    problems = [problem(clearance, tolerance, REVOLUTION) for clearance in clearances]
    runs = [busy_lanes(kernel, problems, watch=False) for _ in range(REPEATS)]
    seconds, made = (statistics.median(column) for column in zip(*runs, strict=True))
    name = "ours, alone" if len(problems) == 1 else "ours, 8 lanes busy"
    found = errors(at_check(kernel, tolerance), reference)
    return Measured(name, tolerance, seconds, (kernel.tableau.stages - 1) * made, *found)


def at_check(kernel: Kernel, tolerance: float) -> np.ndarray:
    """Return our coordinates and speeds at `CHECK_TIME`."""
    bundle = Bundle(kernel, [problem(5e-4, tolerance, CHECK_TIME)], watch=False)
    while bundle.advance(10_000_000):
        pass
    return bundle.lane(0)["y"].copy()


def errors(found: np.ndarray, reference: np.ndarray) -> tuple[float, float]:
    """Return the largest error of a coordinate and of a speed."""
    error, half = np.abs(found - reference), len(reference) // 2
    return float(error[:half].max()), float(error[half:].max())


def peer(
    name: str, tolerance: float, equations: CompiledEquations, leg: Leg, reference: np.ndarray
) -> Measured:
    """Measure a peer."""
    found = by_legs(equations, leg, CHECK_TIME)
    equations.evaluations = 0
    begun = time.process_time()
    by_legs(equations, leg, REVOLUTION)
    seconds = time.process_time() - begun
    return Measured(name, tolerance, seconds, equations.evaluations, *errors(found, reference))


def diffrax(
    kernel: Kernel, tolerance: float, clearances: list[float], reference: np.ndarray
) -> Measured | None:
    """Measure diffrax on eight lanes, errors in one of 0.5 mm; none where it is not installed."""
    problems = [problem(each, tolerance, REVOLUTION) for each in (5e-4, *clearances[1:])]
    found = measure_diffrax(kernel, problems, CHECK_TIME, REVOLUTION)
    if found is None:
        return None
    seconds, evaluations, states = found
    wrong = errors(states[0], reference)
    return Measured("diffrax Tsit5, 8 lanes", tolerance, seconds, evaluations, *wrong)


def exudyn(
    scene: Scene, start: np.ndarray, method: str, size: float, reference: np.ndarray
) -> Measured | None:
    """Measure EXUDYN at a tolerance, or with a step in s; none where it is not installed."""
    checked = measure_exudyn(scene, start, method, size, CHECK_TIME)
    found = measure_exudyn(scene, start, method, size, REVOLUTION)
    if checked is None or found is None:
        return None
    name = "EXUDYN RK44, step in s" if method == "RK44" else f"EXUDYN {method}"
    return Measured(name, size, found[0], found[1], *errors(checked[2], reference))


def main() -> None:
    """Print the table."""
    scene = problem(5e-4, 1e-6, REVOLUTION).scene
    kernel = ready_kernel(scene, "reduced")
    reference = at_check(kernel, 1e-13)
    lanes = [float(clearance) for clearance in np.linspace(3e-4, 6e-4, 8)]
    alone = [ours(kernel, tolerance, [5e-4], reference) for tolerance in TOLERANCES]
    busy = [ours(kernel, tolerance, CLEARANCES, reference) for tolerance in TOLERANCES]
    print(f"{'':22} tolerance  ms a revolution  evaluations  position  velocity   times ours")
    for row in alone + busy:
        print(line(row))
    equations = CompiledEquations(kernel, problem(5e-4, 1e-6, REVOLUTION))
    for tolerance, method in (
        *((1e-6, method) for method in ("RK45", "DOP853", "LSODA", "Adams", "BDF")),
        *((1e-8, method) for method in ("DOP853", "LSODA", "Adams")),
    ):
        library = "CVODE" if method in ("Adams", "BDF") else "SciPy"
        legs = cvode_leg if library == "CVODE" else scipy_leg
        leg = legs(equations, method, tolerance)
        if leg is None:
            print(f"CVODE {method} at {tolerance:g}: scikit-sundae is not installed")
            continue
        row = peer(f"{library} {method}", tolerance, equations, leg, reference)
        print(line(row, alone), flush=True)
    for tolerance in (1e-6, 1e-8):
        row_of_eight = diffrax(kernel, tolerance, lanes, reference)
        if row_of_eight is None:
            print(f"diffrax Tsit5 at {tolerance:g}: diffrax is not installed")
            continue
        print(line(row_of_eight, busy), flush=True)
    for method, size in EXUDYN_RUNS:
        row_of_tree = exudyn(scene, equations.start, method, size, reference)
        if row_of_tree is None:
            print(f"EXUDYN {method} at {size:g}: exudyn is not installed")
            continue
        print(line(row_of_tree, alone), flush=True)
    plain = seconds_a_period(scene)
    fastest = next(row.seconds for row in alone if row.tolerance == 1e-6)
    print(
        f"the paper's equations in Python under SciPy RK45 at 1e-6: {plain:.1f} s a revolution,"
        f" {plain / fastest:.0f} times ours at 1e-6"
    )


def line(row: Measured, rows: list[Measured] | None = None) -> str:
    """Return a row of the table; a peer's with its ratio to ours at no larger errors."""
    text = (
        f"{row.name:22} {row.tolerance:9.0e} {1e3 * row.seconds:16.2f} {row.evaluations:12.0f}"
        f" {row.position_error:9.1e} {row.velocity_error:9.1e}"
    )
    equal = [
        own
        for own in rows or ()
        if own.position_error <= row.position_error and own.velocity_error <= row.velocity_error
    ]
    if equal:
        best = min(equal, key=lambda own: own.seconds)
        text += f"   {row.seconds / best.seconds:6.0f}  (ours at {best.tolerance:.0e})"
    return text


if __name__ == "__main__":
    main()
