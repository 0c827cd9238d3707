"""Neighbours of an unstable orbit part, and still its motion is not chaotic."""

import math
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from jointplay.records.point import PointEnd
from jointplay.solver.kinds import Study, admit
from jointplay.solver.nonlinear.grounds import grounds
from jointplay.solver.nonlinear.recurrence import leaves_an_orbit
from jointplay.solver.nonlinear.verdict import VERDICTS
from jointplay.solver.runs.study.indicators import Sections, indicators_of
from jointplay.solver.runs.study.run import StudyRun
from tests.solver.nonlinear.textbook import HENON, logistic

SHAKEN, SPEED, DRAG = 0.1, 2.0, 0.05
"""m, rad/s and N m s, of a pendulum of 1 kg and 1 m whose weight is 1 N."""


def hanging(angle: float) -> dict[str, Any]:
    """Return a pendulum whose pivot is shaken up and down twice as fast as it swings."""
    motion = {"type": "sinusoidal", "amplitude": SHAKEN, "frequency": SPEED}
    slide = {"type": "prismatic", "guide": "ground.O", "slider": "pivot.P", "axis": [0.0, 1.0]}
    return {
        "name": "hanging",
        "gravity": [0.0, -1.0],
        "ground": {"points": {"O": [0.0, 0.0]}},
        "bodies": {
            "pivot": {"mass": 1.0, "inertia": 1.0, "points": {"P": [0.0, 0.0]}},
            "rod": {"mass": 1.0, "inertia": 1e-9, "points": {"P": [0.0, 1.0]}},
        },
        "joints": {
            "slide": slide,
            "pin": {"type": "revolute", "bearing": "pivot.P", "journal": "rod.P"},
        },
        "drivers": {"shaker": {"joint": "slide", "motion": motion}},
        "forces": {
            "drag": {
                "type": "torsion-spring",
                "first": "pivot.P",
                "second": "rod.P",
                "damping": DRAG,
            }
        },
        "start": {"angles": {"rod": angle}},
    }


def mathieu_exponent() -> float:
    """Return the larger exponent of x'' = -drag x' - (1 - a w^2 sin(w t)) x, 1/s."""
    period = 2.0 * math.pi / SPEED

    def slope(t: float, y: Any) -> list[float]:
        return [y[1], -DRAG * y[1] - (1.0 - SHAKEN * SPEED**2 * math.sin(SPEED * t)) * y[0]]

    ends = [
        solve_ivp(slope, (0.0, period), start, rtol=1e-11, atol=1e-12).y[:, -1]
        for start in ([1.0, 0.0], [0.0, 1.0])
    ]
    return float(np.log(np.abs(np.linalg.eigvals(np.array(ends).T)).max()) / period)


def judged(angle: float, *indicators: str, **more: Any) -> PointEnd:
    job = {"kind": "poincare", "scene": hanging(angle), "settle": 20, "record": 40}
    study = admit(job | {"indicators": list(indicators)} | more)
    assert isinstance(study, Study)
    return next(end for piece in StudyRun(study, 0).slices() for end in piece.ended)


@pytest.mark.parametrize("indicators", [("lyapunov",), ("lyapunov", "recurrence")])
def test_a_pendulum_that_hangs_above_a_shaker_is_not_chaotic(indicators) -> None:
    end = judged(0.0, *indicators)
    assert end.indicators["lyapunov"] == pytest.approx(mathieu_exponent(), rel=1e-3)
    assert end.indicators["verdict"] == VERDICTS["undecided"]
    assert "every section recurs after 1, yet neighbours part" in end.reason
    assert "start elsewhere" in end.reason


@pytest.mark.parametrize("angle", [1e-8, 1e-7, 1e-6])
def test_what_leaves_an_unstable_orbit_is_not_chaotic(angle) -> None:
    """It swings up, by e^0.23 in a period, to a stable swing of twice the period."""
    end = judged(angle, "lyapunov", "recurrence")
    assert end.indicators["lyapunov"] > 3.0 * end.indicators["lyapunov_error"]
    assert end.indicators["verdict"] == VERDICTS["undecided"]
    assert "as on the way from an unstable orbit" in end.reason
    assert "smaller steps: it is 0.07" in grounds(end.indicators)


def test_without_sections_nothing_is_chaotic() -> None:
    """The pendulum never comes to where they would be taken."""
    crossing = {"channel": "rod.theta", "value": 0.5}
    end = judged(0.0, "lyapunov", "recurrence", section=crossing, record=4)
    assert end.indicators["verdict"] == VERDICTS["undecided"]
    assert "whether sections recur, as on an unstable orbit, is not known" in end.reason


def test_chaos_is_seen_by_its_exponent_alone() -> None:
    """The sections of Henon's map come and go."""
    generator = np.random.default_rng(0)
    for skipped in range(0, 2000, 100):
        orbit = HENON.orbit(50, skipped)
        sections = Sections(orbit, np.full(2, 0.1), np.zeros(2, np.bool_), 1, 1.0)
        growth = HENON.exponent + 0.1 * generator.standard_normal(58)
        told, _ = indicators_of(["lyapunov"], sections, growth[:50], growth[50:], 1.0, 100)
        assert told["verdict"] == VERDICTS["chaotic"]


@pytest.mark.parametrize("indicators", [["recurrence"], ["lyapunov", "recurrence"]])
def test_chaos_that_comes_back_for_a_while_is_undecided(indicators) -> None:
    """The logistic map at 3.9 comes within 3e-5 of its unstable orbit of two points."""
    chaos = logistic(3.9)
    root = math.sqrt((3.9 + 1.0) * (3.9 - 3.0))
    states = [np.array([(3.9 + 1.0 + root) / (2.0 * 3.9) + 3e-5])]
    for _ in range(16):
        states.append(chaos.step(states[-1]))
    orbit = np.array(states)
    growth = np.log(np.abs([chaos.jacobian(x)[0, 0] for x in orbit]))
    growth = growth if "lyapunov" in indicators else growth[:0]
    sections = Sections(orbit[:4], np.full(1, 0.1), np.zeros(1, np.bool_), 1, 1.0)
    told, verdict = indicators_of(indicators, sections, growth[:4], growth[4:8], 1.0, 100)
    assert told["period"] == 2.0
    assert told["verdict"] == VERDICTS["undecided"], verdict.reason
    assert "for a while chaos may do so, too" in verdict.reason
    assert "record more sections" in verdict.reason


@pytest.mark.parametrize("indicators", [["recurrence"], ["lyapunov", "recurrence"]])
def test_intermittent_chaos_that_passes_where_an_orbit_will_be_creeps(indicators) -> None:
    """Below 1 + root 8 the logistic map is chaotic; above, it has an orbit of three sections."""
    rate = 1.0 + math.sqrt(8.0) - 1e-5
    chaos = logistic(rate)
    orbit = chaos.orbit(4000, 100)
    growth = np.log(np.abs([chaos.jacobian(x)[0, 0] for x in orbit]))
    recurring = wrong = 0
    for start in range(0, 3900, 13):
        states, grown = orbit[start : start + 50], growth[start : start + 58]
        sections = Sections(states, np.full(1, 0.1), np.zeros(1, np.bool_), 1, 1.0)
        grown = grown if "lyapunov" in indicators else grown[:0]
        told, _ = indicators_of(indicators, sections, grown[:50], grown[50:], 1.0, 100)
        recurring += told["period"] == 3.0
        wrong += told["verdict"] == VERDICTS["periodic"]
    assert recurring > 60
    assert wrong < 0.2 * recurring


def test_an_exponent_alone_keeps_the_period_that_was_looked_for() -> None:
    """From what is kept it was said that whether sections recur is not known."""
    end = judged(0.0, "lyapunov")
    assert end.indicators["period"] == 1.0
    assert "every section recurs after 1" in grounds(end.indicators)
    earlier = {name: one for name, one in end.indicators.items() if name != "period"}
    assert "its sections" in grounds(earlier)
    assert "not known" not in grounds(earlier)


def test_points_that_spiral_away_leave_an_orbit() -> None:
    k = np.arange(24.0)
    spiral = np.exp(0.3 * k)[:, None] * np.stack([np.cos(k), np.sin(k)], axis=1)
    assert leaves_an_orbit(1e-5 * spiral + 1.0)
    assert not leaves_an_orbit(1e-5 * spiral[::-1] + 1.0)
    assert not leaves_an_orbit(1e-5 * spiral[:11] + 1.0)
