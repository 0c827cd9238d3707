"""Random soft contacts at all accuracies, and what their runs miss."""

from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

import numpy as np

from benchmarks.lies.draw import Draw, anywhere
from benchmarks.openings.judgement import Judgement, judge
from benchmarks.openings.runs import Ran, run
from benchmarks.openings.soft_contacts import soft_contact
from jointplay.solver.kernels.layout import BUNDLE

SETTINGS: dict[str, dict[str, Any]] = {
    "draft": {"accuracy": "draft"},
    "standard": {"accuracy": "standard"},
    "fine": {"accuracy": "fine"},
    "reference": {"accuracy": "reference"},
    "long steps": {"method": "dormand-prince-853", "tolerance": 1e-4},
    "implicit": {"method": "rodas", "tolerance": 1e-6},
}
"""All accuracies, and the methods that no accuracy names."""
TRUTH = {"method": "tsitouras", "tolerance": 1e-13}


class Searched(NamedTuple):
    """A job with one of the settings, and the judgement of its run."""

    setting: str
    job: dict[str, Any]
    ended: str
    """``judged``, or who failed."""
    judgement: Judgement
    ajar: float
    """The largest gap at an instant inside a contact, m."""


def soft_contacts(seed: int, count: int) -> list[dict[str, Any]]:
    """Return jobs, the same for the same seed."""
    random = np.random.default_rng(seed)
    return [soft_contact(Draw(anywhere(random))) for _ in range(count)]


def search(jobs: list[dict[str, Any]], settings: Iterable[str] = SETTINGS) -> Iterator[Searched]:
    """Judge the runs of jobs with some of the settings."""
    rubbed = [job for job in jobs if _friction(job) > 0.0]
    smooth = [job for job in jobs if _friction(job) == 0.0]
    for alike in (rubbed, smooth):  # two structures
        for first in range(0, len(alike), BUNDLE):
            some = alike[first : first + BUNDLE]
            truths = run([job | TRUTH for job in some])
            for name in settings:
                chosen = [job | SETTINGS[name] for job in some]
                for job, found, truth in zip(chosen, run(chosen), truths, strict=True):
                    yield _searched(name, job, found, truth)


def _friction(job: dict[str, Any]) -> float:
    return float(job["scene"]["joints"]["J"]["clearance"]["friction"]["coefficient"])


def _searched(setting: str, job: dict[str, Any], found: Ran, truth: Ran) -> Searched:
    if not (found.done and truth.done):
        ended = "the run failed" if truth.done else "the truth failed"
        return Searched(setting, job, ended, Judgement(0, (), (), 0.0), 0.0)
    clearance = job["scene"]["joints"]["J"]["clearance"]["radial_clearance"]
    judgement = judge(found, truth, clearance)
    return Searched(setting, job, "judged", judgement, found.open_in_contact)
