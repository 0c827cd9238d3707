"""Ways in which the product computes a mechanism, measured: a program that is asked by name.

The case is its argument, names of ways are lines of its input, measurements lines of its output. It
reads the installed package alone, so that an earlier one runs the same text.
"""

import json
import sys
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from jointplay.solver.kernels.emit.kernel import Kernel
from jointplay.solver.kernels.kernel_cache import ready_kernel
from jointplay.solver.kinds import Admission, admit
from jointplay.solver.version import SOLVER_VERSION

try:
    from jointplay.solver.lanes.bundle import Bundle
    from jointplay.solver.lanes.problem import LaneProblem
except ModuleNotFoundError:  # of versions that had them in the loop
    from jointplay.solver.kernels.loop.bundle import Bundle  # type: ignore[import-not-found,no-redef]
    from jointplay.solver.kernels.loop.problem import LaneProblem  # type: ignore[import-not-found,no-redef]

BUNDLE = 8
SETTLING, STEADY = 30_000, 10_000
"""Attempts at a step: until the motion is steady, and in one measurement of it."""
ENDLESS = 1e4
"""Periods that are more than any measurement lasts."""


@dataclass(frozen=True)
class Case:
    """Runs of one preset that differ in their parameters."""

    preset: str
    parameters: tuple[dict[str, float], ...]
    period: float
    """s."""
    tolerance: float = 1e-6

    def job(self, index: int, periods: float = 1.0) -> dict[str, Any]:
        """Return a run as a job of so many periods."""
        scene = {"preset": self.preset, "parameters": self.parameters[index]}
        duration = periods * self.period
        return {
            "kind": "simulate",
            "scene": scene,
            "duration": duration,
            "tolerance": self.tolerance,
            "output_step": duration,
        }

    def problems(self, every: int = 1, periods: float = 1.0) -> list[LaneProblem]:
        """Return each run, or every n-th, as the problem of a lane: no samples, no sections."""
        chosen = range(0, len(self.parameters), every)
        duration = periods * self.period
        scenes = (admitted(self.job(i, periods)).scene for i in chosen)
        less: dict[str, Any] = (
            {"ledger": False} if "ledger" in LaneProblem.__dataclass_fields__ else {}
        )
        return [
            LaneProblem(s, duration, self.tolerance, duration, 0, 0, 0.0, **less) for s in scenes
        ]

    def kernel(self, *, alone: bool = False) -> Kernel:
        """Return the compiled kernel of all runs; `alone`: as for a run that has none beside it."""
        [problem, *_] = self.problems(len(self.parameters))
        if alone and "alone" in (ready_kernel.__kwdefaults__ or {}):
            return ready_kernel(problem.scene, "reduced", "tsitouras", alone=True)
        return ready_kernel(problem.scene, "reduced", "tsitouras")


def admitted(job: dict[str, Any]) -> Admission:
    """Return a simulation, filled in."""
    admission = admit(job)
    assert isinstance(admission, Admission)
    return admission


@dataclass(frozen=True)
class Measured:
    """Work that was computed, and its time of the processor."""

    seconds: float
    steps: float
    """Accepted ones, of all runs."""
    periods: float
    """Simulated, of all runs."""


Way = Callable[[], Measured]


def study(case: Case, kernel: Kernel, *, foretold: bool = False, **options: Any) -> Way:
    """Return the first periods of all runs, which take turns in the lanes.

    `foretold` : all extremes are known when a run begins, but for a millionth of their ranges.
    """
    problems = case.problems()
    known: dict[int, dict[str, NDArray[np.float64]]] = {}
    """By run."""

    def measure() -> Measured:
        bundle, waiting = Bundle(kernel, **options), list(range(len(problems)))
        taken: dict[int, int] = {}
        """Run of each lane."""
        seconds, steps = 0.0, 0
        while taken or waiting:
            for lane in [lane for lane in range(BUNDLE) if lane not in taken][: len(waiting)]:
                run = taken[lane] = waiting.pop(0)
                bundle.load(lane, problems[run])
                for name, values in known.get(run, {}).items():
                    bundle.lane(lane)[name] = values
            begun = time.process_time()
            bundle.advance(10_000_000)
            seconds += time.process_time() - begun
            for lane in [lane for lane in taken if not bundle.lane(lane).running]:
                steps += bundle.lane(lane).steps
                run = taken.pop(lane)
                if foretold and run not in known:
                    known[run] = _nearly(bundle.lane(lane)["lowest"], bundle.lane(lane)["highest"])
        return Measured(seconds, steps, len(problems))

    if foretold:
        measure()
    return measure


def _nearly(
    lowest: NDArray[np.float64], highest: NDArray[np.float64]
) -> dict[str, NDArray[np.float64]]:
    """Return extremes that are a millionth of each range short of these."""
    spread = highest - lowest
    short = 1e-6 * np.where(np.isfinite(spread), spread, 0.0)  # of what is sought, and was seen
    return {"lowest": lowest + short, "highest": highest - short}


def steady(case: Case, kernel: Kernel, *, exponents: bool = False, **options: Any) -> Way:
    """Return eight lanes of runs that last, once they have settled."""
    if exponents:
        from jointplay.solver.kernels.emit.tangents import compile_tangents

        options["tangents"] = compile_tangents(kernel)
    problems = case.problems(len(case.parameters) // BUNDLE, ENDLESS)
    bundle = Bundle(kernel, problems, **options)
    bundle.advance(SETTLING)

    def reached() -> tuple[int, float]:
        lanes = [bundle.lane(i) for i in range(BUNDLE)]
        return sum(lane.steps for lane in lanes), sum(lane.time for lane in lanes)

    def measure() -> Measured:
        steps, simulated = reached()
        begun = time.process_time()
        for _ in range(10):  # buffers of contacts are read in between
            bundle.advance(STEADY // 10)
        seconds = time.process_time() - begun
        now, later = reached()
        return Measured(seconds, now - steps, (later - simulated) / case.period)

    return measure


def alone(case: Case, _kernel: Kernel, **options: Any) -> Way:
    """Return the first periods of eight runs, one after the other."""
    kernel = case.kernel(alone=True)
    problems = case.problems(len(case.parameters) // BUNDLE)

    def measure() -> Measured:
        seconds, steps = 0.0, 0
        for problem in problems:
            bundle = Bundle(kernel, [problem], **options)
            begun = time.process_time()
            while bundle.advance(10_000_000):
                pass
            seconds += time.process_time() - begun
            steps += bundle.lane(0).steps
        return Measured(seconds, steps, len(problems))

    return measure


def job(case: Case, _kernel: Kernel, *, certificate: bool) -> Way:
    """Return jobs of one period each, as they are computed with all that results hold."""
    from jointplay.solver.runs.simulate import Simulation

    admissions = [
        admitted(case.job(i) | {"certificate": certificate})
        for i in range(0, len(case.parameters), len(case.parameters) // BUNDLE)
    ]

    def measure() -> Measured:
        seconds, steps = 0.0, 0
        for admission in admissions:
            simulation = Simulation(admission)
            begun = time.process_time()
            for _ in simulation.slices():
                pass
            simulation.certificate()
            seconds += time.process_time() - begun
            steps += int(simulation.summary().statistics["steps"])
        return Measured(seconds, steps, len(admissions))

    return measure


WAYS: dict[str, Callable[[Case, Kernel], Way]] = {
    "study": partial(study, watch=False),
    "study, extremes": partial(study, watch=True),
    "study, foretold": partial(study, watch=True, foretold=True),
    "steady": partial(steady, watch=False),
    "steady, extremes": partial(steady, watch=True),
    "steady, exponents": partial(steady, watch=False, exponents=True),
    "alone": partial(alone, watch=False),
    "alone, extremes": partial(alone, watch=True),
    "alone, kept steps": partial(alone, watch=False, keep_steps=True),
    "job": partial(job, certificate=False),
    "job, certificate": partial(job, certificate=True),
}


def answer(case: Case, kernel: Kernel, ready: dict[str, Way], name: str) -> dict[str, Any]:
    """Return a measurement; of a way that is new a first one, or what it lacks."""
    if name in ready:
        return asdict(ready[name]())
    try:
        ready[name] = WAYS[name](case, kernel)
        return asdict(ready[name]())
    except (ImportError, AttributeError, TypeError, KeyError) as error:
        return {"lacking": f"{type(error).__name__}: {error}"}


def main() -> None:
    """Answer until there are no more lines."""
    given = json.loads(sys.argv[1])
    case = Case(**given | {"parameters": tuple(given["parameters"])})
    kernel, ready = case.kernel(), dict[str, Way]()
    lanes = Bundle(kernel).groups[0].work.shape[1]
    print(json.dumps({"version": SOLVER_VERSION, "lanes": lanes}), flush=True)
    for line in sys.stdin:
        print(json.dumps(answer(case, kernel, ready, line.strip())), flush=True)


if __name__ == "__main__":
    main()
