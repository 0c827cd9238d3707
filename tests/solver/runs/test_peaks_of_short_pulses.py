"""Peaks of what is prescribed in time: pulses far shorter than the drivers' common period."""

import math
from typing import Any

import pytest

from tests.solver.completed_runs import run

PULSE, DEGREE = 100.0, math.pi / 180.0
ROUNDING = 1e-9
"""Share of the pulse: its top is a knot, which no parabola through instants meets exactly."""


def wheels(speeds: list[float], pulse: dict[str, Any], *, free: bool) -> dict[str, Any]:
    """Return a scene of driven wheels, and perhaps a free one: a pulse acts on the last."""
    origin = {"points": {"O": [0.0, 0.0]}}
    names = [f"wheel{i}" for i in range(len(speeds) + free)]
    torque = {"type": "torque", "first": "ground.O", "second": f"{names[-1]}.O", "moment": PULSE}
    return {
        "name": "wheels",
        "ground": origin,
        "bodies": {name: {"mass": 1.0, "inertia": 0.01} | origin for name in names},
        "joints": {
            f"pin{i}": {"type": "revolute", "bearing": "ground.O", "journal": f"{name}.O"}
            for i, name in enumerate(names)
        },
        "drivers": {f"motor{i}": {"joint": f"pin{i}", "speed": s} for i, s in enumerate(speeds)},
        "forces": {"pulse": torque | pulse},
    }


def table(knots: list[float], *, outside: str) -> dict[str, Any]:
    """Return the course of a pulse that is 1 at the middle knot and 0 at the others."""
    values = [float(i == len(knots) // 2) for i in range(len(knots))]
    return {"course": {"type": "table", "knots": knots, "values": values, "outside": outside}}


def over_fast(width: float, middle: float) -> dict[str, Any]:
    """Return a pulse of a width about an angle, degrees, on every turn of the second wheel."""
    middle, half = middle * DEGREE, 0.5 * width * DEGREE
    knots = [0.0, middle - half, middle, middle + half, 2.0 * math.pi]
    over = {"over": {"quantity": "driver", "driver": "motor1"}}
    return table(knots, outside="periodic") | over


@pytest.mark.parametrize(
    ("speeds", "pulse", "free", "duration"),
    [
        ([], table([0.0, 0.3010, 0.3012, 0.3014, 1.0], outside="periodic"), True, 1.0),
        ([1.0, 105.0], over_fast(30.0, 180.0), True, 2.0 * math.pi),
        ([1.0, 200.0], over_fast(20.0, 162.0), False, 2.0 * math.pi),
        ([1.0, 50.0], over_fast(8.0, 184.5), False, 2.0 * math.pi),
    ],
    ids=["free", "beside-two-drivers", "driven", "narrow"],
)
def test_a_short_pulse_is_in_the_peaks(
    speeds: list[float], pulse: dict[str, Any], free: bool, duration: float
) -> None:
    scene = wheels(speeds, pulse, free=free)
    peak = run(scene, duration, output_step=duration).peaks["pulse.moment"]
    assert peak.maximum == pytest.approx(PULSE, rel=ROUNDING)
