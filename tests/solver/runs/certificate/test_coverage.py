"""Error bars against true errors, which runs at a far smaller tolerance tell."""

import random

import pytest

from jointplay.solver.scene import presets
from tests.presets_given import REQUIRED
from tests.solver.runs.certificate.known_truth import CASES, Case, coverage

OTHERS = {
    "andrews-squeezer": 0.03,
    "double-four-bar": 0.6,
    "double-pendulum": 2.0,
    "driven-pendulum": 5.0,
    "four-bar": 0.05,
    "impact-oscillator": 1.0,
    "jansen-leg": 0.2,
    "n-four-bar": 0.6,
    "quick-return": 0.1,
    "seven-bar-press-fitted": 0.2,
    "seven-bar-press-punching": 0.2,
    "seven-bar-test-bed": 0.05,
}
"""Presets of no case, and how long each runs, s; where four-bars lie flat, at 0.71 s, the finest
tolerances end."""
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


@pytest.mark.parametrize(
    "name",
    [
        name if name == "jansen-leg" else pytest.param(name, marks=pytest.mark.long)
        for name in OTHERS
    ],
)
def test_the_error_bar_covers_the_true_error_of_every_other_preset(name: str) -> None:
    found = coverage(Case(name, OTHERS[name], 1e-6, REQUIRED.get(name, {})))
    assert found.covered >= 0.95
    assert found.known >= 0.9
    assert found.converged > 0.05


def test_these_are_all_presets() -> None:
    assert {case.preset for case in CASES.values()} | OTHERS.keys() == set(presets.names())


def test_there_are_forty_cases() -> None:
    assert len(CASES) == 40
