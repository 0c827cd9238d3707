"""Jobs as notebooks use them: pandas tables, lazy xarray, what is shown without asking."""

import json
import subprocess
import sys
import uuid
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

from jointplay.client import Expired, NotFound, Refused
from jointplay.client.axes import on_axes
from jointplay.records.channel import Channel
from jointplay.records.job import JobError
from jointplay.records.peak import PeakColumns
from jointplay.records.point import PointStatus
from jointplay.records.study import StudyDataset
from jointplay.storage.catalogue.records import BlockState
from tests.worker_by_hand import BIFURCATION, CHART, known_section


def test_the_history_is_lazy_and_carries_units(client, finished_job):
    history = client.job(finished_job).history
    force = history["A.normal_force"]
    assert not force.variable._in_memory
    assert (force.attrs["units"], force.sizes) == ("N", {"time": 2001})
    assert force.sel(time=slice(0.25, 0.75)).sizes["time"] == 501
    window = client.job(finished_job).window("A.normal_force")
    np.testing.assert_array_equal(force[100:200], window["A.normal_force"][100:200])
    np.testing.assert_array_equal(history["time"], window.time)


def test_any_group_of_the_store_can_be_opened(client, finished_job, finished_study):
    assert client.job(finished_job).open("impacts").sizes == {"impact": 1}
    assert client.job(finished_study).open("sections").sizes == {"point": 20, "section": 6}
    with pytest.raises(NotFound, match="no group 'sections'"):
        client.job(finished_job).open("sections")


def test_tables_of_a_simulation(client, finished_job):
    job = client.job(finished_job)
    assert job.peaks.loc["slider7.ax", ["unit", "minimum", "maximum_time"]].tolist() == [
        "m/s^2",
        -1.0,
        0.75,
    ]
    assert job.poincare["time"].tolist() == [0.0, 1.0]
    assert job.poincare.attrs["units"]["A.force_x"] == "N"
    (impact,) = job.impacts.to_dict("records")
    assert (impact["joint"], impact["onset"], impact["impulse"]) == ("B", 0.5, 0.2)
    assert np.isnan(impact["release"])
    assert job.impacts.attrs["units"]["peak_force"] == "N"


def test_tables_of_a_diagram(client, finished_study):
    job = client.job(finished_study)
    table = job.poincare
    assert table.index.names == ["point", "section"]
    assert len(table) == 18 * 6 + 2 * 3  # of the two that failed, what they recorded
    names = job.job["observables"]
    column = names.index("A.eccentricity_rate_x")
    row = table.loc[(5, 4)]
    assert row["A.eccentricity_rate_x"] == known_section(5, column, 4)
    assert row["clearance"] == np.linspace(1e-4, 1e-3, 20)[5]
    points = job.points
    assert points["verdict"].tolist()[:3] == ["undecided", "periodic", "quasi-periodic"]
    assert points["reason"][1] == "point 1 was judged"
    assert points.loc[[3, 4], "failure"].tolist() == ["step-size-underflow", ""]
    assert points.loc[19, "steps"] == 1019.0


def test_tables_of_a_sweep(client, finished_sweep):
    peaks = client.job(finished_sweep).peaks
    force = peaks.xs("A.normal_force", level="channel")
    np.testing.assert_array_equal(force["maximum"], [1.0, 2.0, 3.0, 4.0, np.nan, 6.0])
    assert force["friction"].tolist() == [0.0, 0.05] * 3
    assert set(force["unit"]) == {"N"}
    assert force["status"].tolist() == [*["done"] * 4, "failed", "done"]
    assert client.job(finished_sweep).points["status"].tolist()[4] == "failed"


def test_a_sweep_has_the_axes_of_its_parameters(client, finished_sweep):
    found = client.job(finished_sweep).dataset
    force = found["A.normal_force"].sel(extreme="maximum")
    assert force.dims == ("clearance", "friction")
    np.testing.assert_array_equal(force, [[1.0, 2.0], [3.0, 4.0], [np.nan, 6.0]])
    assert float(force.sel(clearance=2e-4, friction=0.05)) == 4.0
    assert (force.attrs["units"], found["clearance"].attrs["units"]) == ("N", "m")
    assert found["status"].sel(clearance=3e-4, friction=0.0) == "failed"


def test_a_diagram_has_sections_besides(client, finished_study):
    job = client.job(finished_study)
    found, study = job.dataset, job.study()
    sections = found["A.eccentricity_rate_x"]
    assert sections.sizes == {"clearance": 20, "section": 6}
    np.testing.assert_array_equal(sections, study.sections("A.eccentricity_rate_x"))
    assert found["verdict"].values[:3].tolist() == ["undecided", "periodic", "quasi-periodic"]


def test_a_chart_has_both_axes_and_no_sections(client, worker):
    job = client.job(worker.finished_study(**CHART))
    assert job.dataset["steps"].sizes == {"friction": 5, "clearance": 300}
    assert len(job.points) == 1500


def test_points_in_two_directions_or_in_no_grid_keep_their_values():
    values = np.array([[1.0], [2.0], [2.0], [1.0]])
    parameters = [Channel("clearance", "m", "")]
    statistics = {"steps": np.arange(4.0)}
    there_and_back = {"job": {"continuation": "both"}}
    both = StudyDataset(there_and_back, parameters, values, np.full(4, 2), statistics=statistics)
    found = on_axes(both)["steps"]
    assert found.sel(clearance=1.0).values.tolist() == [0.0, 3.0]
    assert found.sel(direction="backward").values.tolist() == [3.0, 2.0]
    listed = StudyDataset({"job": {}}, parameters, values[:3], np.full(3, 2), statistics=statistics)
    listed = replace(listed, statistics={"steps": np.arange(3.0)})
    found = on_axes(listed)["steps"]
    assert found.dims == ("point",)
    assert found["clearance"].values.tolist() == [1.0, 2.0, 2.0]
    twice = StudyDataset({"job": {}}, parameters, values, np.full(4, 2), statistics=statistics)
    found = on_axes(twice)["steps"]  # as a list of points, or rows of a design, may have values
    assert found.dims == ("point",)
    assert found.values.tolist() == [0.0, 1.0, 2.0, 3.0]


def test_arrays_have_no_extremes_of_points_that_failed():
    found = np.array([1.0, 0.2, 3.0])
    study = StudyDataset(
        {"job": {}},
        [Channel("clearance", "m", "")],
        np.array([[1.0], [2.0], [3.0]]),
        np.array([PointStatus.done, PointStatus.failed, PointStatus.done]),
        channels=[Channel("force", "N", "")],
        extremes={"force": PeakColumns(-found, found, found, found)},
    )
    force = on_axes(study)["force"]
    assert float(force.sel(extreme="maximum").mean()) == 2.0
    assert force.sel(extreme="minimum").isnull().values.tolist() == [False, True, False]


def test_what_a_job_of_another_kind_has_is_not_found(client, finished_job, finished_sweep):
    for job, name in ((finished_job, "points"), (finished_sweep, "history")):
        with pytest.raises(NotFound, match=f"has no {name}"):
            getattr(client.job(job), name)
    for name in ("poincare", "impacts"):
        with pytest.raises(NotFound):
            getattr(client.job(finished_sweep), name)
    with pytest.raises(NotFound):
        _ = client.job(finished_job).certificate


def test_who_asks_a_job_of_another_kind_is_told_which_kinds_have_it(
    client, finished_job, finished_sweep
):
    asked = [
        (
            finished_job,
            "dataset",
            "has no dataset; jobs of kind bifurcation, sweep, .*calibration do",
        ),
        (finished_job, "accuracy", "has no accuracy; jobs of kind accuracy-study do"),
        (finished_job, "attractors", "jobs of kind basins or basin-stability do"),
        (
            finished_sweep,
            "history",
            "is of kind sweep and has no history; jobs of kind simulate do",
        ),
        (finished_sweep, "branch", "jobs of kind continuation do"),
        (finished_sweep, "poincare", "of kind simulate, bifurcation, .*poincare or ensemble do"),
    ]
    for job, name, words in asked:
        with pytest.raises(NotFound, match=words):
            getattr(client.job(job), name)


def test_a_running_job_is_opened_anew_each_time(client, worker):
    job_id = worker.submit(**BIFURCATION)
    job = client.job(job_id)
    worker.compute(worker.start(job_id), points=1, sections=2)
    assert len(job.poincare) == 2
    worker.compute(worker.start(job_id, 1), points=1, sections=3)
    assert len(job.poincare) == 5


def test_notebooks_show_what_is_known_without_asking(connect, service_url, worker, monkeypatch):
    claim = worker.start(worker.submit(label="<b>bold</b>"))
    worker.finish(claim, BlockState.done)
    client = connect(service_url)
    job = client.job(claim.job.id)
    batch = client.submit_batch([job.job], label="one")
    client.close()  # from here on nothing can be asked
    for shown in (job._repr_html_(), repr(job)):
        assert job.id in shown
        assert "seven-bar-press" in shown
        assert "<b>" not in shown
    assert "succeeded" in job._repr_html_()
    assert "1 jobs: 1 queued" in batch._repr_html_()
    assert service_url in repr(client)


def test_results_of_many_jobs_come_in_the_order_of_their_documents(client, worker):
    documents = [
        {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0, "label": label}
        for label in ("a", "b", "c")
    ]
    results = client.map(documents, label="mapped")
    batch = next(job.batch for job in client.jobs(label="c"))
    a, b, c = client.batch(batch).jobs()
    worker.finish(worker.start(c.id), BlockState.done)
    worker.finish(worker.start(a.id), BlockState.failed, JobError("solver", "step-limit", "Long."))
    first = next(results)
    assert (first.label, first.state) == ("a", "failed")
    b.cancel()
    assert [(job.label, job.state) for job in results] == [("b", "cancelled"), ("c", "succeeded")]


def test_a_job_that_is_gone_is_not_passed_over_in_silence(client, worker):
    """Whoever counts documents and results together would take one job for another."""
    document = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}
    documents = [document | {"label": label} for label in ("one", "gone", "last")]
    results = client.map(documents)
    batch = next(job.batch for job in client.jobs(label="gone", state="queued"))
    client.batch(batch).cancel()
    one, gone, last = client.batch(batch).jobs()
    gone.delete()
    assert [job.id for job in client.batch(batch).jobs()] == [one.id, last.id]
    assert next(results).label == "one"
    with pytest.raises(Expired, match=gone.id):
        next(results)


def test_arrays_can_be_written_as_netcdf(client, finished_job, finished_study, tmp_path):
    job, study = client.job(finished_job), client.job(finished_study)
    assert json.loads(job.history.attrs["job"]) == job.job
    assert job.history.attrs["complete"] == 1
    for number, dataset in enumerate(
        (job.history, job.open("impacts"), job.open("peaks"), study.open(), study.dataset)
    ):
        file = tmp_path / f"{number}.nc"
        dataset.to_netcdf(file)
        again = xr.load_dataset(file)
        assert again.attrs.keys() == dataset.attrs.keys()
        for name, stored in dataset.variables.items():
            np.testing.assert_array_equal(again[name], stored)
            assert again[name].attrs.keys() == stored.attrs.keys()


def test_without_the_extra_it_says_what_to_install(service_url, finished_job):
    program = (
        "import sys\n"
        "from jointplay.client import Client, MissingExtra\n"
        "job = Client(sys.argv[1]).job(sys.argv[2])\n"
        "for ask, missing in (('history', 'xarray'), ('peaks', 'pandas'), ('history', 'fsspec')):\n"
        "    sys.modules[missing] = None\n"  # as if it were not installed
        "    assert len(job.window('slider7.x').time) == 2001\n"
        "    try:\n"
        "        getattr(job, ask)\n"
        "    except MissingExtra as error:\n"
        "        print(error)\n"
        "    del sys.modules[missing]\n"
    )
    ended = subprocess.run(
        [sys.executable, "-c", program, service_url, finished_job], capture_output=True, text=True
    )
    assert ended.stdout.count("pip install 'jointplay[xarray]'") == 3, ended.stderr


def test_jobs_of_several_batches_are_all_queued_or_cancelled(client, monkeypatch):
    monkeypatch.setattr("jointplay.client.client.MOST_JOBS", 3)
    document = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}
    one, another = uuid.uuid4().hex, uuid.uuid4().hex
    wrong = [document | {"label": one}] * 7 + [document | {"duration": -1.0}]
    with pytest.raises(Refused, match="/jobs/7/duration") as refused:
        client.map(wrong)
    assert [field.pointer for field in refused.value.fields] == ["/jobs/7/duration"]
    assert [job.state for job in client.jobs(label=one)] == ["cancelled"] * 6

    results = client.map([document | {"label": another}] * 8)
    batches = {job.batch for job in client.jobs(label=another, state="queued")}
    assert sorted(client.batch(batch).size for batch in batches) == [2, 3, 3]
    for batch in batches:
        client.batch(batch).cancel()
    assert [job.state for job in results] == ["cancelled"] * 8
