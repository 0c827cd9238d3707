"""Mechanisms that are another one in each period of the drive have no periodic orbits."""

import math
from typing import Any

import pytest

from benchmarks.basin_scenes import ON_THE_MASS, shaking, sliding
from benchmarks.limit_cycles import SPRING, varied
from jointplay.local import run
from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds import admit

TURN = 2.0 * math.pi
ONCE = {"type": "table", "knots": [0.0, 1.0, 9.0], "values": [0.0, 1.0, 0.0], "outside": "held"}


def branch_of(scene: dict[str, Any]) -> dict[str, Any]:
    values = {"from": 0.3, "to": 0.4, "count": 2}
    found = {"kind": "continuation", "scene": scene, "parameter": "strength", "values": values}
    return found | {"settle": 12}


def shaken(*courses: dict[str, Any], **fields: Any) -> dict[str, Any]:
    """Return a mass on a spring that forces of these courses in time push."""
    pushes = {f"push{k}": shaking(1.0) | {"course": one} for k, one in enumerate(courses)}
    scene = sliding("shaken", 0.3, spring=SPRING, **pushes)
    return varied(scene, "/forces/damper/damping", 0.3) | fields


def wave(frequency: float) -> dict[str, Any]:
    return {"type": "sinusoidal", "amplitude": 1.0, "frequency": frequency}


@pytest.mark.parametrize(
    ("scene", "words"),
    [
        (shaken(ONCE, period=TURN), "'push0' moves the mechanism in time and never repeats"),
        (shaken(ONCE), "never repeats"),
        (shaken(wave(1.0), ONCE, period=TURN), "'push1'"),
        (shaken(wave(1.0), wave(math.sqrt(2.0))), "gives no 'period' after which"),
        (
            shaken(wave(1.0), wave(math.sqrt(2.0)), period=TURN),
            "4.44288294 s, and the scene's period of 6.28318531 s is no multiple",
        ),
        (
            shaken(wave(1.0), wave(5000.002), period=TURN),  # five thousand turns and 0.002
            "and the scene's period of 6.28318531 s is no multiple",
        ),
    ],
)
def test_what_moves_in_time_and_is_not_back_after_a_period_is_refused(
    scene: dict[str, Any], words: str
) -> None:
    with pytest.raises(InvalidInput, match="there is no motion that comes back") as refused:
        admit(branch_of(scene))
    assert words in str(refused.value)


def test_a_period_in_which_all_that_moves_makes_whole_turns_is_taken() -> None:
    """1201 and 1200 turns in 1200 units of time: too many to be found as a common period."""
    long = shaken(wave(1.0), wave(1201.0 / 1200.0), period=1200.0 * TURN)
    admit(branch_of(long))


def turned(course: dict[str, Any]) -> dict[str, Any]:
    """Return a mass on a spring, pushed by a force over the angle of a crank that a driver turns.

    The angle of a body counts turns: a force that grows with it is another one in each.
    """
    crank = {"mass": 1.0, "inertia": 1.0, "points": {"O": [0.0, 0.0]}}
    over = {"quantity": "angle", "first": "ground.O", "second": "crank.O"}
    push = {"type": "force", **ON_THE_MASS, "magnitude": 1.0, "direction": [1.0, 0.0]}
    scene = sliding("turned", 0.3, spring=SPRING, push=push | {"over": over, "course": course})
    main = {"type": "revolute", "bearing": "ground.O", "journal": "crank.O"}
    scene["bodies"] = scene["bodies"] | {"crank": crank}
    scene["joints"] = scene["joints"] | {"main": main}
    scene["drivers"] = {"motor": {"joint": "main", "speed": 2.0}}
    return varied(scene, "/forces/damper/damping", 0.3)


def test_a_force_that_counts_the_turns_of_a_driver_leaves_no_orbit() -> None:
    """The spring is pushed farther by 0.1 pi m each turn, and yet the first turns are all alike."""
    growing = turned({"type": "polynomial", "coefficients": [0.0, 0.05]})
    (failure,) = run(branch_of(growing), processes=1).study().failures.values()
    assert failure.code == "no-orbit"
    assert "how often a driver has turned" in failure.detail


def test_one_that_repeats_after_each_turn_leaves_it() -> None:
    source = run(branch_of(turned(wave(1.0))), processes=1).study()
    assert not source.failures
    assert int(source.counts[0]) > 2
