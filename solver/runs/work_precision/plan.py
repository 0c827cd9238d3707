"""The runs of an accuracy-study: two references, then every method at every tolerance."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from jointplay.records.energy_residual import RELATIVE_ENERGY_RESIDUAL
from jointplay.solver.integrators import AUTO, COARSE, METHODS
from jointplay.solver.runs.study.plan import Study

REFERENCES = (AUTO.name, COARSE.name)
"""Methods of the two reference runs: those of highest order."""
REFERENCE = 1e-13
"""Their tolerance."""
DEFAULT = (AUTO.name, 1e-6)
"""Always among the runs: the recommendation is relative to it."""
WITHOUT_PERIOD = 1.0
"""s that stand for the period of a scene without turning drivers."""
GRID = 1e-4
"""Longest fixed step, of a period: the 0.2 ms grid on a press that turns in 2 s."""
FINER = (1, 2, 4, 10, 20, 40)

OUTPUTS = {
    "error": (
        "1",
        "root mean square error of coordinates and speeds over the window, relative to the scales"
        " that tolerances are relative to; of the second reference, how far the two are apart",
    ),
    "window": ("s", "time from the start in which the reference is known"),
    RELATIVE_ENERGY_RESIDUAL: ("1", "energy residual divided by what contacts and friction took"),
    "evaluations": ("1", "evaluations of the equations of motion, in attempted steps"),
    "seconds": ("s", "computing time of one core; not the same when it is measured again"),
}
"""Unit and long name of what each run has beside its accepted steps."""


@dataclass(frozen=True)
class Run:
    """A method at a tolerance, or with a fixed step, s."""

    method: str
    tolerance: float | None
    step: float | None = None
    reference: bool = False

    @property
    def admitted(self) -> bool:
        """Whether jobs may ask for it."""
        return self.tolerance is None or self.tolerance <= METHODS[self.method].largest_tolerance

    def evaluations(self, period: float) -> float:
        """Return about how many a period takes, to weigh runs against each other."""
        method = METHODS[self.method]
        if self.tolerance is None:
            return method.evaluations(0) * period / (self.step or period)
        # near rounding some steps are refused: up to four times as many
        return (1.5 if self.reference else 1.0) * method.evaluations_at(self.tolerance)

    def document(self) -> dict[str, Any]:
        """Return the run as a store keeps it."""
        return asdict(self) | {"admitted": self.admitted}


def runs_of(job: Mapping[str, Any], period: float) -> tuple[Run, ...]:
    """Return the runs of a filled-in job in the order of computing.

    `period` : of the drivers, s.
    """
    found = [Run(method, REFERENCE, reference=True) for method in REFERENCES]
    for name in job["methods"]:
        if METHODS[name].fixed_step:
            found += [Run(name, None, GRID * period / finer) for finer in FINER]
        else:
            found += [Run(name, tolerance) for tolerance in job["tolerances"]]
    default = Run(*DEFAULT)
    return tuple(found if default in found else [*found, default])


@dataclass(frozen=True, eq=False)
class WorkPrecisionStudy(Study):
    """A study whose points are runs of several methods, computed one after the other.

    Their seconds can be compared, since one worker computes them all: there is one block.
    """

    runs: tuple[Run, ...]
    """By point; the first are the references."""

    def attributes(self) -> dict[str, Any]:
        """Return the runs as a store keeps them."""
        return {"runs": [run.document() for run in self.runs]}
