"""The ends of the ranges: small jobs, by family, that tests and the table of outcomes run.

Nearly all share three compiled kernels, those of the presets `bouncing-journal`, `slider-crank` and
`seven-bar-press`: what they are about is the motion.
"""

from benchmarks.extreme_cases import laws, motions, starts
from benchmarks.extreme_cases.case import Case, Outcome, outcome_of
from benchmarks.extreme_cases.truth import Coverage, coverage_of

__all__ = ["ALL", "Case", "Coverage", "Outcome", "coverage_of", "outcome_of"]

ALL: tuple[Case, ...] = (*laws.cases(), *motions.cases(), *starts.cases())
