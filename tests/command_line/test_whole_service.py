"""Broker, API, relay and worker as `jointplay serve` runs them, used by commands and client."""

import json
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from jointplay import load
from jointplay.client import Client, JobCancelled
from jointplay.records.point import PointStatus
from jointplay.storage.results.reader import ResultReader
from jointplay.storage.studies.reader import StudyReader
from tests.solver.calibration.calibrations import bounce

PRESS = ["seven-bar-press", "--duration", "0.05", "--set", "clearance=2e-4"]


@pytest.fixture
def url(service) -> str:
    return service.url


def test_a_job_gives_the_same_bits_over_http_as_locally(jointplay, url, tmp_path):
    submitted = jointplay("submit", *PRESS, "--wait", "--url", url)
    assert submitted.code == 0, submitted.err
    job_id = submitted.out.strip()
    assert jointplay("run", *PRESS, "-o", tmp_path / "OUT").code == 0
    local = ResultReader(tmp_path / "OUT" / "results.zarr.zip")
    with Client(url) as client:
        job = client.job(job_id)
        assert job.job == local.attributes["job"]
        history, sections = job.window(), job.results.sections(None)
        for fetched, (time, columns) in (
            (history, local.history()),
            (sections, local.sections()),
        ):
            assert fetched.time.tobytes() == time.tobytes()
            assert fetched.channels.keys() == columns.keys()
            for name, column in columns.items():
                assert fetched[name].tobytes() == column.tobytes(), name
        peaks = {name: (peak.minimum, peak.maximum) for name, peak in job.results.peaks().items()}
        assert peaks == {name: (one.minimum, one.maximum) for name, one in local.peaks().items()}
        ledger = local.attributes["summary"]["energy"]
        assert job.statistics["energy"] == ledger
        impacts, rows = job.results.impacts(), local.impacts()
        assert [local.joints[index] for index in rows["joint"]] == impacts.joint
        assert len(impacts.joint) > 0
        np.testing.assert_array_equal(impacts.release, rows["release"])  # NaN where still open
        same = load(tmp_path / "OUT")
        for name in ("peaks", "poincare", "impacts"):
            pd.testing.assert_frame_equal(getattr(job, name), getattr(same, name))
        ours, theirs = (one.window("acceleration", points=50) for one in (same, job))
        assert ours.time.tobytes() == theirs.time.tobytes()
        assert ours["acceleration"].tobytes() == theirs["acceleration"].tobytes()
        xr.testing.assert_identical(job.history.drop_attrs(), same.history.drop_attrs())


def test_a_study_gives_the_same_bits_over_http_as_locally(jointplay, url, tmp_path):
    diagram = ["slider-crank", "--bifurcation", "clearance=1e-4:5e-4:20", "--settle", "3"]
    diagram += ["--record", "6"]
    submitted = jointplay("submit", *diagram, "--wait", "--url", url)
    assert submitted.code == 0, submitted.err
    job_id = submitted.out.strip()
    assert jointplay("run", *diagram, "-o", tmp_path / "OUT").code == 0
    local = StudyReader(tmp_path / "OUT" / "results.zarr.zip")
    with Client(url) as client:
        job = client.job(job_id)
        assert job.job == local.attributes["job"]
        study = job.study()
        assert study.complete
        assert study.values.tobytes() == local.values.tobytes()
        assert study.times.tobytes() == local.section_times().tobytes()
        for observable in local.observables:
            name = observable.name
            assert study.sections(name).tobytes() == local.sections(name).tobytes(), name
        for name, column in local.statistics.items():
            assert study.statistics[name].tobytes() == column.tobytes(), name
        drawn = job.figure("bifurcation").content
        same = load(tmp_path / "OUT")
        for name in ("points", "poincare"):
            pd.testing.assert_frame_equal(getattr(job, name), getattr(same, name))
    assert drawn == same.figure("bifurcation").content
    assert "20 done" in jointplay("show", job_id, "--url", url).out


def test_a_study_is_read_while_it_runs_and_keeps_what_it_has_when_cancelled(jointplay, url):
    long = ["slider-crank", "--bifurcation", "clearance=1e-4:5e-4:4000", "--record", "100"]
    job_id = jointplay("submit", *long, "--settle", "0", "--url", url).out.strip()
    with Client(url) as client:
        seen = None
        job = client.job(job_id)

        def look(job):
            nonlocal seen
            if seen is None and job.progress.fraction > 0.0:
                seen = job.study(["P.eccentricity_x"], sections=(0, 10))
                job.cancel()

        assert job.wait(report=look, timeout=120.0, check=False).state == "cancelled"
        assert seen is not None
        assert not seen.complete
        assert (seen.status == PointStatus.waiting).any()
        assert (seen.counts > 0).any()
        kept = job.study(["P.eccentricity_x"], sections=(0, 10))
        assert (kept.counts >= seen.counts).all()
        recorded = np.isfinite(seen.times)
        np.testing.assert_array_equal(
            kept.sections("P.eccentricity_x")[recorded], seen.sections("P.eccentricity_x")[recorded]
        )
    shown = jointplay("show", job_id, "--wait", "--url", url)
    assert shown.code == 4
    assert "waiting" in shown.out


def test_a_batch_of_all_kinds_is_computed(jointplay, url, tmp_path):
    scene = {"preset": "slider-crank"}
    jobs = [
        {"kind": "simulate", "scene": scene, "duration": 0.01},
        {
            "kind": "sweep",
            "scene": scene,
            "grid": {"clearance": [1e-4, 2e-4]},
            "periods": 1,
            "statistics": ["median", "impacts"],
        },
        {"kind": "poincare", "scene": scene, "settle": 1, "record": 3},
        {"kind": "ensemble", "scene": scene, "members": 2, "settle": 1, "record": 3},
        {"kind": "accuracy-study", "scene": scene, "duration": 0.005, "methods": ["tsitouras"]},
        bounce(search={"population": 4, "generations": 4}, spread={"generations": 2}),
    ]
    (tmp_path / "jobs.json").write_text(json.dumps(jobs))
    ended = jointplay("batch", tmp_path / "jobs.json", "--wait", "--url", url)
    assert ended.code == 0, ended.err
    batch, states = ended.out.splitlines()
    assert states == "6 jobs: 6 succeeded"
    with Client(url) as client:
        assert client.batch(batch).fraction == 1.0
        _, sweep, poincare, ensemble, accuracy, calibration = client.batch(batch).jobs()
        swept = sweep.study()
        peaks, median = swept.peaks("displacement"), swept.statistics["displacement.median"]
        assert (peaks.minimum < median).all()
        assert (median < peaks.maximum).all()
        assert (swept.statistics["P.impacts"] <= swept.statistics["onsets"]).all()
        assert poincare.study().counts.tolist() == [3]
        assert ensemble.study().counts.tolist() == [3, 3]
        assert accuracy.accuracy["advice"].startswith("The default")
        assert calibration.calibration["cost"] < 10.0


def test_a_running_job_is_cancelled_and_keeps_what_it_computed(jointplay, url):
    long = ["seven-bar-press", "--duration", "100000", "--output-step", "0.5"]
    job_id = jointplay("submit", *long, "--channels", "displacement", "--url", url).out.strip()
    with Client(url) as client:
        cancelled = False

        def cancel_once_it_moves(job):
            nonlocal cancelled
            if job.progress.time > 0.0 and not cancelled:
                assert jointplay("cancel", job_id, "--url", url).code == 0
                cancelled = True

        job = client.job(job_id)
        with pytest.raises(JobCancelled):
            job.wait(report=cancel_once_it_moves, timeout=120.0)
        history = job.window()
        assert not history.complete
        assert 0 < len(history.time) < 200_001
        assert np.isfinite(history["displacement"]).all()
    assert jointplay("show", job_id, "--wait", "--url", url).code == 4


def test_a_job_that_fails_says_why_and_keeps_what_it_computed(jointplay, url):
    stiffest = ["--set", "friction=1", "--tolerance", "1e-13"]  # a step in the friction law:
    stiffest += ["--set", "static_velocity=1e-12", "--set", "dynamic_velocity=1e-12"]
    ended = jointplay("submit", *PRESS[:-1], "clearance=5e-4", *stiffest, "--wait", "--url", url)
    assert ended.code == 3
    assert "larger tolerance" in ended.err.splitlines()[-1]
    with Client(url) as client:
        job = client.job(ended.out.strip())
        assert job.error is not None
        assert job.error.error_class == "solver"
        history = job.window("displacement")
        assert not history.complete
        assert 0.0 < history.time[-1] < 0.05


def test_figures_of_a_real_run_are_served(jointplay, url, tmp_path):
    job_id = jointplay("submit", *PRESS, "--wait", "--url", url).out.strip()
    names = ("displacement", "contact-force", "orbit", "phase-portrait")
    ended = jointplay("plot", job_id, *names, "--format", "svg", "-o", tmp_path, "--url", url)
    assert ended.code == 0
    drawn = {Path(line).name for line in ended.out.splitlines()}
    assert drawn == {f"{name}.svg" for name in names}
