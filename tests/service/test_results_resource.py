"""Results of a finished job, read over HTTP; and what is answered while it is not finished."""

import pytest

from jointplay.records.job import JobError
from jointplay.service.results import schemas
from jointplay.storage.catalogue.records import BlockState
from tests.service.answers import get

RESULTS = ["history", "peaks", "poincare", "impacts", "statistics", "figures", "figures/orbit.png"]


@pytest.mark.parametrize(
    ("result", "model"),
    [
        ("history", schemas.History),
        ("poincare", schemas.Poincare),
        ("peaks", schemas.Peaks),
        ("impacts", schemas.Impacts),
        ("statistics", schemas.Statistics),
        ("figures", schemas.Figures),
    ],
)
def test_results_are_as_the_openapi_document_says(http, finished_job, result, model):
    answer = http.get(f"/v1/jobs/{finished_job}/{result}")
    document = model.model_validate_json(answer.content, strict=True)
    assert document.model_dump(mode="json") == answer.json()  # nothing more, nothing less


def test_history_has_the_stored_numbers_with_their_units(http, finished_job):
    history = get(http, f"/v1/jobs/{finished_job}/history")
    assert history["complete"] is True
    assert history["time"]["unit"] == "s"
    assert len(history["time"]["values"]) == 2001
    assert history["time"]["values"][-1] == 2.0
    slider = history["channels"]["slider7.vx"]
    assert slider["unit"] == "m/s"
    column = list(history["channels"]).index("slider7.vx")
    assert slider["values"] == [column + time for time in history["time"]["values"]]


def test_history_of_a_window_has_both_ends_and_only_the_channels_asked_for(http, finished_job):
    history = get(
        http,
        f"/v1/jobs/{finished_job}/history",
        channels="A.normal_force, slider7.*",
        start=0.5,
        stop=0.51,
    )
    times = history["time"]["values"]
    assert (times[0], times[-1], len(times)) == (0.5, 0.51, 11)
    assert "A.normal_force" in history["channels"]
    assert {name.split(".")[0] for name in history["channels"]} == {"A", "slider7"}
    assert all(len(one["values"]) == 11 for one in history["channels"].values())


def test_a_window_without_samples_is_empty(http, finished_job):
    history = get(http, f"/v1/jobs/{finished_job}/history", start=5.0)
    assert history["time"]["values"] == []


def test_an_unknown_channel_is_refused_with_those_that_are_near(http, finished_job):
    problem = get(http, f"/v1/jobs/{finished_job}/history", 422, channels="slider7.vX")
    assert problem["errors"][0]["parameter"] == "channels"
    assert "slider7.vx" in problem["errors"][0]["detail"]


@pytest.mark.parametrize(
    ("query", "parameter"),
    [
        ({"start": "nan"}, "start"),
        ({"stop": "inf"}, "stop"),
        ({"start": "soon"}, "start"),
        ({"start": 2.0, "stop": 1.0}, "stop"),
        ({"chanels": "slider7.x"}, "chanels"),
        ({"channels": ""}, "channels"),
        ({"channels": "x" * 30_000}, "channels"),
        ({"channels": "*" * 500 + "z"}, "channels"),
    ],
)
def test_a_wrong_parameter_is_named(http, finished_job, query, parameter):
    problem = get(http, f"/v1/jobs/{finished_job}/history", 422, **query)
    assert [error["parameter"] for error in problem["errors"]] == [parameter]


@pytest.mark.parametrize(
    ("address", "sentence"),
    [
        ("/v1/jobs?page_size=0", "'page_size' must be at least 1, not 0."),
        ("/v1/jobs?page_size=1e3", "'page_size' must be a whole number."),
        (
            "/v1/jobs?since=2026-02-31",
            "Give a moment as RFC 3339 has it, such as 2026-01-01T00:00:00Z.",
        ),
        ("/v1/jobs/{job}/history?stop=nan", "'stop' must be a finite number."),
        ("/v1/jobs/{job}/history?stop=noon", "'stop' must be a number."),
        ("/v1/jobs/{job}/history?step=-1e-3", "'step' must be greater than 0, not -0.001."),
        ("/v1/jobs/{job}/figures/outputs.png?width=900", "'width' must be at most 210, not 900."),
        (
            "/v1/jobs/{job}/figures/outputs.png?x_scale=cubic",
            "'x_scale' must be 'linear' or 'log'.",
        ),
    ],
)
def test_the_sentence_on_a_parameter_says_what_would_be_right(
    http, finished_job, address, sentence
):
    problem = http.get(address.format(job=finished_job)).json()
    assert (problem["status"], problem["errors"][0]["detail"]) == (422, sentence)


@pytest.mark.parametrize(
    ("resource", "known"), [("", "wait"), ("/statistics", "none"), ("/figures", "none")]
)
def test_a_parameter_where_there_is_none_of_its_name_is_refused(
    http, finished_job, resource, known
):
    problem = get(http, f"/v1/jobs/{finished_job}{resource}", 422, start=1.0)
    sentence = f"There is no parameter 'start' here; there are: {known}."
    assert problem["errors"] == [{"parameter": "start", "detail": sentence}]


@pytest.mark.parametrize(
    ("address", "sentence"),
    [
        ("/v1/jobs?pagesize=3", "There is no parameter 'pagesize' here; did you mean 'page_size'?"),
        (
            "/v1/jobs?colour=3",
            "there are: before, kind, label, page_size, page_token, scene, since",
        ),
        ("/v1/jobs?since=2026-01-01T00:00:00", "needs an offset, such as the Z of 2026-01-01"),
        ("/v1/jobs/{job}/figures/orbit.png?widht=3", "did you mean 'width'?"),
        ("/v1/jobs/{job}/peaks?stat=3", "did you mean 'start'?"),
    ],
)
def test_an_unknown_parameter_is_answered_with_those_that_there_are(
    http, finished_job, address, sentence
):
    problem = http.get(address.format(job=finished_job)).json()
    assert problem["status"] == 422
    assert sentence in problem["errors"][0]["detail"]


def test_a_scene_that_is_no_object_is_named_and_a_body_without_a_type(http):
    problem = http.post("/v1/scenes/check", json=[1]).json()
    assert (problem["status"], problem["errors"][0]["pointer"]) == (422, "")
    problem = http.post("/v1/scenes/drag", json={"scene": {}, "point": "a.b", "position": 1}).json()
    told = {error["pointer"]: error["detail"] for error in problem["errors"]}
    assert told["/position"] == "'position' must be a list."
    problem = http.post("/v1/jobs", content=b"{}").json()
    assert problem["detail"].startswith("The body was sent without a Content-Type; send it as")


def test_what_is_not_counted_without_keys_is_not_said_to_be_none(http, finished_job):
    used = http.get("/v1/usage").json()
    assert (used["stored_bytes"], used["core_seconds"]) == (None, None)


def test_the_energy_ledger_is_part_of_the_result(http, worker, finished_job):
    statistics = get(http, f"/v1/jobs/{finished_job}/statistics")
    assert (statistics["steps"], statistics["solver_seconds"]) == (7, 0.25)
    assert (statistics["energy"]["driver_work"], statistics["energy"]["residual"]) == (2.5, 1e-6)
    claim = worker.start(worker.submit())
    worker.store_nothing(claim)
    worker.finish(claim, BlockState.failed, JobError("solver", "step-size-underflow", "No step."))
    nothing = get(http, f"/v1/jobs/{claim.job.id}/statistics")
    assert (nothing["complete"], nothing["steps"], nothing["energy"]) == (False, None, None)


def test_an_answer_too_large_is_refused_with_what_would_be_small_enough(http, worker):
    job = worker.finished(output_step=1e-4)  # 20 001 samples of 96 channels
    problem = get(http, f"/v1/jobs/{job}/history", 422)
    assert problem["type"] == "/problems/response-too-large"
    assert "10309 samples (about 1.03 s)" in problem["detail"]
    window = get(http, f"/v1/jobs/{job}/history", start=0.0, stop=1.03)
    assert len(window["time"]["values"]) == 10_301
    get(http, f"/v1/jobs/{job}/history", channels="slider7.*")


def test_contacts_that_are_too_many_are_asked_for_in_windows(http, finished_job, monkeypatch):
    """The refusal advised fewer `channels`, which contacts have not."""
    monkeypatch.setattr("jointplay.service.results.queries.MOST_VALUES", 5)
    problem = get(http, f"/v1/jobs/{finished_job}/impacts", 422)
    assert problem["type"] == "/problems/response-too-large"
    assert "channels" not in problem["detail"]
    assert "6 values each" in problem["detail"]
    assert "with `start` and `stop`" in problem["detail"]


def test_peaks_are_signed_and_have_times_and_units(http, finished_job):
    peaks = get(http, f"/v1/jobs/{finished_job}/peaks")["peaks"]
    assert len(peaks) == 96
    assert peaks["slider7.ax"] == {
        "unit": "m/s^2",
        "minimum": -1.0,
        "minimum_time": 0.25,
        "maximum": 1.0,
        "maximum_time": 0.75,
    }


def test_poincare_sections_are_at_whole_periods(http, finished_job):
    sections = get(http, f"/v1/jobs/{finished_job}/poincare", channels="A.eccentricity_*")
    assert sections["time"]["values"] == [0.0, 1.0]
    assert sections["note"] == ""
    assert len(sections["channels"]) == 4
    later = get(http, f"/v1/jobs/{finished_job}/poincare", start=0.5)
    assert later["time"]["values"] == [1.0]


def test_impacts_name_their_joint_and_an_open_contact_has_no_release(http, finished_job):
    impacts = get(http, f"/v1/jobs/{finished_job}/impacts")["impacts"]
    assert impacts == [
        {
            "joint": "B",
            "onset": 0.5,
            "release": None,
            "approach_rate": 0.01,
            "peak_force": 100.0,
            "impulse": 0.2,
        }
    ]
    assert get(http, f"/v1/jobs/{finished_job}/impacts", start=1.0)["impacts"] == []


def test_figures_are_listed_and_drawn_as_png_and_svg(http, finished_job):
    figures = get(http, f"/v1/jobs/{finished_job}/figures")["figures"]
    assert {"displacement", "contact-force", "orbit"} <= {figure["name"] for figure in figures}
    displacement = next(one for one in figures if one["name"] == "displacement")
    png = http.get(displacement["png"])
    assert png.headers["Content-Type"] == "image/png"
    assert png.content.startswith(b"\x89PNG")
    svg = http.get(displacement["svg"])
    assert svg.headers["Content-Type"] == "image/svg+xml"
    assert b"<svg" in svg.content


def test_any_stored_channel_is_a_figure(http, finished_job):
    png = http.get(f"/v1/jobs/{finished_job}/figures/slider7.vx.png", params={"stop": 0.5})
    assert png.content.startswith(b"\x89PNG")


def test_options_of_the_page_are_parameters(http, finished_job):
    path = f"/v1/jobs/{finished_job}/figures/slider7.vx"
    asked = {"width": 120.0, "title": "Slider", "y_max": 3.0, "units": "mm/s"}
    pdf = http.get(f"{path}.pdf", params=asked)
    assert pdf.headers["Content-Type"] == "application/pdf"
    assert pdf.content.startswith(b"%PDF")
    assert http.get(f"{path}.png", params=asked).content != http.get(f"{path}.png").content


def test_an_unknown_figure_is_refused_with_those_there_are(http, finished_job):
    problem = get(http, f"/v1/jobs/{finished_job}/figures/obrit.png", 404)
    assert problem["type"] == "/problems/unknown-figure"
    assert "orbit" in problem["detail"]
    problem = get(http, f"/v1/jobs/{finished_job}/figures/orbit.jpg", 404)
    assert "png, svg, pdf or eps" in problem["detail"]
    assert problem["errors"][0]["parameter"] == "form"


@pytest.mark.parametrize(
    ("figure", "query", "parameter"),
    [
        ("orbit", {"joints": "Z"}, "joints"),
        ("orbit", {"start": 9.0}, "start"),
        ("mechanism", {"start": 9.0}, "start"),
        ("time-history", {}, "channels"),
        ("time-history", {"channels": "A.*"}, "channels"),
        ("phase-portrait", {"channels": "slider7.x"}, "channels"),
        ("velocity", {"joints": "A"}, "joints"),
        ("orbit", {"channels": "slider7.x"}, "channels"),
        ("orbit", {"x_scale": "log"}, "x_scale"),
        ("orbit", {"units": "furlong"}, "units"),
        ("orbit", {"width": 900.0}, "width"),
    ],
)
def test_what_a_figure_cannot_show_is_named(http, finished_job, figure, query, parameter):
    problem = get(http, f"/v1/jobs/{finished_job}/figures/{figure}.png", 422, **query)
    (error,) = problem["errors"]
    assert error["parameter"] == parameter
    assert error["detail"].endswith(".")


@pytest.mark.parametrize("result", RESULTS)
def test_results_of_a_job_that_is_not_finished_are_a_conflict(http, worker, result):
    queued = worker.submit()
    assert get(http, f"/v1/jobs/{queued}/{result}", 409)["detail"].startswith(f"Job {queued} is")
    worker.start(queued)
    assert "running" in get(http, f"/v1/jobs/{queued}/{result}", 409)["detail"]


def test_a_failed_job_serves_what_it_computed(http, worker):
    claim = worker.start(worker.submit())
    worker.store(claim, complete=False)
    error = JobError("solver", "step-size-underflow", "The step fell below 1e-15 s.", 0.7)
    worker.finish(claim, BlockState.failed, error)
    job = get(http, f"/v1/jobs/{claim.job.id}")
    assert job["state"] == "failed"
    assert job["error"] == {
        "class": "solver",
        "code": "step-size-underflow",
        "detail": "The step fell below 1e-15 s.",
        "time": 0.7,
    }
    history = get(http, f"/v1/jobs/{claim.job.id}/history", channels="slider7.x")
    assert history["complete"] is False
    assert len(history["time"]["values"]) == 2001


def test_a_job_that_ended_before_it_began_has_no_results(http, worker):
    job = worker.submit()
    http.post(f"/v1/jobs/{job}/cancel")
    problem = get(http, f"/v1/jobs/{job}/history", 404)
    assert problem["type"] == "/problems/no-results"
