"""Curves of special orbits of an impact oscillator, beside the closed forms of a rigid stop."""

from functools import cache
from typing import Any

import numpy as np
import pytest

from benchmarks.continuation import branch_job, scene
from benchmarks.rigid_stop import grazing
from benchmarks.special_curves import BRANCHES, apart, curve
from jointplay.local import run
from jointplay.records.branch import SECOND, SECOND_BOUND, VALUE, Branch, branches

NEAR: dict[str, dict[str, Any]] = {
    "PD": {"values": {"from": 20.0, "to": 18.8, "count": 30}},
}


@cache
def followed(stop: float, label: str) -> Branch:
    return curve(stop, label, count=8, **NEAR.get(label, {}))


@pytest.mark.parametrize(("label", "most"), [("LP", 5e-3), ("PD", 2e-2)])
def test_folds_and_doublings_are_off_by_the_time_that_contact_takes(
    label: str, most: float
) -> None:
    found = []
    for stop in (1e10, 1e11):
        branch = followed(stop, label)
        distance, bound = apart(branch)
        assert len(distance) > 12
        assert bound.max() < 1e-4
        order = np.argsort(branch.column(VALUE))
        found.append((branch.column(VALUE)[order], distance[order]))
    # 2e-3 rad/s at 1e11, where doublings have a third of the slope over amplitude that folds have
    assert np.abs(found[1][1]).max() < most
    low = max(speeds[0] for speeds, _ in found)
    high = min(speeds[-1] for speeds, _ in found)
    soft, hard = (np.interp(np.linspace(low, high, 5), *one) for one in found)
    # what is left of the next order, K^-0.8, is a few per cent
    assert soft / hard == pytest.approx(10.0**0.4, rel=0.1)


def test_grazing_of_a_hard_stop_is_where_the_free_motion_touches_it_in_closed_form() -> None:
    branch = followed(1e11, "GR")
    distance, bound = apart(branch)
    assert (branch.column("impacts") == 0.0).all()
    assert len(distance) > 12
    assert np.ptp(branch.column(SECOND)) > 1e-3
    assert (np.abs(distance) < 1e-6).all()  # 2e-7 of the whole motion before it, twice the gap
    speed = branch.column(VALUE)
    beside = grazing(speed + branch.column("bound")).amplitude / grazing(speed).amplitude - 1.0
    assert (np.abs(distance) < 1.01 * (bound + np.abs(beside)) + 1e-9).all()  # of the first order


def test_a_curve_has_the_special_orbit_of_its_branch_at_the_value_of_the_scene() -> None:
    branch = followed(1e11, "PD")
    first = branch.special[0]
    assert (branch.of, first.label, first.row) == ("PD", "PD", 0)
    assert first.second == pytest.approx(5e-3, rel=1e-12)
    job = branch_job(1e11, **(BRANCHES["PD"] | NEAR["PD"]))
    (alone,) = branches(run(job, processes=1).study())
    (doubling,) = (one for one in alone.special if one.label == "PD")
    assert first.value == pytest.approx(
        doubling.value, abs=1e-8
    )  # the same orbits by the same runs
    # runs of other last bits move it by 4e-8, a bound that it has, too
    assert first.value == pytest.approx(19.20320071, abs=8e-8)
    assert branch.column(SECOND_BOUND)[0] == first.second_bound
    assert {one.note for one in branch.special[1:]} <= {
        "end of the range",
        "8 orbits were asked for",
    }
    critical = np.array([branch.column(f"multiplier_{k}.real") for k in (1, 2)])
    assert np.abs(critical + 1.0).min(axis=0).max() < 1e-4  # as their errors are
    assert not branch.column("unstable").any()  # the critical multiplier is not counted


def of_two_periods(amplitude: float, **fields: Any) -> list[Branch]:
    written = scene(1e8)
    written["parameters"]["amplitude"]["default"] = amplitude
    values = {"from": 18.0, "to": 20.5, "count": 30}
    job = {"kind": "continuation", "scene": written, "parameter": "speed", "values": values}
    return list(branches(run(job | {"period": 2, "settle": 200} | fields, processes=1).study()))


def test_grazing_of_an_orbit_that_has_another_impact_is_where_its_branch_gains_the_second() -> None:
    values = {"from": 4.9e-3, "to": 5.1e-3, "count": 3}
    second = {"parameter": "amplitude", "values": values, "labels": ["GR"], "curves": 1}
    first, found = of_two_periods(5e-3, second=second)
    last = found.special[1]
    (other,) = of_two_periods(last.second or 0.0)
    for at, branch in ((found.special[0], first), (last, other)):
        (graze,) = [one for one in branch.special if one.label == "GR"]
        assert graze.note == "an impact begins: 1 before, 2 behind"
        assert abs(at.value - graze.value) < 1.05 * at.bound + graze.bound
        assert at.bound < 1e-5
    assert (found.column("impacts") == 1.0).all()
