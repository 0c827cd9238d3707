"""Runs that were cut short go on to the bits of a run in one piece, however they were cut."""

import copy
import errno
import json
import math
import os
import shutil
import signal
import subprocess
import sys
from contextlib import contextmanager

import pytest
import zarr

import jointplay
from jointplay import jobs
from jointplay.client import JobCancelled, JobFailed, NotFound
from jointplay.records.failure import InvalidInput
from jointplay.solver.kinds import admit, parse
from jointplay.storage import durable
from jointplay.storage.results.comparison import compared_arrays, differing_attributes
from jointplay.worker.local import computing, restart_points, study
from jointplay.worker.local.folder import holding
from tests.waiting import descendants, is_alive, until

CRANK = jobs.simulate("slider-crank", clearance=1e-4, duration=1.0, output_step=1e-4)
CLEARANCES = [1e-4 + 1e-5 * step for step in range(20)]
DIAGRAM = jobs.bifurcation("slider-crank", "clearance", CLEARANCES, settle=3, record=10)
LONG = pytest.mark.long
SIGNALS = [
    signal.SIGTERM,
    *(pytest.param(one, marks=LONG) for one in (signal.SIGINT, signal.SIGHUP)),
]


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The folder of each job's run in one piece."""
    folders = {}
    for job in (CRANK, DIAGRAM):
        folders[job["kind"]] = tmp_path_factory.mktemp("whole") / "OUT"
        jointplay.run(job, output=folders[job["kind"]], processes=1)
    return folders


def begun(job, folder, *, at=0.3, by=signal.SIGTERM, processes=1, admitted=admit):
    """Begin a job, and have a signal end it once a part of it is done."""
    folder.mkdir()

    def report(fraction, note):
        if fraction > at:
            os.kill(os.getpid(), by)

    return computing.compute(admitted(job), folder, processes, report)


def assert_equal(folder, other):
    paths = [one / computing.STORE for one in (folder, other)]
    stores = [zarr.open_group(zarr.storage.ZipStore(path), mode="r") for path in paths]
    assert [one.name for one in compared_arrays(*stores) if one.differing] == []
    assert list(differing_attributes(*stores)) == []
    assert not (folder / "running").exists()


@contextmanager
def heard(number):
    """While the block runs a signal ends the process, also where `nohup` has it ignored."""
    before = signal.signal(number, signal.SIG_DFL)
    try:
        yield
    finally:
        signal.signal(number, before)


@pytest.mark.parametrize("number", SIGNALS)
def test_a_signal_ends_a_simulation_which_goes_on_bit_for_bit(number, whole, tmp_path, caplog):
    folder = tmp_path / "OUT"
    with heard(number):
        outcome = begun(CRANK, folder, by=number)
    assert (outcome.state, 0.3 < outcome.fraction < 1.0) == ("cancelled", True)
    cut = jointplay.load(folder)
    assert cut.state == "cancelled"
    assert cut.history["displacement"].size > 3000
    assert jointplay.resume(folder).state == "succeeded"
    assert "anew" not in caplog.text
    assert_equal(folder, whole["simulate"])
    changed = (folder / computing.STORE).stat().st_mtime_ns
    assert jointplay.resume(folder).state == "succeeded"  # which had ended: nothing is computed
    assert (folder / computing.STORE).stat().st_mtime_ns == changed


def test_what_an_earlier_version_began_goes_on_though_it_is_refused_today(tmp_path):
    press = jobs.simulate("seven-bar-press", stiffness=1e10, duration=0.25, output_step=1e-4)
    fields = copy.deepcopy(admit(press).job)
    fields["scene"]["parameters"]["youngs_modulus"] = 7e10
    with pytest.raises(InvalidInput):
        admit(fields)
    folder = tmp_path / "OUT"
    assert begun(fields, folder, admitted=parse).state == "cancelled"
    finished = jointplay.resume(folder)
    assert (finished.state, finished.job) == ("succeeded", fields)


@pytest.mark.parametrize("processes", [1, pytest.param(2, marks=LONG)])
def test_a_signal_ends_a_study_which_goes_on_bit_for_bit(processes, whole, tmp_path, caplog):
    folder = tmp_path / "OUT"
    outcome = begun(DIAGRAM, folder, processes=processes)
    assert (outcome.state, outcome.fraction > 0.3) == ("cancelled", True)
    assert jointplay.load(folder).study().counts.sum() > 0
    assert len(admit(DIAGRAM).blocks) > 1
    assert jointplay.resume(folder, processes=1).state == "succeeded"
    assert "anew" not in caplog.text
    assert_equal(folder, whole["bifurcation"])


@pytest.mark.parametrize("beginning", [0.0, math.inf])
def test_processes_begin_for_what_takes_longer_than_they_do(
    beginning, whole, tmp_path, monkeypatch
):
    monkeypatch.setattr(study, "_LOOK", 0.0)
    monkeypatch.setattr(study, "_BEGINNING", beginning)
    seen = set()
    (tmp_path / "OUT").mkdir()
    before = descendants(os.getpid()).keys()

    def report(*_):
        seen.update(descendants(os.getpid()).keys() - before)

    outcome = computing.compute(admit(DIAGRAM), tmp_path / "OUT", 2, report)
    assert (outcome.state, len(seen) > 1) == ("succeeded", beginning == 0.0)
    assert_equal(tmp_path / "OUT", whole["bifurcation"])


@pytest.mark.parametrize(("job", "processes"), [(CRANK, None), (DIAGRAM, 2)], ids=["run", "study"])
def test_a_killed_run_goes_on_from_its_last_restart_point(job, processes, whole, tmp_path):
    folder = tmp_path / "OUT"
    program = (
        "import json, sys, jointplay\n"
        "from jointplay.worker.local import restart_points, study\n"
        "restart_points.PERIOD = restart_points._MOST_OVERHEAD = 0\n"
        "study._LOOK = study._BEGINNING = 0\n"
        "job, folder, processes = sys.argv[1:]\n"
        "jointplay.run(json.loads(job), output=folder, processes=json.loads(processes))\n"
    )
    arguments = [json.dumps(job), str(folder), json.dumps(processes)]
    with subprocess.Popen([sys.executable, "-c", program, *arguments]) as process:
        kept = ("running/block0-*", "running/study/parts/0000?")  # a restart point, a whole block
        until(lambda: process.poll() is not None or any(map(any, map(folder.glob, kept))))
        others = descendants(process.pid)
        process.kill()
    until(lambda: not any(is_alive(pid) for pid in others))
    assert jointplay.load(folder).job == admit(job).job
    assert jointplay.resume(folder, processes=processes).state == "succeeded"
    assert_equal(folder, whole[job["kind"]])


def test_a_full_disk_ends_a_run_which_goes_on_once_there_is_room(whole, tmp_path, monkeypatch):
    folder = tmp_path / "OUT"
    whole_draft, left = durable.draft, [12]

    def filling(path, pieces, **options):
        left[0] -= 1
        if left[0] < 0:
            raise OSError(errno.ENOSPC, "No space left on device")
        return whole_draft(path, pieces, **options)

    monkeypatch.setattr(restart_points, "PERIOD", 0.0)
    monkeypatch.setattr(restart_points, "_MOST_OVERHEAD", 0)
    with monkeypatch.context() as full:
        full.setattr(durable, "draft", filling)
        with pytest.raises((JobFailed, JobCancelled)):
            jointplay.run(CRANK, output=folder)
    assert json.loads((folder / "job.json").read_bytes())["kind"] == "simulate"
    assert jointplay.load(folder).window("displacement").time[-1] > 0.0
    assert jointplay.resume(folder).state == "succeeded"
    assert_equal(folder, whole["simulate"])


def test_a_run_is_computed_by_one_process_at_a_time(tmp_path):
    folder = tmp_path / "OUT"
    begun(CRANK, folder, at=-1.0)
    with holding(folder), pytest.raises(BlockingIOError, match="another process"):
        jointplay.resume(folder)


def test_of_a_folder_what_a_run_left_is_deleted_and_nothing_else(tmp_path):
    folder, store = tmp_path / "OUT", tmp_path / "store.zip"
    job = jointplay.run("pendulum", duration=0.1, output=folder)
    shutil.copy(folder / "results.zarr.zip", store)
    (folder / "figures").mkdir()
    notes = folder / "notes.txt"
    notes.write_text("mine")
    with holding(folder), pytest.raises(BlockingIOError, match="another process"):
        job.delete()
    assert job.results.peaks()
    job.delete()
    assert [*folder.iterdir()] == [notes]
    alone = jointplay.load(store)
    alone.delete()
    assert not store.exists()
    other = jointplay.run("pendulum", duration=0.1, output=tmp_path / "other")
    other.delete()
    assert not (tmp_path / "other").exists()


def test_what_was_begun_by_another_version_begins_anew(whole, tmp_path):
    folder = tmp_path / "OUT"
    begun(CRANK, folder)
    restart = folder / "running" / "block0-1"
    restart.write_bytes(restart.read_bytes()[:-1])
    assert jointplay.resume(folder).state == "succeeded"
    assert_equal(folder, whole["simulate"])


def test_a_signal_that_is_ignored_stays_so(tmp_path):
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        outcome = begun(CRANK | {"duration": 0.02}, tmp_path / "OUT", by=signal.SIGHUP)
    finally:
        signal.signal(signal.SIGHUP, before)
    assert outcome.state == "succeeded"


def test_where_no_run_was_begun_there_is_nothing_to_go_on_with(tmp_path):
    with pytest.raises(NotFound, match="holds no run"):
        jointplay.resume(tmp_path)
