"""Mechanisms that are refused: each with the field, the number that is wrong, and the remedy."""

import copy
from typing import Any

import pytest

from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds import admit


def bar(length: float) -> dict[str, Any]:
    return {"mass": 1.0, "inertia": 0.01, "points": {"a": [0.0, 0.0], "b": [length, 0.0]}}


def pin(first: str, second: str) -> dict[str, Any]:
    return {"type": "revolute", "bearing": first, "journal": second}


FOUR_BAR: dict[str, Any] = {
    "name": "four-bar",
    "ground": {"points": {"O": [0.0, 0.0], "C": [1.0, 0.0]}},
    "bodies": {"crank": bar(0.2), "coupler": bar(1.1), "rocker": bar(0.7)},
    "joints": {
        "O": pin("ground.O", "crank.a"),
        "A": pin("crank.b", "coupler.a"),
        "B": pin("coupler.b", "rocker.b"),
        "C": pin("ground.C", "rocker.a"),
    },
    "drivers": {"motor": {"joint": "O", "speed": 10.0}},
    "start": {"angles": {"coupler": 0.6, "rocker": 1.5}},
}
PAIR = {"first": "ground.C", "second": "crank.b"}
SPRING = {"type": "spring-damper", **PAIR, "stiffness": 1e3}
PLAY = {
    "radial_clearance": 1e-4,
    "bearing_radius": 1e-2,
    "contact": {"law": "lankarani-nikravesh", "restitution": 0.9},
}
LAW = "lankarani-nikravesh"
GUIDE = {"type": "prismatic", "guide": "ground.O", "slider": "crank.a", "axis": [1.0, 0.0]}
SLOT = {"type": "pin-in-slot", "slot": "ground.O", "pin": "crank.a", "axis": [1.0, 0.0]}
WAVE = {"type": "sinusoidal", "offset": 0.03, "amplitude": 0.01, "frequency": 1.0}
TWO_LOBES = WAVE | {"frequency": 2.0, "phase": 1.5707963267948966}
FACE = {
    "type": "flat-follower",
    "cam": "crank.a",
    "follower": "rocker.b",
    "profile": WAVE,
    "normal": [0.0, 1.0],
}
ROLLER = {k: v for k, v in FACE.items() if k != "normal"} | {"type": "roller-follower"}
WALLS = {
    "wall_clearance": 1e-3,
    "length": 0.1,
    "height": 0.05,
    "contact": {"law": LAW, "stiffness": 1e8},
}
PUSHED = {"contact": WALLS["contact"]}
PUBLISHED = {"coefficient": 0.1, "slip_velocity": "as-published"}
BAD: dict[str, tuple[dict[str, Any], str, list[str]]] = {
    "a spring to an unknown point": (
        {"/forces": {"spring": SPRING | {"second": "crank.pin"}}},
        "/forces/spring/second",
        ["There is no point of 'crank' named 'pin'", "there are: a, b."],
    ),
    "a spring to an unknown body": (
        {"/forces": {"spring": SPRING | {"second": "cranc.b"}}},
        "/forces/spring/second",
        ["did you mean 'crank'?"],
    ),
    "gravity as one number": ({"/gravity": -9.81}, "/gravity", ["must be a list of 2 numbers."]),
    "a point as one number": (
        {"/bodies/crank/points/b": 0.2},
        "/bodies/crank/points/b",
        ["'b' must be a list of 2 numbers."],
    ),
    "a clearance as a number": (
        {"/joints/A/clearance": 2e-4},
        "/joints/A/clearance",
        ["must be an object with 'radial_clearance' and 'bearing_radius' and 'contact'."],
    ),
    "a misspelt type of joint": (
        {"/joints/A/type": "revolut"},
        "/joints/A/type",
        ["'type' must be 'revolute', 'prismatic'", "did you mean 'revolute'?"],
    ),
    "a misspelt law": (
        {"/joints/A/clearance": PLAY | {"contact": {"law": "lankarani-nikraves"}}},
        "/joints/A/clearance/contact/law",
        ["did you mean 'lankarani-nikravesh'?"],
    ),
    "gravity in space": (
        {"/gravity": [0.0, -9.81, 0.0]},
        "/gravity",
        ["'gravity' has more entries than the 2 that it may have."],
    ),
    "no bodies": ({"/bodies": {}}, "/bodies", ["has 0 entries, and needs at least 1."]),
    "a spring that pushes": (
        {"/forces": {"spring": SPRING | {"stiffness": -5.0}}},
        "/forces/spring/stiffness",
        ["at least 0 N/m, not -5"],
    ),
    "two drivers of a joint": (
        {"/drivers/second": {"joint": "O", "speed": 9.0}},
        "/drivers",
        ["'O' has more than one driver", "keep one"],
    ),
    "two drivers that fight": (
        {"/drivers/second": {"joint": "C", "speed": 9.0, "position": 1.5}},
        "/drivers",
        ["'motor' and 'second' is prescribed twice", "Drop one of the 2 drivers"],
    ),
    "a loop that cannot close": (  # 1 m less 0.2 m of the crank and 0.5 m of the others
        {"/bodies/coupler": bar(0.2), "/bodies/rocker": bar(0.3)},
        "/start/angles",
        ["0.3 m remain open at joint 'B'", "Check lengths"],
    ),
    "a law's parameter out of its range": (
        {"/joints/B/clearance": PLAY | {"contact": PLAY["contact"] | {"restitution": 1.5}}},
        "/joints/B/clearance/contact/restitution",
        ["at most 1, not 1.5"],
    ),
    "a clearance without a journal": (
        {"/joints/B/clearance": PLAY | {"radial_clearance": 0.01}},
        "/joints/B/clearance/radial_clearance",
        ["0.01 m leaves no journal", "must be smaller"],
    ),
    "a massless body": (
        {"/bodies/coupler/mass": 0.0},
        "/bodies/coupler/mass",
        ["at least 1e-15 kg, not 0"],
    ),
    "a body that turns without inertia": (
        {"/bodies/coupler/inertia": 0.0},
        "/bodies/coupler/inertia",
        ["at least 1e-27 kg m^2, not 0"],
    ),
    "a field of other tools": (
        {"/springs": {}},
        "/springs",
        ["no field 'springs' here; there are: bodies, ", "forces"],
    ),
    "a field of another joint": (
        {"/joints/guide": {"type": "prismatic", "guide": "ground.O", "journal": "crank.a"}},
        "/joints/guide/journal",
        ["there are: angle, axis, clearance, guide, slider, type."],
    ),
    "a field of another element": (
        {"/forces": {"spring": SPRING | {"moment": 1.0}}},
        "/forces/spring/moment",
        ["there are: damping, first, free_length, second, stiffness, type."],
    ),
    "an output that is always the same": (
        {"/outputs": [{"name": "angle", "channel": "crank.theta", "factor": 0.0, "offset": 2.0}]},
        "/outputs/0/factor",
        ["'angle' would always be 2"],
    ),
    "a full rate at all rates": (
        {"/forces": {"push": {**PAIR, "type": "torque", "moment": 1.0, "full_rate": 0.1}}},
        "/forces/push/full_rate",
        ["give 'only'"],
    ),
    "a guide whose law needs radii": (
        {"/joints/guide": GUIDE | {"clearance": WALLS | {"contact": {"law": LAW}}}},
        "/joints/guide/clearance/contact",
        ["radii of journal and bearing, which a wall or a cam has not", "give a stiffness"],
    ),
    "a slip of journals in a guide": (
        {"/joints/guide": GUIDE | {"clearance": WALLS | {"friction": PUBLISHED}}},
        "/joints/guide/clearance/friction",
        ["'as-published' is that of a journal", "take 'material'"],
    ),
    "a slider that could turn over": (
        {"/joints/guide": GUIDE | {"clearance": WALLS | {"length": 0.001}}},
        "/joints/guide/clearance/length",
        ["0.001 m long and 0.05 m high could turn over between walls 0.052 m apart", "longer"],
    ),
    "a slot without direction": (
        {"/joints/guide": SLOT | {"axis": [0.0, 0.0]}},
        "/joints/guide/axis",
        ["The axis has no length; give e.g. [0, 1]."],
    ),
    "a slot whose axis is too short to divide by its square": (
        {"/joints/guide": SLOT | {"axis": [0.0, 1e-200]}},
        "/joints/guide/axis",
        ["The axis has no length"],
    ),
    "a driven pin in a slot": (
        {"/joints/guide": SLOT, "/drivers/second": {"joint": "guide", "speed": 1.0}},
        "/drivers/second/joint",
        ["cannot be driven: it is a pin in a slot", "drive an ideal revolute or prismatic joint"],
    ),
    "a start of a slider in its guide": (
        {
            "/joints/guide": GUIDE | {"clearance": WALLS},
            "/start/joints": {"guide": {"eccentricity": [0.0, 1e-3]}},
        },
        "/start/joints/guide",
        ["no journal in a bearing", "starts in 'guides', by its 'offset' (m)"],
    ),
    "a start of a guide without play": (
        {"/joints/guide": GUIDE, "/start/guides": {"guide": {"offset": 1e-3}}},
        "/start/guides/guide",
        ["has no clearance", "leave it out"],
    ),
    "a start of a slider in a wall": (
        {
            "/joints/guide": GUIDE | {"clearance": WALLS},
            "/start/guides": {"guide": {"offset": -0.05}},
        },
        "/start/guides/guide/offset",
        ["half of what joint 'guide' guides, or more, would be in a wall or a cam; its play is"],
    ),
    "a start of a slider whose corner is in a wall": (
        {
            "/joints/guide": GUIDE | {"clearance": WALLS},
            "/start/guides": {"guide": {"tilt": 1.0}},
        },
        "/start/guides/guide/tilt",
        ["would be in a wall"],
    ),
    "a start of a pin in a wall": (
        {
            "/joints/guide": SLOT
            | {"clearance": {"wall_clearance": 1e-4, "pin_radius": 5e-3, **PUSHED}},
            "/start/guides": {"guide": {"offset": 5.2e-3}},
        },
        "/start/guides/guide/offset",
        ["would be in a wall or a cam; its play is 0.0001 m"],
    ),
    "a start of a roller in its cam": (
        {
            "/joints/cam": ROLLER | {"roller_radius": 0.01, "clearance": {"lash": 1e-4, **PUSHED}},
            "/start/guides": {"cam": {"offset": -0.05}},
        },
        "/start/guides/cam/offset",
        ["would be in a wall or a cam; its play is 0.0001 m"],
    ),
    "a start of a flat face beyond its cam": (
        {
            "/joints/cam": FACE | {"clearance": {"lash": 1e-4, **PUSHED}},
            "/start/guides": {"cam": {"offset": -0.0201}},
        },
        "/start/guides/cam/offset",
        ["would be in a wall or a cam; its play is 0.0001 m"],
    ),
    "a start of a journal in a guide": (
        {"/joints/B/clearance": PLAY, "/start/guides": {"B": {"offset": 1e-4}}},
        "/start/guides/B",
        ["'B' is a journal; say where it starts in 'joints'."],
    ),
    "a cam that is no cam after a turn": (
        {"/joints/cam": FACE | {"profile": WAVE | {"frequency": 1.5}}},
        "/joints/cam/profile",
        ["repeats every turn of its cam, 2 pi rad; this one repeats after 4.18879"],
    ),
    "a cam that a face cannot follow": (
        {"/joints/cam": FACE | {"profile": WAVE | {"frequency": 3.0}}},
        "/joints/cam/profile",
        ["At 0.524 rad the cam is not convex (radius of curvature -0.05 m)", "enlarge the base"],
    ),
    "a cam that its roller cuts away": (
        {"/joints/cam": ROLLER | {"roller_radius": 0.05}},
        "/joints/cam/roller_radius",
        ["At 3.48 rad", "a radius of 0.02828 m", "a roller of 0.05 m cuts the cam away"],
    ),
    "a cam without a base": (
        {"/joints/cam": FACE | {"profile": WAVE | {"offset": 0.0}}},
        "/joints/cam/profile",
        ["The profile is -0.01 m at 4.71 rad", "add a base radius"],
    ),
    "a lash that leaves no cam": (
        {"/joints/cam": FACE | {"clearance": {"lash": 0.03, "contact": WALLS["contact"]}}},
        "/joints/cam/clearance/lash",
        ["A lash of 0.03 m leaves nothing", "whose profile is 0.02 m at 4.71 rad", "larger"],
    ),
    "a lash that leaves no cam inside of a roller": (
        {
            "/joints/cam": ROLLER
            | {
                "profile": {"type": "constant", "value": 0.01},
                "roller_radius": 0.0098,
                "clearance": {"lash": 5e-4, "contact": WALLS["contact"]},
            }
        },
        "/joints/cam/clearance/lash",
        ["A lash of 0.0005 m leaves nothing", "a roller of 0.0098 m leaves it 0.0002 m", "larger"],
    ),
    "a lash that leaves no convex cam": (
        {
            "/joints/cam": FACE
            | {
                "profile": TWO_LOBES | {"offset": 0.02, "amplitude": 0.0066},
                "clearance": {"lash": 5e-4, "contact": WALLS["contact"]},
            }
        },
        "/joints/cam/clearance/lash",
        ["A lash of 0.0005 m leaves no convex cam", "radius of curvature is 0.0002 m", "larger"],
    ),
    "a cam that its roller cuts in two": (
        {
            "/joints/cam": ROLLER
            | {
                "profile": TWO_LOBES | {"offset": 0.01, "amplitude": 0.006},
                "roller_radius": 0.005,
            }
        },
        "/joints/cam/roller_radius",
        ["The profile is 0.004 m at 1.57 rad", "a roller of 0.005 m covers the cam's centre"],
    ),
    "a cam whose law needs radii": (
        {"/joints/cam": FACE | {"clearance": {"lash": 1e-4, "contact": {"law": LAW}}}},
        "/joints/cam/clearance/contact",
        ["which a wall or a cam has not", "give a stiffness"],
    ),
    "a point of the drawing that is not there": (
        {"/start/points": {"coupler.c": [1.0, 0.5]}},
        "/start/points/coupler.c",
        ["There is no point of 'coupler' named 'c'; there are: a, b."],
    ),
    "a driver of two forms": (
        {"/drivers/motor": {"joint": "O", "speed": 10.0, "motion": {"type": "constant"}}},
        "/drivers/motor/speed",
        ["'speed' does not go with the others here; leave it or them out."],
    ),
    "a preset that is written out, too": (
        {"/preset": "four-bar"},
        "/bodies",
        ["'bodies' does not go with the others here; leave it or them out."],
    ),
    "a field misspelt": (
        {"/joints/B/clearance": PLAY | {"contact": PLAY["contact"] | {"stifness": 1e9}}},
        "/joints/B/clearance/contact/stifness",
        ["did you mean 'stiffness'?"],
    ),
}


@pytest.mark.parametrize("case", BAD)
def test_a_bad_mechanism_is_refused_with_field_number_and_remedy(case: str) -> None:
    changes, pointer, words = BAD[case]
    with pytest.raises(InvalidInput) as refused:
        admit(of(changes))
    found = {problem.pointer: problem.detail for problem in refused.value.problems}
    assert f"/scene{pointer}" in found, found
    for word in words:
        assert word in found[f"/scene{pointer}"]


def test_the_mechanism_that_they_spoil_is_accepted() -> None:
    assert admit(of({})).period


def of(changes: dict[str, Any]) -> dict[str, Any]:
    scene = copy.deepcopy(FOUR_BAR)
    for path, value in changes.items():
        *parents, last = path.strip("/").split("/")
        place = scene
        for key in parents:
            place = place[key]
        place[last] = copy.deepcopy(value)
    return {"kind": "simulate", "scene": scene, "duration": 0.1}
