"""Figures drawn by two processes are those that one draws, whatever becomes of the second."""

import os
import signal
import subprocess
import sys

import pytest

import jointplay
from jointplay import jobs
from jointplay.local import drawing_process
from jointplay.local.drawing_process import DrawingProcess, draw_all
from jointplay.solver.kinds import admit
from jointplay.storage.packed import pack
from tests.stores import files_of
from tests.waiting import is_alive, until

CRANK = {"clearance": 1e-4, "duration": 0.05}
ON_LINUX = pytest.mark.skipif(sys.platform != "linux", reason="looks at /proc")


@pytest.fixture(scope="module")
def job(tmp_path_factory):
    return jointplay.run("slider-crank", output=tmp_path_factory.mktemp("run") / "OUT", **CRANK)


@pytest.fixture(scope="module")
def alone(job, tmp_path_factory):
    folder = tmp_path_factory.mktemp("alone")
    draw_all(job, folder)
    return contents(folder)


@pytest.fixture
def second():
    drawer = DrawingProcess()
    yield drawer
    drawer.end()


class Drawn:
    """A job that does something first whenever one of its figures is drawn here."""

    def __init__(self, job, before):
        self.id, self.figures = job.id, job.figures
        self._job, self._before = job, before
        self.here = []

    def figure(self, name):
        self.here.append(name)
        self._before()
        return self._job.figure(name)


def contents(folder):
    return {file.name: file.read_bytes() for file in folder.iterdir()}


def test_both_draw_the_same_bytes_as_one_alone(job, alone, second, tmp_path):
    shared = Drawn(job, lambda: until(lambda: len(list(tmp_path.iterdir())) >= len(alone) - 1))
    draw_all(shared, tmp_path, second)
    assert len(alone) == 7
    assert len(shared.here) == 1  # the other one drew the rest
    assert contents(tmp_path) == alone


def test_what_a_killed_drawer_leaves_is_drawn_here(job, alone, second, tmp_path):
    def kill():
        if len(shared.here) == 1:
            until(lambda: len(list(tmp_path.iterdir())) > 1)  # it has drawn one at least
            os.kill(second.pid, signal.SIGKILL)

    shared = Drawn(job, kill)
    draw_all(shared, tmp_path, second)
    assert len(shared.here) < 7
    assert contents(tmp_path) == alone


@ON_LINUX
def test_a_drawer_that_is_gone_before_leaves_all_figures_here(job, alone, second, tmp_path):
    os.kill(second.pid, signal.SIGKILL)
    until(lambda: not is_alive(second.pid))
    draw_all(job, tmp_path, second)
    assert contents(tmp_path) == alone


def test_a_drawer_that_says_nothing_is_not_waited_for(job, alone, second, tmp_path, monkeypatch):
    monkeypatch.setattr(drawing_process, "_LONGEST", 0.1)
    os.kill(second.pid, signal.SIGSTOP)
    draw_all(job, tmp_path, second)
    assert contents(tmp_path) == alone


def test_a_figure_that_cannot_be_drawn_says_why_as_one_alone_does(second, tmp_path):
    broken = jointplay.run("slider-crank", output=tmp_path / "OUT", **CRANK)
    store = tmp_path / "OUT" / "results.zarr.zip"
    files = files_of(store) | {"displacement/c/0": b"no such thing"}
    store.write_bytes(b"".join(pack(files.items())))
    with pytest.raises(Exception, match=r".") as told_alone:
        draw_all(broken, tmp_path / "alone")
    with pytest.raises(Exception, match=r".") as told:
        draw_all(broken, tmp_path / "shared", second)
    assert type(told.value) is type(told_alone.value)
    assert str(told.value) == str(told_alone.value)
    assert set(contents(tmp_path / "shared")) > {"orbit.png", "contact-force.png"}


def test_an_interruption_ends_the_second_process(monkeypatch):
    monkeypatch.setattr(drawing_process, "cores", lambda: 2)
    admission = admit(jobs.simulate("slider-crank", **CRANK))
    with pytest.raises(KeyboardInterrupt), drawing_process.drawing_process(admission) as second:
        raise KeyboardInterrupt
    with pytest.raises(ProcessLookupError):
        os.kill(second.pid, 0)


@ON_LINUX
def test_it_ends_with_the_process_that_started_it():
    program = (
        "import time\n"
        "from jointplay.local.drawing_process import DrawingProcess\n"
        "print(DrawingProcess().pid, flush=True)\n"
        "time.sleep(600)\n"
    )
    with subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE) as process:
        pid = int(process.stdout.readline())
        assert is_alive(pid)
        process.kill()
    until(lambda: not is_alive(pid))


@pytest.mark.parametrize(
    ("document", "cores", "wanted"),
    [
        (jobs.simulate("slider-crank", **CRANK), 2, True),
        (jobs.simulate("slider-crank", **CRANK), 1, False),
        (jobs.simulate("pendulum", duration=1.0), 2, False),
        (jobs.simulate("slider-crank", channels=["displacement"], **CRANK), 2, False),
        (jobs.bifurcation("slider-crank", "clearance", [1e-4, 2e-4], record=3), 2, False),
    ],
    ids=["many figures", "one core", "few figures", "few channels", "a study"],
)
def test_it_is_started_where_it_is_of_use(document, cores, wanted, monkeypatch):
    monkeypatch.setattr(drawing_process, "cores", lambda: cores)
    with drawing_process.drawing_process(admit(document)) as second:
        assert (second is not None) == wanted


def test_a_machine_that_has_no_process_left_draws_alone(monkeypatch):
    def refuse(*arguments, **more):
        raise BlockingIOError

    monkeypatch.setattr(drawing_process, "cores", lambda: 2)
    monkeypatch.setattr(subprocess, "Popen", refuse)
    admission = admit(jobs.simulate("slider-crank", **CRANK))
    with drawing_process.drawing_process(admission) as second:
        assert second is None


def test_it_does_not_wait_for_an_order_for_ever():
    program = (
        "from jointplay.local import drawing_program\n"
        "drawing_program._PATIENCE = 0.1\n"
        "drawing_program.main(0)\n"
    )
    with subprocess.Popen([sys.executable, "-c", program], stdin=subprocess.PIPE) as process:
        assert process.wait() == 0
