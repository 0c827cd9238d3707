"""A slider-crank whose pin is in contact all the time: what friction does to its orbits."""

import json
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from jointplay.records.arrays import Floats
from jointplay.solver.computations import computation_of
from jointplay.solver.continuation.columns import LABELS
from jointplay.solver.continuation.passage import Section
from jointplay.solver.continuation.plan import ContinuationStudy
from jointplay.solver.continuation.run import section_map
from jointplay.solver.kinds import admit
from tests.solver.completed_runs import run

SECTION = [0.17009598, 2.9076956e-4, 0.036738736, -74.871574, 0.033164115]
"""Slider and rod at 178 rad/s, with their speeds; last the rate of an impact long ago."""


STATE = "state.", "rate.", "impact_rate."


def studied(**fields: Any) -> ContinuationStudy:
    parameters = {"restitution": 0.5, "friction": 0.1, "clearance": 1e-4}
    job = {
        "kind": "continuation",
        "scene": {"preset": "slider-crank", "parameters": parameters},
        "parameter": "speed",
        "values": {"from": 177.0, "to": 174.5, "count": 20},
        "settle": 20,
        "largest_step": 0.5,
        "state": SECTION,
    }
    study = admit(job | fields)
    assert isinstance(study, ContinuationStudy)
    return study


@cache
def followed() -> dict[str, Floats]:
    study = studied()
    rows = [rows for one in computation_of(study, 0).slices() for rows in one.rows]
    values = np.concatenate([one.values for one in rows])
    return {c.name: values[:, k] for k, c in enumerate(study.observables)}


def motion(row: int, periods: int = 16) -> Floats:
    """Return the sections of a motion that begins near an orbit of the branch, (periods + 1,)."""
    found, map_ = followed(), section_map(studied())
    state = np.array([values[row] for name, values in found.items() if name.startswith(STATE)])
    state[3] *= 1.0 + 1e-7
    ends = [state]
    for _ in range(periods):
        (passage,) = map_.passages([Section(float(found["value"][row]), ends[-1])])
        assert not passage.failure
        ends.append(passage.end)
    return np.array(ends)[:, 3]


def test_an_orbit_in_lasting_contact_doubles_where_motions_do() -> None:
    found = followed()
    (row,) = np.flatnonzero(found["label"] == list(LABELS).index("PD"))
    assert abs(found["value"][row] - 175.7896) < 1e-3
    assert found["bound"][row] < 1e-3
    assert (found["impacts"] == 0.0).all()
    assert (found["unstable"][:row] == 0.0).all()
    assert (found["unstable"][row + 1 :] == 1.0).all()
    stable, unstable = motion(0), motion(len(found["value"]) - 1)
    assert abs(stable[-1] - stable[-2]) < 1e-2 * abs(stable[4] - stable[3])
    steps = np.diff(unstable)
    assert (steps[3:12] * steps[4:13] < 0.0).all()
    assert abs(steps[12]) > 5.0 * abs(steps[3])


def test_the_impact_rate_of_a_contact_that_lasts_is_part_of_the_section() -> None:
    found = followed()
    assert found["impact_rate.P"] == pytest.approx(SECTION[-1], rel=1e-12)


def test_a_lasting_contact_tells_how_near_it_is_to_opening() -> None:
    found, study = followed(), studied()
    assert np.isnan(found["slowest_impact"]).all()
    names = [one.name for one in study.observables]
    state = [float(found[one][0]) for one in names if one.startswith(STATE)]
    scene = json.loads(study.point_scene(0).model_dump_json(exclude_none=True))
    speed = scene["drivers"]["motor"]["speed"] = float(found["value"][0])
    del scene["parameters"]
    period = 2.0 * np.pi / speed
    seen = run(scene, period, output_step=period / 32768, tolerance=1e-10, state=state)
    # samples miss the least, of swings of 1e-6 m that last 600 of them, by less than 1e-10 m
    least = seen["P.penetration"].min()
    assert found["least_penetration"][0] == pytest.approx(least, abs=1e-10)


def test_the_slip_of_a_lasting_contact_tells_its_phases() -> None:
    map_ = replace(section_map(studied()), tells=True)
    assert map_.has_friction
    (passage,) = map_.passages([Section(178.0, np.array(SECTION))])
    # the journal turns against its bearing one way, 178 rad/s at least less what the rod swings
    assert passage.phases == (0, 1)
