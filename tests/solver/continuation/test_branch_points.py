"""Branches that pass a branch point of another: pitchforks, and branches that cross."""

import math
from typing import Any

import numpy as np
import pytest

from benchmarks.known_orbits import DOUBLINGS, followed
from benchmarks.pitchfork import JOB, KNOWN
from jointplay.local import run
from jointplay.records.arrays import Floats
from jointplay.records.branch import Branch
from jointplay.solver.continuation.branch import Row, follow
from jointplay.solver.continuation.plan import Reach
from jointplay.solver.continuation.settled import NoStart
from jointplay.solver.continuation.switching import beside_branch_point
from tests.solver.continuation.known_maps import Formula, rows_of


def pitchfork(state: Floats, a: float) -> list[float]:
    x, y = state.tolist()
    return [a * x - x**3 + 0.1 * y, 0.5 * y]


def crossing(state: Floats, a: float) -> list[float]:
    (x,) = state.tolist()
    return [x + (x - math.sin(a)) * (x + 0.5 * a) * -0.3]


def other_branch(rows: list[Row], low: float, high: float) -> list[list[tuple[float, float]]]:
    """Return parameter and first state along both ways from the first branch point."""
    start, ways = beside_branch_point(rows, 0)
    assert (start.label, start.length) == ("BP", 0.0)
    found = []
    for orbit, along in ways:
        behind = follow(orbit, along, Reach(low, high, 100, 0.05))
        found.append([(row.orbit.value, float(row.orbit.section.state[0])) for row in behind])
    return found


@pytest.mark.parametrize(
    ("formula", "start", "values", "known"),
    [
        (pitchfork, [0.0, 0.0], (0.5, 1.4), [lambda a: math.sqrt(a - 1.0)] * 2),
        (crossing, [math.sin(-0.5)], (-0.5, 0.5), [lambda a: -0.5 * a] * 2),
    ],
)
def test_the_other_branch_goes_both_ways_from_a_branch_point(
    formula: Formula, start: list[float], values: tuple[float, float], known: list[Any]
) -> None:
    one, other = other_branch(rows_of(formula, start, values), *values)
    for way, expected in zip((one, other), known, strict=True):
        assert len(way) > 5
        for value, state in way:
            assert abs(state) == pytest.approx(abs(expected(value)), abs=1e-7)
    assert one[-1][1] * other[-1][1] < 0.0


def test_where_there_is_no_branch_point_nothing_begins() -> None:
    rows = rows_of(pitchfork, [0.0, 0.0], (0.5, 0.9))
    with pytest.raises(NoStart, match="has 0 branch points; try a wider range, a larger 'count'"):
        beside_branch_point(rows, 0)


def sections(strength: float) -> tuple[float, float]:
    """Return angle and rate that a motion comes to, without knowing of any branch."""
    scene = JOB["scene"]
    varied = scene["parameters"]["strength"] | {"default": strength}
    job = {"kind": "poincare", "scene": scene | {"parameters": {"strength": varied}}}
    job |= {"settle": 400, "record": 1, "tolerance": 1e-9}
    study = run(job | {"observables": ["rod.theta", "rod.omega"]}, processes=1).study()
    angle, rate = (float(study.sections(name)[0, 0]) for name in ("rod.theta", "rod.omega"))
    return angle, rate


def at(branch: Branch, strength: float, way: float) -> list[float]:
    """Return angle and rate of a branch at a value, on one side of its start."""
    side = way * branch.column("length") >= 0.0
    order = np.argsort(branch.column("value")[side])
    value = branch.column("value")[side][order]
    columns = (branch.column(name)[side][order] for name in ("state.rod.theta", "rate.rod.theta"))
    return [float(np.interp(strength, value, column)) for column in columns]


def test_a_pendulum_loses_its_symmetry_and_both_branches_double() -> None:
    first, other = followed(JOB)
    (point,) = [one for one in first.special if one.label == "BP"]
    assert point.value == pytest.approx(KNOWN, abs=2e-9)
    assert other.special[0].label == "BP"
    doubled = [one.value for one in other.special if one.label == "PD"]
    assert doubled == [pytest.approx(DOUBLINGS[0], abs=1e-9)] * 2
    unstable = first.column("unstable")
    assert not unstable[first.column("value") < KNOWN - 1e-6].any()
    assert unstable[first.column("value") > KNOWN + 1e-6].all()
    # motions come to the symmetric orbit before, and to one of the others behind; steps of 1e-3
    assert sections(0.99) == pytest.approx(at(first, 0.99, 1.0), abs=1e-3)
    came, away = sections(1.02), at(first, 1.02, 1.0)
    apart = [np.abs(np.subtract(came, at(other, 1.02, way))).max() for way in (1.0, -1.0)]
    assert min(apart) < 0.02
    assert np.abs(np.subtract(came, away)).max() > 0.5
