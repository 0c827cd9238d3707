"""Corners of cells: what makes them differ."""

from types import SimpleNamespace

import numpy as np
import pytest

from jointplay.records.point import PointEnd
from jointplay.solver.runs.study.cell_similarity import CellSimilarity

PERIODIC = {"verdict": 1.0, "period": 1.0, "lyapunov": -1.0, "lyapunov_error": 1e-9}
CHAOTIC = {"verdict": 3.0, "period": 0.0, "lyapunov": 2.0, "lyapunov_error": 0.1}
QUASI_PERIODIC = {"verdict": 2.0, "period": 0.0, "lyapunov": -0.1, "lyapunov_error": 1e-4}
UNDECIDED = QUASI_PERIODIC | {"verdict": 0.0}
RECURRING = {"verdict": 0.0, "period": 1.0, "lyapunov": 0.5, "lyapunov_error": 0.01}
"""Sections recur, yet neighbours part: undecided."""
NEUTRAL = {"lyapunov": -2e-3, "lyapunov_error": 1e-3}


def end(indicators, code="", **statistics):
    return PointEnd(0, code, "", 1.0, np.empty((0, 4)), statistics, indicators)


def differ(one, other, record=10, cycles=False):
    states = {"scales": {"x": 1e-3, "phi": 0.1}, "angles": ["phi"]} if cycles else None
    study = SimpleNamespace(record=record, attributes=lambda: {"states": states})
    (found,) = CellSimilarity(study).differ([[one, one, other, one]])
    assert CellSimilarity(study).differ([[other, one, one, one]]) == [found]
    return bool(found)


@pytest.mark.parametrize(
    ("one", "other", "apart"),
    [
        (end(PERIODIC), end(PERIODIC), False),
        (end(PERIODIC), end(PERIODIC | {"lyapunov": -2.0}), False),
        (end(PERIODIC), end(PERIODIC | {"period": 2.0}), True),
        (end(PERIODIC), end(CHAOTIC), True),
        (end(CHAOTIC), end(CHAOTIC | {"lyapunov": 2.4}), False),
        (end(CHAOTIC), end(CHAOTIC | {"lyapunov": 2.5}), True),
        (end(CHAOTIC), end(CHAOTIC | {"lyapunov": float("nan")}), False),
        (end(CHAOTIC | {"period": float("nan")}), end(CHAOTIC), False),
        (end(QUASI_PERIODIC), end(QUASI_PERIODIC | {"lyapunov": -0.2}), False),
        (end(QUASI_PERIODIC), end(QUASI_PERIODIC | NEUTRAL), False),
        (end(QUASI_PERIODIC), end(UNDECIDED), True),
        (end(UNDECIDED), end(UNDECIDED | {"lyapunov": -0.2}), False),
        (end(UNDECIDED), end(UNDECIDED | {"lyapunov": 0.2}), True),
        (end(UNDECIDED), end(UNDECIDED | NEUTRAL), True),
        (end(UNDECIDED | NEUTRAL), end(UNDECIDED | NEUTRAL | {"lyapunov": 2.9e-3}), False),
        (end(UNDECIDED | {"lyapunov": 0.1}), end(UNDECIDED | {"lyapunov": 0.2}), True),
        (end(RECURRING), end(RECURRING | {"lyapunov": 5.0}), True),
        (end(RECURRING), end(RECURRING | {"lyapunov": 0.51}), False),
        (end(RECURRING), end(RECURRING | {"period": 2.0}), True),
        (end({}, "a"), end({}, "a"), False),
        (end({}, "a"), end({}, "b"), True),
        (end({}, "a"), end(PERIODIC), True),
        (end(PERIODIC, attractors=1.0), end(PERIODIC, attractors=2.0), True),
    ],
)
def test_labels_differ_or_exponents_of_what_does_not_recur(one, other, apart):
    assert differ(one, other) == apart


def test_impacts_count_by_period_whatever_the_ends_of_the_record_cut():
    def strikes(count, period=1.0):
        return end(PERIODIC | {"period": period}, **{"stop.impacts": count})

    assert not differ(strikes(10.0), strikes(9.0))
    assert not differ(strikes(10.0), strikes(11.0))
    assert differ(strikes(10.0), strikes(0.0))
    assert differ(strikes(10.0), strikes(20.0))
    assert not differ(strikes(5.0, 4.0), strikes(6.0, 4.0))  # 2 or 2.4 in four periods
    assert not differ(strikes(2.0, 5.0), strikes(3.0, 5.0))  # nothing to be told by two cycles


def test_cycles_are_compared_where_the_study_compares_them():
    def cycle(x=0.02, phi=0.3, verdict=PERIODIC, spread=0.0):
        means = {"cycle_mean.x": x, "cycle_mean.phi": phi}
        return end(verdict, **means, **{"cycle_spread.x": spread, "cycle_spread.phi": 0.0})

    rests = {"verdict": 4.0, "period": float("nan"), "lyapunov": -1.0, "lyapunov_error": 1e-9}
    for verdict in (PERIODIC, rests):
        one = cycle(verdict=verdict)
        assert not differ(one, cycle(0.02 + 1e-6, verdict=verdict), cycles=True)
        assert differ(one, cycle(0.02 + 3e-6, verdict=verdict), cycles=True)
        assert differ(one, cycle(spread=3e-6, verdict=verdict), cycles=True)
        assert differ(one, cycle(phi=0.301, verdict=verdict), cycles=True)
        assert not differ(one, cycle(phi=0.3 + 2.0 * np.pi, verdict=verdict), cycles=True)
        assert not differ(one, cycle(0.03, verdict=verdict))
    assert not differ(cycle(verdict=CHAOTIC), cycle(0.03, verdict=CHAOTIC), cycles=True)
    assert not differ(end(rests), end(rests | {"lyapunov": -2.0}))
