"""Motions of drives without a common period are quasi-periodic, though neighbours converge."""

import math
from typing import Any

import pytest

from jointplay.records.failure import InvalidInput
from jointplay.records.point import PointEnd
from jointplay.solver.kinds import Study, admit
from jointplay.solver.nonlinear.decision import decide
from jointplay.solver.nonlinear.estimate import UNKNOWN
from jointplay.solver.nonlinear.grounds import grounds
from jointplay.solver.nonlinear.verdict import QUASI_PERIODIC, UNDECIDED, VERDICTS
from jointplay.solver.runs.study.run import StudyRun
from jointplay.solver.scene.document import Scene
from jointplay.solver.scene.periods import InStep, in_step
from tests.solver.nonlinear.test_verdict import BETWEEN, HESITANT, NEGATIVE, REGULAR, TURNING

DAMPING = 0.2
"""N s/m of 1 kg: tangents fade at half of it, whatever drives the mass."""
TURN = 2.0 * math.pi
ROOT = math.sqrt(2.0)


def shaken(*speeds: float, period: float | None = None) -> dict[str, Any]:
    """Return x'' = -0.2 x' - 3 x + the sum of cos(speed t)."""
    ends = {"first": "ground.O", "second": "mass.centre"}
    push = {"type": "force", **ends, "magnitude": 1.0, "direction": [1.0, 0.0]}
    course = {"type": "sinusoidal", "amplitude": 1.0, "phase": 0.5 * math.pi}
    held = {"type": "spring-damper", "first": "ground.anchor", "second": "mass.centre"}
    slide = {"type": "prismatic", "guide": "ground.O", "slider": "mass.centre", "axis": [1.0, 0.0]}
    pushes = {
        f"push{k}": push | {"course": course | {"frequency": speed}}
        for k, speed in enumerate(speeds)
    }
    scene = {
        "name": "shaken",
        "ground": {"points": {"O": [0.0, 0.0], "anchor": [-10.0, 0.0]}},
        "bodies": {"mass": {"mass": 1.0, "inertia": 1.0, "points": {"centre": [0.0, 0.0]}}},
        "joints": {"guide": slide},
        "forces": {
            "spring": held | {"stiffness": 3.0, "free_length": 10.0, "damping": DAMPING},
            **pushes,
        },
    }
    return scene if period is None else scene | {"period": period}


def judged(scene: dict[str, Any], *indicators: str, **more: Any) -> PointEnd:
    job = {"kind": "poincare", "scene": scene, "settle": 40, "record": 320, "tolerance": 1e-9}
    study = admit(job | {"indicators": ["lyapunov", "recurrence", *indicators]} | more)
    assert isinstance(study, Study)
    return next(end for piece in StudyRun(study, 0).slices() for end in piece.ended)


def test_a_linear_oscillator_with_two_incommensurate_forces_is_on_a_closed_curve() -> None:
    """Its sections are A cos(root k turns) + B sin(root k turns) about a point, in closed form."""
    end = judged(shaken(1.0, ROOT, period=TURN), "zero_one", "rotation")
    assert end.indicators["verdict"] == VERDICTS["quasi-periodic"]
    assert min(end.indicators["rotation"] % 1.0, -end.indicators["rotation"] % 1.0) == (
        pytest.approx(ROOT - 1.0, abs=1e-9)
    )
    assert end.indicators["lyapunov"] == pytest.approx(-0.5 * DAMPING, rel=1e-2)
    assert "what drives the motion does not repeat from section to section" in end.reason
    assert "settle for longer" not in end.reason
    assert grounds(end.indicators).startswith("neighbours converge")


def test_its_advice_helps_where_indicators_are_missing() -> None:
    end = judged(shaken(1.0, ROOT, period=TURN), record=40)
    assert end.indicators["verdict"] == VERDICTS["undecided"]
    assert "record 300 sections with the indicator 'zero_one' and 'rotation'" in end.reason


def test_sections_at_the_period_of_neither_force_lie_on_no_curve() -> None:
    end = judged(shaken(1.0, ROOT, period=1.0), "zero_one", "rotation")
    assert end.indicators["verdict"] == VERDICTS["undecided"]
    assert "take sections at the period of one of two drives" in end.reason


def test_sections_in_step_with_a_drive_are_not_asked_to_be() -> None:
    """Sections of three drives without a common period lie on no curve, wherever they are taken."""
    lost = REGULAR, 0, UNKNOWN
    one = decide(NEGATIVE, *lost, drives=InStep(back=True, others=1))
    assert "no closed curve: settle for longer or record more sections" in one.reason
    golden = shaken(1.0, ROOT, 0.5 + 0.5 * math.sqrt(5.0), period=TURN)
    three = in_step(Scene.model_validate(golden), TURN)
    assert three == InStep(back=True, others=2)
    assert "only two drives make one" in decide(NEGATIVE, *lost, drives=three).reason
    double = Scene.model_validate(shaken(1.0, ROOT, 2.0 * ROOT, period=TURN))
    assert in_step(double, TURN) == InStep(back=True, others=1)
    assert in_step(double, 1.0) == InStep(back=False, others=2)


def test_forces_with_a_common_period_recur() -> None:
    end = judged(shaken(1.0, 1.5), "zero_one", "rotation", record=16)
    assert end.indicators["verdict"] == VERDICTS["periodic"]


def test_a_refusal_says_that_the_scene_may_give_a_period() -> None:
    with pytest.raises(InvalidInput, match="The scene may give a 'period'"):
        judged(shaken(1.0, ROOT))


@pytest.mark.parametrize(
    ("zero_one", "rotation", "code", "said"),
    [
        (REGULAR, TURNING, QUASI_PERIODIC, "rotation number 0.3"),
        (REGULAR, HESITANT, UNDECIDED, "rotation number is 0.30"),
        (REGULAR, UNKNOWN, UNDECIDED, "no closed curve"),
        (BETWEEN, TURNING, UNDECIDED, "no regular motion"),
        (None, TURNING, UNDECIDED, "'zero_one' and 'rotation'"),
    ],
)
def test_evidence_beside_such_drives_is_weighed(zero_one, rotation, code, said) -> None:
    verdict = decide(NEGATIVE, zero_one, 0, rotation, drives=InStep(back=True, others=1))
    assert verdict.code == code
    assert said in verdict.reason
    unsettled = decide(NEGATIVE, zero_one, 0, rotation, drives=InStep(back=True, others=0))
    assert unsettled.code == UNDECIDED


def test_what_never_repeats_is_not_out_of_step() -> None:
    """A force that begins, and then stays, lets a motion recur."""
    scene = shaken(1.0, period=TURN)
    begins = {"type": "ramp", "start": 0.0, "end": 1.0, "length": 3.0}
    scene["forces"]["load"] = scene["forces"]["push0"] | {"course": begins}
    assert in_step(Scene.model_validate(scene), TURN).others == 0
    assert in_step(Scene.model_validate(scene), 1.0).others == 1
    both = Scene.model_validate(shaken(1.0, ROOT, period=TURN))
    assert in_step(both, TURN).others == 1
    assert in_step(Scene.model_validate(shaken(1.0, 1.5)), 2.0 * TURN).others == 0


def test_a_fast_drive_is_out_of_step_by_its_own_turns() -> None:
    """It is 0.72 degrees farther at each section, which is 4e-7 of its 5000 turns."""
    assert in_step(Scene.model_validate(shaken(1.0, 5000.002, period=TURN)), TURN).others == 1
    assert in_step(Scene.model_validate(shaken(1.0, 5000.0, period=TURN)), TURN).others == 0


def test_curves_are_seen_at_whole_periods_rather_than_at_events() -> None:
    """A mass that comes through its middle has but one state there: its speed."""
    crossing = {"channel": "mass.x", "value": 0.0}
    end = judged(shaken(1.0), "rotation", section=crossing, record=40)
    assert "at events is no part of them: sections at whole periods may" in end.reason
    end = judged(shaken(1.0), "rotation", record=40)
    assert "lie on no closed curve" in end.reason
    assert "at events" not in end.reason
