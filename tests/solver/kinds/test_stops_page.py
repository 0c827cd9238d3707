"""The page about stops, backlash, slots that end and wear: what it expresses so moves so."""

import contextlib
import io
import json
import math
import re
from pathlib import Path
from typing import Any

import pytest

from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds import admit
from tests.solver.completed_runs import run
from tests.solver.kinds.refusals import assert_points

PAGE = (Path(__file__).resolve().parents[3] / "docs" / "stops.md").read_text()
STOPS, BACKLASH, TRAVEL = (
    json.loads(block)
    for block in re.findall(r"^```json\n(.*?)^```", PAGE, re.DOTALL | re.MULTILINE)
)
(WEAR,) = re.findall(r"^```python\n(.*?)^```", PAGE, re.DOTALL | re.MULTILINE)


def test_a_slide_strikes_its_stops_where_they_are_and_comes_back_more_slowly() -> None:
    far, near = run(STOPS, 0.3).impacts
    assert far["onset"] == pytest.approx(0.08, abs=1e-9)  # 80 mm at 1 m/s
    assert far["approach_rate"] == pytest.approx(1.0, rel=1e-9)
    assert near["approach_rate"] == pytest.approx(0.7, rel=1e-5)
    assert near["onset"] - far["release"] == pytest.approx(0.1 / 0.7, rel=1e-3)
    depth = (2.5 * 0.5 * 1.0**2 / 1e8) ** 0.4  # m, without loss
    assert 0.0 < near["peak_force"] < far["peak_force"] < 1.2 * 1e8 * depth**1.5


def driven_into_its_stops() -> dict[str, Any]:
    """Return the slide driven 0.1 mm into both stops, 10 times a second."""
    motion = {"type": "sinusoidal", "amplitude": 0.0501, "frequency": 20.0 * math.pi}
    driver = {"joint": "guide", "position": 0.05, "motion": motion}
    return {name: part for name, part in STOPS.items() if name != "start"} | {
        "drivers": {"motor": driver}
    }


def test_a_stop_that_a_driver_runs_into_holds_as_its_stiffness_says() -> None:
    scene = driven_into_its_stops()
    idle = {"mass": 1.0, "inertia": 1e-3, "points": {"o": [0.0, 0.0]}}
    pin = {"type": "revolute", "bearing": "ground.O", "journal": "idle.o"}
    scene["bodies"], scene["joints"] = (
        scene["bodies"] | {"idle": idle},
        scene["joints"] | {"aside": pin},
    )
    found = run(scene, 0.1, output_step=1e-5, tolerance=1e-9)
    depth, rate = found["stops.wall_2.penetration"], found["stops.wall_2.penetration_rate"]
    assert depth.max() == pytest.approx(1e-4, rel=1e-3)
    far, near = found.impacts
    turn = 20.0 * math.pi
    # asin(0.05 / 0.0501) of a turn, and half a turn later
    assert far["onset"] == pytest.approx(math.asin(0.05 / 0.0501) / turn, abs=1e-10)
    assert near["onset"] - far["onset"] == pytest.approx(math.pi / turn, abs=1e-10)
    assert far["approach_rate"] == pytest.approx(turn * math.sqrt(0.0501**2 - 0.05**2), rel=1e-6)
    # chi of restitution 0.7: chi (1 + e) = ln((1 + chi) / (1 - chi e))
    chi = 0.6348282812664141
    touching = depth > 0.0
    force = 1e8 * depth[touching] ** 1.5 * (1.0 + chi * rate[touching] / far["approach_rate"])
    load = found["stops.wall_2.normal_force"][touching]
    assert load == pytest.approx(force, rel=1e-6)
    pushed = found["motor.torque"] - found["block.ax"]  # 1 kg
    assert pushed[touching] == pytest.approx(load, rel=1e-9)


def test_stops_of_which_nothing_moves_freely_are_refused() -> None:
    # they were accepted, and ended as redundant constraints, or in an error of its own
    job = {"kind": "simulate", "scene": driven_into_its_stops(), "duration": 0.1}
    with pytest.raises(InvalidInput) as refused:
        admit(job)
    assert_points(refused.value, "/scene/joints/stops/clearance", "leave nothing free to move")


def test_a_coupling_turns_by_its_backlash_before_it_carries() -> None:
    ended = run(BACKLASH, 0.5)
    assert ended.statistics["onsets"] > 2
    play = math.asin(5e-4 / 0.05)  # rad to each side
    swing = ended.peaks["load.theta"]
    assert 0.05 - play < swing.maximum < 0.05 + 2.0 * play
    for wall in ("wall_1", "wall_2"):
        assert 0.0 < ended.peaks[f"coupling.{wall}.penetration"].maximum < 0.1 * 5e-4


def test_a_weak_spring_measures_how_far_a_pin_is_along_its_slot() -> None:
    scene: dict[str, Any] = {
        "name": "arm",
        "ground": {"points": {"C": [0.0, 0.0], "O": [0.0, 0.2]}},
        "bodies": {
            "crank": {"mass": 1.0, "inertia": 1e-3, "points": {"O": [0.0, 0.0], "A": [0.08, 0.0]}},
            "arm": {"mass": 1.0, "inertia": 0.1, "points": {"C": [0.0, 0.0], "slot": [0.0, 0.2]}},
        },
        "joints": {
            "O": {"type": "revolute", "bearing": "ground.O", "journal": "crank.O"},
            "C": {"type": "revolute", "bearing": "ground.C", "journal": "arm.C"},
            "slot": {"type": "pin-in-slot", "slot": "arm.slot", "pin": "crank.A", "axis": [0, 1]},
        },
        "drivers": {"motor": {"joint": "O", "position": 1.5, "speed": 10.0}},
    }
    before, after = run(scene, 0.7), run(scene | TRAVEL, 0.7)
    travel = after.peaks["travel.length"]
    assert travel.maximum == pytest.approx(0.08, rel=1e-9)
    torque = "motor.torque"
    assert after.peaks[torque].maximum == pytest.approx(before.peaks[torque].maximum, rel=1e-9)


def test_the_work_of_friction_between_samples_is_that_of_the_ledger() -> None:
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(WEAR, {})
    _, wear, friction = printed.getvalue().splitlines()
    heat, ledger = (float(number) for number in re.findall(r"[\d.]+(?= J)", friction))
    assert heat == pytest.approx(ledger, rel=1e-5)
    volume = float(wear.split()[1])  # where the whole coefficient acts, F |v| is heat / 0.05
    assert volume == pytest.approx(1e-16 * heat / 0.05 * 1e9, rel=1e-2)
