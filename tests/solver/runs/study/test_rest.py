"""Motions that end at rest are equilibria, whatever sections they left on the way."""

import numpy as np
import pytest

from benchmarks.basin_scenes import belt, cubic_oscillator, pendulum, shaking
from jointplay.solver.kinds import admit
from jointplay.solver.nonlinear.verdict import VERDICTS
from jointplay.solver.runs.study.run import StudyRun

WHERE = "/start/angular_velocities/rod"
TURNS = {"channel": "rod.theta", "value": np.pi}


def job(scene, starts, start=WHERE, section=TURNS, **fields):
    """Return a job of a point for each start."""
    return {
        "kind": "basins",
        "scene": scene,
        "along": {"start": start, "values": [*starts]},
        "by": {"start": "/drivers/none/position", "values": [0.0]},
        "section": section,
        "settle": 30,
        "record": 6,
        "tolerance": 1e-8,
        "indicators": ["recurrence"],
    } | fields


def ends(document, study=None, limit=None):
    """Return the points' ends; after `limit` slices the run is given up and resumed."""
    found = {}
    study = study or admit(document)
    for block in range(len(study.blocks)):
        run = StudyRun(study, block)
        while True:
            for number, piece in enumerate(run.slices()):
                found |= {end.point: end for end in piece.ended}
                if limit is not None and number == limit:
                    break
            else:
                break
            run = StudyRun(study, block, run.checkpoint())
    return [found[point] for point in range(study.points)]


def pendulums(**fields):
    by = {"start": "/start/angles/rod", "values": [0.0]}
    return job(pendulum(), [0.0, 6.0], by=by, **fields)


def verdict(end):
    return next(name for name, code in VERDICTS.items() if code == end.indicators["verdict"])


def test_a_pushed_pendulum_rests_where_weight_and_torque_are_equal_or_turns():
    rests, turns = ends(pendulums())
    assert (verdict(rests), verdict(turns)) == ("equilibrium", "periodic")
    assert rests.statistics["cycle_mean.rod.theta"] == pytest.approx(np.arcsin(0.5), abs=1e-6)
    assert rests.statistics["cycle_spread.rod.theta_rate"] == 0.0
    assert turns.indicators["period"] == 1.0
    # on average the torque does the work of the drag: theta' is 5 and a little
    assert 4.5 < turns.statistics["cycle_mean.rod.theta_rate"] < 5.5


def test_rest_counts_more_than_sections_that_recur_while_it_is_approached():
    """A spiral crosses the rate zero at ever smaller angles, which differ by less than counts."""
    section = {"channel": "rod.omega", "value": 0.0}
    rests, _ = ends(pendulums(section=section, settle=60))
    assert rests.indicators["period"] == 1.0
    assert verdict(rests) == "equilibrium"


def test_what_still_swings_is_not_at_rest():
    swings, _ = ends(pendulums(section={"channel": "rod.omega", "value": 0.0}, settle=2))
    assert verdict(swings) != "equilibrium"


def test_a_force_over_time_lets_nothing_rest():
    """The mass moves by less than counts; its sections recur all the same."""
    scene = cubic_oscillator(shaking=shaking(1e-9))
    (end,) = ends(
        job(
            scene,
            [0.0],
            "/start/velocities/mass/0",
            {"crank_angle": 0.0},
            by={"start": "/start/points/mass.centre/0", "values": [0.0]},
        )
    )
    assert verdict(end) == "periodic"


def test_a_mass_rests_on_a_belt_that_slides_or_sticks_and_slips():
    scene = job(
        belt(),
        [0.3, 2.0],
        "/start/points/mass.centre/0",
        {"channel": "mass.vx", "value": 0.0},
        by={"start": "/start/velocities/mass/0", "values": [0.0]},
        settle=60,
    )
    rests, sticks = ends(scene)
    assert (verdict(rests), verdict(sticks)) == ("equilibrium", "periodic")
    assert rests.statistics["cycle_mean.mass.s"] == pytest.approx(
        0.5 + 0.5 * np.exp(-3.0), abs=1e-4
    )  # between knots the table is a cubic


def test_a_point_at_rest_is_the_same_after_a_restart():
    document = pendulums(indicators=["lyapunov", "recurrence"])
    once, again = ends(document), ends(document, limit=0)
    assert [end.statistics for end in once] == [end.statistics for end in again]
    assert [end.indicators for end in once] == [end.indicators for end in again]
