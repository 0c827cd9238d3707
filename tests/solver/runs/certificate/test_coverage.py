"""Error bars against true errors, which runs at a far smaller tolerance tell."""

import random

import pytest

from tests.solver.runs.certificate.known_truth import CASES, coverage

SAMPLE = random.Random(3).sample(sorted(CASES), 8)


@pytest.mark.parametrize(
    "name",
    [name if name in SAMPLE else pytest.param(name, marks=pytest.mark.long) for name in CASES],
)
def test_the_error_bar_covers_the_true_error(name: str) -> None:
    found = coverage(CASES[name])
    assert found.covered >= 0.95
    assert found.known >= 0.9  # else the reference, not the estimate, would be judged
    assert found.converged > 0.05  # something is claimed


def test_there_are_forty_cases() -> None:
    assert len(CASES) == 40
