"""The Python client on studies and batches, against the real service."""

import numpy as np
import pytest

from jointplay import figures
from jointplay.client import NotFound, Refused, ResultsNotReady, Unreachable, service_job
from jointplay.client.connection import Connection
from jointplay.records.point import PointStatus
from jointplay.storage.catalogue.records import BlockState
from tests.worker_by_hand import BIFURCATION, known_section

PENDULUM = {"kind": "simulate", "scene": {"preset": "pendulum"}, "duration": 1.0}


def test_a_study_comes_as_arrays(client, finished_study):
    study = client.job(finished_study).study(["A.eccentricity_*"])
    assert (study.kind, study.points, study.record, study.complete) == ("bifurcation", 20, 6, True)
    np.testing.assert_array_equal(study.values[:, 0], np.linspace(1e-4, 1e-3, 20))
    assert [(one.name, one.unit) for one in study.parameters] == [("clearance", "m")]
    assert np.flatnonzero(study.status == PointStatus.failed).tolist() == [3, 17]
    assert study.failures[17].code == "step-size-underflow"
    counts = [3 if point in (3, 17) else 6 for point in range(20)]
    assert study.counts.tolist() == counts
    assert client.job(finished_study).points["sections"].tolist() == counts
    assert client.job(finished_study).dataset["sections"].values.tolist() == counts
    names = client.job(finished_study).job["observables"]
    column = names.index("A.eccentricity_rate_x")
    rows = study.sections("A.eccentricity_rate_x")
    assert rows.shape == (20, 6)
    np.testing.assert_array_equal(rows[5], known_section(5, column, np.arange(6)))
    assert np.isnan(rows[3, 3:]).all()
    words = [study.verdict_names[code] if code >= 0 else None for code in study.verdicts[:4]]
    assert words == ["undecided", "periodic", "quasi-periodic", None]
    assert study.indicators["lyapunov"][2] == 0.2
    assert study.statistics["steps"][19] == 1019.0
    assert [one.name for one in study.observables] == [
        name for name in names if name.startswith("A.eccentricity_")
    ]


def test_a_sweep_comes_as_arrays(client, finished_sweep):
    study = client.job(finished_sweep).study(channels=["A.normal_force"])
    assert (study.points, study.values.shape) == (6, (6, 2))
    assert study.values[3].tolist() == [2e-4, 0.05]
    peaks = study.peaks("A.normal_force")
    np.testing.assert_array_equal(peaks.maximum, [1.0, 2.0, 3.0, 4.0, np.nan, 6.0])
    assert (study.status == PointStatus.done).sum() == 5
    mean = study.statistics["A.normal_force.mean"]
    np.testing.assert_array_equal(mean, [0.0, 0.5, 1.0, 1.5, np.nan, 2.5])
    assert study.attributes["meanings"]["A.normal_force.mean"][0] == "N"
    assert "displacement.mean" not in study.statistics


def test_what_comes_can_be_drawn_like_a_store(client, finished_study, finished_sweep):
    study = client.job(finished_study).study(["A.eccentricity_x"])
    assert figures.render(study, "A.eccentricity_x", "png").startswith(b"\x89PNG")
    assert figures.render(client.job(finished_sweep).study(), "sweep", "png").startswith(b"\x89PNG")


@pytest.mark.parametrize("most", [150, 30])
def test_pages_of_points_and_windows_of_sections_are_put_together(
    client, finished_study, monkeypatch, most
):
    """150 values are some points of all sections; 30 are not even one point's."""
    whole = client.job(finished_study).study(["A.eccentricity_*"])
    monkeypatch.setattr("jointplay.service.studies.queries.MOST_VALUES", most)
    pieces = client.job(finished_study).study(["A.eccentricity_*"])
    np.testing.assert_array_equal(pieces.times, whole.times)
    for one in whole.observables:
        np.testing.assert_array_equal(pieces.sections(one.name), whole.sections(one.name))
    np.testing.assert_array_equal(pieces.status, whole.status)
    np.testing.assert_array_equal(pieces.verdicts, whole.verdicts)
    assert pieces.reasons == whole.reasons
    np.testing.assert_array_equal(pieces.indicators["lyapunov"], whole.indicators["lyapunov"])


def test_a_study_can_be_fetched_while_it_runs(client, worker):
    job = worker.submit(**BIFURCATION)
    with pytest.raises(ResultsNotReady, match="is queued"):
        client.job(job).study()
    worker.compute(worker.start(job, 1), points=3, sections=2)
    study = client.job(job).study(["A.eccentricity_x"])
    assert not study.complete
    states = ["waiting"] * 8 + ["done"] * 2 + ["running"] + ["waiting"] * 9
    assert [PointStatus(code).name for code in study.status] == states
    assert study.counts[10] == 2


def test_a_simulation_is_no_study_and_other_refusals_stay_what_they_are(
    client, finished_job, finished_study
):
    with pytest.raises(NotFound, match="of kind simulate"):
        client.job(finished_job).study()
    with pytest.raises(Refused, match=r"did you mean A\.eccentricity_x"):
        client.job(finished_study).study(["A.excentricity_x"])


def test_a_figure_of_one_value(client, finished_study):
    section = client.job(finished_study).figure("section", start=4, stop=5, joint="A", form="svg")
    assert b"<svg" in section.content
    with pytest.raises(Refused) as caught:
        client.job(finished_study).figure("section")
    assert caught.value.fields[0].pointer == "start"


def test_a_batch_is_submitted_looked_at_waited_for_and_cancelled(client, worker):
    batch = client.submit_batch([worker_job(), PENDULUM | {"label": "second"}], label="both")
    assert (batch.label, batch.size, batch.counts["queued"], batch.is_finished) == (
        "both", 2, 2, False,
    )  # fmt: skip
    first, second = batch.jobs()
    assert (first.batch, second.label) == (batch.id, "second")

    def report(seen):
        """Play the worker's part at the first question, and cancel the rest."""
        if seen.counts["queued"] == 2:
            claim = worker.start(first.id)
            worker.store(claim)
            worker.finish(claim, BlockState.done)
            seen.cancel()

    finished = client.batch(batch.id).wait(report=report)
    assert (finished.counts["succeeded"], finished.counts["cancelled"]) == (1, 1)
    assert finished.fraction >= 0.5


def worker_job():
    return {"kind": "simulate", "scene": {"preset": "seven-bar-press"}, "duration": 2.0}


def test_a_batch_is_refused_as_a_whole(client):
    with pytest.raises(Refused) as caught:
        client.submit_batch([PENDULUM, PENDULUM | {"duration": -1.0}])
    assert [field.pointer for field in caught.value.fields] == ["/jobs/1/duration"]


def test_what_accuracy_costs_comes_as_a_document(client, finished_accuracy, finished_sweep):
    found = client.job(finished_accuracy).accuracy
    assert found["complete"]
    assert {"method", "tolerance", "error", "evaluations"} <= found["points"][0].keys()
    assert client.job(finished_accuracy).figures == ["work-precision"]
    with pytest.raises(NotFound, match="has no accuracy"):
        client.job(finished_sweep).accuracy  # noqa: B018  (asking is what fails)


def test_a_batch_is_waited_for_while_its_service_is_away_for_a_while(client, monkeypatch):
    batch = client.submit_batch([PENDULUM | {"cache": False}])
    away = []
    get = Connection.get

    def lost(connection, path, query=None):
        away.append(path)
        if len(away) <= 3:
            raise Unreachable("away")
        return get(connection, path, query)

    def report(found):
        if not found.is_finished:
            for job in found.jobs():
                job.cancel()
            monkeypatch.setattr(Connection, "get", lost)

    assert batch.wait(report=report).is_finished
    assert len(away) == 4
    away.clear()
    monkeypatch.setattr(service_job, "PATIENCE", 0.0)
    with pytest.raises(Unreachable):
        batch.wait()
