"""The period that a scene gives itself, over the points of a study."""

import math
from typing import Any

import numpy as np

from jointplay.solver.kinds import admit
from jointplay.solver.scene import presets
from tests.solver.kinds.refusals import assert_refused


def press(period: float, second: list[float]) -> dict[str, Any]:
    """Return a sweep of the press over the speed of its second crank; the first has pi rad/s."""
    scene = presets.document("seven-bar-press") | {"period": period}
    grid = {"speed_crank4": second}
    return {"kind": "sweep", "scene": scene, "grid": grid, "duration": 1.0}


def test_it_is_that_of_the_points_whose_drivers_do_not_repeat() -> None:
    study = admit(press(0.5, [-math.pi, 3.0]))
    np.testing.assert_allclose(study.period, [2.0, 0.5], rtol=1e-12)  # rounding of 2 pi / pi


def test_it_is_refused_where_drivers_repeat_at_every_point_with_another() -> None:
    assert_refused(press(0.5, [-math.pi, math.pi / 2]), "/scene/period", "repeats after 2 s")
    assert len(admit(press(2.0000001, [-math.pi, math.pi])).period) == 2


def test_that_of_the_scene_as_written_may_stand_beside_other_speeds() -> None:
    assert len(admit(press(2.0, [-math.pi / 2, math.pi / 2])).period) == 2
    scene = press(2.0, [])["scene"]
    scene["parameters"]["speed_crank4"]["default"] = math.pi / 2  # as `--set` gives it
    assert admit({"kind": "simulate", "scene": scene, "duration": 1.0}).period == 4.0


def test_it_may_vary_from_point_to_point() -> None:
    scene = presets.document("impact-oscillator")
    start_up = {"type": "start-up", "speed": 25.0, "length": 1.0}
    scene["drivers"]["motor"] = {"joint": "O", "motion": start_up}
    target = [{"path": "/period"}]
    scene["parameters"] = {"period": {"help": "Period.", "unit": "s", "targets": target}}
    values = [0.2, 0.3, 0.4]
    study = admit({"kind": "bifurcation", "scene": scene, "parameter": "period", "values": values})
    np.testing.assert_array_equal(study.period, values)
