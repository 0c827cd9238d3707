"""A calibration as a study of one point: the best candidate."""

from dataclasses import dataclass

from jointplay.solver.calibration.document import CHAINS
from jointplay.solver.calibration.problem import Calibration
from jointplay.solver.runs.study.plan import Study

BYTES_PER_NUMBER, BYTES_PER_TARGET = 24, 512
"""Sizes in the document of results, before compression."""


@dataclass(frozen=True, eq=False)
class CalibrationStudy(Study):
    """A study whose one point is the best candidate; its document has all that was found."""

    calibration: Calibration


def best_of(parameter: str) -> str:
    """Return the name of the number that a parameter was found to be."""
    return f"best_{parameter}"


def result_bytes(calibration: Calibration) -> int:
    """Return about how many bytes the document of results takes."""
    numbers = CHAINS * len(calibration.space.names) + calibration.search.generations
    targets = sum(len(case.targets) for case in calibration.cases)
    return BYTES_PER_NUMBER * numbers + BYTES_PER_TARGET * targets
