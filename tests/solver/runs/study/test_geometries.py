"""Only numbers on which an assembly depends count as geometries, of which a study has few."""

import copy
from typing import Any

import pytest

from jointplay.records.failure import InvalidInput, LimitExceeded
from jointplay.solver.kinds.limits import MOST_GEOMETRIES
from jointplay.solver.runs.study.plan import Study
from tests.solver.runs.study.jobs_of_studies import study

SIDE = 50
assert SIDE**2 > MOST_GEOMETRIES
SHAKEN: dict[str, Any] = {
    "name": "shaken",
    "ground": {"points": {"O": [0.0, 0.0], "S": [0.1, 0.0]}},
    "bodies": {
        "base": {"mass": 1.0, "inertia": 1e-3, "points": {"P": [0.0, 0.0]}},
        "mass": {"mass": 1.0, "inertia": 1e-3, "points": {"P": [0.0, 0.0]}},
    },
    "joints": {
        "shaker": {
            "type": "prismatic", "guide": "ground.O", "slider": "base.P", "axis": [1.0, 0.0]
        },
        "guide": {
            "type": "prismatic", "guide": "ground.O", "slider": "mass.P", "axis": [1.0, 0.0]
        },
        "stop": {
            "type": "pin-in-slot", "slot": "ground.S", "pin": "mass.P", "axis": [0.0, 1.0],
            "clearance": {
                "wall_clearance": 0.005,
                "pin_radius": 0.01,
                "contact": {
                    "law": "stiffness-and-dissipation",
                    "stiffness": {"law": "power", "stiffness": 1e7, "exponent": 1.5},
                    "dissipation": {"law": "exact", "restitution": 0.7},
                },
            },
        },
    },
    "drivers": {
        "shake": {
            "joint": "shaker",
            "motion": {"type": "sinusoidal", "amplitude": 2e-3, "frequency": 20.0},
        }
    },
    "forces": {
        "spring": {
            "type": "spring-damper", "first": "base.P", "second": "mass.P",
            "stiffness": 400.0, "damping": 1.2, "free_length": 0.1,
        },
        "push": {
            "type": "force", "first": "ground.O", "second": "mass.P",
            "direction": [1.0, 0.0], "magnitude": 1.0,
            "course": {"type": "sinusoidal", "amplitude": 1.0, "frequency": 20.0},
        },
    },
}  # fmt: skip
CONTACT = "/joints/stop/clearance/contact"


def chart(first: str, second: str, side: int = SIDE, **start: Any) -> Study:
    """Return a chart of side² points over two numbers of the scene, from 0.5 to 0.9 each."""
    scene = copy.deepcopy(SHAKEN) | start
    scene["parameters"] = {
        name: {"help": "Varies.", "targets": [{"path": path}]}
        for name, path in (("first", first), ("second", second))
    }
    values = {"from": 0.5, "to": 0.9, "count": side}
    axes = {
        axis: {"parameter": name, "values": values}
        for axis, name in (("along", "first"), ("by", "second"))
    }
    section = {"onset": "stop.wall_2"}
    job = {"kind": "chart", "scene": scene, "section": section, "settle": 1, "record": 4}
    return study({**job, **axes})


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("/drivers/shake/motion/frequency", "/drivers/shake/motion/amplitude"),
        ("/forces/spring/stiffness", "/forces/spring/damping"),
        ("/forces/push/course/frequency", "/forces/push/magnitude"),
        (f"{CONTACT}/stiffness/stiffness", f"{CONTACT}/dissipation/restitution"),
    ],
)
def test_numbers_on_which_no_assembly_depends_may_have_any_number_of_values(
    first: str, second: str
) -> None:
    assert chart(first, second).points == SIDE**2


def test_where_a_driver_begins_is_geometry() -> None:
    with pytest.raises(LimitExceeded, match="2500 geometries"):
        chart("/drivers/shake/motion/phase", "/drivers/shake/motion/amplitude")


def test_a_point_whose_driver_begins_out_of_reach_is_refused() -> None:
    tied = copy.deepcopy(SHAKEN["joints"])
    tied["tie"] = {"type": "revolute", "bearing": "base.P", "journal": "rod.A"}
    tied["far"] = {
        "type": "pin-in-slot", "slot": "ground.O", "pin": "rod.B", "axis": [0.0, 1.0]
    }  # fmt: skip
    rod = {"mass": 1.0, "inertia": 1e-3, "points": {"A": [-0.3, 0.0], "B": [0.3, 0.0]}}
    bodies = SHAKEN["bodies"] | {"rod": rod}
    with pytest.raises(InvalidInput, match="does not close"):
        chart(
            "/drivers/shake/motion/offset",
            "/drivers/shake/motion/frequency",
            3,
            joints=tied,
            bodies=bodies,
        )
