"""Branches of an impact oscillator: every special orbit, and what motions do on both sides."""

import math
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from benchmarks.continuation import free_section
from benchmarks.known_orbits import pendulum
from jointplay.records.point import StudySlice
from jointplay.solver.computations import computation_of
from jointplay.solver.continuation.columns import LABELS
from jointplay.solver.continuation.run import FULL
from jointplay.solver.kinds import admit, parse
from jointplay.solver.runs.study.plan import Study
from tests.solver.continuation.oscillator import document, grazing

SOFT = 1e8
"""Stiffness of a stop next to whose grazing the map bends slowly enough to be followed."""
JOB: dict[str, Any] = {
    "kind": "continuation",
    "scene": document(SOFT),
    "parameter": "speed",
    "values": {"from": 33.0, "to": 19.0, "count": 300},
    "settle": 60,
}
names = list(LABELS)


def admitted(job: dict[str, Any]) -> Study:
    study = admit(job)
    assert isinstance(study, Study)
    return study


def table(
    slices: list[StudySlice], study: Study, point: int = 0
) -> dict[str, np.ndarray[Any, Any]]:
    rows = [rows for one in slices for rows in one.rows if rows.point == point]
    assert [one.first for one in rows] == list(range(len(rows)))
    values = np.concatenate([one.values for one in rows])
    return {c.name: values[:, k] for k, c in enumerate(study.observables)}


@cache
def followed() -> tuple[Study, tuple[StudySlice, ...]]:
    study = admitted(JOB | {"doublings": 1})
    return study, tuple(computation_of(study, 0).slices())


def special(found: dict[str, np.ndarray[Any, Any]], label: str) -> list[tuple[float, float]]:
    rows = found["label"] == names.index(label)
    return list(zip(found["value"][rows].tolist(), found["bound"][rows].tolist(), strict=True))


def sections(speed: float) -> Any:
    """Return the sections that a motion comes to, without knowing of any branch."""
    scene = document(SOFT)
    scene["parameters"]["speed"]["default"] = speed
    job = {"kind": "poincare", "scene": scene, "settle": 2000, "record": 4, "tolerance": 1e-9}
    study = admitted(job | {"observables": ["mass.x"]})
    slices = computation_of(study, 0).slices()
    return np.concatenate([rows.values[:, 0] for one in slices for rows in one.rows])


def test_a_branch_goes_from_free_motion_through_grazing_and_folds_to_a_doubling() -> None:
    study, slices = followed()
    found = table(list(slices), study)
    assert [names[int(k)] for k in found["label"] if k] == ["EP", "GR", "LP", "LP", "PD", "EP"]
    for channel, state in (("mass.x", "state.mass.s"), ("mass.vx", "rate.mass.s")):
        assert found[channel].tolist() == pytest.approx(found[state].tolist(), abs=1e-15)
    ((touch, bound),) = special(found, "GR")
    assert bound < 1e-7
    assert touch == pytest.approx(grazing()[1], abs=1e-7)  # in closed form, whatever the stop
    assert set(found["impacts"].tolist()) == {0.0, 1.0}
    (low, _), (high, _) = special(found, "LP")
    assert low < touch < high
    between = np.flatnonzero(found["label"] == names.index("LP"))
    unstable = found["unstable"]
    assert not unstable[: between[0]].any()
    assert (unstable[between[0] + 1 : between[1]] == 1.0).all()
    assert (found["residual"] < 1e-6).all()


def test_the_doubling_is_where_motions_begin_to_alternate() -> None:
    study, slices = followed()
    ((at, bound),) = special(table(list(slices), study), "PD")
    assert bound < 1e-5
    # the doubling is subcritical: above it the orbit attracts, below it none of period 1 does
    above, below = sections(at + 0.05), sections(at - 0.05)
    assert np.ptp(above) < 1e-7
    assert np.ptp(below) > 1e-4
    assert np.abs(below[2:] - below[:2]).max() < 1e-6


def test_the_branch_behind_the_doubling_has_twice_the_period() -> None:
    study, slices = followed()
    found = table(list(slices), study, 1)
    assert found["duration"] == pytest.approx(4.0 * math.pi / found["value"], rel=1e-12)
    ends = [end for one in slices for end in one.ended]
    assert [end.code for end in ends] == ["", ""]
    assert ends[0].statistics["doublings"] == 1.0
    assert ends[1].statistics["orbits"] == float(len(found["value"]))
    notes = [one["note"] for one in ends[1].document["special"]]  # type: ignore[index]
    assert "an impact ends: 2 before, 1 behind" in notes


def test_beside_the_fold_there_is_an_orbit_on_one_side_alone() -> None:
    study, slices = followed()
    found = table(list(slices), study)
    _, (high, bound) = special(found, "LP")
    assert np.spacing(high) <= bound < 1e-6
    assert found["value"][found["impacts"] == 1.0].max() == pytest.approx(high, abs=1e-9)
    # starts next to the stable impacting orbit stay there below, and fall to free motion above
    stable = np.flatnonzero((found["impacts"] == 1.0) & (found["unstable"] == 0.0))
    near = stable[np.argmin(np.abs(found["value"][stable] - high))]
    state = [float(found[f"{kind}.mass.s"][near]) for kind in ("state", "rate")]
    job = JOB | {"state": state, "settle": 200}
    for at, impacts in ((high - 0.05, 1.0), (high + 0.05, 0.0)):
        values = {"from": at, "to": at + 1e-3, "count": 1}
        first = admitted(job | {"values": values})
        orbit = table(list(computation_of(first, 0).slices()), first)
        assert orbit["impacts"][0] == impacts


OVER_AMPLITUDE = {
    "values": {"from": 19.4, "to": 19.0, "count": 30},
    "largest_step": 0.2,
    "second": {
        "parameter": "amplitude",
        "values": {"from": 4e-3, "to": 6e-3, "count": 3},
        "curves": 2,
    },
}


IN_CHAOS = {
    "scene": pendulum(),
    "parameter": "strength",
    "values": {"from": 1.105, "to": 1.106, "count": 4},
    "orbits": 3,
}
PAST_GRAZING = {
    "scene": document(1e11),
    "values": {"from": 24.4, "to": 24.3, "count": 20},
    "state": free_section(24.4),
}


@pytest.mark.parametrize(
    "fields",
    [
        {"values": {"from": 25.0, "to": 24.3, "count": 30}},
        OVER_AMPLITUDE,
        IN_CHAOS,
        PAST_GRAZING,
    ],
)
def test_a_branch_that_is_cut_and_continued_has_the_same_bits(fields: dict[str, Any]) -> None:
    job = JOB | {"settle": 10} | fields
    study = admitted(job)
    whole = list(computation_of(study, 0).slices())
    news = [one for one in whole if one.rows or one.started or one.ended]
    found: list[StudySlice] = []
    computation, looks, cuts = computation_of(study, 0), 0, 0
    slices = computation.slices()
    while (piece := next(slices, None)) is not None:
        if piece.rows or piece.started or piece.ended:
            found.append(piece)
        looks += 1
        if looks % 53 == 0:  # before the first orbit is found, and between orbits
            cuts += 1
            computation = computation_of(parse(study.job), 0, computation.checkpoint())  # type: ignore[arg-type]
            slices = computation.slices()
    assert cuts > 2
    assert len(found) == len(news)
    for one, other in zip(found, news, strict=True):
        assert one.started == other.started
        assert [rows.values.tobytes() for rows in one.rows] == [
            rows.values.tobytes() for rows in other.rows
        ]
        assert [replace(end, peaks=None) for end in one.ended] == [  # type: ignore[arg-type]
            replace(end, peaks=None)
            for end in other.ended  # type: ignore[arg-type]
        ]


def test_a_special_orbit_that_is_the_last_of_a_branch_stays_one() -> None:
    study, slices = followed()
    found = table(list(slices), study)
    near = int(np.flatnonzero(found["label"] == names.index("PD"))[0]) - 1
    state = [float(found[f"{kind}.mass.s"][near]) for kind in ("state", "rate")]
    values = {"from": float(found["value"][near]), "to": 19.0, "count": 300}
    job = JOB | {"values": values, "state": state, "settle": 0, "largest_step": 0.5}
    rows: int | None = None
    for most in (20, rows):
        study = admitted(job | {"record": most or rows})
        slices = tuple(computation_of(study, 0).slices())
        (end,) = [end for one in slices for end in one.ended]
        special_ones = end.document["special"]  # type: ignore[index]
        rows = next(one["row"] for one in special_ones if one["label"] == "PD") + 1
    assert len(table(list(slices), study)["label"]) == rows < 20
    assert special_ones[-1]["note"] == FULL


def test_curves_follow_branches_and_those_for_which_there_is_no_special_orbit_are_empty() -> None:
    study = admitted(JOB | {"settle": 10} | OVER_AMPLITUDE)
    slices = list(computation_of(study, 0).slices())
    ends = [end for one in slices for end in one.ended]
    assert [end.code for end in ends] == ["", "", ""]
    assert (ends[0].statistics["doublings"], ends[1].statistics["doublings"]) == (1.0, 0.0)
    (at,) = [one for one in ends[0].document["special"] if one["label"] == "PD"]  # type: ignore[index]
    found = table(slices, study, 1)
    assert len(found["value"]) == ends[1].statistics["orbits"] == 7.0
    # bounds tell the size of noise in multipliers by one other scale of differences, thus roughly
    assert found["value"][0] == pytest.approx(
        at["value"], abs=3 * (at["bound"] + found["bound"][0])
    )
    assert at["bound"] + found["bound"][0] < 1e-5
    assert (np.diff(found["second"][1:4]) > 0.0).all()
    assert (found["length"][4:] < 0.0).all()
    assert ends[2].statistics["orbits"] == 0.0
    branch = table(slices, study)
    assert set(branch["second"].tolist()) == {5e-3}


def test_without_a_first_branch_there_are_no_curves() -> None:
    study = admitted(JOB | {"period": 2} | OVER_AMPLITUDE)
    ends = [end for one in computation_of(study, 0).slices() for end in one.ended]
    assert [end.code for end in ends] == ["no-orbit"] * 3
    assert "There is no first branch" in ends[1].detail


def test_where_there_is_no_orbit_the_branch_fails_and_says_what_to_try() -> None:
    study = admitted(JOB | {"period": 2, "doublings": 1})
    ends = [end for one in computation_of(study, 0).slices() for end in one.ended]
    assert [end.code for end in ends] == ["no-orbit", "no-orbit"]
    assert "ask for 'period' 1" in ends[0].detail
    assert "no period doubling" in ends[1].detail


@pytest.mark.parametrize("to", [24.42, 24.62, 25.58])
def test_a_branch_ends_at_the_end_of_its_range_whatever_rounding_does(to: float) -> None:
    study = admitted(JOB | {"values": {"from": 25.0, "to": to, "count": 40}, "settle": 20})
    slices = list(computation_of(study, 0).slices())
    (end,) = [end for one in slices for end in one.ended]
    last = end.document["special"][-1]  # type: ignore[index]
    assert (last["label"], last["note"]) == ("EP", "end of the range")
    values = table(slices, study)["value"]
    assert values[[0, -1]] == pytest.approx([25.0, to], rel=1e-14)
    assert len(set(values.tolist())) == len(values)


def test_a_branch_begins_within_its_range_and_ends_at_its_most_orbits() -> None:
    job = JOB | {"values": {"from": 26.0, "to": 25.0, "count": 4}, "at": 25.5, "settle": 20}
    study = admitted(job | {"record": 7})
    slices = list(computation_of(study, 0).slices())
    found = table(slices, study)
    assert (found["value"][1:5] < 25.5).all()  # towards 'to' first
    assert (found["length"][1:5] > 0.0).all()
    assert (found["value"][5:] > 25.5).all()
    assert (found["length"][5:] < 0.0).all()
    (end,) = [end for one in slices for end in one.ended]
    notes = [one["note"] for one in end.document["special"]]  # type: ignore[index]
    assert notes == ["start of the branch", "4 orbits were asked for", FULL]
    assert end.statistics["orbits"] == len(found["value"]) == 7.0
