"""Journals of searches: one that was interrupted goes on with the verdicts that it had."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from benchmarks.lies.covered import Verdict
from benchmarks.lies.journal import Journal

JOBS = [{"kind": "simulate", "duration": float(seconds)} for seconds in range(1, 5)]


def judged(jobs: list[dict[str, Any]], path: Path) -> tuple[list[Verdict], int]:
    """Return the verdicts of jobs, and how many of them had to be judged."""
    seen = []

    def judge(job: dict[str, Any]) -> Verdict:
        seen.append(job)
        duration = job["duration"]
        return Verdict("judged", 7, 6, duration / 3.0, "x", np.array([duration, 1.0 / duration]))

    journal = Journal(path, judge, Verdict)
    return [journal(job) for job in jobs], len(seen)


def test_an_interrupted_search_goes_on_with_the_same_verdicts(tmp_path: Path) -> None:
    path = tmp_path / "journal"
    first, count = judged(JOBS[:3], path)
    assert count == 3
    path.write_text(path.read_text()[:-5])  # it was writing the third
    again, count = judged(JOBS, path)
    assert count == 2
    for before, now in zip(first, again, strict=False):
        assert before.ended == now.ended == "judged"
        assert (before.worst, before.inside, before.errors) == (now.worst, now.inside, now.errors)
        np.testing.assert_array_equal(before.ratios, now.ratios)
    assert judged(JOBS, path)[1] == 0


def test_a_journal_of_another_search_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "journal"
    judged(JOBS, path)
    with pytest.raises(ValueError, match=re.escape(str(path))):
        judged(JOBS[1:], path)
