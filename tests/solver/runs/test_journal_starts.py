"""Journals start where a scene says, in contact if that is beyond the clearance."""

import math
from typing import Any

import numpy as np
import pytest

from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds import admit
from jointplay.solver.scene import presets
from tests.solver.completed_runs import Run, run


def scene(preset: str, joints: dict[str, Any]) -> dict[str, Any]:
    """Return a preset's document with journals that start somewhere."""
    document = presets.document(preset) | {"parameters": {}, "outputs": []}
    document["start"]["joints"] = joints
    return document


def journal(
    eccentricity: tuple[float, float], rate: tuple[float, float], duration: float = 0.01
) -> Run:
    start = {"eccentricity": list(eccentricity), "rate": list(rate)}
    return run(scene("bouncing-journal", {"bearing": start}), duration, tolerance=1e-8)


@pytest.mark.parametrize(
    "formulation", ["reduced", pytest.param("lagrange", marks=pytest.mark.long)]
)
def test_journals_of_the_press_start_as_they_are_told(formulation: str) -> None:
    given = {
        "A": {"eccentricity": [3e-4, -2e-4], "rate": [0.01, 0.02]},
        "B": {"eccentricity": [-1e-4, 0.0]},
    }
    found = run(scene("seven-bar-press", given), 1e-3, formulation=formulation)
    for joint, (x, y), (vx, vy) in (
        ("A", (3e-4, -2e-4), (0.01, 0.02)),
        ("B", (-1e-4, 0.0), (0.0, 0.0)),
    ):
        start = [found[f"{joint}.{name}"][0] for name in ("eccentricity_x", "eccentricity_y")]
        rates = [
            found[f"{joint}.{name}"][0] for name in ("eccentricity_rate_x", "eccentricity_rate_y")
        ]
        # positions of a metre and Newton's last step, in the rounding of doubles
        np.testing.assert_allclose(start, [x, y], rtol=0, atol=1e-14)
        np.testing.assert_allclose(rates, [vx, vy], rtol=0, atol=1e-13)


def test_a_start_in_contact_latches_the_larger_of_its_rate_and_the_floor() -> None:
    fast = journal((0.0, -1.01e-3), (0.0, -0.5)).contacts("bearing")[0]
    assert fast["onset"] == 0.0
    assert fast["approach_rate"] == pytest.approx(0.5, rel=1e-12)
    # with 1 / 0.5 in its damping it behaves as an impact at that rate: its rebound of 0.9 nearly;
    # latched at the floor, 1e-3 m/s, it would be a thousandth
    found = journal((0.0, -1.01e-3), (0.0, -0.5))
    assert 0.4 < found.peaks["journal.vy"].maximum < 0.5
    # creeping out: damping over the floor balances the spring at 1e-3 / (0.75 * 0.19) m/s
    slow = journal((0.0, -1.2e-3), (0.0, 0.0), 2e-3)
    assert slow["journal.vy"][-1] == pytest.approx(1e-3 / (0.75 * 0.19), rel=1e-2)


def test_parameters_move_the_bouncing_journal() -> None:
    found = run("bouncing-journal", 1e-3, parameters={"position_x": 4e-4, "velocity_y": 0.02})
    assert found["bearing.eccentricity_x"][0] == pytest.approx(4e-4, rel=1e-14)
    assert found["journal.vy"][0] == 0.02


@pytest.mark.parametrize(
    ("joints", "pointer", "advice"),
    [
        ({"A": {"eccentricity": [1e-3, -5.1e-3]}}, "A/eccentricity/1", "whose radius is 0.005 m"),
        ({"C2": {}}, "C2", "has no clearance"),
        ({"a": {}}, "a", "There is no joint 'a'"),
        ({"A": {"eccentricity": [0.0]}}, "A/eccentricity", "2"),
        ({"A": {"speed": [0.0, 0.0]}}, "A/speed", "'speed'"),
    ],
)
def test_what_cannot_be_a_start_is_refused_at_its_field(
    joints: dict[str, Any], pointer: str, advice: str
) -> None:
    job = {"kind": "simulate", "scene": scene("seven-bar-press", joints), "duration": 1.0}
    with pytest.raises(InvalidInput) as refused:
        admit(job)
    problem = refused.value.problems[0]
    assert problem.pointer == f"/scene/start/joints/{pointer}"
    assert advice in problem.detail


def test_an_eccentricity_that_the_links_do_not_reach_is_refused() -> None:
    # the crank stands up, and a rod that is hardly longer reaches down to the guide
    document = scene("slider-crank", {"P": {"eccentricity": [0.0, -1e-3]}})
    document["drivers"]["motor"]["position"] = 0.5 * math.pi
    document["bodies"]["rod"]["points"] = {"crank": [-0.0251, 0.0], "slider": [0.0251, 0.0]}
    document["start"]["angles"]["rod"] = -1.5
    with pytest.raises(InvalidInput) as refused:
        admit({"kind": "simulate", "scene": document, "duration": 1e-3})
    assert refused.value.problems[0].pointer == "/scene/start/joints/P/eccentricity"


def test_an_offset_that_the_links_do_not_reach_is_refused_at_its_field() -> None:
    document = scene("slider-crank", {})
    document["joints"]["guide"]["clearance"] |= {
        "wall_clearance": 1e-3,
        "height": 3.0,
        "length": 9.0,
    }
    document["start"]["guides"] = {"guide": {"offset": 1.0}}  # m; the links are half as long
    with pytest.raises(InvalidInput) as refused:
        admit({"kind": "simulate", "scene": document, "duration": 1e-3})
    (problem,) = refused.value.problems
    assert problem.pointer == "/scene/start/guides/guide/offset"
    assert "does not reach this offset" in problem.detail


def test_a_sweep_over_starts_refuses_the_one_out_of_reach() -> None:
    job = {
        "kind": "sweep",
        "scene": {"preset": "bouncing-journal"},
        "duration": 0.01,
        "grid": {"position_x": [0.0, 5e-4, 2e-2]},
    }
    with pytest.raises(InvalidInput) as refused:
        admit(job)
    assert [problem.pointer for problem in refused.value.problems] == ["/grid/position_x/2"]
