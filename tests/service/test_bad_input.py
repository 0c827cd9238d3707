"""Everything that a client can get wrong in a job: a 4xx problem document that names the field."""

import copy
import gzip
import json
from collections.abc import Callable
from typing import Any

import httpx
import pytest

from jointplay.service.body import LARGEST_BODY, MOST_TOGETHER
from jointplay.solver.scene import presets

PRESS = {"kind": "simulate", "scene": {"preset": "seven-bar-press"}, "duration": 2.0}


def press(**fields: Any) -> dict[str, Any]:
    return {**PRESS, **fields}


def press_with(**parameters: Any) -> dict[str, Any]:
    return press(scene={"preset": "seven-bar-press", "parameters": parameters})


def own_scene(change: Callable[[dict[str, Any]], None]) -> dict[str, Any]:
    """A job with the pendulum's scene given whole, changed."""
    scene = copy.deepcopy(presets.document("pendulum"))
    change(scene)
    return {"kind": "simulate", "scene": scene, "duration": 1.0}


def diagram(**fields: Any) -> dict[str, Any]:
    """A bifurcation diagram of the press over its clearance, changed."""
    values = {"from": 1e-4, "to": 1e-3, "count": 20}
    job = {"kind": "bifurcation", "scene": PRESS["scene"], "parameter": "clearance"}
    return {**job, "values": values, **fields}


def without(field: str) -> dict[str, Any]:
    return {name: value for name, value in PRESS.items() if name != field}


def _unknown_body(scene: dict[str, Any]) -> None:
    joint = next(iter(scene["joints"].values()))
    joint["journal"] = "nobody.pivot"


def _unknown_point(scene: dict[str, Any]) -> None:
    joint = next(iter(scene["joints"].values()))
    joint["journal"] = joint["journal"].split(".")[0] + ".nowhere"


def _extra_field(scene: dict[str, Any]) -> None:
    scene["colour"] = "red"


def _over_constrained(scene: dict[str, Any]) -> None:
    name, joint = next(iter(scene["joints"].items()))
    scene["joints"]["second"] = {
        "type": "fixed",
        "base": joint["bearing"],
        "part": joint["journal"],
    }
    assert name != "second"


def _adrift(scene: dict[str, Any]) -> None:
    scene["bodies"]["adrift"] = {"mass": 1.0, "inertia": 1.0, "points": {}}


def _cannot_close(scene: dict[str, Any]) -> None:
    """Pin both ends of a body to ground points further apart than the body is long."""
    body = next(iter(scene["bodies"].values()))
    body["points"]["far"] = [0.1, 0.0]
    name = next(iter(scene["bodies"]))
    scene["ground"]["points"]["elsewhere"] = [1e3, 0.0]
    scene["joints"]["second"] = {
        "type": "revolute",
        "bearing": "ground.elsewhere",
        "journal": f"{name}.far",
    }


REFUSED = {
    "unknown kind": (press(kind="simulation"), "/kind"),
    "no kind": (without("kind"), "/kind"),
    "no scene": (without("scene"), "/scene"),
    "no duration": (without("duration"), "/duration"),
    "unknown field": (press(durations=1.0), "/durations"),
    "unknown preset": (press(scene={"preset": "six-bar-press"}), "/scene/preset"),
    "unknown parameter": (press_with(clearence=1e-4), "/scene/parameters/clearence"),
    "unknown channel": (press(channels=["slider8.x"]), "/channels/0"),
    "negative clearance": (press_with(clearance=-1e-4), "/scene/parameters/clearance"),
    "clearance not below the bearing's radius": (
        press_with(clearance=5e-3),
        "/scene/parameters/clearance",
    ),
    "a required parameter": (
        press(scene={"preset": "seven-bar-test-bed"}),
        "/scene/parameters/pivot_distance",
    ),
    "stiffness missing for another exponent": (
        press_with(exponent=1.2),
        "/scene/parameters/exponent",
    ),
    "static above dynamic velocity": (
        press_with(static_velocity=1e-2),
        "/scene/parameters/static_velocity",
    ),
    "duration zero": (press(duration=0.0), "/duration"),
    "duration negative": (press(duration=-1.0), "/duration"),
    "duration a text": (press(duration="2"), "/duration"),
    "duration a truth value": (press(duration=True), "/duration"),
    "too many periods": (press(duration=1e7), "/duration"),
    "too many samples": (press(output_step=1e-9), "/output_step"),
    "tolerance too tight": (press(tolerance=1e-20), "/tolerance"),
    "tolerance and accuracy": (press(tolerance=1e-6, accuracy="standard"), "/accuracy"),
    "unknown formulation": (press(formulation="hamilton"), "/formulation"),
    "label not a text": (press(label=7), "/label"),
    "not an object": ([PRESS], ""),
    "unknown body": (own_scene(_unknown_body), "/scene/joints/"),
    "unknown point": (own_scene(_unknown_point), "/scene/joints/"),
    "unknown field of a scene": (own_scene(_extra_field), "/scene/colour"),
    "over-constrained": (own_scene(_over_constrained), "/scene/joints"),
    "under-constrained": (own_scene(_adrift), "/scene/bodies/adrift"),
    "an assembly that cannot close": (own_scene(_cannot_close), "/scene/"),
    "a study over an unknown parameter": (diagram(parameter="clearence"), "/parameter"),
    "a value outside its range": (diagram(values=[1e-4, 2e-4, -1.0]), "/values/2"),
    "no values": (diagram(values={"from": 1e-4, "to": 1e-3, "count": 0}), "/values/count"),
    "a thousand million values": (
        diagram(values={"from": 1e-4, "to": 1e-3, "count": 10**9}),
        "/values",
    ),
    "a section at a joint without play": (diagram(section={"onset": "D"}), "/section/onset"),
    "a section that nothing crosses": (
        diagram(section={"channel": "displacement", "value": 9.0}),
        "/section/value",
    ),
    "speeds without a common period": (
        diagram(scene={"preset": "seven-bar-press", "parameters": {"speed_crank4": -1.0}}),
        "/values",
    ),
    "a study with a duration": (diagram(duration=2.0), "/duration"),
}


@pytest.mark.parametrize(("job", "expected"), REFUSED.values(), ids=REFUSED)
def test_a_wrong_job_is_refused_with_the_field_and_what_would_be_right(
    http: httpx.Client, job: object, expected: str
) -> None:
    problem = refused(http, json.dumps(job).encode(), 422)
    pointers = [error["pointer"] for error in problem["errors"]]
    assert any(pointer.startswith(expected) for pointer in pointers), problem
    assert all(len(error["detail"]) >= 15 for error in problem["errors"])


def test_wrong_parameters_are_told_together_with_a_missing_field(http: httpx.Client) -> None:
    press = press_with(clearence=1e-4, friction=-0.1, speed="fast")
    job = {name: value for name, value in press.items() if name != "duration"}
    problem = refused(http, json.dumps(job).encode(), 422)
    told = {error["pointer"]: error["detail"] for error in problem["errors"]}
    wrong = {f"/scene/parameters/{name}" for name in ("clearence", "friction", "speed")}
    assert told.keys() == {"/duration"} | wrong
    assert told["/scene/parameters/friction"] == "'friction' is -0.1; it lies between 0 and 10."
    assert "did you mean 'clearance'?" in told["/scene/parameters/clearence"]


def test_where_no_field_is_near_all_that_there_are_are_listed(http: httpx.Client) -> None:
    problem = refused(http, json.dumps(diagram(duration=2.0)).encode(), 422)
    (told,) = [one["detail"] for one in problem["errors"] if one["pointer"] == "/duration"]
    assert told.endswith("scene, section, settle, step, tolerance, values.")


MALFORMED = {
    "NaN": (b'{"kind": "simulate", "duration": NaN}', "/duration"),
    "infinity": (b'{"kind": "simulate", "duration": -Infinity}', "/duration"),
    "1e400": (b'{"kind": "simulate", "duration": 1e400}', "/duration"),
    "integer of 5000 digits": (b'{"duration": ' + b"9" * 5000 + b"}", "/duration"),
    "key twice": (b'{"kind": "simulate", "kind": "simulate"}', "/kind"),
    "cut off": (b'{"kind": "simul', ""),
    "empty": (b"", ""),
    "not UTF-8": (b'{"label": "\xff"}', ""),
    "half a surrogate pair": (b'{"label": "\\ud800"}', "/label"),
    "100 000 levels": (b"[" * 100_000, ""),
    "500 levels": (b'{"scene":' * 500 + b"1" + b"}" * 500, ""),
}


@pytest.mark.parametrize(("body", "pointer"), MALFORMED.values(), ids=MALFORMED)
def test_a_body_that_is_not_json_is_refused_with_the_pointer(
    http: httpx.Client, body: bytes, pointer: str
) -> None:
    problem = refused(http, body, 400)
    assert [error["pointer"] for error in problem["errors"]] == [pointer]


def test_the_estimate_is_given_when_a_limit_is_exceeded(http: httpx.Client) -> None:
    problem = refused(http, json.dumps(press(output_step=1e-9)).encode(), 422)
    assert problem["type"] == "/problems/limit-exceeded"
    assert "2e+09 samples" in problem["errors"][0]["detail"]


def test_a_body_of_ten_megabytes_is_not_read(http: httpx.Client) -> None:
    refused(http, b" " * 10_000_000, 413)
    assert LARGEST_BODY < 10_000_000


def test_answered_bodies_leave_their_room_to_others(http: httpx.Client) -> None:
    for _ in range(MOST_TOGETHER // LARGEST_BODY + 1):
        refused(http, b" " * (LARGEST_BODY + 1), 413)


def test_another_media_type_is_refused(http: httpx.Client) -> None:
    answer = http.post("/v1/jobs", content=b"{}", headers={"Content-Type": "text/plain"})
    assert answer.status_code == 415
    assert "application/json" in answer.json()["detail"]


def test_a_compressed_body_is_refused_as_such(http: httpx.Client) -> None:
    sent = {"Content-Type": "application/json", "Content-Encoding": "gzip"}
    answer = http.post("/v1/jobs", content=gzip.compress(b" " * 10_000_000), headers=sent)
    assert answer.status_code == 415
    assert "without a Content-Encoding" in answer.json()["detail"]
    assert answer.headers["Accept-Encoding"] == "identity"
    sent["Content-Encoding"] = "identity"
    assert http.post("/v1/jobs", content=b"{}", headers=sent).status_code == 422


def test_what_was_refused_was_not_queued(http: httpx.Client) -> None:
    before = http.get("/v1/jobs").json()["jobs"]
    refused(http, json.dumps(press(duration=-1.0)).encode(), 422)
    assert http.get("/v1/jobs").json()["jobs"] == before


def refused(http: httpx.Client, body: bytes, status: int) -> dict[str, Any]:
    answer = http.post("/v1/jobs", content=body, headers={"Content-Type": "application/json"})
    assert answer.status_code == status, answer.text
    assert answer.headers["Content-Type"] == "application/problem+json"
    problem: dict[str, Any] = answer.json()
    assert problem["status"] == status
    assert problem["instance"] == "/v1/jobs"
    assert http.get(problem["type"]).json()["status"] == status  # the type can be looked up
    return problem
