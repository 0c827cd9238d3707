"""Jobs without a service: the same objects, from a folder."""

import json
import math
import os
import subprocess
import sys
import threading

import numpy as np
import pytest

import jointplay
from jointplay import jobs
from jointplay.client import JobFailed, NotFound, Progress, Refused

CRANK = {"clearance": 1e-4, "duration": 0.05}


@pytest.fixture(scope="module")
def job(tmp_path_factory):
    return jointplay.run("slider-crank", output=tmp_path_factory.mktemp("run") / "OUT", **CRANK)


@pytest.fixture(scope="module")
def study():
    values = np.linspace(1e-4, 5e-4, 20)
    described = jobs.bifurcation("slider-crank", "clearance", values, settle=3, record=6)
    return jointplay.run(described, processes=1)


def test_a_simulation_is_a_finished_job(job):
    assert (job.kind, job.state, job.is_finished) == ("simulate", "succeeded", True)
    assert job.wait() is job
    assert job.refresh().seconds > 0.0
    assert job.progress.fraction == 1.0
    displacement = job.history["displacement"]
    assert displacement.attrs["units"] == "m"
    window = job.window("displacement", 0.01, 0.02)
    assert (window.time[0], window.time[-1]) == pytest.approx((0.01, 0.02), abs=1e-9)
    overview = job.window("displacement", points=20)
    assert not overview.exact
    assert overview.between_samples
    assert 0.0 <= overview["displacement"].max() - float(displacement.max()) < 1e-7
    between = job.window("displacement", 0.0101, 0.0103, step=1e-5)
    assert len(between.time) == 21
    assert job.peaks.loc["displacement", "maximum"] >= float(displacement.max())
    assert set(job.impacts["joint"]) == {"P"}
    assert len(job.poincare) == 5  # the start and four periods of 12 ms
    assert job.statistics["steps"] == job.certificate["steps"] > 0
    assert job.figure("orbit", joint="P").content.startswith(b"\x89PNG")
    assert job.id in job._repr_html_()


def test_a_study_has_points_and_sections(study):
    assert study.points["status"].tolist() == ["done"] * 20
    assert study.poincare.shape[0] == 120
    assert study.open("values")["clearance"].values.tolist() == study.study().values[:, 0].tolist()
    assert study.figure("section", start=3, stop=4).content.startswith(b"\x89PNG")


def test_a_folder_is_loaded_later(job):
    again = jointplay.load(job.id)
    assert again.to_document() == job.to_document()
    store = jointplay.load(f"{job.id}/results.zarr.zip")  # alone: only that it is whole is known
    assert (store.state, store.progress) == ("succeeded", Progress(0.05, 1.0))
    with pytest.raises(NotFound, match="holds no results"):
        jointplay.load("/nowhere")
    with pytest.raises(FileExistsError):
        jointplay.run("slider-crank", output=job.id, **CRANK)


def test_what_cannot_be_is_refused_as_by_a_service(job, study):
    refusals = (
        (lambda: jointplay.run("slider-crank", clearence=1e-4, duration=1), "did you mean"),
        (lambda: jointplay.run("slider-crank"), "duration"),
        (lambda: job.window("displacment"), "did you mean displacement"),
        (lambda: job.window(start=2.0, stop=1.0), "swap them"),
        (lambda: job.window(start=0.01, stop=math.nan), "stop is not a number"),
        (lambda: job.window(start=0.01, stop=math.nan, points=4), "stop is not a number"),
        (lambda: job.window(start=math.nan, step=0.01), "start is not a number"),
        (lambda: job.results.peaks(start=math.nan), "start is not a number"),
        (lambda: job.window(points=0), "at least 1"),
        (lambda: study.figure("section", start=20), "points 0 to 19"),
    )
    for ask, words in refusals:
        with pytest.raises((Refused, TypeError), match=words):
            ask()
    for ask in (
        lambda: job.figure("obrit"),
        lambda: study.certificate,
        lambda: job.points,
        lambda: study.history,
        lambda: study.window("P.eccentricity_x"),
    ):
        with pytest.raises(NotFound):
            ask()
    for asked, name, kinds in (
        (job, "accuracy", "accuracy-study"),
        (job, "attractors", "basins or basin-stability"),
        (study, "branch", "continuation"),
        (study, "statistics", "simulate"),
    ):
        with pytest.raises(NotFound, match=f"has no {name}; jobs of kind {kinds} do"):
            getattr(asked, name)


def test_a_run_that_fails_raises_and_keeps_what_it_computed():
    with pytest.raises(JobFailed, match="larger tolerance") as caught:
        jointplay.run(
            "seven-bar-press",
            clearance=5e-4,
            friction=1.0,
            duration=0.05,
            tolerance=1e-13,
            static_velocity=1e-12,
            dynamic_velocity=1e-12,
        )
    failed = caught.value.job
    assert failed.error.error_class == "solver"
    assert not failed.window("displacement").complete
    assert jointplay.load(failed.id).error == failed.error


def test_a_script_without_a_guard_runs_a_study_on_several_processes(tmp_path):
    script = tmp_path / "script.py"
    script.write_text(
        "import jointplay\n"
        "from jointplay.worker.local import study\n"
        "study._LOOK = study._BEGINNING = 0.0\n"
        "print('once')\n"
        "sweep = jointplay.jobs.sweep('slider-crank', {'clearance': [1e-4] * 16}, periods=0.1)\n"
        "job = jointplay.run(sweep, processes=2)\n"
        "print(job.id, len(job.points))\n"
    )
    ended = subprocess.run([sys.executable, script], capture_output=True, text=True)
    assert ended.returncode == 0, ended.stderr
    once, told = ended.stdout.splitlines()
    folder, points = told.split()
    assert (once, points) == ("once", "16")
    assert not os.path.exists(folder)  # a temporary one goes with the process


def test_a_run_in_a_thread_computes_the_same(job):
    found = []
    thread = threading.Thread(target=lambda: found.append(jointplay.run("slider-crank", **CRANK)))
    thread.start()
    thread.join()
    assert found[0].window()["displacement"].tobytes() == job.window()["displacement"].tobytes()


def test_importing_loads_no_compiler_and_no_queue():
    program = (
        "import sys, json, jointplay, jointplay.client, jointplay.local, jointplay.jobs\n"
        "jointplay.Client, jointplay.run\n"
        "print(json.dumps([m for m in ('numba', 'celery', 'matplotlib', 'pandas', 'xarray')"
        " if m in sys.modules]))\n"
    )
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert json.loads(ended.stdout) == [], ended.stderr


def test_a_calibration_that_fits_nothing_fails_and_says_what_to_try(tmp_path):
    targets = [{"channel": "bearing.normal_force", "to": 0.3, "value": 1000.0}]
    described = jobs.calibration(
        "bouncing-journal",
        {"restitution": {"minimum": 0.5, "maximum": 1.0}},
        [{"targets": targets}],
        search={"generations": 1, "population": 4, "most_steps": 100},
    )
    with pytest.raises(JobFailed, match="Narrow the bounds"):
        jointplay.run(described, output=tmp_path / "OUT")
