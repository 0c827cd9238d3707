"""A claim that was wrong once: the job that made it, and what holds it to the truth."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from benchmarks.lies.covered import Tell, coverage_of
from benchmarks.lies.extremes import extremes_of
from benchmarks.lies.tables import percent

COVERED = 0.95
"""Least share of errors that bars must cover in a single run."""
FARTHEST = 3.0
"""Largest error of all, in bars: what a bar leaves out by chance, it leaves out by little."""


@dataclass(frozen=True)
class Found:
    """Whether a claim is true now, and a sentence of what was found."""

    true: bool
    said: str


@dataclass(frozen=True)
class Lie:
    """A claim by its name, what was wrong with it, and how it is judged."""

    name: str
    was: str
    judge: Callable[[], Found]


def by_bars(job: dict[str, Any], tell: Tell | None = None) -> Found:
    """Judge a job's error bars against the independent program, or against who else tells."""
    verdict = coverage_of(job, tell)
    true = verdict.ended == "judged" and verdict.covered >= COVERED and verdict.worst <= FARTHEST
    said = f"{verdict.ended}, {percent(verdict.covered)} inside, worst {verdict.worst:.3g} bars"
    return Found(true, f"{said} ({verdict.where})")


def by_extremes(job: dict[str, Any]) -> Found:
    """Judge a job's extremes against its samples."""
    found = extremes_of(job)
    true = found.ended == "judged" and found.right == found.extremes
    return Found(true, f"{found.ended}, off by {found.worst:.2g} of its range ({found.where})")
