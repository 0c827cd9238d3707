"""Bifurcations behind a hard stop are those of Newton's law of impact, in closed form."""

import pytest

from benchmarks.continuation import RIGID, extrapolated


def test_folds_doublings_and_multipliers_have_the_limit_of_newtons_law() -> None:
    table, limit = extrapolated((1e10, 1e11, 1e12))
    assert abs(table[-1] - limit).max() > 1e-3  # the hardest stop alone would not do
    assert limit.tolist() == [pytest.approx(one, abs=1e-4, rel=1e-4) for one in RIGID.values()]
