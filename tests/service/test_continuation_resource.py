"""A continuation over HTTP: submitted, computed, and its branch read in every form."""

import numpy as np
import pytest

from jointplay import jobs
from jointplay.client import Client, Refused, ResultsNotReady
from jointplay.local import run
from jointplay.service.studies.schemas import Branches
from tests.service.answers import get

WIDE = {"from": 4e-3, "to": 8e-3, "count": 4}
SECOND = {"parameter": "amplitude", "values": WIDE, "labels": ["GR"], "curves": 1}
JOB = jobs.continuation(
    "impact-oscillator",
    "speed",
    {"from": 30.0, "to": 24.0, "count": 80},
    settle=20,
    doublings=1,
    second=SECOND,
    stop_stiffness=1e8,
)


@pytest.fixture(scope="module")
def client(service_url):
    with Client(service_url) as found:
        yield found


@pytest.fixture(scope="module")
def finished(client, worker):
    job = client.submit(JOB)
    with pytest.raises(ResultsNotReady):
        _ = job.branch
    worker.work(job.id)
    return job.refresh()


def test_the_branch_is_what_a_local_run_finds(finished, http, tmp_path):
    assert (finished.kind, finished.state) == ("continuation", "succeeded")
    local = run(JOB, processes=1)
    assert finished.branch == local.branch
    answer = http.get(f"/v1/jobs/{finished.id}/branch")
    document = Branches.model_validate_json(answer.content, strict=True)
    assert document.model_dump(mode="json") == answer.json()
    first, second, curve = document.branches
    assert [one.label for one in first.special][:1] == ["EP"]
    assert first.columns["value"].unit == "rad/s"
    for branch in (first, curve):
        lengths = {len(one.values) for one in branch.columns.values()}
        assert lengths == {int(finished.points["orbits"][branch.index])}
    assert second.status == "failed"
    assert "no period doubling" in second.failure.detail
    assert (first.of, curve.of, document.second, document.second_unit) == (
        *("", "GR"),
        *("amplitude", "m"),
    )
    (graze,) = [one for one in first.special if one.label == "GR"]
    assert curve.special[0].value == pytest.approx(graze.value, abs=1e-5)
    assert curve.special[0].second == pytest.approx(5e-3, rel=1e-9)


def test_columns_are_chosen_and_wrong_ones_are_refused(finished, http):
    address = f"/v1/jobs/{finished.id}/branch"
    chosen = get(http, address, columns="value,multiplier_*")["branches"][0]["columns"]
    assert set(chosen) == {"value"} | {
        f"multiplier_{k}.{part}" for k in (1, 2) for part in ("real", "imaginary")
    } | {"multiplier_error"}
    refused = http.get(f"{address}?columns=valeu")
    assert (refused.status_code, refused.json()["errors"][0]["parameter"]) == (422, "columns")


def test_its_orbits_are_a_table_with_units_and_in_zarr(finished, tmp_path):
    table = finished.poincare
    (branch, _, curve) = finished.branch["branches"]
    for name in ("value", "second"):
        both = [one["columns"][name]["values"] for one in (branch, curve)]
        assert table[name].tolist() == [*both[0], *both[1]]
    file = finished.export(tmp_path / "branch.csv", "poincare")
    assert "value [rad/s]" in file.read_text()
    with finished.open("sections") as store:
        values = store["value"]
        assert values.attrs["units"] == "rad/s"
        rows = np.isfinite(values.values[0])
        assert values.values[0][rows].tolist() == branch["columns"]["value"]["values"]


def test_every_link_leads_somewhere_and_its_figure_is_drawn(finished, http):
    links = get(http, f"/v1/jobs/{finished.id}")["links"]
    assert links.keys() >= {"branch", "points", "poincare", "figures", "zarr"}
    for name, link in links.items():
        answer = http.post(link) if name == "cancel" else http.get(link)
        assert answer.is_success, (name, answer.text)
    assert {"branch", "curves"} <= set(finished.figures)
    for name in finished.figures:
        assert finished.figure(name).content.startswith(b"\x89PNG"), name


def test_curves_lie_over_a_chart_of_the_service(client, worker, finished, http):
    axes = {"speed": [24.0, 30.0], "amplitude": [4e-3, 8e-3]}
    along, by = ({"parameter": name, "values": values} for name, values in axes.items())
    chart = client.submit(jobs.chart("impact-oscillator", along, by, settle=2, record=4))
    worker.work(chart.id)
    alone, over = (finished.figure("curves", over=one) for one in (None, chart))
    assert over.content.startswith(b"\x89PNG")
    assert over.content != alone.content
    picture = f"/v1/jobs/{finished.id}/figures/curves.png"
    unknown = http.get(picture, params={"over": "0" * 32})
    assert (unknown.status_code, unknown.json()["errors"][0]["parameter"]) == (404, "over")
    own = http.get(picture, params={"over": finished.id})
    assert (own.status_code, own.json()["errors"][0]["parameter"]) == (404, "over")
    assert "has no chart" in own.json()["detail"]


def test_a_continuation_is_estimated_before_it_is_queued(client):
    estimate = client.estimate(JOB | {"doublings": 0, "second": None})
    assert (estimate.points, estimate.blocks, estimate.failure) == (1, 1, None)
    assert estimate.steps > 1000


@pytest.mark.parametrize(
    ("change", "pointer"),
    [
        ({"values": {"from": 30.0, "to": 30.0, "count": 3}}, "/values/to"),
        ({"values": [1.0, 2.0]}, "/values"),
        ({"values": {"from": 30.0, "to": 20.0, "count": 3, "spacing": "log"}}, "/values/spacing"),
        ({"values": {"from": 30.0, "to": 20.0, "count": 10**6}}, "/values/count"),
        ({"values": {"from": 30.0, "to": 2000.0, "count": 3}}, "/values/to"),
        ({"values": {"from": 30.0, "to": 0.0, "count": 3}}, "/values/to"),
        ({"parameter": "slack"}, "/parameter"),
        ({"second": SECOND | {"parameter": "slack"}}, "/second/parameter"),
        ({"second": SECOND | {"parameter": "speed"}}, "/second/parameter"),
        ({"second": SECOND | {"labels": ["BP"]}}, "/second/labels/0"),
        ({"second": SECOND | {"curves": 0}}, "/second/curves"),
        ({"second": SECOND | {"values": WIDE | {"from": 6e-3}}}, "/second/values"),
        ({"second": SECOND | {"values": WIDE | {"from": 8e-3}}}, "/second/values/to"),
        ({"second": SECOND | {"values": WIDE | {"from": -1.0}}}, "/second/values/from"),
        ({"second": SECOND | {"values": WIDE | {"spacing": "log"}}}, "/second/values/spacing"),
        ({"second": SECOND | {"values": WIDE | {"count": 10**7}}}, "/second/values/count"),
        ({"at": 40.0}, "/at"),
        ({"state": [0.0]}, "/state"),
        ({"state": [0.0, 0.0, -1.0]}, "/state"),
        ({"period": 0}, "/period"),
        ({"section": {"channel": "mass.x", "value": 0.0}}, "/section"),
        ({"section": {"crank_angle": 1.0}}, "/section/channel"),
        ({"doublings": 7}, "/doublings"),
        ({"orbits": 17}, "/orbits"),
        ({"formulation": "lagrange"}, "/formulation"),
        ({"method": "rk4", "step": 1e-3}, "/method"),
    ],
)
def test_what_cannot_be_followed_is_refused_at_its_field(client, change, pointer):
    with pytest.raises(Refused) as refusal:
        client.submit(JOB | change)
    assert pointer in [problem.pointer for problem in refusal.value.fields]


@pytest.mark.parametrize(
    ("section", "pointer", "sentence"),
    [
        (None, "/section", "Give a 'section' where a channel crosses a value"),
        ({"channel": "rod.tehta", "value": 0.0}, "/section/channel", "There is no channel"),
    ],
)
def test_a_mechanism_that_nothing_drives_needs_a_section(client, section, pointer, sentence):
    job = jobs.continuation("pendulum", "mass", {"from": 0.5, "to": 1.0, "count": 3})
    with pytest.raises(Refused) as refusal:
        client.submit(job | {"section": section})
    (problem,) = refusal.value.fields
    assert problem.pointer == pointer
    assert sentence in problem.detail
