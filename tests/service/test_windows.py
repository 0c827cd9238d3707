"""Windows of a history at screen resolution, and the forms that answers have."""

import io

import httpx
import numpy as np
import pyarrow.ipc
import pytest
from scipy.io import loadmat

from jointplay.service.results import schemas
from jointplay.storage.packed import Packed
from jointplay.storage.results.reader import ResultReader


@pytest.fixture(scope="module")
def job(worker):
    """20 001 samples, so that there is a pyramid; each is the column's index plus the time."""
    return worker.finished(output_step=1e-4, label="windows")


@pytest.fixture(scope="module")
def values(settings, job):
    reader = ResultReader(Packed(settings.sealed_run(job, 1)))
    time, columns = reader.history(["slider7.x", "acceleration"])
    return {"time": time, **columns}


def ask(http, job, accept="application/json", status=200, what="history", **query):
    query = {"channels": "slider7.x,acceleration"} | query
    answer = http.get(f"/v1/jobs/{job}/{what}", params=query, headers={"Accept": accept})
    assert answer.status_code == status, answer.text
    return answer


@pytest.mark.parametrize("points", [1, 2, 100, 2000])
def test_an_overview_has_the_extremes_of_all_samples(http, job, values, points):
    answer = ask(http, job, points=points)
    shown = schemas.Overview.model_validate_json(answer.content, strict=True)
    assert shown.model_dump(mode="json") == answer.json()
    assert shown.samples == 20_001
    begins = np.searchsorted(values["time"], shown.bins.first)
    assert 0.5 * points <= len(begins) <= points
    ends = [*begins[1:], 20_001]
    for name, one in shown.extremes.items():
        column = values[name]
        pairs = list(zip(begins, ends, strict=True))
        assert one.minimum == [column[b:e].min() for b, e in pairs]
        assert one.maximum == [column[b:e].max() for b, e in pairs]
    assert shown.bins.last[-1] == 2.0


def test_a_small_window_is_exact(http, job):
    shown = ask(http, job, points=100, start=0.5, stop=0.5099).json()
    assert len(shown["time"]["values"]) == 100
    shown = ask(http, job, points=100, start=0.5, stop=0.51).json()
    assert shown["samples"] == 101
    assert shown["bins"]["first"][0] == 0.5


@pytest.mark.parametrize("points", [0, -1, 10**9, "many", 1.5])
def test_a_number_of_points_that_makes_no_sense_is_refused(http, job, points):
    problem = ask(http, job, status=422, points=points).json()
    assert [error["parameter"] for error in problem["errors"]] == ["points"]


def test_too_many_points_of_too_many_channels_are_refused_with_how_many_there_may_be(http, job):
    problem = ask(http, job, status=422, points=20_000, channels="*").json()
    assert problem["type"] == "/problems/response-too-large"
    assert problem["errors"] == [{"parameter": "points", "detail": "Ask for at most 5154 points."}]
    assert len(ask(http, job, points=5154, channels="*").json()["extremes"]) == 96


@pytest.mark.parametrize(
    ("accept", "media_type"),
    [
        ("*/*", "application/json"),
        ("application/*", "application/json"),
        ("text/csv", "text/csv"),
        ("TEXT/CSV; q=0.5", "text/csv"),
        ("application/json;q=0.1, text/csv;q=0.2", "text/csv"),
        ("text/html, */*;q=0.1", "application/json"),
        ("application/json;q=0, */*", "text/csv"),
        ("application/x-npz", "application/x-npz"),
        ("application/x-matlab-data", "application/x-matlab-data"),
    ],
)
def test_accept_chooses_the_form(http, job, accept, media_type):
    answer = ask(http, job, accept, stop=0.01)
    assert answer.headers["Content-Type"].partition(";")[0] == media_type
    assert answer.headers["Vary"].split(", ")[0] == "Accept"


@pytest.mark.parametrize("accept", ["text/html", "image/png", "application/json;q=0", "nonsense"])
def test_a_form_that_there_is_not_is_refused_with_those_there_are(http, job, accept):
    answer = ask(http, job, accept, status=406)
    assert answer.headers["Vary"] == "Accept"
    problem = answer.json()
    assert problem["type"] == "/problems/not-acceptable"
    assert "text/csv" in problem["detail"]


def test_without_accept_the_answer_is_json(service_url, job):
    request = httpx.Request("GET", f"{service_url}/v1/jobs/{job}/history?stop=0.01")
    with httpx.Client(trust_env=False, timeout=60) as client:
        assert client.send(request).headers["Content-Type"] == "application/json"


def test_csv_gives_back_every_bit(http, job, values):
    text = ask(http, job, "text/csv", stop=0.1).text
    assert text.splitlines()[0] == "time [s],slider7.x [m],acceleration [m/s^2]"
    table = np.loadtxt(io.StringIO(text), delimiter=",", skiprows=1)
    for column, name in zip(table.T, values, strict=True):
        np.testing.assert_array_equal(column, values[name][:1001])


def test_npz_has_arrays_by_channel(http, job, values):
    answer = ask(http, job, "application/x-npz")
    assert f'filename="{job}-history.npz"' in answer.headers["Content-Disposition"]
    with np.load(io.BytesIO(answer.content)) as found:
        for name, column in values.items():
            np.testing.assert_array_equal(found[name], column)
        assert ["slider7.x", "m"] in found["units"].tolist()
        assert found["complete"]


def test_matlab_has_channels_as_nested_structs(http, job, values):
    content = ask(http, job, "application/x-matlab-data").content
    found = loadmat(io.BytesIO(content), simplify_cells=True)
    np.testing.assert_array_equal(found["slider7"]["x"], values["slider7.x"])
    np.testing.assert_array_equal(found["acceleration"], values["acceleration"])
    np.testing.assert_array_equal(found["time"], values["time"])
    assert found["units"]["slider7"]["x"] == "m"
    assert found["complete"] == 1


def test_arrow_has_columns_with_units(http, job, values):
    content = ask(http, job, "application/vnd.apache.arrow.stream").content
    found = pyarrow.ipc.open_stream(content).read_all()
    assert found.schema.metadata == {b"complete": b"true"}
    assert found.schema.field("slider7.x").metadata == {b"unit": b"m"}
    for name, column in values.items():
        np.testing.assert_array_equal(found[name].to_numpy(), column)


def test_overviews_and_sections_have_all_forms_too(http, job, finished_study):
    table = ask(http, job, "text/csv", points=10).text.splitlines()
    assert table[0].startswith("time_first [s],time_last [s],slider7.x_minimum [m]")
    assert 5 < len(table) <= 11
    content = ask(http, job, "application/x-matlab-data", points=10).content
    found = loadmat(io.BytesIO(content), simplify_cells=True)
    assert found["slider7"]["x"]["maximum"][-1] == found["slider7"]["x"]["minimum"][0] + 2.0
    sections = ask(http, job, "text/csv", what="poincare").text.splitlines()
    assert [line.partition(",")[0] for line in sections] == ["time [s]", "0", "1"]
    problem = http.get(f"/v1/jobs/{finished_study}/poincare", headers={"Accept": "text/csv"})
    assert problem.status_code == 406
