"""The searches for lies: repeatable, and their measures see what is wrong."""

import math
from typing import Any

import numpy as np
import pytest

from benchmarks.lies.climbing import Found, climb
from benchmarks.lies.contacts import contacts_hold
from benchmarks.lies.draw import DIMENSIONS, anywhere
from benchmarks.lies.extremes import beyond
from benchmarks.lies.job import random_job
from benchmarks.lies.measures import MEASURES
from benchmarks.lies.scenes import EVERY, LOOSE, SCENES
from benchmarks.lies.search import report, search
from jointplay.solver.integrators import METHODS
from jointplay.solver.kinds import Admission, admit

TIME = np.linspace(0.0, 1.0, 1001)
PRESETS = ["bouncing-journal", "slider-crank", "seven-bar-press"]
"""Whose kernels other tests compile, too."""
SLOT, GUIDE = ["slot of a rocker, bristles"], ["slider-crank, guide, motor"]
"""A slot with bristles; a guide with a journal and a motor."""


def test_a_climb_repeats_itself_and_comes_closer_to_the_worst() -> None:
    def looked(seed: int) -> list[float]:
        seen: list[float] = []

        def look(point: list[float]) -> Found:
            badness = -math.dist(point[:3], (0.3, 0.7, 0.9))
            seen.append(badness)
            return Found("all", 3, badness)

        climb(seed, 200, look)
        return seen

    found = looked(1)
    assert found == looked(1) != looked(2)
    assert max(found[100:]) > max(found[:20])


@pytest.mark.parametrize("kind", EVERY)
def test_every_random_job_is_admitted(kind: str) -> None:
    random = np.random.default_rng(3)
    seen = set()
    for _ in range(20):
        chosen = random_job(anywhere(random), [kind])
        assert chosen.kind == kind
        assert 4 < chosen.drawn <= DIMENSIONS
        assert isinstance(admit(chosen.job), Admission)
        seen.add(chosen.job["method"])
    assert len(seen) > (1 if kind in LOOSE else len(METHODS) / 2)


@pytest.mark.parametrize("shape", [np.sin(7.0 * TIME), -np.abs(TIME - 0.40033)])
def test_a_highest_value_between_samples_is_right(shape: np.ndarray) -> None:
    # between two samples, 1e-3 apart, the sine rises by 49 (1e-3)² / 8, the corner by 3.3e-4
    highest = 1.0 if shape[1] > 0.0 else 0.0
    assert beyond(highest, shape) == 0.0


def test_a_highest_value_that_is_invented_is_seen() -> None:
    shape = np.sin(7.0 * TIME)
    assert beyond(1.1, shape) == pytest.approx(0.1, abs=1e-4)
    assert beyond(1.0, shape[600:]) > 0.2  # not where it is said to be


@pytest.mark.parametrize(
    ("own", "true", "coarse", "said"),
    [
        ([0.1, 0.5], [0.1, 0.5], [0.1, 0.5], True),
        ([0.1, 0.501], [0.1, 0.5], [0.1, 0.5], True),  # as late as it may be
        ([0.1, 0.503], [0.1, 0.5], [0.1, 0.5], False),
        ([0.1], [0.1, 0.5], [0.1, 0.5], False),
        ([0.1, 0.3, 0.5], [0.1, 0.5], [0.1, 0.5], False),
        ([], [0.1], [0.1], False),  # a pair that the run never saw in contact
        ([0.1, 0.7, 0.8], [0.1, 0.9], [0.1], True),  # behind the span nothing is certified
        ([0.1], [0.1, 0.5], [0.1], None),  # the truth is not known
    ],
)
def test_certified_contacts_are_compared_one_by_one(
    own: list[float], true: list[float], coarse: list[float], said: bool | None
) -> None:
    impacts = {"until": 0.6, "onset_error": 2e-3}
    runs = [{3: np.array(onsets)} if onsets else {} for onsets in (own, true, coarse)]
    assert contacts_hold(impacts, runs[0], (runs[1], runs[2]), 1.0) is said
    assert contacts_hold(None, runs[0], (runs[1], runs[2]), 1.0) is None


def searched(measure: str, seed: int, runs: int, kinds: list[str]) -> list[Any]:
    """Return the verdicts of a search, most of which judge."""
    judged = search(MEASURES[measure], seed, runs, kinds)
    assert "| all |" in report(MEASURES[measure], judged)
    verdicts = [each.verdict for each in judged if each.verdict.ended == "judged"]
    assert len(verdicts) >= 2 * runs // 3
    return verdicts


@pytest.mark.parametrize(
    ("seed", "runs", "kinds"),
    [
        (8, 2, PRESETS),
        (8, 3, SLOT),
        (3, 2, GUIDE),  # whose first jobs have a truth, which others have not within seconds
        pytest.param(8, 150, list(SCENES), marks=pytest.mark.long),
        pytest.param(8, 1000, list(LOOSE), marks=pytest.mark.long),
    ],
)
def test_error_bars_of_a_search_hold(seed: int, runs: int, kinds: list[str]) -> None:
    verdicts = searched("coverage", seed, runs, kinds)
    assert min(verdict.covered for verdict in verdicts) >= 0.95
    inside = sum(verdict.inside for verdict in verdicts)
    assert inside >= 0.999 * sum(verdict.errors for verdict in verdicts)
    assert sum(verdict.untrue for verdict in verdicts) == 0
    assert sum(verdict.contacts for verdict in verdicts) > 0


@pytest.mark.parametrize(
    ("runs", "kinds"),
    [
        (1, PRESETS),
        pytest.param(150, list(SCENES), marks=pytest.mark.long),
        pytest.param(150, list(LOOSE), marks=pytest.mark.long),
    ],
)
def test_extremes_of_a_search_are_found(runs: int, kinds: list[str]) -> None:
    # the first job of this seed has extremes beside ends of steps
    verdicts = searched("extremes", 10, runs, kinds)
    assert [verdict.where for verdict in verdicts if verdict.right < verdict.extremes] == []
