"""Studies read over HTTP when they are done, and what is refused."""

import httpx
import numpy as np
import pytest

from jointplay.service.studies import schemas
from tests.service.answers import get
from tests.worker_by_hand import BIFURCATION, known_section

OBSERVED = "A.eccentricity_x"


def column_of(http: httpx.Client, job: str, observable: str) -> int:
    observed: list[str] = get(http, f"/v1/jobs/{job}")["job"]["observables"]
    return observed.index(observable)


@pytest.mark.parametrize(
    ("study", "result", "model"),
    [
        ("finished_study", "bifurcation", schemas.Bifurcation),
        ("finished_study", "poincare", schemas.Sections),
        ("finished_sweep", "sweep", schemas.Sweep),
        ("finished_accuracy", "accuracy", schemas.Accuracy),
        ("finished_study", "points?observables=*", schemas.Points),
        ("finished_sweep", "points", schemas.Points),
        ("finished_accuracy", "points", schemas.Points),
    ],
)
def test_answers_are_as_the_openapi_document_says(http, request, study, result, model):
    answer = http.get(f"/v1/jobs/{request.getfixturevalue(study)}/{result}")
    document = model.model_validate_json(answer.content, strict=True)
    assert document.model_dump(mode="json") == answer.json()  # nothing more, nothing less


@pytest.mark.parametrize(
    ("study", "view", "shown", "asked"),
    [
        ("finished_study", "bifurcation", {}, {"observables": OBSERVED}),
        ("finished_study", "bifurcation", {"section_start": 2}, {"observables": OBSERVED}),
        ("finished_study", "poincare", {"start": 3, "stop": 9}, {"observables": "*"}),
        ("finished_sweep", "sweep", {"start": 2}, {}),
        ("finished_sweep", "sweep", {"channel": "A.*"}, {"channels": "A.*"}),
    ],
)
def test_every_view_is_part_of_the_points(http, request, study, view, shown, asked):
    job = request.getfixturevalue(study)
    observed = {"observable": OBSERVED} if view == "bifurcation" else {}
    seen = get(http, f"/v1/jobs/{job}/{view}", **shown, **observed)
    window = {name: value for name, value in shown.items() if name != "channel"}
    whole = get(http, f"/v1/jobs/{job}/points", **window, **asked)
    assert (whole["shape"], whole["axes"]) == ([whole["points"]], [])
    for name, value in seen.items():
        if name == "sections":  # of one observable
            assert value == whole["sections"][OBSERVED]
        elif name == "channels":
            assert value == whole["sections"]
        elif name not in ("parameter", "directions", "observable"):
            assert value == whole[name], name


def test_points_of_an_accuracy_study_say_which_run_each_is(http, finished_accuracy):
    points = get(http, f"/v1/jobs/{finished_accuracy}/points", stop=4)
    assert points["time"] is None
    assert [run["reference"] for run in points["runs"]][:3] == [True, True, False]
    found = get(http, f"/v1/jobs/{finished_accuracy}/accuracy")["points"]
    assert points["statistics"]["error"]["values"][2:] == [one["error"] for one in found[:2]]


def test_a_diagram_has_values_status_sections_verdicts_and_failures(http, finished_study):
    found = get(http, f"/v1/jobs/{finished_study}/bifurcation", observable=OBSERVED)
    assert (found["complete"], found["points"], found["start"]) == (True, 20, 0)
    assert (found["parameter"], found["directions"], found["next_start"]) == (
        "clearance",
        None,
        None,
    )
    clearance = found["values"]["clearance"]
    assert clearance["unit"] == "m"
    assert clearance["values"] == np.linspace(1e-4, 1e-3, 20).tolist()
    assert [i for i, status in enumerate(found["status"]) if status == "failed"] == [3, 17]
    assert set(found["status"]) == {"done", "failed"}
    assert found["failures"][0] == {
        "point": 3,
        "code": "step-size-underflow",
        "detail": "The step fell below 1e-15 s.",
        "time": 0.7,
    }
    assert (found["observable"], found["sections"]["unit"]) == (OBSERVED, "m")
    rows = found["sections"]["values"]
    column = column_of(http, finished_study, OBSERVED)
    assert rows[5] == known_section(5, column, np.arange(6)).tolist()
    assert [len(row) for row in rows] == [3 if point in (3, 17) else 6 for point in range(20)]
    assert found["verdicts"][:5] == ["undecided", "periodic", "quasi-periodic", None, "undecided"]
    exponents = found["indicators"]["lyapunov"]
    assert (exponents["unit"], exponents["values"][:4]) == ("1/s", [0.0, 0.1, 0.2, None])
    assert found["reasons"][2:5] == ["point 2 was judged", None, "point 4 was judged"]
    assert "verdict" not in found["indicators"]
    assert found["statistics"]["steps"]["values"][19] == 1019.0


def test_without_an_observable_the_first_one_is_shown(http, finished_study):
    job = get(http, f"/v1/jobs/{finished_study}")["job"]
    shown = get(http, f"/v1/jobs/{finished_study}/bifurcation")
    assert shown["observable"] == job["observables"][0]


def test_a_range_of_points_and_of_sections(http, finished_study):
    query = {"observable": OBSERVED, "start": 16, "stop": 19}
    found = get(http, f"/v1/jobs/{finished_study}/bifurcation", **query)
    assert (found["start"], len(found["status"]), found["next_start"]) == (16, 3, None)
    assert [failure["point"] for failure in found["failures"]] == [17]
    query |= {"section_start": 2, "section_stop": 4}
    found = get(http, f"/v1/jobs/{finished_study}/bifurcation", **query)
    column = column_of(http, finished_study, OBSERVED)
    assert found["sections"]["values"] == [
        known_section(16, column, np.arange(2, 4)).tolist(),
        known_section(17, column, np.arange(2, 3)).tolist(),
        known_section(18, column, np.arange(2, 4)).tolist(),
    ]


def test_sections_of_points_have_times_and_channels(http, finished_study):
    query = {"channels": "A.eccentricity_*", "start": 3, "stop": 5}
    found = get(http, f"/v1/jobs/{finished_study}/poincare", **query)
    assert len(found["channels"]) == 4
    assert found["time"]["unit"] == "s"
    assert [len(row) for row in found["time"]["values"]] == [3, 6]
    column = column_of(http, finished_study, "A.eccentricity_rate_y")
    rows = found["channels"]["A.eccentricity_rate_y"]
    assert rows["unit"] == "m/s"
    assert rows["values"][1] == known_section(4, column, np.arange(6)).tolist()


def test_of_one_point_only_a_window_is_sent(http, finished_study):
    query = {"start": 4, "stop": 5, "section_start": 5, "channels": OBSERVED}
    found = get(http, f"/v1/jobs/{finished_study}/poincare", **query)
    assert found["time"]["values"] == [[105.0]]


def test_a_sweep_has_extremes_and_ranges_at_every_point(http, finished_sweep):
    found = get(http, f"/v1/jobs/{finished_sweep}/sweep", channel="displacement,A.*")
    assert found["values"]["clearance"]["values"] == [1e-4, 1e-4, 2e-4, 2e-4, 3e-4, 3e-4]
    assert found["values"]["friction"]["values"] == [0.0, 0.05] * 3
    assert found["peaks"].keys() == {"displacement", "A.normal_force", "A.penetration"}
    force = found["peaks"]["A.normal_force"]
    assert force["unit"] == "N"
    assert force["maximum"] == [1.0, 2.0, 3.0, 4.0, None, 6.0]
    assert force["minimum"][1] == -2.0
    assert force["range"][5] == 12.0
    assert (force["minimum_time"][0], force["maximum_time"][0]) == (0.25, 0.75)
    assert found["status"][4] == "failed"


def test_a_sweep_has_the_statistics_that_it_was_asked_for(http, finished_sweep):
    whole = get(http, f"/v1/jobs/{finished_sweep}/sweep")
    assert whole["statistics"]["displacement.mean"] == {
        "unit": "m",
        "long_name": f"mean of {whole['peaks']['displacement']['long_name']}",
        "values": [0.0, 0.5, 1.0, 1.5, None, 2.5],
    }
    found = get(http, f"/v1/jobs/{finished_sweep}/sweep", channel="A.*")["statistics"]
    of_others = {name for name in whole["statistics"] if name.startswith(("displ", "vel", "acc"))}
    assert of_others == {"displacement.mean", "velocity.mean", "acceleration.mean"}
    assert found.keys() == {"steps", "A.normal_force.mean", "A.penetration.mean"} | {
        "A.contact_share",
        "B.contact_share",
    }
    assert found["B.contact_share"]["long_name"].startswith("share of the time in contact")


def test_many_points_come_in_pages(http, worker, monkeypatch):
    monkeypatch.setattr("jointplay.service.studies.queries.MOST_VALUES", 100)
    job = worker.finished_study(**BIFURCATION)
    start, status, rows = 0, [], []
    while start is not None:
        page = get(http, f"/v1/jobs/{job}/bifurcation", start=start)
        assert page["start"] == start == len(status)
        status += page["status"]
        rows += page["sections"]["values"]
        start = page["next_start"]
    assert (len(status), len(rows)) == (20, 20)
    assert rows[19] == known_section(19, 0, np.arange(6)).tolist()
    monkeypatch.setattr("jointplay.service.studies.queries.MOST_VALUES", 10)
    problem = get(http, f"/v1/jobs/{job}/bifurcation", 422)
    assert problem["type"] == "/problems/response-too-large"
    assert "section_stop" in problem["detail"]
    assert get(http, f"/v1/jobs/{job}/bifurcation", section_stop=2)["next_start"] == 1


def test_continuation_in_both_directions_says_which_point_is_which(http, worker):
    job = worker.finished_study(**BIFURCATION, continuation="both", chains=2)
    found = get(http, f"/v1/jobs/{job}/bifurcation")
    assert found["points"] == 40
    assert found["directions"] == ["forward"] * 20 + ["backward"] * 20
    values = found["values"]["clearance"]["values"]
    assert values[:20] == values[20:]


@pytest.mark.parametrize(
    ("study", "result"),
    [
        ("finished_study", "sweep"),
        ("finished_study", "history"),
        ("finished_study", "peaks"),
        ("finished_sweep", "bifurcation"),
        ("finished_sweep", "poincare"),
        ("finished_sweep", "impacts"),
        ("finished_job", "bifurcation"),
        ("finished_job", "sweep"),
        ("finished_job", "accuracy"),
        ("finished_sweep", "accuracy"),
        ("finished_accuracy", "sweep"),
        ("finished_accuracy", "poincare"),
    ],
)
def test_what_a_kind_does_not_have_is_not_found_and_what_it_has_is_said(
    http, request, study, result
):
    job = request.getfixturevalue(study)
    problem = get(http, f"/v1/jobs/{job}/{result}", 404)
    assert problem["type"] == "/problems/wrong-kind"
    links = get(http, f"/v1/jobs/{job}")["links"]
    assert result not in links
    assert all(link in problem["detail"] for name, link in links.items() if name == "figures")


@pytest.mark.parametrize("study", ["finished_study", "finished_sweep", "finished_accuracy"])
def test_every_link_of_a_study_leads_somewhere(http, request, study):
    job = request.getfixturevalue(study)
    for name, link in get(http, f"/v1/jobs/{job}")["links"].items():
        answer = http.post(link) if name == "cancel" else http.get(link)
        assert answer.is_success, (name, answer.text)


@pytest.mark.parametrize(
    ("result", "query", "parameter"),
    [
        ("bifurcation", {"observable": "A.excentricity_x"}, "observable"),
        ("bifurcation", {"observable": ""}, "observable"),
        ("bifurcation", {"start": 20}, "start"),
        ("bifurcation", {"stop": 21}, "stop"),
        ("bifurcation", {"start": 5, "stop": 5}, "stop"),
        ("bifurcation", {"start": -1}, "start"),
        ("bifurcation", {"start": 0.5}, "start"),
        ("bifurcation", {"section_stop": 7}, "section_stop"),
        ("bifurcation", {"channels": OBSERVED}, "channels"),
        ("poincare", {"channels": "slider8.x"}, "channels"),
        ("poincare", {"start": 1.5}, "start"),
        ("poincare", {"stop": -2}, "stop"),
        ("poincare", {"section_start": 6}, "section_start"),
        ("figures/section.png", {"start": 30}, "start"),
        ("figures/section.png", {"start": 1.5}, "start"),
        ("figures/section.png", {}, "start"),
        ("figures/bifurcation.png", {"joints": "A"}, "joints"),
        ("figures/bifurcation.png", {"stop": 21}, "stop"),
    ],
)
def test_a_wrong_parameter_is_named(http, finished_study, result, query, parameter):
    problem = get(http, f"/v1/jobs/{finished_study}/{result}", 422, **query)
    assert [error["parameter"] for error in problem["errors"]] == [parameter]
    assert problem["errors"][0]["detail"].endswith((".", "?"))


def test_a_near_observable_and_a_near_channel_are_named(http, finished_study, finished_sweep):
    wrong = {"observable": "A.excentricity_x"}
    problem = get(http, f"/v1/jobs/{finished_study}/bifurcation", 422, **wrong)
    assert problem["type"] == "/problems/unknown-channel"
    assert OBSERVED in problem["detail"]
    problem = get(http, f"/v1/jobs/{finished_sweep}/sweep", 422, channel="A.normal_forces")
    assert problem["errors"][0]["parameter"] == "channel"
    assert "A.normal_force" in problem["detail"]


def test_a_simulation_has_no_sections_by_number(http, finished_job):
    problem = get(http, f"/v1/jobs/{finished_job}/poincare", 422, section_start=1)
    assert problem["errors"][0]["parameter"] == "section_start"


def test_figures_of_a_study_are_listed_and_drawn(http, finished_study, finished_sweep):
    figures = get(http, f"/v1/jobs/{finished_study}/figures")["figures"]
    assert [figure["name"] for figure in figures] == ["bifurcation", "exponents"]
    assert http.get(figures[0]["png"]).content.startswith(b"\x89PNG")
    assert b"<svg" in http.get(figures[0]["svg"]).content
    one = http.get(f"/v1/jobs/{finished_study}/figures/section.png", params={"start": 4, "stop": 5})
    assert one.content.startswith(b"\x89PNG")
    figures = get(http, f"/v1/jobs/{finished_sweep}/figures")["figures"]
    assert [figure["name"] for figure in figures] == ["sweep"]
    assert http.get(figures[0]["png"]).content.startswith(b"\x89PNG")
    mean = http.get(
        f"/v1/jobs/{finished_sweep}/figures/A.normal_force.mean.png", params={"stop": 2}
    )
    assert mean.content.startswith(b"\x89PNG")
    assert "sweep" in get(http, f"/v1/jobs/{finished_sweep}/figures/orbit.png", 404)["detail"]


def test_an_accuracy_study_tells_what_each_run_costs_and_recommends_one(http, finished_accuracy):
    found = get(http, f"/v1/jobs/{finished_accuracy}/accuracy")
    # as the worker played by hand stores them: half the number of the point
    assert (found["complete"], found["duration"]) == (True, 0.003)
    assert (found["window"], found["uncertainty"]) == (0.5, 0.5)
    assert [one["method"] for one in found["points"]] == ["tsitouras"] * 2 + ["rk4"] * 6 + [
        "tsitouras"
    ]
    assert found["points"][0] == {
        "method": "tsitouras",
        "tolerance": 1e-4,
        "step": None,
        "admitted": False,
        "error": 1.0,
        "relative_energy_residual": 1.0,
        "steps": 1002,
        "evaluations": 1,
        "seconds": 1.0,
        "failure": None,
    }
    assert found["points"][2]["step"] == pytest.approx(2e-4)
    assert found["advice"].startswith("The default, tsitouras at 1e-06, makes an error of 5.0e+00")
    figures = get(http, f"/v1/jobs/{finished_accuracy}/figures")["figures"]
    assert [figure["name"] for figure in figures] == ["work-precision"]
    assert http.get(figures[0]["png"]).content.startswith(b"\x89PNG")
    assert b"<svg" in http.get(figures[0]["svg"]).content
