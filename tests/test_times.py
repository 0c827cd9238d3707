"""The report of where the tests' time goes."""

import json
import subprocess
import sys
import time
from dataclasses import asdict
from pathlib import Path

from tests.times import Spent, most_expensive, processor

ROOT = Path(__file__).parents[1]
BUSY = "import time; [None for _ in iter(lambda: time.process_time() < 0.5, False)]"
TESTS = f"""
import pytest, subprocess, sys, time

def test_here():
    begun = time.process_time()
    while time.process_time() < begun + 0.1:
        pass

def test_elsewhere():
    subprocess.run([sys.executable, "-c", {BUSY!r}], check=True)

@pytest.fixture(scope="module")
def shared():
    subprocess.run([sys.executable, "-c", {BUSY!r}], check=True)

def test_first(shared):
    pass

def test_second(shared):
    pass
"""


def test_tests_have_their_processes_and_seconds(tmp_path: Path) -> None:
    (tmp_path / "test_some.py").write_text(TESTS)
    (tmp_path / "test_other.py").write_text("def test_none(): assert True")
    times = tmp_path / "build" / "times.json"
    command = [sys.executable, "-m", "pytest", "-p", "tests.times", "--times", str(times)]
    subprocess.run([*command, str(tmp_path)], check=True, cwd=ROOT, capture_output=True)
    written = json.loads(times.read_text()).items()
    found = {name.rpartition("::")[2]: Spent(**one) for name, one in written}
    here, elsewhere, none = (found[f"test_{name}"] for name in ("here", "elsewhere", "none"))
    assert [(one.tests, one.processes) for one in (here, elsewhere, none)] == [
        (1, 0),
        (1, 1),
        (1, 0),
    ]
    assert here.processor >= 0.1 - 0.02  # clocks of 10 ms
    assert elsewhere.processor >= 0.5 - 0.02
    assert none.processor < here.processor
    assert here.seconds >= 0.1
    assert found["shared"].processor >= 0.5 - 0.02
    assert (found["shared"].tests, found["shared"].processes) == (0, 1)
    assert max(found[f"test_{name}"].processor for name in ("first", "second")) < 0.25


ORPHAN = f"""
import subprocess, sys
import tests.times

CHILD = "import subprocess, sys; subprocess.Popen([sys.executable, '-c', sys.argv[1]]); input()"
parent = subprocess.Popen([sys.executable, "-c", CHILD, {BUSY!r} + "; input()"], stdin=-1)

def test_works():
    before = tests.times.processor()
    while tests.times.processor() < before + 0.5:
        pass

def test_leaves_it():
    parent.kill()
    parent.wait()
"""


def test_what_an_orphan_took_is_taken_from_no_test(tmp_path: Path) -> None:
    """It is no longer among our processes, and its parent has not waited for it."""
    (tmp_path / "test_orphan.py").write_text(ORPHAN)
    times = tmp_path / "times.json"
    command = [sys.executable, "-m", "pytest", "-p", "tests.times", "--times", str(times)]
    subprocess.run([*command, str(tmp_path)], check=True, cwd=ROOT, capture_output=True)
    works, leaves = (Spent(**one).processor for one in json.loads(times.read_text()).values())
    assert works >= 0.5 - 0.02  # clocks of 10 ms
    assert leaves >= 0.0


def test_a_process_that_lives_on_counts_for_the_test_that_makes_it_work() -> None:
    before = processor()
    with subprocess.Popen([sys.executable, "-c", BUSY + "; input()"], stdin=subprocess.PIPE) as one:
        while processor() < before + 0.5:
            time.sleep(0.01)
        assert one.poll() is None


def test_the_most_expensive_come_first_and_all_are_added() -> None:
    names = {2: "test_2.py::a", 10: "test_30.py::a", 20: "test_30.py::b", 4: "test_4.py::a[::]"}
    tests = {name: asdict(Spent(i, 2 * i, 0.0, 1, 1)) for i, name in names.items()}
    head, first, second, total = most_expensive(tests, 2).splitlines()
    assert head.split()[-1] == "file"
    assert first.split() == ["30.0", "60.0", "0.0", "2", "2", "test_30.py"]
    assert second.split()[-1] == "test_4.py"
    assert total.split()[:5] == ["36.0", "72.0", "0.0", "4", "4"]
