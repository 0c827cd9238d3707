"""Scenes checked and drawn over HTTP before they are run, and the heads and lists beside."""

import json
import math

import pytest

from jointplay.command_line.application import run
from jointplay.solver.scene import presets
from tests.command_line.four_bar import four_bar


@pytest.fixture
def jointplay_check(capsys):
    def call(*arguments):
        assert run(["scene", "check", "--json", *arguments]) == 0
        return json.loads(capsys.readouterr().out)

    return call


def check(http, scene):
    return http.post("/v1/scenes/check", json=scene)


def test_a_scene_is_checked(http, jointplay_check):
    answer = check(http, {"preset": "slider-crank", "parameters": {"clearance": 1e-4}})
    assert answer.status_code == 200
    found = answer.json()
    assert (found["scene"], found["joints_with_clearance"]) == ("slider-crank", ["P"])
    assert (found["freedom"], found["ideal_freedom"], found["problems"]) == (2, 0, [])
    assert found == jointplay_check("slider-crank", "--set", "clearance=1e-4")


def test_starts_to_paste_keep_the_turns_that_are_given(http):
    scene = four_bar()
    del scene["drivers"]
    wound = scene["start"]["angles"]["crank"] + 4.0 * math.pi
    scene["start"]["angles"]["crank"] = wound
    starts = check(http, scene).json()["starts"]
    assert len(starts) > 1
    for start in starts:
        assert start["angles"]["crank"] == pytest.approx(wound, abs=1e-7)
        pasted = check(http, scene | {"start": start}).json()
        assert pasted["pose"]["crank"][2] == pytest.approx(wound, abs=1e-7)
        assert all(given["kept"] for given in pasted["given"])


def test_a_smooth_table_that_passes_its_values_is_told(http):
    scene = presets.document("seven-bar-press-punching")
    assert check(http, scene).json()["overshoots"] == []
    scene["forces"]["punch"]["course"]["between"] = "smooth"
    (told,) = check(http, scene).json()["overshoots"]
    assert told["pointer"] == "/forces/punch/course"
    assert told["percent"] == pytest.approx(8.08, abs=0.01)
    assert 1.9417 < told["argument"] < 1.9457


def test_numbers_that_defaults_of_parameters_replace_are_told(http):
    scene = presets.document("slider-crank")
    assert check(http, scene).json()["replaced"] == []
    scene["drivers"]["motor"]["speed"] = 100
    (told,) = check(http, scene).json()["replaced"]
    assert told == {
        "pointer": "/drivers/motor/speed",
        "parameter": "speed",
        "written": 100.0,
        "taken": scene["parameters"]["speed"]["default"],
    }


def test_a_document_that_cannot_be_run_is_told_why(http):
    scene = four_bar()
    scene["bodies"]["coupler"]["points"] = {"a": [-0.001, 0.0], "b": [0.001, 0.0]}
    scene["bodies"]["rocker"]["points"] = {"a": [-0.1, 0.0], "b": [0.1, 0.0]}  # both too short
    answer = check(http, scene)
    assert answer.status_code == 200
    assert answer.json()["problems"]
    assert answer.json()["residual"] > 1e-3
    drawn = http.post("/v1/scenes/drawing.svg", json=scene)
    assert drawn.status_code == 200


@pytest.mark.parametrize(
    ("scene", "pointer"),
    [
        ({"preset": "slider-krank"}, "/preset"),
        ({"preset": "slider-crank", "parameters": {"clearence": 1}}, "/parameters/clearence"),
        ({}, ""),
        ([1], ""),
    ],
)
def test_what_is_no_scene_is_refused_at_its_field(http, scene, pointer):
    answer = check(http, scene)
    assert answer.status_code == 422
    places = [one["pointer"] for one in answer.json()["errors"]]
    assert any(one.startswith(pointer) for one in places)


@pytest.mark.parametrize(("form", "begin"), [("png", b"\x89PNG"), ("svg", b"<?xml")])
def test_a_scene_is_drawn(http, form, begin):
    answer = http.post(f"/v1/scenes/drawing.{form}", json=presets.document("pendulum"))
    assert answer.status_code == 200
    assert answer.content.startswith(begin)
    wider = http.post(f"/v1/scenes/drawing.{form}?width=120", json={"preset": "pendulum"})
    assert wider.status_code == 200
    assert wider.content != answer.content


def test_drawings_of_other_forms_are_refused(http):
    answer = http.post("/v1/scenes/drawing.doc", json={"preset": "pendulum"})
    assert (answer.status_code, answer.json()["errors"][0]["parameter"]) == (404, "form")


def test_figures_have_heads(http, finished_job):
    listed = http.head(f"/v1/jobs/{finished_job}/figures")
    assert (listed.status_code, listed.content) == (200, b"")
    drawn = http.head(f"/v1/jobs/{finished_job}/figures/outputs.svg")
    assert (drawn.status_code, drawn.headers["content-type"]) == (200, "image/svg+xml")
    assert int(drawn.headers["content-length"]) > 1000


def test_batches_are_listed_page_by_page(http):
    job = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}
    made = [
        http.post("/v1/batches", json={"jobs": [job] * size, "label": f"of {size}"}).json()["id"]
        for size in (1, 2, 3)
    ]
    first = http.get("/v1/batches?page_size=2").json()
    assert [one["id"] for one in first["batches"]] == made[:0:-1]
    assert [one["jobs"] for one in first["batches"]] == [3, 2]
    assert first["batches"][0]["states"]["queued"] == 3
    following = http.get(f"/v1/batches?page_size=1&page_token={first['next_page_token']}").json()
    assert following["batches"][0]["id"] == made[0]
    assert http.get("/v1/batches?page_token=nonsense").status_code == 422


def test_a_mechanism_that_jams_is_told_where_and_by_how_much(http, jointplay_check, tmp_path):
    scene = four_bar()
    scene["bodies"]["coupler"]["points"] = {"a": [-0.075, 0.0], "b": [0.075, 0.0]}
    found = check(http, scene).json()
    assert found["problems"] == []  # a shorter run is sound
    turn = found["turn"]
    # the crank's pin is as far from P as coupler and rocker reach
    angle = math.acos((0.1**2 + 0.4**2 - 0.45**2) / (2.0 * 0.1 * 0.4))
    assert turn["jams"]
    assert turn["reached"] == pytest.approx(angle / 10.0, abs=1e-10)
    assert turn["drivers"]["motor"] == pytest.approx(angle, abs=1e-9)
    assert f"{math.degrees(angle):.6g} deg" in turn["detail"]
    # farthest at half a turn
    assert turn["margin"]["size"] == pytest.approx(0.05, abs=1e-9)
    assert turn["margin"]["drivers"]["motor"] == pytest.approx(math.pi, abs=1e-6)
    path = tmp_path / "jams.json"
    path.write_text(json.dumps(scene))
    assert jointplay_check(str(path)) == found


def test_a_mechanism_with_play_is_told_to_turn_through(http):
    turn = check(http, {"preset": "slider-crank"}).json()["turn"]
    assert (turn["jams"], turn["reached"]) == (False, turn["span"])
    assert check(http, {"preset": "pendulum"}).json()["turn"] is None
